//! The timeline: spans and waits of every unit.

mod path;
mod usage;

use std::sync::Arc;

pub use path::{PathShare, Segment};
pub use usage::Usage;

use strum::Display;

use super::Picoseconds;

/// Label of a span: the name of a draw, an upload, or host work. Shared by the spans of one command.
pub type Label = Arc<str>;

/// A unit of the host, the card or a bus; it does one piece of work at a time.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Display)]
#[strum(serialize_all = "lowercase")]
pub enum Unit {
    /// The host's processor: its own work, and the submission of commands.
    Host,
    /// The bus from host to card.
    #[strum(to_string = "upload bus")]
    UploadBus,
    /// Command processor, vertex units, triangle set-up.
    #[strum(to_string = "front end")]
    FrontEnd,
    /// The pixel pipelines.
    #[strum(to_string = "shader array")]
    ShaderArray,
    /// The card's memory.
    Memory,
    /// The bus from card to host.
    #[strum(to_string = "read-back bus")]
    ReadBackBus,
}

impl Unit {
    /// All units, in pipeline order.
    pub const ALL: [Self; 6] =
        [Self::Host, Self::UploadBus, Self::FrontEnd, Self::ShaderArray, Self::Memory, Self::ReadBackBus];

    /// Index in [`Unit::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Returns `true` if the unit is part of the card.
    pub const fn on_card(self) -> bool {
        matches!(self, Self::FrontEnd | Self::ShaderArray | Self::Memory)
    }
}

/// Kind of work of a span.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Display)]
#[strum(serialize_all = "lowercase")]
pub enum SpanKind {
    /// The host's own work.
    #[strum(to_string = "host work")]
    HostWork,
    /// Submission of a command or a fence operation by the host.
    Submit,
    /// Transfer to the card.
    Upload,
    /// State change on the card.
    State,
    /// Clear of a surface.
    Clear,
    /// Commands, vertices and set-up of a draw.
    Vertices,
    /// Fill and drain of the pipeline. It takes time but occupies no unit, so it only appears on the critical path.
    #[strum(to_string = "pipeline fill")]
    Fill,
    /// Fragments of a draw.
    Fragments,
    /// Memory traffic of a draw.
    #[strum(to_string = "memory traffic")]
    Traffic,
    /// Transfer from the card.
    #[strum(to_string = "read-back")]
    ReadBack,
}

/// Index of a span in [`Timeline::spans`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SpanId(pub u32);

/// A busy interval of a unit; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TimelineSpan {
    /// The unit.
    pub unit: Unit,
    /// Start time.
    pub start: Picoseconds,
    /// End time.
    pub end: Picoseconds,
    /// Kind of work.
    pub kind: SpanKind,
    /// Label, for display.
    pub label: Label,
    /// Index of the command in program order, from 0; host work counts too.
    pub command: u32,
    /// The dependency that ended last; this span starts [`TimelineSpan::latency`] after that end. `None` if there are
    /// no dependencies.
    pub after: Option<SpanId>,
    /// Latency after the dependency, in which the pipeline fills or drains.
    pub latency: Picoseconds,
}

impl TimelineSpan {
    /// Duration.
    pub fn duration(&self) -> Picoseconds {
        self.start.until(self.end)
    }
}

/// Reason why a unit with pending work waits.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Display)]
#[strum(serialize_all = "lowercase")]
pub enum WaitReason {
    /// The host waits because the command queue is full.
    #[strum(to_string = "queue full")]
    QueueFull,
    /// The host waits for a fence.
    Fence,
    /// The host waits for a synchronous read-back.
    #[strum(to_string = "read-back")]
    Transfer,
    /// The resource is still being read, written or transferred.
    #[strum(to_string = "resource in use")]
    Hazard,
    /// Earlier commands are not finished.
    #[strum(to_string = "earlier commands")]
    Order,
    /// Earlier pipeline stages have not delivered their first output yet.
    #[strum(to_string = "earlier stages")]
    Input,
}

/// An interval in which a unit with pending work waits; never empty, and never overlaps a span of the same unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wait {
    /// The unit.
    pub unit: Unit,
    /// Start time.
    pub start: Picoseconds,
    /// End time.
    pub end: Picoseconds,
    /// The reason.
    pub reason: WaitReason,
    /// The span that is waited for; `None` for a pipeline fill without a predecessor.
    pub on: Option<SpanId>,
    /// The command that waits.
    pub command: u32,
}

impl Wait {
    /// Duration.
    pub fn duration(&self) -> Picoseconds {
        self.start.until(self.end)
    }
}

/// A point in time and its cause: the end of a span, plus latency.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(in crate::timing) struct Mark {
    pub(in crate::timing) time: Picoseconds,
    pub(in crate::timing) after: Option<SpanId>,
    pub(in crate::timing) latency: Picoseconds,
}

impl Mark {
    /// The later of two marks; `self` if they are equal.
    pub(in crate::timing) fn or_later(self, other: Self) -> Self {
        if other.time > self.time { other } else { self }
    }

    /// This mark, `latency` later.
    pub(in crate::timing) fn plus(self, latency: Picoseconds) -> Self {
        Self { time: self.time + latency, latency: self.latency + latency, ..self }
    }
}

/// The timeline of a run: spans in the order of the commands, and waits. The same commands give an equal timeline.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Timeline {
    pub(in crate::timing) spans: Vec<TimelineSpan>,
    pub(in crate::timing) waits: Vec<Wait>,
    pub(in crate::timing) end: Mark,
}

impl Timeline {
    /// All spans; the spans of each unit are in order of time.
    pub fn spans(&self) -> &[TimelineSpan] {
        &self.spans
    }

    /// All waits; the waits of each unit are in order of time.
    pub fn waits(&self) -> &[Wait] {
        &self.waits
    }

    /// Returns a span.
    pub fn span(&self, id: SpanId) -> Option<&TimelineSpan> {
        self.spans.get(id.0 as usize)
    }

    /// Duration of the run, until the host and all submitted work are done.
    pub fn makespan(&self) -> Picoseconds {
        self.end.time
    }

    /// Total busy time of a unit.
    pub fn busy(&self, unit: Unit) -> Picoseconds {
        self.spans.iter().filter(|span| span.unit == unit).map(TimelineSpan::duration).sum()
    }
}
