//! Export of a timeline as a trace for a viewer.

use refsim::device::Profile;
use refsim::event::Event;
use refsim::timing::replay::{Options, ReplayError, replay};
use refsim::timing::timeline::{Segment, SpanKind, Timeline, Unit};
use refsim::timing::{Level, Model, TimingError};
use serde_json::{Map, Value, json};

use crate::report::not_encoded;
use crate::report::trace::{Arrow, Slice, Trace};
use crate::study::StudyError;
use crate::study::error::library_errors;

library_errors! {
    ReplayError;
}

/// Encodes the timeline of a log in the pipeline model as a trace; `None` for devices without timing. `what` names the
/// log.
pub fn file(profile: &Profile, log: &[Event], what: &str) -> Result<Option<Vec<u8>>, StudyError> {
    let model = match Model::new(Level::Pipeline, profile) {
        Ok(model) => model,
        Err(TimingError::Missing { .. }) => return Ok(None),
        Err(error) => return Err(StudyError::coded("timeline::timing", error)),
    };
    let replayed = replay(log, &model, &Options::of(Level::Pipeline))?;
    let mut bytes = Vec::new();
    let trace = trace(profile, "pipeline", what, &replayed.timeline);
    trace.write(&mut bytes).map_err(|error| not_encoded("JSON", error))?;
    Ok(Some(bytes))
}

/// Builds a trace with spans and waits on one lane per unit, and arrows where the critical path changes units. `model`
/// is the timing model, `what` names the log.
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

/// Returns the arrows from each span of the path to the next one on another unit.
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
