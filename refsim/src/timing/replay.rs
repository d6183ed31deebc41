//! Replay of a machine's log on the time axis.

use std::collections::BTreeMap;

use super::host::{HostError, HostModel, HostOperation};
use super::queue::{DoubleBuffer, Fence, FenceError, Queue, QueueFigures, ResourceId};
use super::timeline::Timeline;
use super::{DrawCost, Level, Model, Picoseconds};
use crate::event::{self, DrawRecord, Event, FenceId, MipmapRecord, ReadBackMode};

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
    /// Overrides the mode of every read-back. Asynchronous read-backs in a log in which nobody waits for the data give
    /// an upper bound on the gain from asynchrony.
    pub read_back: Option<ReadBackMode>,
    /// Gives every resource two copies: uploads and clears, which overwrite all of it, use the copy not used last.
    pub double_buffered: bool,
    /// Cost of host work; without a model it is free, and counted in [`Replay::uncosted`].
    pub host: Option<&'a HostModel>,
}

impl Options<'_> {
    /// Options that fit a model: [`Level::Rates`], like the paper's equation 11, has no host cost of commands.
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

/// Error of replaying a log. Events are numbered from 0.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ReplayError {
    /// A fence was tested or waited for before it was set.
    #[error("event {event}: expected a fence that has been set, found fence {} that was not", fence.0)]
    #[diagnostic(code(timing::replay_fence), help("set the fence before it is tested or waited for"))]
    Fence { event: usize, fence: FenceId },
    /// Host work of an unknown kind.
    #[error("event {event}: the host model can't cost it")]
    #[diagnostic(code(timing::replay_host))]
    Host { event: usize, source: HostError },
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
    /// Result of each fence test.
    pub fence_tests: Vec<bool>,
    /// Number of host operations without cost because there is no host model.
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
/// [`ReplayError`] for fences that are not set, and for host work of an unknown kind.
pub fn replay(log: &[Event], costs: &impl Costs, options: &Options<'_>) -> Result<Replay, ReplayError> {
    let mut player = Player {
        queue: Queue::new(options.queue),
        options,
        copies: BTreeMap::new(),
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
    copies: BTreeMap<event::ResourceId, DoubleBuffer>,
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
                    // An option made the read-back synchronous: the log's fence is passed with it, at no cost.
                    let passed = passed.unwrap_or_else(|| self.queue.fence_for_free());
                    self.fences.insert(*id, passed);
                }
            }
            Event::SetFence(id) => {
                let fence = self.queue.set_fence();
                self.fences.insert(*id, fence);
            }
            Event::TestFence(id) => {
                let fence = self.fence(place, *id)?;
                let answer = self.queue.test(fence).map_err(|error| unset(place, *id, error))?;
                self.found.fence_tests.push(answer);
            }
            Event::FinishFence(id) => {
                let fence = self.fence(place, *id)?;
                self.queue.finish(fence).map_err(|error| unset(place, *id, error))?;
            }
            Event::Host(work) => {
                let operation =
                    HostOperation::named(&work.kind).map_err(|source| ReplayError::Host { event: place, source })?;
                match self.options.host {
                    Some(model) => {
                        let label = format!("{} {operation}", work.operations);
                        self.queue.host(model.time_of(operation, work.operations), label);
                    }
                    None => self.found.uncosted = self.found.uncosted.saturating_add(work.operations),
                }
            }
        }
        Ok(())
    }

    fn draw(&mut self, record: &DrawRecord, cost: DrawCost) {
        let reads: Vec<ResourceId> = record.reads().into_iter().map(|resource| self.current(resource)).collect();
        let writes: Vec<ResourceId> = record.writes().into_iter().map(|resource| self.current(resource)).collect();
        self.queue.draw(&reads, &writes, cost, format!("draw {}", self.found.draws.len()));
        self.found.draws.push(cost);
    }

    /// Scheduled as a draw that reads and writes the texture: it follows earlier draws, and nothing reads meanwhile.
    fn mipmaps(&mut self, record: &MipmapRecord, cost: DrawCost) {
        let texture = self.current(record.texture);
        self.queue.draw(&[texture], &[texture], cost, format!("mip levels of {}", name(record.texture)));
        self.found.mipmaps.push(cost);
    }

    fn fence(&self, event: usize, fence: FenceId) -> Result<Fence, ReplayError> {
        self.fences.get(&fence).copied().ok_or(ReplayError::Fence { event, fence })
    }

    /// The copy of a resource in use.
    fn current(&mut self, resource: event::ResourceId) -> ResourceId {
        self.copies_of(resource).current()
    }

    /// The copy of a resource to overwrite.
    fn overwritten(&mut self, resource: event::ResourceId) -> ResourceId {
        let double = self.options.double_buffered;
        let copies = self.copies_of(resource);
        if double { copies.flip() } else { copies.current() }
    }

    fn copies_of(&mut self, resource: event::ResourceId) -> &mut DoubleBuffer {
        let number = match resource {
            event::ResourceId::Texture(number) => 4 * number as u64,
            event::ResourceId::Depth(number) => 4 * number as u64 + 2,
        };
        let copies = || DoubleBuffer::new(ResourceId(number), ResourceId(number + 1));
        self.copies.entry(resource).or_insert_with(copies)
    }
}

/// The queue generated the fence, so the only possible error is that it is unset.
fn unset(event: usize, fence: FenceId, _: FenceError) -> ReplayError {
    ReplayError::Fence { event, fence }
}

fn name(resource: event::ResourceId) -> String {
    match resource {
        event::ResourceId::Texture(number) => format!("texture {number}"),
        event::ResourceId::Depth(number) => format!("depth buffer {number}"),
    }
}
