//! The teapot room of Tables 1 and 3 to 5: rendered once, each run of the engine made once, whichever entries ask.

use std::cell::RefCell;
use std::ops::RangeInclusive;
use std::rc::Rc;

use rayon::prelude::*;
use refsim::timing::host::{HostModel, HostWeights};

use super::super::ReproduceError;
use super::engine_run::{Commands, Run, rays_per_s};
use super::workload::{CLASSICAL_TEAPOT, Workload};
use crate::ray_engine::engine::{EngineParameters, Readback};
use crate::scene::built;

/// How the engine runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Variant {
    pub(super) triangles: RangeInclusive<usize>,
    pub(super) rays: usize,
    pub(super) readback: Readback,
}

impl Variant {
    /// "Plus GPU": 5 to 15 triangles, 64 rays (section 6.3).
    pub(super) const PLUS_CARD: Self = Self { triangles: 5..=15, rays: 64, readback: Readback::Synchronous };

    /// The engine of the tables: triangles outside the bucket culled by the vertex program, buckets tested against
    /// cells, rays put into the tree in random order (section 5.3).
    pub(super) fn parameters(&self) -> EngineParameters {
        EngineParameters {
            triangles: self.triangles.clone(),
            rays: self.rays,
            readback: self.readback,
            cull: true,
            beams: true,
            shuffle: Some(built::SEED),
            ..EngineParameters::default()
        }
    }
}

/// The teapot room, rendered classically, and a host that does it alone as fast as the paper's.
pub(crate) struct TeapotRoom {
    pub(super) work: Workload,
    pub(super) host: HostModel,
    /// Pixels on a side of the picture.
    pub(super) side: u32,
    runs: RefCell<Vec<(Variant, Rc<Run>)>>,
}

impl TeapotRoom {
    pub(crate) fn new() -> Result<Self, ReproduceError> {
        let work = CLASSICAL_TEAPOT.workload()?;
        let host = work.alone.calibrate(HostWeights::default())?;
        let side = CLASSICAL_TEAPOT.side;
        Ok(Self { work, host, side, runs: RefCell::default() })
    }

    /// The runs of some variants, in their order.
    pub(super) fn runs(&self, wanted: &[Variant]) -> Result<Vec<Rc<Run>>, ReproduceError> {
        let mut missing: Vec<Variant> = Vec::new();
        for variant in wanted {
            if !missing.contains(variant) && self.known(variant).is_none() {
                missing.push(variant.clone());
            }
        }
        // One engine is one thread; the runs don't know of each other.
        let work = &self.work;
        let run = |variant: Variant| Ok((Run::of(work, variant.parameters())?, variant));
        let made: Vec<(Run, Variant)> = missing.into_par_iter().map(run).collect::<Result<_, ReproduceError>>()?;
        self.runs.borrow_mut().extend(made.into_iter().map(|(run, variant)| (variant, Rc::new(run))));
        Ok(wanted.iter().filter_map(|variant| self.known(variant)).collect())
    }

    fn known(&self, variant: &Variant) -> Option<Rc<Run>> {
        self.runs.borrow().iter().find(|(made, _)| made == variant).map(|(_, run)| Rc::clone(run))
    }

    /// Rays per second of a run on the calibrated host.
    pub(super) fn rays_per_s(&self, run: &Run, commands: Commands) -> Result<f64, ReproduceError> {
        rays_per_s(run, &self.host, commands)
    }
}
