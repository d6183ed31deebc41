//! The modelled time of a frame: host work, uploads and constants, vertices and pixels. For a frame that is not drawn,
//! the log is computed from sizes and counts alone.

use std::collections::BTreeMap;
use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::{DrawEvents, DrawRecord, Event, FlowConstants, HostWork, PrimitiveCounts, ProgramWork};
use refsim::timing::host::{HostError, HostModel, HostOperation};
use refsim::timing::replay::{Options, ReplayError, replay};
use refsim::timing::timeline::Unit;
use refsim::timing::{Bottleneck, Level, Model, Picoseconds, TimingError};
use thiserror::Error;

use super::kernels::SHADE;

/// Number of consecutive frames that are modelled: enough for card and host to reach a steady state.
const FRAMES: usize = 4;

/// Errors of modelling a frame's time.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages of the errors below say what is wrong")]
pub enum FrameTimeError {
    #[error(transparent)]
    Timing(#[from] TimingError),
    #[error(transparent)]
    Replay(#[from] ReplayError),
    #[error(transparent)]
    Host(#[from] HostError),
}

/// The modelled time of a frame and of its parts. Host and card work in parallel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameTime {
    /// Time from one frame to the next in a sequence of equal frames.
    pub frame: Picoseconds,
    /// Time in which the host works: products, and commands submitted to the driver.
    pub host: Picoseconds,
    /// Time of the host's products alone.
    pub products: Picoseconds,
    /// Time of uploads to the card, without constants.
    pub uploads: Picoseconds,
    /// Time of state changes, including constants.
    pub state: Picoseconds,
    /// Sum of the times of all draws, including those into the depth buffer.
    pub draws: Picoseconds,
    /// Number of constant registers uploaded.
    pub constants: u64,
    /// Number of vertex program runs.
    pub vertices_run: u64,
    /// Number of triangles set up.
    pub triangles: u64,
    /// Number of draws.
    pub calls: usize,
    /// The bottleneck whose draws take the most time together; `None` if there are no draws.
    pub bottleneck: Option<Bottleneck>,
}

impl FrameTime {
    /// Frames per second.
    pub fn per_second(&self) -> f64 {
        1.0 / self.frame.seconds()
    }
}

/// The modelled time of a frame from its log. Fails with [`FrameTimeError`] if the device's rates are unknown.
pub fn frame_time(profile: &Profile, log: &[Event], host: &HostModel) -> Result<FrameTime, FrameTimeError> {
    let model = Model::new(Level::Pipeline, profile)?;
    let options = Options { host: Some(host), ..Options::of(Level::Pipeline) };
    let span = |frames: usize| -> Result<_, ReplayError> {
        let frames: Vec<Event> = std::iter::repeat_n(log, frames).flatten().cloned().collect();
        Ok(replay(&frames, &model, &options)?.timeline)
    };
    // The difference excludes the start of the sequence, in which card and host wait for each other.
    let (fewer, more) = (span(FRAMES - 1)?, span(FRAMES)?);
    let mut time = FrameTime {
        frame: fewer.makespan().until(more.makespan()),
        host: fewer.busy(Unit::Host).until(more.busy(Unit::Host)),
        ..FrameTime::default()
    };
    let mut longest = BTreeMap::<Bottleneck, Picoseconds>::new();
    for event in log {
        match event {
            Event::Host(work) => time.products += host.time_of(work.kind, work.operations),
            Event::Upload { bytes, .. } => time.uploads += model.upload(*bytes),
            Event::StateChange { changes, constants } => {
                time.state += model.state_change(*changes, *constants);
                time.constants += u64::from(*constants);
            }
            Event::Draw(draw) => {
                let cost = model.draw(draw);
                time.draws += cost.total;
                time.calls += 1;
                time.vertices_run += draw.vertices_run[1];
                time.triangles += draw.counts.primitives.assembled;
                *longest.entry(cost.bottleneck).or_default() += cost.total;
            }
            _ => {}
        }
    }
    time.bottleneck = longest.into_iter().max_by_key(|&(_, sum)| sum).map(|(bottleneck, _)| bottleneck);
    Ok(time)
}

const ATTRIBUTE_BYTES: u64 = 16;

/// Log event of host work.
pub fn host_work(operation: HostOperation, operations: u64) -> Event {
    Event::Host(HostWork { kind: operation, operations })
}

/// The log of a frame that is not drawn, from triangle counts alone; pixels take no time.
#[derive(Clone, Debug)]
pub struct UnseenFrame {
    run_per_triangle: f64,
    pixel: Arc<ProgramWork>,
    /// The events of the frame.
    pub log: Vec<Event>,
}

impl UnseenFrame {
    /// A frame that begins with the host work in `log`. `run_per_triangle` is the mean number of vertex program runs
    /// per triangle; it depends on the order of the mesh and the card's vertex cache.
    pub fn new(log: Vec<Event>, run_per_triangle: f64) -> Self {
        let program = refsim::asm::assemble(SHADE.text).expect("a program of the project");
        Self { run_per_triangle, pixel: Arc::new(ProgramWork::new(&program, FlowConstants::default())), log }
    }

    /// Adds a draw of triangles whose vertices have `attributes` attributes and run a program of `slots` slots.
    pub fn draw(&mut self, triangles: u64, slots: u64, attributes: u64) {
        let run = (triangles as f64 * self.run_per_triangle).round() as u64;
        let mut counts = DrawEvents {
            draws: 1,
            instances: 1,
            vertices: run,
            vertex_instructions: slots * run,
            primitives: PrimitiveCounts { assembled: triangles, ..PrimitiveCounts::default() },
            ..DrawEvents::default()
        };
        counts.bytes.vertices = ATTRIBUTE_BYTES * attributes * run;
        self.log.push(Event::Draw(Box::new(DrawRecord {
            counts,
            vertices_run: [run; 3],
            quads: 0,
            pixel: self.pixel.clone(),
            vertex: None,
            samplers: Vec::new(),
            targets: Vec::new(),
            depth: None,
            alpha_test: false,
            blend: true,
        })));
    }

    /// Adds a pass: new programs, new constants, and a draw.
    pub fn pass(&mut self, constants: u32, triangles: u64, slots: u64, attributes: u64) {
        self.log.push(Event::StateChange { changes: 2, constants });
        self.draw(triangles, slots, attributes);
    }
}
