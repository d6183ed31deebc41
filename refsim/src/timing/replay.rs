//! Replay of a machine's log on the time axis.

use std::collections::{BTreeMap, BTreeSet};

use super::host::HostModel;
use super::queue::{Fence, Queue, QueueFigures, ResourceCopy};
use super::timeline::Timeline;
use super::{DrawCost, Level, Model, Picoseconds};
use crate::event::{DrawRecord, Event, FenceId, MipmapRecord, ReadBackMode, ResourceId};

/// Durations of a log's events on a card and its bus.
pub trait Costs {
    /// Cost of a draw.
    fn draw(&self, record: &DrawRecord) -> DrawCost;
    /// Cost of generating a texture's mip levels.
    fn mipmaps(&self, record: &MipmapRecord) -> DrawCost;
    /// Duration of an upload.
    fn upload(&self, bytes: u64) -> Picoseconds;
    /// Duration of a read-back.
    fn read_back(&self, bytes: u64) -> Picoseconds;
    /// Duration of filling `bytes` with one value.
    fn clear(&self, bytes: u64) -> Picoseconds;
    /// Duration of a state change, including `constants` constants.
    fn state(&self, changes: u32, constants: u32) -> Picoseconds;
}

/// Options of a replay.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options<'a> {
    /// Host cost of commands.
    pub queue: QueueFigures,
    /// Overrides the mode of every read-back. Making all read-backs asynchronous, in a log that never waits for the
    /// data, gives an upper bound on the gain from asynchrony.
    pub read_back: Option<ReadBackMode>,
    /// Gives every resource two copies: uploads and clears overwrite the copy that was not used last.
    pub double_buffered: bool,
    /// Cost of host work. If `None`, host work costs nothing and is counted in [`Replay::uncosted`].
    pub host: Option<&'a HostModel>,
}

impl Options<'_> {
    /// Options for a level of the model. [`Level::Rates`] has no host cost of commands, like equation 11 of the Ray
    /// Engine paper.
    pub fn of(level: Level) -> Self {
        let queue = QueueFigures::default();
        let queue = if level == Level::Rates { queue.without_overhead() } else { queue };
        Self { queue, ..Self::default() }
    }
}

impl Costs for Model {
    fn draw(&self, record: &DrawRecord) -> DrawCost {
        self.draw(record)
    }

    fn mipmaps(&self, record: &MipmapRecord) -> DrawCost {
        self.mipmaps(record)
    }

    fn upload(&self, bytes: u64) -> Picoseconds {
        self.upload(bytes)
    }

    fn read_back(&self, bytes: u64) -> Picoseconds {
        self.read_back(bytes)
    }

    fn clear(&self, bytes: u64) -> Picoseconds {
        self.clear(bytes)
    }

    fn state(&self, changes: u32, constants: u32) -> Picoseconds {
        self.state_change(changes, constants)
    }
}

/// Error of replaying a log: the host waits for a fence that no read-back set. Events are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("event {event}: expected a fence that has been set, found fence {} that was not", fence.0)]
#[diagnostic(code(timing::replay_fence), help("wait for a fence after the read-back that sets it"))]
pub struct ReplayError {
    /// Index of the event that waits for the fence.
    pub event: usize,
    /// The fence.
    pub fence: FenceId,
}

/// Result of a replay.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Replay {
    /// Spans and waits of all units.
    pub timeline: Timeline,
    /// Cost of each draw, in the order of the log.
    pub draws: Vec<DrawCost>,
    /// Cost of each generation of mip levels, in the order of the log.
    pub mipmaps: Vec<DrawCost>,
    /// Number of host operations that cost nothing because there is no host model.
    pub uncosted: u64,
}

/// Replays a log on the time axis.
///
/// ```
/// use refsim::machine::{ExecutorKind, Machine};
/// use refsim::texture::TexelFormat;
/// use refsim::timing::replay::{Options, replay};
/// use refsim::timing::{Level, Model};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let geforce = refsim::device::Profile::named("nv20")?;
/// let model = Model::new(Level::Pipeline, &geforce)?;
/// let mut card = Machine::new(geforce, ExecutorKind::Batch);
/// card.record(true);
/// let target = card.create_target(TexelFormat::Bgra8, 64, 64)?;
/// card.read_back(target)?;
/// let timeline = replay(&card.take_log(), &model, &Options::default())?.timeline;
/// assert!(timeline.makespan() > refsim::timing::Picoseconds::ZERO);
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`ReplayError`] for fences that are not set.
pub fn replay(log: &[Event], costs: &impl Costs, options: &Options<'_>) -> Result<Replay, ReplayError> {
    let mut player = Player {
        queue: Queue::new(options.queue),
        options,
        seconds: BTreeSet::new(),
        fences: BTreeMap::new(),
        found: Replay::default(),
    };
    for (place, event) in log.iter().enumerate() {
        player.play(place, event, costs)?;
    }
    Ok(Replay { timeline: player.queue.timeline(), ..player.found })
}

struct Player<'a> {
    queue: Queue,
    options: &'a Options<'a>,
    /// Resources whose second copy is the current one.
    seconds: BTreeSet<ResourceId>,
    fences: BTreeMap<FenceId, Fence>,
    found: Replay,
}

impl Player<'_> {
    fn play(&mut self, place: usize, event: &Event, costs: &impl Costs) -> Result<(), ReplayError> {
        match event {
            Event::Upload { resource, bytes } => {
                let copy = self.overwritten(*resource);
                self.queue.upload(copy, costs.upload(*bytes), format!("upload {}", name(*resource)));
            }
            Event::StateChange { changes, constants } => {
                let (time, label) = (costs.state(*changes, *constants), format!("{changes} state changes"));
                self.queue.state(time, *constants, label);
            }
            Event::Clear { resource, bytes } => {
                let copy = self.overwritten(*resource);
                self.queue.clear(copy, costs.clear(*bytes), format!("clear {}", name(*resource)));
            }
            Event::Draw(record) => self.draw(record, costs.draw(record)),
            Event::GenerateMipmaps(record) => self.mipmaps(record, costs.mipmaps(record)),
            Event::ReadBack { resource, bytes, mode, fence } => {
                let copy = self.current(*resource);
                let mode = self.options.read_back.unwrap_or(*mode);
                let label = format!("read back {}", name(*resource));
                let passed = self.queue.read_back(copy, costs.read_back(*bytes), mode, label);
                if let Some(id) = fence {
                    // The read-back was synchronous because of an option, so its fence is passed together with it and
                    // costs nothing.
                    let passed = passed.unwrap_or_else(|| self.queue.fence_for_free());
                    self.fences.insert(*id, passed);
                }
            }
            Event::FinishFence(id) => {
                let fence = self.fence(place, *id)?;
                self.queue.finish(fence);
            }
            Event::Host(work) => match self.options.host {
                Some(model) => {
                    let label = format!("{} {}", work.operations, work.kind);
                    self.queue.host(model.time_of(work.kind, work.operations), label);
                }
                None => self.found.uncosted = self.found.uncosted.saturating_add(work.operations),
            },
        }
        Ok(())
    }

    fn draw(&mut self, record: &DrawRecord, cost: DrawCost) {
        let reads: Vec<ResourceCopy> = record.reads().into_iter().map(|resource| self.current(resource)).collect();
        let writes: Vec<ResourceCopy> = record.writes().into_iter().map(|resource| self.current(resource)).collect();
        self.queue.draw(&reads, &writes, cost, format!("draw {}", self.found.draws.len()));
        self.found.draws.push(cost);
    }

    /// Scheduled as a draw that reads and writes the texture: it follows earlier draws, and excludes other reads.
    fn mipmaps(&mut self, record: &MipmapRecord, cost: DrawCost) {
        let texture = self.current(record.texture);
        self.queue.draw(&[texture], &[texture], cost, format!("mip levels of {}", name(record.texture)));
        self.found.mipmaps.push(cost);
    }

    fn fence(&self, event: usize, fence: FenceId) -> Result<Fence, ReplayError> {
        self.fences.get(&fence).copied().ok_or(ReplayError { event, fence })
    }

    /// The current copy of a resource.
    fn current(&self, resource: ResourceId) -> ResourceCopy {
        ResourceCopy { resource, second: self.seconds.contains(&resource) }
    }

    /// The copy of a resource that is overwritten next; if double-buffered, the copy that was not used last.
    fn overwritten(&mut self, resource: ResourceId) -> ResourceCopy {
        if self.options.double_buffered && !self.seconds.remove(&resource) {
            self.seconds.insert(resource);
        }
        self.current(resource)
    }
}

fn name(resource: ResourceId) -> String {
    match resource {
        ResourceId::Texture(number) => format!("texture {number}"),
        ResourceId::Depth(number) => format!("depth buffer {number}"),
    }
}
