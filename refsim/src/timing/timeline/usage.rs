//! Utilisation of each unit.

use super::{Timeline, Unit, WaitReason};
use crate::timing::Picoseconds;

/// Utilisation of a unit. Busy, waiting and idle time sum to [`Timeline::makespan`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Usage {
    /// The unit.
    pub unit: Unit,
    /// Time with work.
    pub busy: Picoseconds,
    /// Time in which pending work waits.
    pub waiting: Picoseconds,
    /// Time without work.
    pub idle: Picoseconds,
    /// Waiting time by reason, in the order of [`WaitReason`]; sums to `waiting`.
    pub reasons: Vec<(WaitReason, Picoseconds)>,
}

impl Timeline {
    /// Utilisation of each unit, in the order of [`Unit::ALL`].
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
