//! The critical path: the spans that determine the total time.

use std::collections::BTreeMap;

use super::{SpanId, SpanKind, Timeline, TimelineSpan, Unit};
use crate::timing::Picoseconds;

/// A segment of the critical path. Segments are contiguous: the first starts at 0, the last ends with the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Segment {
    /// The span; for [`SpanKind::Fill`], the span whose end starts the pipeline fill, if any.
    pub span: Option<SpanId>,
    /// The busy unit; the front end for pipeline fills.
    pub unit: Unit,
    /// Kind of work.
    pub kind: SpanKind,
    /// Start time.
    pub start: Picoseconds,
    /// End time.
    pub end: Picoseconds,
}

impl Segment {
    /// Duration.
    pub fn duration(&self) -> Picoseconds {
        self.start.until(self.end)
    }
}

/// Time on the critical path that one unit spends on one kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathShare {
    /// The busy unit.
    pub unit: Unit,
    /// Kind of work.
    pub kind: SpanKind,
    /// Number of segments.
    pub segments: u64,
    /// Total duration.
    pub time: Picoseconds,
}

impl Timeline {
    /// The critical path from start to end; each segment depends on the previous one. Durations sum to
    /// [`Timeline::makespan`].
    ///
    /// Ties prefer the unit's own previous span, then program order.
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

    /// The critical path aggregated by unit and kind, longest first. Times sum to [`Timeline::makespan`].
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
