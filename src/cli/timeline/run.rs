//! The arguments of `crossbar timeline`, the input of the timing model, and its replay.

use std::path::PathBuf;

use miette::IntoDiagnostic as _;
use refsim::device::Profile;
use refsim::event::{Event, ReadBackMode, TexelObserver};
use refsim::machine::ExecutorKind;
use refsim::timing::cache::TextureCaches;
use refsim::timing::replay::{Options, Replay, replay};
use refsim::timing::{Level, Model, Picoseconds, TimingError};

use crate::case::{self, Overrides, Setup, device_named};
use crate::cli::{Problem, ProgressBar};
use crate::geom::exact::Sides;
use crate::geom::teapot::teapot;
use crate::options::Size;
use crate::options::one_of::{OneOf, one_of};
use crate::ray_engine::{Crossbar, RayBatch, Recording};
use crate::scene::Camera;

const EXAMPLES: &str = "\
Examples:
  crossbar timeline fixtures/cases/modulate.toml
      both timing models of a case: what each draw costs, what each unit does, and the critical path
  crossbar timeline --eye-rays 64x64 --device r200 --readback async --double-buffer --perfetto out.json
      the Ray Engine's intersection passes on the teapot, as a trace for https://ui.perfetto.dev or chrome://tracing
  crossbar timeline fixtures/cases/modulate.toml --sensitivity
      also the effect on the total if a guessed figure is halved or doubled

The model `rates` has a fill rate and the rates of the bus (equation 11 of the Ray Engine paper); its commands take no \
time. The model `pipeline` includes the clocks of the units, memory traffic, latencies and the host's time per \
command. Both models time the same log of events, which is the same for every executor. With `--readback async`, the \
host waits for no read-back, so the time is a lower bound. The trace shows the model `pipeline`. docs/timing.md \
explains both models.

Exit codes: 0 done, 2 the case cannot be run, or the device has no timing.";

/// Model the time of a run on a card: cost of each draw, busy and waiting units, the critical path
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// The case, a TOML file: see `crossbar run`
    #[arg(required_unless_present = "eye_rays", conflicts_with = "eye_rays")]
    pub(super) case: Option<PathBuf>,

    /// Instead of a case, model the Ray Engine on the teapot with this many eye rays, bucket by bucket on one card
    #[arg(long, value_name = "WxH", allow_hyphen_values = true)]
    pub(super) eye_rays: Option<Size>,

    /// The card [default: the case's device; r200 for --eye-rays]
    #[arg(long, value_name = "D")]
    pub(super) device: Option<String>,

    /// Whether the host waits for read-backs [default: as it did in the run]
    #[arg(long, value_name = "MODE", value_parser = readback())]
    pub(super) readback: Option<ReadBackMode>,

    /// Keep two copies of every texture and target: one is overwritten while the card uses the other
    #[arg(long)]
    pub(super) double_buffer: bool,

    /// Simulate the texture cache with every address that the run reads, instead of estimating its misses; slower
    #[arg(long)]
    pub(super) cache: bool,

    /// Halve and double each guessed figure, and show the effect on the total
    #[arg(long)]
    pub(super) sensitivity: bool,

    /// Write the timeline as a trace for Perfetto and chrome://tracing
    #[arg(long, value_name = "FILE")]
    pub(super) perfetto: Option<PathBuf>,
}

fn readback() -> OneOf<ReadBackMode> {
    one_of([
        ("sync", "The host waits for all earlier work and the transfer", ReadBackMode::Synchronous),
        ("async", "The host continues", ReadBackMode::Asynchronous),
    ])
}

const DEFAULT_DEVICE: &str = "r200";
const TESSELLATION: u32 = 8;

/// A run on a card: a case, or rays on the teapot.
pub(super) struct CardRun {
    pub(super) profile: Profile,
    pub(super) title: String,
    /// Number of rays; `None` for a case.
    pub(super) rays: Option<u64>,
    /// With `--cache`, it has the texture cache's hits and misses over every texel read.
    pub(super) log: Vec<Event>,
}

impl CardRun {
    pub(super) fn new(args: &Args) -> miette::Result<Self> {
        let device = args.device.as_deref().map(device_named).transpose()?;
        // Figures that the models lack are reported before the drawing, which may take long.
        let watcher = |profile: &Profile| -> Result<_, Problem> {
            for level in [Level::Rates, Level::Pipeline] {
                Model::new(level, profile).map_err(no_figure)?;
            }
            let caches = args.cache.then(|| TextureCaches::new(profile)).transpose().map_err(no_figure)?;
            Ok(caches.map(|caches| move || -> Box<dyn TexelObserver> { Box::new(caches.clone()) }))
        };
        let bar = ProgressBar::new("drawing", 1).quicker("fewer `--eye-rays`");
        match (&args.case, args.eye_rays) {
            (Some(case), None) => {
                let setup = Setup::read_with(case, &Overrides { device, ..Overrides::default() })?;
                let log = match watcher(&setup.profile)? {
                    Some(make) => case::log_observed(&setup, make())?,
                    None => case::log(&setup, ExecutorKind::Batch)?,
                };
                let title = setup.title.unwrap_or_else(|| "a case".to_owned());
                Ok(Self { profile: setup.profile, title, rays: None, log })
            }
            (None, Some(size)) => {
                let profile = device.map_or_else(|| device_named(DEFAULT_DEVICE), Ok)?;
                let make = watcher(&profile)?;
                let camera = Camera::teapot(size.width, size.height).into_diagnostic()?;
                let mesh = teapot(TESSELLATION).into_diagnostic()?;
                let rays = RayBatch::new(size.width, size.height, camera.rays()).into_diagnostic()?;
                let show = |done: usize, of: usize| bar.show("drawing".to_owned(), done as u64, of as u64);
                let new_observer = make.as_ref().map(|make| make as &(dyn Fn() -> Box<dyn TexelObserver> + Sync));
                let recording = Recording { new_observer, done: Some(&show) };
                let crossbar = Crossbar::new(profile.clone(), ExecutorKind::Batch);
                let answer = crossbar.intersect_recorded(&mesh, &rays, Sides::Front, recording)?;
                let title = format!("{}x{} rays on the teapot, {} triangles", rays.width(), rays.height(), mesh.len());
                Ok(Self { profile, title, rays: Some(rays.rays().len() as u64), log: answer.log })
            }
            _ => Err(Problem::usage("expected a case or `--eye-rays`", "give one of the two").into()),
        }
    }
}

fn no_figure(error: TimingError) -> Problem {
    Problem::usage(error.to_string(), "`crossbar devices NAME` lists a device's figures")
}

pub(super) struct TimedLog {
    pub(super) model: Model,
    pub(super) replay: Replay,
    pub(super) sensitivity: Vec<Sensitivity>,
}

impl TimedLog {
    pub(super) fn new(level: Level, run: &CardRun, args: &Args) -> miette::Result<Self> {
        let model = Model::new(level, &run.profile).map_err(no_figure)?;
        let options = Options { read_back: args.readback, double_buffered: args.double_buffer, ..Options::of(level) };
        let replay = replay(&run.log, &model, &options)?;
        let sensitivity = if args.sensitivity { sensitivity(&model, &run.log, &options)? } else { Vec::new() };
        Ok(Self { model, replay, sensitivity })
    }

    pub(super) fn name(&self) -> &'static str {
        match self.model.level() {
            Level::Rates => "rates",
            Level::Pipeline => "pipeline",
        }
    }
}

/// A guessed figure, and the total time with half and with twice its value.
pub(super) struct Sensitivity {
    pub(super) key: String,
    pub(super) value: String,
    pub(super) halved: Picoseconds,
    pub(super) doubled: Picoseconds,
}

/// Varies every guess that the model reads, in its order, then the queue's guesses. Halving rounds down, but not to 0.
fn sensitivity(model: &Model, log: &[Event], options: &Options<'_>) -> miette::Result<Vec<Sensitivity>> {
    let time = |model: &Model, options: &Options<'_>| -> miette::Result<Picoseconds> {
        Ok(replay(log, model, options)?.timeline.makespan())
    };
    let constants = model.constants();
    // In the rates model, commands cost nothing, so these figures have no effect.
    let queue = if model.level() == Level::Pipeline { options.queue.rows() } else { Vec::new() };
    let guesses = model.guesses();
    let bar = ProgressBar::new("halving and doubling", (guesses.len() + queue.len()) as u64);
    let mut rows = Vec::new();
    for key in guesses {
        let halved = time(&model.with_scaled(&key, 1, 2).into_diagnostic()?, options)?;
        let doubled = time(&model.with_scaled(&key, 2, 1).into_diagnostic()?, options)?;
        let value = constants.iter().find(|row| row.key == key);
        let value = value.map(|row| format!("{} {}", row.value, row.unit).trim_end().to_owned()).unwrap_or_default();
        rows.push(Sensitivity { key, value, halved, doubled });
        bar.advance(1);
    }
    for row in queue {
        let scaled = |scale: fn(u64) -> u64| {
            let mut options = *options;
            if let Some(figure) = options.queue.figure_mut(&row.key) {
                *figure = scale(*figure);
            }
            time(model, &options)
        };
        let (halved, doubled) = (scaled(|n| (n / 2).max(n.min(1)))?, scaled(|n| n.saturating_mul(2))?);
        rows.push(Sensitivity { value: format!("{} {}", row.value, row.unit), key: row.key, halved, doubled });
        bar.advance(1);
    }
    Ok(rows)
}
