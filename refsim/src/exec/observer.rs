//! Observers of program execution: executed instructions and texture reads.

use crate::isa::Mask;
use crate::num::Flags;
use crate::texture::Lod;

/// One instruction executed by one lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Index of the instruction in the program.
    pub instruction: usize,
    /// Lane of the quad: 0 to 3 for (0, 0), (1, 0), (0, 1), (1, 1).
    pub lane: usize,
    /// Components written; none for instructions without a destination register.
    pub mask: Mask,
    /// Values written, as patterns of the register format; components outside the mask are undefined.
    pub value: [u32; 4],
    /// Exceptions raised by the instruction; for a co-issued pair, the first step has the exceptions of both
    /// instructions.
    pub flags: Flags,
}

/// A read of a bound texture by a covered lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextureRead {
    /// The sampler.
    pub sampler: usize,
    /// Coordinates, as single-precision patterns.
    pub coordinates: [u32; 4],
    /// Level of detail.
    pub lod: Lod,
}

/// Observer of an executor. The default does nothing at no cost.
pub trait Observer {
    /// Enables calls of [`Self::executed`].
    const ACTIVE: bool = true;
    /// Enables calls of [`Self::reads`].
    const READS: bool = false;

    /// Called when a lane has executed an instruction.
    fn executed(&mut self, step: &Step);

    /// Called when a covered lane reads a bound texture: in program order, then in lane order.
    fn reads(&mut self, _: &TextureRead) {}
}

/// Observer that does nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    const ACTIVE: bool = false;

    fn executed(&mut self, _: &Step) {}
}

/// Records the steps of one lane, in order of execution.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// The observed lane.
    pub lane: usize,
    /// Its steps.
    pub steps: Vec<Step>,
}

impl Trace {
    /// Creates an empty trace of a lane.
    pub fn of_lane(lane: usize) -> Self {
        Self { lane, steps: Vec::new() }
    }
}

impl Observer for Trace {
    fn executed(&mut self, step: &Step) {
        if step.lane == self.lane {
            self.steps.push(*step);
        }
    }
}
