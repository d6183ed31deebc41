//! Counts of wrong hits by the aim of the rays.

use std::collections::BTreeMap;
use std::fmt;

use super::disagreement::DisagreementKind;
use super::hard::{Aim, JudgedRay};
use super::report::Report;

/// Number of wrong hits of each kind among the rays of each [`Aim`]. Displays as a table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct AimCounts {
    rows: BTreeMap<Aim, AimRow>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct AimRow {
    rays: usize,
    counts: BTreeMap<DisagreementKind, usize>,
}

impl Report {
    /// Counts the wrong hits by aim. `rays` are the rays that were judged, in the same order; those without an aim are
    /// not counted.
    pub fn by_aim<R: JudgedRay>(&self, rays: &[R]) -> AimCounts {
        let mut counts = AimCounts::default();
        for aim in rays.iter().filter_map(JudgedRay::aim) {
            counts.rows.entry(aim).or_default().rays += 1;
        }
        for wrong in self.disagreements() {
            let aim = rays.get(wrong.ray).and_then(JudgedRay::aim);
            let Some(row) = aim.and_then(|aim| counts.rows.get_mut(&aim)) else { continue };
            *row.counts.entry(wrong.kind).or_default() += 1;
        }
        counts
    }

    /// The report, and a table of its counts by aim if the rays have aims.
    pub(crate) fn with_aims<R: JudgedRay>(&self, rays: &[R]) -> String {
        let counts = self.by_aim(rays);
        if counts.rows.is_empty() { self.to_string() } else { format!("{self}\n\n{counts}") }
    }
}

impl AimCounts {
    /// Number of rays of an aim.
    pub fn rays(&self, aim: Aim) -> usize {
        self.rows.get(&aim).map_or(0, |row| row.rays)
    }

    /// Number of wrong hits of one kind among the rays of an aim.
    pub fn count(&self, aim: Aim, kind: DisagreementKind) -> usize {
        self.rows.get(&aim).and_then(|row| row.counts.get(&kind).copied()).unwrap_or(0)
    }

    /// Number of leaks among the rays of an aim.
    pub fn leaks(&self, aim: Aim) -> usize {
        DisagreementKind::ALL.into_iter().filter(|kind| kind.is_leak()).map(|kind| self.count(aim, kind)).sum()
    }
}

impl fmt::Display for AimCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let occurs = |kind: &DisagreementKind| self.rows.keys().any(|&aim| self.count(aim, *kind) > 0);
        let kinds: Vec<DisagreementKind> = DisagreementKind::ALL.into_iter().filter(occurs).collect();
        write!(f, "| aim | rays |")?;
        kinds.iter().try_for_each(|kind| write!(f, " {kind} |"))?;
        write!(f, "\n|---|---|{}", "---|".repeat(kinds.len()))?;
        for (aim, row) in &self.rows {
            write!(f, "\n| {aim} | {} |", row.rays)?;
            kinds.iter().try_for_each(|&kind| write!(f, " {} |", self.count(*aim, kind)))?;
        }
        Ok(())
    }
}
