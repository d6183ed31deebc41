//! Tests the command queue: worked examples, exact to the picosecond, and properties of every list of commands.

mod examples;
mod host;
mod laws;
mod replay;

use refsim::timing::queue::{Fence, Queue, QueueFigures, ReadBackMode, ResourceCopy, ResourceId};
use refsim::timing::timeline::{Timeline, Unit};
use refsim::timing::{DrawCost, Picoseconds};

/// Cost of a draw: front end, shader, memory, and pipeline fill.
fn cost(front_end: u64, shader: u64, memory: u64, fill: u64) -> DrawCost {
    DrawCost {
        front_end: Picoseconds(front_end),
        shader: Picoseconds(shader),
        memory: Picoseconds(memory),
        total: Picoseconds(front_end.max(shader).max(memory) + fill),
        ..DrawCost::default()
    }
}

/// Commands are free and the queue is long.
fn free() -> QueueFigures {
    QueueFigures::default().without_overhead()
}

/// Spans of a unit, as pairs of start and end.
fn spans(timeline: &Timeline, unit: Unit) -> Vec<(u64, u64)> {
    timeline.spans().iter().filter(|span| span.unit == unit).map(|span| (span.start.0, span.end.0)).collect()
}

/// A command of an artificial program; resources are 0 to 3.
#[derive(Clone, Debug)]
enum Command {
    Host(u64),
    Upload(u64, u64),
    State(u64),
    Clear(u64, u64),
    Draw {
        reads: Vec<u64>,
        writes: Vec<u64>,
        cost: [u64; 4],
    },
    ReadBack(u64, u64),
    /// Waits for the last fence, if any.
    Finish,
}

impl Command {
    /// The command with durations multiplied by `by`.
    fn scaled(&self, by: u64) -> Self {
        match self.clone() {
            Self::Host(time) => Self::Host(time * by),
            Self::Upload(resource, time) => Self::Upload(resource, time * by),
            Self::State(time) => Self::State(time * by),
            Self::Clear(resource, time) => Self::Clear(resource, time * by),
            Self::Draw { reads, writes, cost } => Self::Draw { reads, writes, cost: cost.map(|time| time * by) },
            Self::ReadBack(resource, time) => Self::ReadBack(resource, time * by),
            other => other,
        }
    }

    /// The command on an infinitely fast card; times of the buses and the host are unchanged.
    fn on_infinitely_fast_card(&self) -> Self {
        match self {
            Self::State(_) | Self::Clear(..) | Self::Draw { .. } => self.scaled(0),
            other => other.clone(),
        }
    }
}

fn texture(name: u64) -> ResourceCopy {
    ResourceId::Texture(name as usize).into()
}

fn textures(names: &[u64]) -> Vec<ResourceCopy> {
    names.iter().map(|name| texture(*name)).collect()
}

/// Submits the commands; returns the timeline.
fn play(commands: &[Command], figures: QueueFigures, mode: ReadBackMode) -> Timeline {
    let mut queue = Queue::new(figures);
    let mut fence: Option<Fence> = None;
    for command in commands {
        match command {
            Command::Host(time) => queue.host(Picoseconds(*time), "work"),
            Command::Upload(resource, time) => queue.upload(texture(*resource), Picoseconds(*time), "upload"),
            Command::State(time) => queue.state(Picoseconds(*time), 0, "state"),
            Command::Clear(resource, time) => queue.clear(texture(*resource), Picoseconds(*time), "clear"),
            Command::Draw { reads, writes, cost: [front_end, shader, memory, fill] } => {
                queue.draw(&textures(reads), &textures(writes), cost(*front_end, *shader, *memory, *fill), "draw");
            }
            Command::ReadBack(resource, time) => {
                fence = queue.read_back(texture(*resource), Picoseconds(*time), mode, "read back").or(fence);
            }
            Command::Finish => {
                if let Some(fence) = fence {
                    queue.finish(fence);
                }
            }
        }
    }
    queue.timeline()
}
