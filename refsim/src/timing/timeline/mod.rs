//! The timeline: spans and waits of every unit.

mod path;
mod usage;

use std::sync::Arc;

pub use path::{PathShare, Segment};
pub use usage::Usage;

use strum::Display;

use super::Picoseconds;

/// The text of a span: the name of a draw, of an upload, of host work. Shared by the spans of one command.
pub type Label = Arc<str>;

/// A unit of host, card or bus. Each does one thing at a time.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Display)]
#[strum(serialize_all = "lowercase")]
pub enum Unit {
    /// The host's processor: its own work, and what it spends on giving commands.
    Host,
    /// Host to card.
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
    /// Card to host.
    #[strum(to_string = "read-back bus")]
    ReadBackBus,
}

impl Unit {
    /// All units, in the order in which work passes them.
    pub const ALL: [Self; 6] =
        [Self::Host, Self::UploadBus, Self::FrontEnd, Self::ShaderArray, Self::Memory, Self::ReadBackBus];

    /// The place in [`Unit::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Whether the unit is part of the card, rather than the host or a bus.
    pub const fn on_card(self) -> bool {
        matches!(self, Self::FrontEnd | Self::ShaderArray | Self::Memory)
    }
}

/// The kind of work of a span.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Display)]
#[strum(serialize_all = "lowercase")]
pub enum SpanKind {
    /// The host's own work.
    #[strum(to_string = "host work")]
    HostWork,
    /// The host gives a command to the card, or asks for a fence.
    Submit,
    /// Data go to the card.
    Upload,
    /// The card changes its state.
    State,
    /// The card clears a surface.
    Clear,
    /// Commands, vertices and set-up of a draw.
    Vertices,
    /// The pipeline fills and drains; takes time but keeps no unit busy, so that it is found on the critical path
    /// alone.
    #[strum(to_string = "pipeline fill")]
    Fill,
    /// Fragments of a draw.
    Fragments,
    /// Memory traffic of a draw.
    #[strum(to_string = "memory traffic")]
    Traffic,
    /// Data come from the card.
    #[strum(to_string = "read-back")]
    ReadBack,
}

/// The place of a span in [`Timeline::spans`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SpanId(pub u32);

/// A unit busy with one thing. Never of no length.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TimelineSpan {
    /// The unit.
    pub unit: Unit,
    /// Its start.
    pub start: Picoseconds,
    /// Its end.
    pub end: Picoseconds,
    /// With what.
    pub kind: SpanKind,
    /// For people.
    pub label: Label,
    /// The command that it belongs to, counted from 0 in the order of the program; host work counts too.
    pub command: u32,
    /// The span that it waited for last: the end of that one, and [`TimelineSpan::latency`], is the start of this one.
    /// `None` where nothing had to end before.
    pub after: Option<SpanId>,
    /// Time between the two in which the pipeline filled or drained.
    pub latency: Picoseconds,
}

impl TimelineSpan {
    /// Its length.
    pub fn duration(&self) -> Picoseconds {
        self.start.until(self.end)
    }
}

/// Why a unit waits that has something to do.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Display)]
#[strum(serialize_all = "lowercase")]
pub enum WaitReason {
    /// The host: the command queue is full.
    #[strum(to_string = "queue full")]
    QueueFull,
    /// The host: a fence.
    Fence,
    /// The host: a read-back that it asked to be synchronous.
    #[strum(to_string = "read-back")]
    Transfer,
    /// The host: everything that it has asked for.
    Finish,
    /// The resource is still being read, written, sent or fetched.
    #[strum(to_string = "resource in use")]
    Hazard,
    /// Commands before this one are not done.
    #[strum(to_string = "earlier commands")]
    Order,
    /// The units before it in the pipeline have sent nothing yet.
    #[strum(to_string = "earlier stages")]
    Input,
}

/// A unit that has something to do but can't. Never of no length, never beside a span of the same unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wait {
    /// The unit.
    pub unit: Unit,
    /// Its start.
    pub start: Picoseconds,
    /// Its end.
    pub end: Picoseconds,
    /// The reason.
    pub reason: WaitReason,
    /// For which span, `None` for the filling of the pipeline with nothing before it.
    pub on: Option<SpanId>,
    /// The command that waits.
    pub command: u32,
}

impl Wait {
    /// Its length.
    pub fn duration(&self) -> Picoseconds {
        self.start.until(self.end)
    }
}

/// A moment, and what made it so: the end of a span, and perhaps some latency.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(in crate::timing) struct Mark {
    pub(in crate::timing) time: Picoseconds,
    pub(in crate::timing) after: Option<SpanId>,
    pub(in crate::timing) latency: Picoseconds,
}

impl Mark {
    /// The later of two; `self` of two at the same time.
    pub(in crate::timing) fn or_later(self, other: Self) -> Self {
        if other.time > self.time { other } else { self }
    }

    /// As much later.
    pub(in crate::timing) fn plus(self, latency: Picoseconds) -> Self {
        Self { time: self.time + latency, latency: self.latency + latency, ..self }
    }
}

/// A run on the time axis: spans in the order of the commands, and waits. Deterministic: the same commands give an
/// equal timeline.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Timeline {
    pub(in crate::timing) spans: Vec<TimelineSpan>,
    pub(in crate::timing) waits: Vec<Wait>,
    pub(in crate::timing) end: Mark,
}

impl Timeline {
    /// What the units did. The spans of one unit come in the order of time.
    pub fn spans(&self) -> &[TimelineSpan] {
        &self.spans
    }

    /// What they waited for. The waits of one unit come in the order of time.
    pub fn waits(&self) -> &[Wait] {
        &self.waits
    }

    /// One span.
    pub fn span(&self, id: SpanId) -> Option<&TimelineSpan> {
        self.spans.get(id.0 as usize)
    }

    /// From the start to the end of everything: the host's work and what it asked for.
    pub fn makespan(&self) -> Picoseconds {
        self.end.time
    }

    /// Time that a unit is busy.
    pub fn busy(&self, unit: Unit) -> Picoseconds {
        self.spans.iter().filter(|span| span.unit == unit).map(TimelineSpan::duration).sum()
    }
}
