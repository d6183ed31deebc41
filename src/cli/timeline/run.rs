//! The input of the timing model, and its replay.

use miette::IntoDiagnostic as _;
use refsim::device::Profile;
use refsim::event::{Event, TexelObserver};
use refsim::machine::ExecutorKind;
use refsim::timing::cache::TextureCaches;
use refsim::timing::replay::{Options, Replay, replay};
use refsim::timing::{Level, Model, TimingError};

use super::args::Args;
use super::sensitivity::{Sensitivity, sensitivity};
use crate::case::{self, Overrides, Setup, device_named};
use crate::cli::{Problem, ProgressBar};
use crate::geom::exact::Sides;
use crate::geom::teapot::teapot;
use crate::ray_engine::{Crossbar, RayBatch};
use crate::scene::Camera;

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
        let watcher = |profile: &Profile| -> Result<_, Problem> {
            let caches = args.cache.then(|| TextureCaches::new(profile)).transpose().map_err(no_figure)?;
            Ok(caches.map(|caches| move || -> Box<dyn TexelObserver> { Box::new(caches.clone()) }))
        };
        // A single step, shown because it takes long with `--cache`.
        let _bar = ProgressBar::new("drawing", 1);
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
                let camera = Camera::teapot(size.width, size.height).into_diagnostic()?;
                let mesh = teapot(TESSELLATION).into_diagnostic()?;
                let rays = RayBatch::new(size.width, size.height, camera.rays()).into_diagnostic()?;
                let crossbar = Crossbar::new(profile.clone(), ExecutorKind::Batch);
                let answer = match watcher(&profile)? {
                    Some(make) => crossbar.intersect_observed(&mesh, &rays, Sides::Front, &make)?,
                    None => crossbar.intersect_recorded(&mesh, &rays, Sides::Front)?,
                };
                let title = format!("{}x{} rays on the teapot, {} triangles", rays.width(), rays.height(), mesh.len());
                Ok(Self { profile, title, rays: Some(rays.rays().len() as u64), log: answer.log })
            }
            _ => Err(Problem::usage("expected a case or `--eye-rays`", "name one of them").into()),
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
