//! Answers held against the truth.

use rayon::prelude::*;
use thiserror::Error;

use super::disagreement::{Disagreement, DisagreementKind, Expected};
use super::{Report, Tolerance};
use crate::compare::{self, Number};
use crate::geom::classify::{Candidate, HitVerdict, classify};
use crate::geom::exact::{self, NearestHit, Sides, Tracer};
use crate::geom::{ExactT, Hit, Mesh, Ray};

/// Why answers cannot be judged.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum OracleError {
    /// There is not one answer a ray.
    #[error("expected an answer for each of {rays} rays (`None` for no hit), found {hits}")]
    Count {
        /// Number of rays.
        rays: usize,
        /// Number of answers.
        hits: usize,
    },
}

/// Knows what every ray hits first, exactly.
#[derive(Debug)]
pub struct Oracle<'a> {
    mesh: &'a Mesh,
    tracer: Tracer<'a>,
    sides: Sides,
    tolerance: Tolerance,
}

impl<'a> Oracle<'a> {
    /// An oracle over a mesh. `sides` says whether backs can be hit, `tolerance` how far a t may be off.
    #[must_use]
    pub fn new(mesh: &'a Mesh, sides: Sides, tolerance: Tolerance) -> Self {
        Self { mesh, tracer: Tracer::new(mesh), sides, tolerance }
    }

    /// Judges one answer a ray, in the order of the rays. A t counts in multiples of its ray's direction as given.
    ///
    /// # Errors
    /// [`OracleError::Count`] unless there are as many answers as rays.
    pub fn judge(&self, rays: &[Ray], hits: &[Option<Hit>]) -> Result<Report, OracleError> {
        if rays.len() != hits.len() {
            return Err(OracleError::Count { rays: rays.len(), hits: hits.len() });
        }
        Ok(self.report(rays, hits))
    }

    /// Asks an intersector for every ray, one after the other, and judges its answers.
    pub fn examine(&self, rays: &[Ray], intersector: impl FnMut(&Ray) -> Option<Hit>) -> Report {
        let hits: Vec<_> = rays.iter().map(intersector).collect();
        self.report(rays, &hits)
    }

    /// As [`Oracle::examine`].
    ///
    /// # Errors
    /// The report, if anything disagrees.
    pub fn agrees(&self, rays: &[Ray], intersector: impl FnMut(&Ray) -> Option<Hit>) -> Result<(), Box<Report>> {
        let report = self.examine(rays, intersector);
        if report.agrees() { Ok(()) } else { Err(Box::new(report)) }
    }

    /// As [`Oracle::examine`].
    ///
    /// # Errors
    /// The report of the leaks alone, if there is one: surfaces that were missed. Everything else passes.
    pub fn no_leaks(&self, rays: &[Ray], intersector: impl FnMut(&Ray) -> Option<Hit>) -> Result<(), Box<Report>> {
        let leaks = self.examine(rays, intersector).only(DisagreementKind::is_leak);
        if leaks.agrees() { Ok(()) } else { Err(Box::new(leaks)) }
    }

    /// As [`Oracle::agrees`], for tests.
    ///
    /// # Panics
    /// With the report, if anything disagrees.
    #[track_caller]
    pub fn assert_agrees(&self, rays: &[Ray], intersector: impl FnMut(&Ray) -> Option<Hit>) {
        if let Err(report) = self.agrees(rays, intersector) {
            panic!("{report}");
        }
    }

    /// As [`Oracle::no_leaks`], for tests.
    ///
    /// # Panics
    /// With the report, if a surface was missed.
    #[track_caller]
    pub fn assert_no_leaks(&self, rays: &[Ray], intersector: impl FnMut(&Ray) -> Option<Hit>) {
        if let Err(report) = self.no_leaks(rays, intersector) {
            panic!("{report}");
        }
    }

    fn report(&self, rays: &[Ray], hits: &[Option<Hit>]) -> Report {
        let judged: Vec<(bool, Option<Disagreement>)> = (rays, hits)
            .into_par_iter()
            .enumerate()
            .map(|(place, (ray, hit))| {
                let truth = self.tracer.nearest(ray, self.sides);
                (truth.is_some(), self.disagreement(place, ray, truth, *hit))
            })
            .collect();
        let surface = judged.iter().filter(|(surface, _)| *surface).count();
        let found = hits.iter().flatten().count();
        let wrong = judged.into_iter().filter_map(|(_, wrong)| wrong).collect();
        Report::new([rays.len(), surface, found], self.sides, self.tolerance, wrong)
    }

    fn disagreement(
        &self,
        place: usize,
        ray: &Ray,
        truth: Option<NearestHit>,
        found: Option<Hit>,
    ) -> Option<Disagreement> {
        let corners = found.and_then(|hit| self.mesh.corners(hit.triangle));
        let meets = |sides| exact::intersect(ray, &corners?, sides);
        let candidate = Candidate { triangle: found.map(|hit| hit.triangle), t: found.map_or(0.0, |hit| hit.t) };
        let verdict = classify(self.mesh, truth.as_ref(), candidate).verdict;
        let t_ulps = found.zip(truth.as_ref()).and_then(|(hit, truth)| ulps(truth.t.to_f32(), hit.t));
        let right_t = |truth: &NearestHit, hit: Hit| self.tolerance.allows(hit.t, &truth.t, t_ulps);
        // A triangle met behind the first, but so little that t's of this tolerance cannot tell.
        let near = |met: &ExactT, truth: &NearestHit| {
            let met = met.to_f32();
            self.tolerance.allows(met, &truth.t, ulps(truth.t.to_f32(), met))
        };
        let met_at = meets(Sides::Both);
        let kind = match (verdict, found) {
            (HitVerdict::Right, Some(hit)) if !truth.as_ref().is_some_and(|truth| right_t(truth, hit)) => {
                DisagreementKind::TOff
            }
            (HitVerdict::Right, _) => return None,
            (HitVerdict::Leak, _) => DisagreementKind::Leak,
            _ if corners.is_none() => DisagreementKind::NoSuchTriangle,
            _ if self.sides == Sides::Front && met_at.is_some() && meets(Sides::Front).is_none() => {
                DisagreementKind::BackFace
            }
            (HitVerdict::FalseHit, _) => DisagreementKind::FalseHit,
            (HitVerdict::WrongTriangle { adjacent }, _) => match (&met_at, &truth) {
                (Some(met), Some(truth)) if self.tolerance != Tolerance::ANY_T && near(met, truth) => {
                    DisagreementKind::NearTie
                }
                _ if adjacent => DisagreementKind::WrongNeighbour,
                (Some(_), _) => DisagreementKind::LeakThrough,
                (None, _) => DisagreementKind::WrongTriangle,
            },
        };
        let expected = truth.map(|truth| Expected { triangles: truth.ties, t: truth.t });
        let (origin, direction) = (ray.origin(), ray.direction());
        Some(Disagreement { ray: place, origin, direction, kind, expected, found, t_ulps, met_at })
    }
}

/// Steps of f32 between two numbers; `None` where one is not finite and they differ.
pub(super) fn ulps(left: f32, right: f32) -> Option<u64> {
    compare::ulps(&Number::from(left), &Number::from(right)).0.map(|ulps| ulps as u64)
}
