//! The command queue: the host submits commands, the card executes them in order, the buses transfer data in parallel.
//!
//! The simulation is online: each call schedules its command immediately, after previously scheduled work. Every start
//! is a maximum of ends, so shortening an operation or removing a dependency never lengthens the run. All durations are
//! inputs. docs/timing.md lists the rules, with an example.

mod figures;
mod schedule;

use std::collections::{BTreeMap, VecDeque};

pub use figures::QueueFigures;

pub use crate::event::{ReadBackMode, ResourceId};

use super::timeline::{Label, Mark, SpanKind, Timeline, Unit, WaitReason};
use super::{DrawCost, Picoseconds};
use schedule::{Schedule, SpanWork};

/// A texture, target or depth buffer, or its second copy if it is double-buffered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ResourceCopy {
    /// The resource.
    pub resource: ResourceId,
    /// `true` for the second copy.
    pub second: bool,
}

impl From<ResourceId> for ResourceCopy {
    fn from(resource: ResourceId) -> Self {
        Self { resource, second: false }
    }
}

/// A fence as in `NV_fence`: it is passed when every command before it, transfers included, is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fence(Mark);

/// Times from which a resource can be read and written.
#[derive(Clone, Copy, Debug, Default)]
struct ResourceUse {
    written: Mark,
    read: Mark,
}

/// Host, queue, card and buses, with all submitted work.
#[derive(Clone, Debug)]
pub struct Queue {
    figures: QueueFigures,
    schedule: Schedule,
    /// Times at which the most recent commands left the queue.
    taken: VecDeque<Mark>,
    /// End times of the most recent draws and clears.
    bodies: VecDeque<Mark>,
    /// End of all work submitted to the card, transfers included.
    done: Mark,
    resources: BTreeMap<ResourceCopy, ResourceUse>,
    commands: u32,
}

/// A submitted command: its arrival at the card, and the label of its spans.
struct SubmittedCommand {
    ready: Mark,
    label: Label,
    index: u32,
}

impl SubmittedCommand {
    fn work(&self, kind: SpanKind) -> SpanWork<'_> {
        SpanWork { kind, label: &self.label, command: self.index }
    }
}

impl Queue {
    /// An empty queue at time 0.
    pub fn new(figures: QueueFigures) -> Self {
        Self {
            figures,
            schedule: Schedule::default(),
            taken: VecDeque::new(),
            bodies: VecDeque::new(),
            done: Mark::default(),
            resources: BTreeMap::new(),
            commands: 0,
        }
    }

    /// Current time of the host: the end of its work and waits so far.
    pub fn now(&self) -> Picoseconds {
        self.schedule.free(Unit::Host).time
    }

    /// Adds work of the host.
    pub fn host(&mut self, duration: Picoseconds, label: impl Into<Label>) {
        let command = self.new_command(label.into());
        self.on_host(SpanKind::HostWork, duration, &command);
    }

    /// Uploads data for a whole resource, in parallel with the card's work. The transfer waits for earlier draws that
    /// read or write the resource.
    pub fn upload(&mut self, resource: ResourceCopy, duration: Picoseconds, label: impl Into<Label>) {
        let command = self.submit(self.figures.upload_ps, label.into());
        let taken = self.dequeue(command.ready);
        let held = self.resource_use(resource);
        let needs = [(taken, WaitReason::Order), (held.written.or_later(held.read), WaitReason::Hazard)];
        let sent =
            self.schedule.place(Unit::UploadBus, command.ready, &needs, duration, &command.work(SpanKind::Upload)).end;
        self.resources.entry(resource).or_default().written = sent;
        self.done = self.done.or_later(sent);
    }

    /// Changes state on the card, including `constants` constants.
    pub fn state(&mut self, duration: Picoseconds, constants: u32, label: impl Into<Label>) {
        let handed = self.figures.constant_ps.saturating_mul(constants.into());
        let command = self.submit(self.figures.state_ps.saturating_add(handed), label.into());
        let end = self.front_end(&command, duration, SpanKind::State).1;
        self.done = self.done.or_later(end);
    }

    /// Fills a resource with one value; `duration` is how long the memory is busy.
    pub fn clear(&mut self, resource: ResourceCopy, duration: Picoseconds, label: impl Into<Label>) {
        let command = self.submit(self.figures.clear_ps, label.into());
        let (start, _) = self.front_end(&command, Picoseconds::ZERO, SpanKind::State);
        let needs = self.body_needs(start, &[], &[resource]);
        let end =
            self.schedule.place(Unit::Memory, command.ready, &needs, duration, &command.work(SpanKind::Clear)).end;
        self.body_ends(end, &[], &[resource]);
    }

    /// Submits a draw that reads some resources and writes others. The front end may be ahead of the pixel pipelines by
    /// [`QueueFigures::draws_ahead`] draws; pixel pipelines and memory work in parallel on one draw at a time.
    pub fn draw(&mut self, reads: &[ResourceCopy], writes: &[ResourceCopy], cost: DrawCost, label: impl Into<Label>) {
        let command = self.submit(self.figures.draw_ps, label.into());
        // The total minus the busiest unit's time is the time to fill and drain the pipeline.
        let fill = cost.front_end.max(cost.shader).max(cost.memory).until(cost.total);
        let (start, vertices) = self.front_end(&command, cost.front_end, SpanKind::Vertices);
        let needs = self.body_needs(start.plus(fill), reads, writes);
        let mut place =
            |unit, duration, kind| self.schedule.place(unit, command.ready, &needs, duration, &command.work(kind)).end;
        let shaded = place(Unit::ShaderArray, cost.shader, SpanKind::Fragments);
        let moved = place(Unit::Memory, cost.memory, SpanKind::Traffic);
        self.body_ends(shaded.or_later(moved).or_later(vertices.plus(fill)), reads, writes);
    }

    /// Reads a resource back, after all earlier draws. If synchronous, the host waits for all earlier work and the
    /// transfer, as with `glReadPixels`. If asynchronous, host and card continue, and only writes to the resource wait.
    /// It returns a fence, which is passed when the data have arrived and all earlier work is done; setting the fence
    /// costs nothing.
    pub fn read_back(
        &mut self,
        resource: ResourceCopy,
        duration: Picoseconds,
        mode: ReadBackMode,
        label: impl Into<Label>,
    ) -> Option<Fence> {
        let command = self.submit(self.figures.read_back_ps, label.into());
        let taken = self.dequeue(command.ready);
        let drawn = self.bodies.back().copied().unwrap_or_default();
        let needs = [
            (taken, WaitReason::Order),
            (drawn, WaitReason::Order),
            (self.resource_use(resource).written, WaitReason::Hazard),
        ];
        let work = command.work(SpanKind::ReadBack);
        let arrived = self.schedule.place(Unit::ReadBackBus, command.ready, &needs, duration, &work).end;
        let held = self.resources.entry(resource).or_default();
        held.read = held.read.or_later(arrived);
        self.done = self.done.or_later(arrived);
        match mode {
            ReadBackMode::Synchronous => {
                self.schedule.host_waits(self.done, WaitReason::Transfer, command.index);
                None
            }
            ReadBackMode::Asynchronous => Some(self.fence_for_free()),
        }
    }

    /// A fence after all commands so far. It costs nothing, because it belongs to another command.
    pub(super) fn fence_for_free(&self) -> Fence {
        Fence(self.done)
    }

    /// Waits on the host until the fence is passed.
    pub fn finish(&mut self, fence: Fence) {
        let command = self.new_command("finish fence".into());
        self.on_host(SpanKind::Submit, Picoseconds(self.figures.finish_fence_ps), &command);
        self.schedule.host_waits(fence.0, WaitReason::Fence, command.index);
    }

    /// Returns the timeline of all submitted work.
    pub fn timeline(self) -> Timeline {
        self.schedule.finish(self.done)
    }

    fn new_command(&mut self, label: Label) -> SubmittedCommand {
        let index = self.commands;
        self.commands = self.commands.saturating_add(1);
        SubmittedCommand { ready: self.schedule.free(Unit::Host), label, index }
    }

    fn on_host(&mut self, kind: SpanKind, duration: Picoseconds, command: &SubmittedCommand) -> Mark {
        self.schedule.place(Unit::Host, Mark::default(), &[], duration, &command.work(kind)).end
    }

    /// Submits a command at the given host cost, once the queue has room.
    fn submit(&mut self, cost_ps: u64, label: Label) -> SubmittedCommand {
        let mut command = self.new_command(label);
        let room = usize::try_from(self.figures.commands.max(1)).unwrap_or(usize::MAX);
        if self.taken.len() >= room {
            let oldest = self.taken[self.taken.len() - room];
            self.schedule.host_waits(oldest, WaitReason::QueueFull, command.index);
            self.taken.drain(..=self.taken.len() - room);
        }
        command.ready = self.on_host(SpanKind::Submit, Picoseconds(cost_ps), &command);
        command
    }

    /// Removes a command from the queue at `moment`, but not before its predecessor.
    fn dequeue(&mut self, moment: Mark) -> Mark {
        let taken = moment.or_later(self.taken.back().copied().unwrap_or_default());
        self.taken.push_back(taken);
        taken
    }

    /// Executes a command in the front end, which takes it from the queue. Returns start and end.
    fn front_end(&mut self, command: &SubmittedCommand, duration: Picoseconds, kind: SpanKind) -> (Mark, Mark) {
        let ahead = usize::try_from(self.figures.draws_ahead).unwrap_or(usize::MAX);
        let behind = self.bodies.len().checked_sub(ahead.saturating_add(1)).map_or(Mark::default(), |i| self.bodies[i]);
        let before = self.taken.back().copied().unwrap_or_default();
        let needs = [(before, WaitReason::Order), (behind, WaitReason::Order)];
        let placed = self.schedule.place(Unit::FrontEnd, command.ready, &needs, duration, &command.work(kind));
        self.dequeue(placed.start);
        (placed.start, placed.end)
    }

    /// Dependencies of the first pixel of a draw or clear; `filled` is the time at which the pipeline delivers that
    /// pixel.
    fn body_needs(&self, filled: Mark, reads: &[ResourceCopy], writes: &[ResourceCopy]) -> [(Mark, WaitReason); 3] {
        let inputs = reads.iter().map(|resource| self.resource_use(*resource).written);
        let outputs = writes.iter().map(|resource| {
            let held = self.resource_use(*resource);
            held.written.or_later(held.read)
        });
        let hazard = inputs.chain(outputs).fold(Mark::default(), Mark::or_later);
        let order = self.bodies.back().copied().unwrap_or_default();
        [(order, WaitReason::Order), (filled, WaitReason::Input), (hazard, WaitReason::Hazard)]
    }

    fn body_ends(&mut self, end: Mark, reads: &[ResourceCopy], writes: &[ResourceCopy]) {
        for resource in reads {
            let held = self.resources.entry(*resource).or_default();
            held.read = held.read.or_later(end);
        }
        for resource in writes {
            self.resources.entry(*resource).or_default().written = end;
        }
        let capacity = usize::try_from(self.figures.draws_ahead).unwrap_or(usize::MAX).saturating_add(1);
        if self.bodies.len() >= capacity {
            self.bodies.pop_front();
        }
        self.bodies.push_back(end);
        self.done = self.done.or_later(end);
    }

    fn resource_use(&self, resource: ResourceCopy) -> ResourceUse {
        self.resources.get(&resource).copied().unwrap_or_default()
    }
}
