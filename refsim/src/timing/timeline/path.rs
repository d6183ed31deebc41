//! The critical path: the spans that the total time depends on.

use std::collections::BTreeMap;

use super::{SpanId, SpanKind, Timeline, TimelineSpan, Unit};
use crate::timing::Picoseconds;

/// A piece of the critical path. Each begins where the one before it ends, the first at 0, the last ends with the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Segment {
    /// The span, or the one after whose end the pipeline fills ([`SpanKind::Fill`]), if there is one.
    pub span: Option<SpanId>,
    /// The busy unit; the front end, while the pipeline fills.
    pub unit: Unit,
    /// With what.
    pub kind: SpanKind,
    /// From when.
    pub start: Picoseconds,
    /// Until when.
    pub end: Picoseconds,
}

impl Segment {
    /// How long it lasts.
    pub fn duration(&self) -> Picoseconds {
        self.start.until(self.end)
    }
}

/// A part of the critical path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathShare {
    /// The busy unit.
    pub unit: Unit,
    /// With what.
    pub kind: SpanKind,
    /// How often.
    pub segments: u64,
    /// How long in all.
    pub time: Picoseconds,
}

impl Timeline {
    /// From the start to the end, each piece waiting for the one before it. The lengths sum to [`Timeline::makespan`].
    ///
    /// Where two things ended at once, the path takes the unit's own last span first, then what was first in the
    /// program.
    pub fn critical_path(&self) -> Vec<Segment> {
        let mut path = Vec::new();
        let (mut end, mut after, mut latency) = (self.end.time, self.end.after, self.end.latency);
        loop {
            if latency > Picoseconds::ZERO {
                let start = end - latency;
                path.push(Segment { span: after, unit: Unit::FrontEnd, kind: SpanKind::Fill, start, end });
            }
            let Some((id, span)) = after.and_then(|id| Some((id, self.span(id)?))) else { break };
            let TimelineSpan { unit, kind, start, .. } = *span;
            path.push(Segment { span: Some(id), unit, kind, start, end: span.end });
            (end, after, latency) = (start, span.after, span.latency);
        }
        path.reverse();
        path
    }

    /// Where the time went: the critical path by unit and kind, the longest first. The times sum to
    /// [`Timeline::makespan`].
    pub fn where_the_time_went(&self) -> Vec<PathShare> {
        let mut shares: BTreeMap<(Unit, SpanKind), (u64, Picoseconds)> = BTreeMap::new();
        for segment in self.critical_path() {
            let share = shares.entry((segment.unit, segment.kind)).or_default();
            share.0 += 1;
            share.1 += segment.duration();
        }
        let share = |((unit, kind), (segments, time))| PathShare { unit, kind, segments, time };
        let mut shares: Vec<PathShare> = shares.into_iter().map(share).collect();
        shares.sort_by_key(|share| std::cmp::Reverse(share.time));
        shares
    }
}
