//! Observers of a running program: executed instructions and texture reads.

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
    /// What was written, patterns of the register format; components outside the mask mean nothing.
    pub value: [u32; 4],
    /// Exceptions raised by the instruction's arithmetic: both instructions' for the first of a co-issued pair.
    pub flags: Flags,
}

/// One read of a bound texture by one covered lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextureRead {
    /// The sampler.
    pub sampler: usize,
    /// Where, single precision patterns.
    pub coordinates: [u32; 4],
    /// Level of detail.
    pub lod: Lod,
}

/// Called for every instruction that an executor runs. The default does nothing and costs nothing.
pub trait Observer {
    /// Whether [`Self::executed`] is called at all.
    const ACTIVE: bool = true;
    /// Whether [`Self::reads`] is called at all.
    const READS: bool = false;

    /// A lane has executed an instruction.
    fn executed(&mut self, step: &Step);

    /// A covered lane reads a bound texture: instruction by instruction, lane by lane.
    fn reads(&mut self, _: &TextureRead) {}
}

/// Observes nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    const ACTIVE: bool = false;

    fn executed(&mut self, _: &Step) {}
}

/// Keeps the steps of one lane, in the order they ran.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// The observed lane.
    pub lane: usize,
    /// Its steps.
    pub steps: Vec<Step>,
}

impl Trace {
    /// An empty trace of a lane.
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
