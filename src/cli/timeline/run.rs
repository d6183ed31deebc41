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
use crate::cli::Problem;
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::geom::teapot::teapot;
use crate::ray_engine::{Crossbar, RayBatch};
use crate::scene::Camera;

const DEFAULT_DEVICE: &str = "r200";
const TESSELLATION: u32 = 8;

pub(super) enum Input {
    Case(Box<Setup>),
    Rays { profile: Box<Profile>, mesh: Box<Mesh>, rays: Box<RayBatch> },
}

impl Input {
    pub(super) fn read(args: &Args) -> miette::Result<Self> {
        let device = args.device.as_deref().map(device_named).transpose()?;
        match (&args.case, args.eye_rays) {
            (Some(case), None) => {
                let overrides = Overrides { device, ..Overrides::default() };
                let setup = Setup::read_with(case, &overrides)?;
                Ok(Self::Case(Box::new(setup)))
            }
            (None, Some(size)) => {
                let profile = device.map_or_else(|| device_named(DEFAULT_DEVICE), Ok)?;
                let camera = Camera::teapot(size.width, size.height).into_diagnostic()?;
                let mesh = Box::new(teapot(TESSELLATION).into_diagnostic()?);
                let rays = RayBatch::new(size.width, size.height, camera.rays()).into_diagnostic()?;
                Ok(Self::Rays { profile: Box::new(profile), mesh, rays: Box::new(rays) })
            }
            _ => Err(Problem::usage("expected a case or `--eye-rays`", "name one of them").into()),
        }
    }

    pub(super) fn profile(&self) -> &Profile {
        match self {
            Self::Case(setup) => &setup.profile,
            Self::Rays { profile, .. } => profile,
        }
    }

    pub(super) fn title(&self) -> String {
        match self {
            Self::Case(setup) => setup.title.clone().unwrap_or_else(|| "a case".to_owned()),
            Self::Rays { mesh, rays, .. } => {
                format!("{}x{} rays on the teapot, {} triangles", rays.width(), rays.height(), mesh.len())
            }
        }
    }

    /// Number of rays; `None` for a case.
    pub(super) fn rays(&self) -> Option<u64> {
        match self {
            Self::Case(_) => None,
            Self::Rays { rays, .. } => Some(rays.rays().len() as u64),
        }
    }

    /// The run's log; with `cache`, it has the texture cache's hits and misses over every texel read.
    pub(super) fn log(&self, cache: bool) -> miette::Result<Vec<Event>> {
        let caches = if cache { Some(TextureCaches::new(self.profile()).map_err(no_figure)?) } else { None };
        let watcher = caches.map(|caches| move || -> Box<dyn TexelObserver> { Box::new(caches.clone()) });
        match self {
            Self::Case(setup) => Ok(match watcher {
                Some(make) => case::log_observed(setup, make())?,
                None => case::log(setup, ExecutorKind::Batch)?,
            }),
            Self::Rays { profile, mesh, rays, .. } => {
                let crossbar = Crossbar::new(profile.as_ref().clone(), ExecutorKind::Batch);
                let answer = match &watcher {
                    Some(make) => crossbar.intersect_observed(mesh, rays, Sides::Front, make)?,
                    None => crossbar.intersect_recorded(mesh, rays, Sides::Front)?,
                };
                Ok(answer.log)
            }
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
    pub(super) fn new(level: Level, input: &Input, log: &[Event], args: &Args) -> miette::Result<Self> {
        let model = Model::new(level, input.profile()).map_err(no_figure)?;
        let options = Options { read_back: args.readback, double_buffered: args.double_buffer, ..Options::of(level) };
        let replay = replay(log, &model, &options)?;
        let sensitivity = if args.sensitivity { sensitivity(&model, log, &options)? } else { Vec::new() };
        Ok(Self { model, replay, sensitivity })
    }

    pub(super) fn name(&self) -> &'static str {
        match self.model.level() {
            Level::Rates => "rates",
            Level::Pipeline => "pipeline",
        }
    }
}
