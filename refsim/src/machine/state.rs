//! State changes between draws, counted by hashes of the pieces of state.

use super::{DrawCall, VertexSource};
use crate::event::SAMPLERS;
use std::fmt::{self, Write as _};

/// One hash per piece of state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct StateMarks(Vec<u64>);

impl StateMarks {
    /// The state that a call brings.
    pub(super) fn of(call: &DrawCall<'_>) -> Self {
        let mut marks = Vec::with_capacity(SAMPLERS + 14);
        marks.extend(call.samplers.iter().map(mark));
        marks.push(mark(crate::exec::program(call.pixel_program)));
        marks.push(mark(call.pixel_constants));
        match &call.vertices {
            VertexSource::Transformed(_) => marks.extend([0, 0, 0]),
            VertexSource::Program { program, constants, streams } => {
                let layout: Vec<_> = streams.streams.iter().map(|s| (s.register, s.step)).collect();
                marks.extend([mark(crate::exec::program(program)), mark(constants), mark(&layout)]);
            }
        }
        marks.extend([mark(&call.targets), mark(&call.depth_buffer), mark(&call.depth), mark(&call.alpha_test)]);
        marks.extend([mark(&call.blend), mark(&call.masks), mark(&(call.bump, call.projections))]);
        marks.push(mark(&(call.viewport, call.scissor, call.center, call.clip_space, call.cull, call.flat)));
        Self(marks)
    }

    /// How many pieces differ from `last`; before the first draw, from a state in which no piece is set.
    pub(super) fn changes_from(&self, last: Option<&Self>) -> u32 {
        let Some(last) = last else { return self.0.len() as u32 };
        self.0.iter().zip(&last.0).filter(|(a, b)| a != b).count() as u32
    }
}

/// The hash of a value: FNV-1a of its debug text, the same on every computer.
fn mark(value: &(impl fmt::Debug + ?Sized)) -> u64 {
    let mut hash = Fnv(0xcbf2_9ce4_8422_2325);
    // The writer never fails.
    let _ = write!(hash, "{value:?}");
    hash.0
}

struct Fnv(u64);

impl fmt::Write for Fnv {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}
