//! `--caster`: the ray caster behind first hits.

use clap::ValueEnum;
use refsim::device::Profile;
use refsim::machine::Executor;
use refsim::num::Format;
use serde_json::json;

use super::executor::Decider;
use super::{Problem, view};
use crate::case::device_named;
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::ray_engine::engine::{EngineCounts, EngineParameters, RayEngine};
use crate::report::Findings;
use crate::report::digits::{Quantity, count, shown};
use crate::tracer::Caster;
use crate::tracer::HostTracer;

/// A ray caster.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum CasterArg {
    /// The host's octree, in single precision
    Host,
    /// The Ray Engine on `--device`, by `--executor`
    Engine,
    /// The same for all but eye rays, which the device draws; one sample per pixel, front faces
    Hybrid,
}

/// A caster with its options, not yet built.
pub(super) enum CasterChoice {
    Host,
    Engine { profile: Box<Profile>, executor: Executor },
}

/// A caster with its structures.
pub(super) enum OpenCaster<'a> {
    Host(Box<HostTracer>),
    Engine(Box<RayEngine<'a>>),
}

impl CasterArg {
    /// Checks that the options fit the caster, and looks up device and executor.
    pub(super) fn choose(self, device: Option<&str>, executor: Option<Decider>) -> miette::Result<CasterChoice> {
        if self == Self::Host {
            if device.is_some() || executor.is_some() {
                let help = "add `--caster engine`, or leave them out";
                return Err(Problem::usage("`--device` and `--executor` are for the Ray Engine here", help).into());
            }
            return Ok(CasterChoice::Host);
        }
        let profile = Box::new(device_named(device.unwrap_or(view::DEFAULT_DEVICE))?);
        let Some(executor) = executor.unwrap_or(Decider::Batch).open()? else {
            let help = "name `--executor scalar`, `batch` or `wgpu`";
            return Err(Problem::usage("the Ray Engine does not run in exact arithmetic", help).into());
        };
        Ok(CasterChoice::Engine { profile, executor })
    }
}

impl CasterChoice {
    /// The number format that hits are computed in.
    pub(super) fn format(&self) -> Format {
        match self {
            Self::Host => Format::FP32,
            Self::Engine { profile, .. } => profile.rules.format,
        }
    }

    /// Builds the caster's structures for a mesh: the octree, and for the engine its GPU cells and the card.
    pub(super) fn build(self, mesh: &Mesh, sides: Sides) -> miette::Result<OpenCaster<'_>> {
        Ok(match self {
            Self::Host => OpenCaster::Host(Box::new(HostTracer::new(mesh, sides))),
            Self::Engine { profile, executor } => {
                let parameters = EngineParameters { sides, ..EngineParameters::default() };
                OpenCaster::Engine(Box::new(RayEngine::new(mesh, *profile, executor, parameters)?))
            }
        })
    }
}

impl<'a> OpenCaster<'a> {
    /// The caster, for rays.
    pub(super) fn caster(&mut self) -> &mut (dyn Caster + 'a) {
        match self {
            Self::Host(host) => host.as_mut(),
            Self::Engine(engine) => engine.as_mut(),
        }
    }

    /// The engine's counts, if it is one.
    pub(super) fn counts(&self) -> Option<EngineCounts> {
        match self {
            Self::Host(_) => None,
            Self::Engine(engine) => Some(engine.counts()),
        }
    }
}

/// Adds the engine's counts to findings.
pub(super) fn report(engine: &EngineCounts, found: &mut Findings) {
    found.field(
        "engine",
        json!({ "rays": engine.rays, "rays_on_card": engine.rays_on_card, "passes": engine.passes,
                "pass_rays": engine.pass_rays, "pass_tests": engine.pass_tests, "host_tests": engine.host_tests }),
    );
    found.print(format!(
        "engine: {} % of rays met the card, in {} passes with {} tests; {} tests on the host",
        shown(100.0 * engine.share_on_card(), Quantity::Percent),
        count(engine.passes),
        count(engine.pass_tests),
        count(engine.host_tests)
    ));
}
