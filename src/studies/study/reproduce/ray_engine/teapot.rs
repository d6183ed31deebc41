//! The teapot room of Tables 1 and 3 to 5: rendered once; each engine run is made once for all entries.

use std::cell::RefCell;
use std::ops::RangeInclusive;
use std::rc::Rc;

use rayon::prelude::*;
use refsim::timing::host::{HostModel, HostWeights};

use super::engine_run::{Commands, Run, rays_per_s};
use super::workload::{CLASSICAL_TEAPOT, Workload};
use super::{Shared, SharedResult, StudyError};
use crate::ray_engine::engine::{EngineParameters, Readback};

/// Seed of the rays' random order.
const SEED: u64 = 2002;

/// Parameters of an engine run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Variant {
    pub(super) triangles: RangeInclusive<usize>,
    pub(super) rays: usize,
    pub(super) readback: Readback,
}

impl Variant {
    /// "Plus GPU": 5 to 15 triangles, 64 rays (section 6.3).
    pub(super) const PLUS_CARD: Self = Self { triangles: 5..=15, rays: 64, readback: Readback::Synchronous };

    /// Parameters of the tables' engine: the vertex program culls triangles outside the bucket, buckets are tested
    /// against cells, and rays are inserted into the tree in random order (section 5.3).
    pub(super) fn parameters(&self) -> EngineParameters {
        EngineParameters {
            triangles: self.triangles.clone(),
            rays: self.rays,
            readback: self.readback,
            cull: true,
            beams: true,
            shuffle: Some(SEED),
            ..EngineParameters::default()
        }
    }
}

/// The teapot room, rendered classically, and a host calibrated to render it alone at the paper's speed.
pub(crate) struct TeapotRoom {
    pub(super) work: Workload,
    pub(super) host: HostModel,
    /// Side of the picture, in pixels.
    pub(super) side: u32,
    runs: RefCell<Vec<(Variant, Rc<Run>)>>,
}

impl SharedResult for TeapotRoom {
    type Key = ();

    fn compute((): &(), _: &Shared) -> Result<Self, StudyError> {
        Self::new()
    }
}

impl TeapotRoom {
    fn new() -> Result<Self, StudyError> {
        let work = CLASSICAL_TEAPOT.workload()?;
        let host = work.alone.calibrate(HostWeights::default())?;
        let side = CLASSICAL_TEAPOT.side;
        Ok(Self { work, host, side, runs: RefCell::default() })
    }

    /// Returns the runs of some variants, in the given order.
    pub(super) fn runs(&self, wanted: &[Variant]) -> Result<Vec<Rc<Run>>, StudyError> {
        let mut missing: Vec<Variant> = Vec::new();
        for variant in wanted {
            if !missing.contains(variant) && self.known(variant).is_none() {
                missing.push(variant.clone());
            }
        }
        // One thread per engine; the runs are independent.
        let work = &self.work;
        let run = |variant: Variant| Ok((Run::new(work, variant.parameters())?, variant));
        let made: Vec<(Run, Variant)> = missing.into_par_iter().map(run).collect::<Result<_, StudyError>>()?;
        self.runs.borrow_mut().extend(made.into_iter().map(|(run, variant)| (variant, Rc::new(run))));
        Ok(wanted.iter().filter_map(|variant| self.known(variant)).collect())
    }

    fn known(&self, variant: &Variant) -> Option<Rc<Run>> {
        self.runs.borrow().iter().find(|(made, _)| made == variant).map(|(_, run)| Rc::clone(run))
    }

    /// Rays per second of a run on the calibrated host.
    pub(super) fn rays_per_s(&self, run: &Run, commands: Commands) -> Result<f64, StudyError> {
        rays_per_s(run, &self.host, commands)
    }
}
