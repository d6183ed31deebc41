//! How well each unit is used.

use super::{Timeline, Unit, WaitReason};
use crate::timing::Picoseconds;

/// What became of a unit's time. The three sum to [`Timeline::makespan`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Usage {
    /// Which unit.
    pub unit: Unit,
    /// It works.
    pub busy: Picoseconds,
    /// It has something to do but can't.
    pub waiting: Picoseconds,
    /// It has nothing to do.
    pub idle: Picoseconds,
    /// What it waits for, in the order of [`WaitReason`]; the times sum to `waiting`.
    pub reasons: Vec<(WaitReason, Picoseconds)>,
}

impl Timeline {
    /// What became of the time of each unit, in the order of [`Unit::ALL`].
    pub fn usage(&self) -> Vec<Usage> {
        Unit::ALL.into_iter().map(|unit| self.usage_of(unit)).collect()
    }

    fn usage_of(&self, unit: Unit) -> Usage {
        let mut reasons = std::collections::BTreeMap::<WaitReason, Picoseconds>::new();
        for wait in self.waits.iter().filter(|wait| wait.unit == unit) {
            *reasons.entry(wait.reason).or_default() += wait.duration();
        }
        let busy = self.busy(unit);
        let waiting = reasons.values().copied().sum();
        Usage {
            unit,
            busy,
            waiting,
            idle: (busy + waiting).until(self.makespan()),
            reasons: reasons.into_iter().collect(),
        }
    }
}
