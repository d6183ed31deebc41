//! A timeline as a trace for a viewer.

use refsim::device::Profile;
use refsim::timing::timeline::{Segment, SpanKind, Timeline, Unit};
use serde_json::{Map, Value, json};

use crate::report::trace::{Arrow, Slice, Trace};

/// Spans and waits on a lane per unit, arrows where the critical path goes from one to another. `model` made the
/// timeline of what `what` names.
pub fn trace(profile: &Profile, model: &str, what: &str, timeline: &Timeline) -> Trace {
    let spans = timeline.spans().iter().map(|span| Slice {
        lane: span.unit.index(),
        name: span.label.to_string(),
        category: span.kind.to_string(),
        start: span.start.0,
        duration: span.duration().0,
        details: details([("kind", json!(span.kind.to_string())), ("command", json!(span.command))]),
    });
    let waits = timeline.waits().iter().map(|wait| {
        let on = wait.on.and_then(|id| timeline.span(id)).map(|span| format!("{}: {}", span.unit, span.label));
        Slice {
            lane: wait.unit.index(),
            name: format!("waits: {}", wait.reason),
            category: "wait".to_owned(),
            start: wait.start.0,
            duration: wait.duration().0,
            details: details([("on", json!(on)), ("command", json!(wait.command))]),
        }
    });
    Trace {
        title: format!("{} ({model} model): {what}", profile.title),
        lanes: Unit::ALL.iter().map(ToString::to_string).collect(),
        slices: spans.chain(waits).collect(),
        arrows: arrows(&timeline.critical_path()),
        about: details([
            ("device", json!(profile.name)),
            ("model", json!(model)),
            ("makespan_ps", json!(timeline.makespan().0)),
            ("version", json!(env!("CARGO_PKG_VERSION"))),
        ]),
    }
}

/// From each span of the path to the next one that is on another unit.
fn arrows(path: &[Segment]) -> Vec<Arrow> {
    let spans: Vec<&Segment> = path.iter().filter(|segment| segment.kind != SpanKind::Fill).collect();
    let arrow = |pair: &[&Segment]| Arrow {
        from: (pair[0].unit.index(), pair[0].start.0),
        to: (pair[1].unit.index(), pair[1].start.0),
    };
    spans.windows(2).filter(|pair| pair[0].unit != pair[1].unit).map(arrow).collect()
}

fn details<const N: usize>(entries: [(&str, Value); N]) -> Map<String, Value> {
    entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}
