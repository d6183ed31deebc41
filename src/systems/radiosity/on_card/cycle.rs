//! Cycle detection: an iteration in finite precision either reaches its tolerance or returns to an earlier state.
//!
//! The digest of every state that is read back is stored. If a digest repeats, the iteration continues until the state
//! repeats, compared bit for bit, because a collision of digests is not a cycle.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hasher as _};

use serde::{Deserialize, Serialize};

use super::{CardError, CardSolver};

/// The state of an iteration: red, green and blue of each patch.
type Radiosities = [[f32; 3]];

/// Cycle of states that repeats bit for bit: the limit of convergence in the card's number format.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cycle {
    /// Iterations until the first state of the cycle.
    pub entered: u32,
    /// Period: the smallest number of iterations after which every bit is equal; 1 is a fixed point.
    pub period: u32,
    /// Maximum number of values (three per patch) that one iteration changes; 0 at a fixed point.
    pub changing: usize,
    /// Largest relative change of a value in one iteration, relative to the larger of both values.
    pub largest_change: f64,
}

impl Cycle {
    /// Returns `true` if no iteration changes a bit.
    pub fn is_fixed_point(&self) -> bool {
        self.period == 1
    }
}

/// Digests of the states read back, each with the iteration of its first occurrence.
#[derive(Debug, Default)]
pub(super) struct StateDigests(BTreeMap<u64, u32>);

impl StateDigests {
    /// Adds a state. Returns the iteration of an earlier state with the same digest, if there is one.
    pub(super) fn note(&mut self, state: &Radiosities, number: u32) -> Option<u32> {
        let first = *self.0.entry(digest(state)).or_insert(number);
        (first < number).then_some(first)
    }
}

fn digest(state: &Radiosities) -> u64 {
    // Its keys are fixed, so that the same states have the same digest in every run.
    let mut hasher = DefaultHasher::new();
    state.iter().flatten().for_each(|value| hasher.write_u32(value.to_bits()));
    hasher.finish()
}

impl CardSolver {
    /// Iterates from `start`, at most `most` times, until it repeats; else resets the card and returns `None`.
    pub(super) fn around(&mut self, start: &Radiosities, entered: u32, most: u32) -> Result<Option<Cycle>, CardError> {
        let mut cycle = Cycle { entered, period: 0, changing: 0, largest_change: 0.0 };
        let mut last = start.to_vec();
        while cycle.period < most {
            self.iterate()?;
            let next = self.read()?;
            let changes = last.iter().flatten().zip(next.iter().flatten()).filter(|(a, b)| a.to_bits() != b.to_bits());
            let (mut changing, mut largest) = (0, cycle.largest_change);
            for (&a, &b) in changes {
                let (a, b) = (f64::from(a), f64::from(b));
                // A change between +0 and -0 changes the bits, but not the value.
                let size = a.abs().max(b.abs()).max(f64::MIN_POSITIVE);
                (changing, largest) = (changing + 1, largest.max((a - b).abs() / size));
            }
            (cycle.changing, cycle.largest_change) = (cycle.changing.max(changing), largest);
            cycle.period += 1;
            if same_bits(&next, start) {
                return Ok(Some(cycle));
            }
            last = next;
        }
        self.load(start)?;
        Ok(None)
    }
}

fn same_bits(a: &Radiosities, b: &Radiosities) -> bool {
    a.iter().zip(b).all(|(a, b)| a.map(f32::to_bits) == b.map(f32::to_bits))
}
