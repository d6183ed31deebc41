//! Scheduling: a span starts when its unit is free, its command has arrived and its inputs are done.

use crate::timing::Picoseconds;
use crate::timing::timeline::{Label, Mark, SpanId, SpanKind, Timeline, TimelineSpan, Unit, Wait, WaitReason};

/// Description of a span, without its time.
#[derive(Clone, Debug)]
pub(super) struct SpanWork<'a> {
    pub(super) kind: SpanKind,
    pub(super) label: &'a Label,
    pub(super) command: u32,
}

/// Start and end of scheduled work.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) start: Mark,
    pub(super) end: Mark,
}

/// The timeline so far, and the time at which each unit becomes free.
#[derive(Clone, Debug, Default)]
pub(super) struct Schedule {
    timeline: Timeline,
    free: [Mark; Unit::ALL.len()],
}

impl Schedule {
    /// Time at which the unit has finished all scheduled work.
    pub(super) fn free(&self, unit: Unit) -> Mark {
        self.free[unit.index()]
    }

    /// Schedules work of `duration` on the unit, after its earlier work. `ready` is when the command reaches the unit.
    ///
    /// Work of zero duration keeps its position in the order, but has no span.
    pub(super) fn place(
        &mut self,
        unit: Unit,
        ready: Mark,
        needs: &[(Mark, WaitReason)],
        duration: Picoseconds,
        work: &SpanWork<'_>,
    ) -> Placed {
        let at_hand = self.free(unit).or_later(ready);
        let mut start = at_hand;
        let mut reason = WaitReason::Order;
        for (need, why) in needs {
            if need.time > start.time {
                (start, reason) = (*need, *why);
            }
        }
        if duration == Picoseconds::ZERO {
            self.free[unit.index()] = start;
            return Placed { start, end: start };
        }
        self.wait(unit, at_hand.time, start, reason, work.command);
        // 2^32 spans do not fit into memory, so the conversion cannot fail.
        let id = SpanId(u32::try_from(self.timeline.spans.len()).unwrap_or(u32::MAX));
        let end = Mark { time: start.time + duration, after: Some(id), latency: Picoseconds::ZERO };
        self.timeline.spans.push(TimelineSpan {
            unit,
            start: start.time,
            end: end.time,
            kind: work.kind,
            label: work.label.clone(),
            command: work.command,
            after: start.after,
            latency: start.latency,
        });
        self.free[unit.index()] = end;
        Placed { start, end }
    }

    /// Blocks the host until `moment`.
    pub(super) fn host_waits(&mut self, moment: Mark, reason: WaitReason, command: u32) {
        let now = self.free(Unit::Host);
        self.wait(Unit::Host, now.time, moment, reason, command);
        self.free[Unit::Host.index()] = now.or_later(moment);
    }

    fn wait(&mut self, unit: Unit, start: Picoseconds, until: Mark, reason: WaitReason, command: u32) {
        if until.time > start {
            self.timeline.waits.push(Wait { unit, start, end: until.time, reason, on: until.after, command });
        }
    }

    /// Returns the timeline; `done` is the end of the card's work.
    pub(super) fn finish(mut self, done: Mark) -> Timeline {
        self.timeline.end = self.free(Unit::Host).or_later(done);
        self.timeline
    }
}
