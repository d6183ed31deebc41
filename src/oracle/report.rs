//! All disagreements, to be read.

use std::fmt;

use serde::Serialize;
use serde::ser::{SerializeStruct as _, Serializer};

use super::Tolerance;
use super::disagreement::{Disagreement, DisagreementKind};
use crate::geom::Sides;

/// Disagreements that a text lists.
const LISTED: usize = 10;
/// Disagreements that JSON lists.
const LISTED_IN_JSON: usize = 1000;

/// What the oracle found. As text at most ten disagreements are listed, as JSON at most 1000, the worst first;
/// [`Report::disagreements`] has them all.
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
    /// `[rays, rays that truly hit, hits found]`, and what is wrong in any order.
    pub(super) fn new(
        [rays, surface, hits]: [usize; 3],
        sides: Sides,
        tolerance: Tolerance,
        mut disagreements: Vec<Disagreement>,
    ) -> Self {
        disagreements.sort_by_key(Disagreement::rank);
        Self { rays, surface, hits, sides, tolerance, disagreements }
    }

    /// Rays judged.
    #[must_use]
    pub fn rays(&self) -> usize {
        self.rays
    }

    /// Rays that truly hit something.
    #[must_use]
    pub fn surface(&self) -> usize {
        self.surface
    }

    /// Rays for which a hit was found.
    #[must_use]
    pub fn hits(&self) -> usize {
        self.hits
    }

    /// Whether every answer is right.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.disagreements.is_empty()
    }

    /// Every wrong answer, the worst first: by [`DisagreementKind`], then by the error of t, then by place.
    #[must_use]
    pub fn disagreements(&self) -> &[Disagreement] {
        &self.disagreements
    }

    /// Number of wrong answers of one kind.
    #[must_use]
    pub fn count(&self, kind: DisagreementKind) -> usize {
        self.disagreements.iter().filter(|wrong| wrong.kind == kind).count()
    }

    /// Number of holes seen: [`DisagreementKind::Leak`] and [`DisagreementKind::LeakThrough`].
    #[must_use]
    pub fn leaks(&self) -> usize {
        self.disagreements.iter().filter(|wrong| wrong.kind.is_leak()).count()
    }

    /// The kinds that occur and how often, the worst first.
    pub fn counts(&self) -> impl Iterator<Item = (DisagreementKind, usize)> + '_ {
        DisagreementKind::ALL.into_iter().map(|kind| (kind, self.count(kind))).filter(|&(_, count)| count > 0)
    }

    /// The report of some kinds alone.
    #[must_use]
    pub fn only(self, wanted: impl Fn(DisagreementKind) -> bool) -> Self {
        self.retain(|wrong| wanted(wrong.kind))
    }

    /// The report of some disagreements alone.
    #[must_use]
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

impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let counts: std::collections::BTreeMap<DisagreementKind, usize> = self.counts().collect();
        let listed = &self.disagreements[..self.disagreements.len().min(LISTED_IN_JSON)];
        let sides = match self.sides {
            Sides::Front => "front",
            Sides::Both => "both",
        };
        let mut out = serializer.serialize_struct("Report", 8)?;
        out.serialize_field("rays", &self.rays)?;
        out.serialize_field("surface", &self.surface)?;
        out.serialize_field("hits", &self.hits)?;
        out.serialize_field("sides", sides)?;
        out.serialize_field("tolerance", &self.tolerance)?;
        out.serialize_field("counts", &counts)?;
        out.serialize_field("worst", listed)?;
        out.serialize_field("not_listed", &(self.disagreements.len() - listed.len()))?;
        out.end()
    }
}
