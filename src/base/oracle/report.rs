//! Report of all disagreements.

use std::fmt;

use super::Tolerance;
use super::disagreement::{Disagreement, DisagreementKind};
use crate::geom::Sides;

const LISTED: usize = 10;

/// Result of an oracle. At most ten disagreements are displayed, worst first; [`Report::disagreements`] returns all.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    rays: usize,
    surface: usize,
    hits: usize,
    sides: Sides,
    tolerance: Tolerance,
    disagreements: Vec<Disagreement>,
}

impl Report {
    /// Creates a report from `[rays, rays that hit in exact arithmetic, hits found]` and disagreements in any order.
    pub(super) fn new(
        [rays, surface, hits]: [usize; 3],
        sides: Sides,
        tolerance: Tolerance,
        mut disagreements: Vec<Disagreement>,
    ) -> Self {
        disagreements.sort_by_key(Disagreement::rank);
        Self { rays, surface, hits, sides, tolerance, disagreements }
    }

    /// Number of rays judged.
    pub fn rays(&self) -> usize {
        self.rays
    }

    /// Number of rays that hit something in exact arithmetic.
    pub fn surface(&self) -> usize {
        self.surface
    }

    /// Number of rays for which a hit was found.
    pub fn hits(&self) -> usize {
        self.hits
    }

    /// Returns `true` if every result is correct.
    pub fn agrees(&self) -> bool {
        self.disagreements.is_empty()
    }

    /// The report as an error unless every result is correct.
    pub(super) fn verdict(self) -> Result<(), Box<Self>> {
        if self.agrees() { Ok(()) } else { Err(Box::new(self)) }
    }

    /// Wrong results, worst first: by [`DisagreementKind`], then by the error of t, then by index.
    pub fn disagreements(&self) -> &[Disagreement] {
        &self.disagreements
    }

    /// Number of wrong results of one kind.
    pub fn count(&self, kind: DisagreementKind) -> usize {
        self.disagreements.iter().filter(|wrong| wrong.kind == kind).count()
    }

    /// Number of holes: [`DisagreementKind::Leak`] and [`DisagreementKind::LeakThrough`].
    pub fn leaks(&self) -> usize {
        self.disagreements.iter().filter(|wrong| wrong.kind.is_leak()).count()
    }

    /// Kinds that occur, with their counts, worst first.
    pub fn counts(&self) -> impl Iterator<Item = (DisagreementKind, usize)> + '_ {
        DisagreementKind::ALL.into_iter().map(|kind| (kind, self.count(kind))).filter(|&(_, count)| count > 0)
    }

    /// Returns the report reduced to some kinds.
    pub fn only(self, wanted: impl Fn(DisagreementKind) -> bool) -> Self {
        self.retain(|wrong| wanted(wrong.kind))
    }

    /// Returns the report reduced to some disagreements.
    pub fn retain(mut self, wanted: impl Fn(&Disagreement) -> bool) -> Self {
        self.disagreements.retain(wanted);
        self
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sides = match self.sides {
            Sides::Front => "fronts",
            Sides::Both => "both sides",
        };
        write!(f, "{} of {} rays disagree ({sides}; {}", self.disagreements.len(), self.rays, self.tolerance)?;
        write!(f, "; {} rays truly hit, {} hits found)", self.surface, self.hits)?;
        for (at, (kind, count)) in self.counts().enumerate() {
            write!(f, "{}{kind}: {count}", if at == 0 { "\n  " } else { ", " })?;
        }
        for wrong in self.disagreements.iter().take(LISTED) {
            write!(f, "\n  {wrong}\n    {}", wrong.literal())?;
        }
        match self.disagreements.len().saturating_sub(LISTED) {
            0 => Ok(()),
            more => write!(f, "\n  and {more} more"),
        }
    }
}

impl std::error::Error for Report {}
