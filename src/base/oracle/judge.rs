//! Judgement of hits against exact arithmetic.

use rayon::prelude::*;

use super::disagreement::{Disagreement, DisagreementKind};
use super::hard::{Aim, JudgedRay};
use super::nearby::{moved, passes_contact, passes_corner_at, turned};
use super::{Report, Tolerance};
use crate::compare::f32_ulps as ulps;
use crate::error::{InputError, ensure};
use crate::geom::classify::{HitVerdict, classify};
use crate::geom::exact::{self, NearestHit, Sides, Tracer};
use crate::geom::{ExactT, Hit, Mesh, Ray};

/// Judges first hits by exact arithmetic.
#[derive(Debug)]
pub struct Oracle<'a> {
    tracer: Tracer<'a>,
    sides: Sides,
    tolerance: Tolerance,
    nearby_ulps: u32,
}

impl Oracle<'static> {
    /// Creates an oracle like [`Oracle::new`], and takes ownership of the mesh.
    pub fn owning(mesh: Mesh, sides: Sides, tolerance: Tolerance) -> Self {
        Self { tracer: Tracer::owning(mesh), sides, tolerance, nearby_ulps: NEARBY_ULPS }
    }
}

/// Default of [`Oracle::with_nearby_ulps`]. A single-precision test that subtracts the origin from a vertex, shears and
/// scales it has an error of at most five roundings.
const NEARBY_ULPS: u32 = 8;

impl<'a> Oracle<'a> {
    /// Creates an oracle over a mesh. `sides` determines whether backs can be hit, `tolerance` the allowed error of t.
    pub fn new(mesh: &'a Mesh, sides: Sides, tolerance: Tolerance) -> Self {
        Self { tracer: Tracer::new(mesh), sides, tolerance, nearby_ulps: NEARBY_ULPS }
    }

    /// Mesh that is judged.
    pub fn mesh(&self) -> &Mesh {
        self.tracer.mesh()
    }

    /// Returns the exact first hit of a ray.
    pub fn first_hit(&self, ray: &Ray) -> Option<NearestHit> {
        self.tracer.nearest(ray, self.sides)
    }

    /// Judges the hit of one ray, whose index among all rays is `place`. Returns the exact first hit, and the
    /// disagreement if there is one.
    pub fn judge_one(
        &self,
        place: usize,
        ray: &impl JudgedRay,
        found: Option<Hit>,
    ) -> (Option<NearestHit>, Option<Disagreement>) {
        let nearest = self.first_hit(ray.as_ref());
        let wrong = self.disagreement((place, ray.aim()), ray.as_ref(), nearest.clone(), found);
        (nearest, wrong)
    }

    /// Sets the maximum distance of nearby rays in ULPs; the default is 8. A missed surface is a
    /// [`DisagreementKind::Silhouette`] if the miss is correct for a nearby ray, otherwise a leak. With 0 there are no
    /// nearby rays: every missed surface is a leak, even at a silhouette.
    pub fn with_nearby_ulps(mut self, ulps: u32) -> Self {
        self.nearby_ulps = ulps;
        self
    }

    /// Judges one hit per ray, in the order of the rays. Each t is in multiples of its ray's direction as given.
    pub fn judge<R: JudgedRay>(&self, rays: &[R], hits: &[Option<Hit>]) -> Result<Report, InputError> {
        ensure!(
            rays.len() == hits.len(),
            "expected an answer for each of {} rays (`None` for no hit), found {}",
            rays.len(),
            hits.len()
        );
        Ok(self.report(rays, hits))
    }

    /// Runs an intersector on every ray, one after the other, and judges its hits.
    pub fn examine<R: JudgedRay>(&self, rays: &[R], intersector: impl FnMut(&Ray) -> Option<Hit>) -> Report {
        let hits: Vec<_> = rays.iter().map(AsRef::as_ref).map(intersector).collect();
        self.report(rays, &hits)
    }

    /// Checks by [`Oracle::examine`] that every result is exact.
    pub fn agrees<R: JudgedRay>(
        &self,
        rays: &[R],
        intersector: impl FnMut(&Ray) -> Option<Hit>,
    ) -> Result<(), Box<Report>> {
        self.examine(rays, intersector).verdict()
    }

    /// Checks by [`Oracle::examine`] that the surface has no holes.
    pub fn watertight<R: JudgedRay>(
        &self,
        rays: &[R],
        intersector: impl FnMut(&Ray) -> Option<Hit>,
    ) -> Result<(), Box<Report>> {
        self.examine(rays, intersector).only(DisagreementKind::is_leak).verdict()
    }

    /// Checks by [`Oracle::examine`] that rounding explains every result that is not exact
    /// ([`Disagreement::is_rounding`]): it is correct for a ray within a few ULPs of the given one, up to the order of
    /// the triangles that this ray passes. A t beyond the tolerance fails; [`Tolerance::ANY_T`] judges triangles alone.
    pub fn faithful<R: JudgedRay>(
        &self,
        rays: &[R],
        intersector: impl FnMut(&Ray) -> Option<Hit>,
    ) -> Result<(), Box<Report>> {
        self.examine(rays, intersector).retain(|wrong| !wrong.is_rounding()).verdict()
    }

    /// Asserts [`Oracle::agrees`].
    #[track_caller]
    pub fn assert_agrees<R: JudgedRay>(&self, rays: &[R], intersector: impl FnMut(&Ray) -> Option<Hit>) {
        assert_ok(self.agrees(rays, intersector), rays);
    }

    /// Asserts [`Oracle::watertight`].
    #[track_caller]
    pub fn assert_watertight<R: JudgedRay>(&self, rays: &[R], intersector: impl FnMut(&Ray) -> Option<Hit>) {
        assert_ok(self.watertight(rays, intersector), rays);
    }

    /// Asserts [`Oracle::faithful`]: no leaks and no false hits.
    #[track_caller]
    pub fn assert_faithful<R: JudgedRay>(&self, rays: &[R], intersector: impl FnMut(&Ray) -> Option<Hit>) {
        assert_ok(self.faithful(rays, intersector), rays);
    }

    fn report<R: JudgedRay>(&self, rays: &[R], hits: &[Option<Hit>]) -> Report {
        let rays: Vec<(Ray, Option<Aim>)> = rays.iter().map(|ray| (*ray.as_ref(), ray.aim())).collect();
        let judged: Vec<(bool, Option<Disagreement>)> = (&rays, hits)
            .into_par_iter()
            .enumerate()
            .map(|(place, ((ray, aim), hit))| {
                let nearest = self.tracer.nearest(ray, self.sides);
                (nearest.is_some(), self.disagreement((place, *aim), ray, nearest, *hit))
            })
            .collect();
        let surface = judged.iter().filter(|(surface, _)| *surface).count();
        let found = hits.iter().flatten().count();
        let wrong = judged.into_iter().filter_map(|(_, wrong)| wrong).collect();
        Report::new([rays.len(), surface, found], self.sides, self.tolerance, wrong)
    }

    fn disagreement(
        &self,
        (place, aim): (usize, Option<Aim>),
        ray: &Ray,
        nearest: Option<NearestHit>,
        found: Option<Hit>,
    ) -> Option<Disagreement> {
        let corners = found.and_then(|hit| self.mesh().corners(hit.triangle));
        let meets = |sides| exact::intersect(ray, &corners?, sides);
        let verdict = classify(self.mesh(), nearest.as_ref(), found);
        let t_ulps = found.zip(nearest.as_ref()).and_then(|(hit, nearest)| ulps(nearest.t.to_f32(), hit.t));
        let right_t = |nearest: &NearestHit, hit: Hit| self.tolerance.allows(hit.t, &nearest.t, t_ulps);
        // Behind the first by less than the tolerance of t.
        let near = |met: &ExactT, nearest: &NearestHit| {
            let met = met.to_f32();
            self.tolerance.allows(met, &nearest.t, ulps(nearest.t.to_f32(), met))
        };
        let met_at = meets(Sides::Both);
        let kind = match (verdict, found) {
            (HitVerdict::Right, Some(hit)) if !nearest.as_ref().is_some_and(|nearest| right_t(nearest, hit)) => {
                DisagreementKind::TOff
            }
            (HitVerdict::Right, _) => return None,
            (HitVerdict::Leak, _) => DisagreementKind::Leak,
            _ if corners.is_none() => DisagreementKind::NoSuchTriangle,
            _ if self.sides == Sides::Front && met_at.is_some() && meets(Sides::Front).is_none() => {
                DisagreementKind::BackFace
            }
            (HitVerdict::FalseHit, _) => DisagreementKind::FalseHit,
            (HitVerdict::WrongTriangle { adjacent }, Some(hit)) => match (&met_at, &nearest) {
                (Some(met), Some(nearest)) if self.tolerance != Tolerance::ANY_T && near(met, nearest) => {
                    DisagreementKind::NearTie
                }
                // A triangle hit far from the common edge or vertex is seen through a hole.
                (Some(_), Some(nearest)) if adjacent && self.passes_contact(ray, nearest, hit) => {
                    DisagreementKind::WrongNeighbour
                }
                (Some(_), _) => DisagreementKind::LeakThrough,
                (None, _) if adjacent => DisagreementKind::WrongNeighbour,
                (None, _) => DisagreementKind::WrongTriangle,
            },
            (HitVerdict::WrongTriangle { .. }, None) => DisagreementKind::WrongTriangle,
        };
        let (kind, right_for, touched_by) = match kind {
            DisagreementKind::TOff | DisagreementKind::NoSuchTriangle => (kind, None, None),
            _ => {
                let (kind, right_for) = self.right_nearby(ray, nearest.as_ref(), found, (kind, met_at.as_ref()));
                match found.filter(|_| right_for.is_none()) {
                    Some(hit) => self.touched_nearby(ray, nearest.as_ref(), hit, kind),
                    None => (kind, right_for, None),
                }
            }
        };
        let shown = found.filter(|_| corners.is_some()).map(|hit| hit.triangle);
        let shown = shown.or_else(|| nearest.as_ref().map(|nearest| nearest.triangle));
        let corners = shown.and_then(|triangle| self.mesh().corners(triangle));
        let (origin, direction) = (ray.origin(), ray.direction());
        Some(Disagreement {
            ray: place,
            aim,
            origin,
            direction,
            kind,
            expected: nearest,
            found,
            t_ulps,
            met_at,
            right_for,
            touched_by,
            corners,
        })
    }

    /// Searches for this ray, or a nearby one, that passes an edge or vertex shared by the found triangle and the ray's
    /// first triangle, or a corner of the found triangle at the same t; returns the kind of error if there is one. At a
    /// vertex where a surface ends, a triangle that faces away ties with the triangles in front of it at one point, and
    /// perhaps no f32 ray hits it first. From far away, a whole surface can be such a point.
    fn touched_nearby(
        &self,
        ray: &Ray,
        nearest: Option<&NearestHit>,
        hit: Hit,
        kind: DisagreementKind,
    ) -> (DisagreementKind, Option<Ray>, Option<Ray>) {
        use DisagreementKind::{FalseHit, Silhouette, WrongNeighbour, WrongTriangle};
        let touches = |ray: &Ray, nearest: Option<&NearestHit>| {
            let ties = |nearest: &NearestHit| {
                passes_corner_at(self.mesh(), ray, hit.triangle, nearest.t.to_f64(), self.nearby_ulps)
            };
            nearest.is_some_and(|nearest| self.passes_contact(ray, nearest, hit) || ties(nearest)).then_some(*ray)
        };
        if !matches!(kind, WrongNeighbour | FalseHit | WrongTriangle) {
            return (kind, None, None);
        }
        let nearby = || turned(ray, self.nearby_ulps);
        let found = touches(ray, nearest)
            .or_else(|| nearby().find_map(|ray| touches(&ray, self.tracer.nearest(&ray, self.sides).as_ref())));
        (if found.is_some() && kind != WrongNeighbour { Silhouette } else { kind }, None, found)
    }

    fn passes_contact(&self, ray: &Ray, nearest: &NearestHit, hit: Hit) -> bool {
        let pairs = nearest.ties.iter().map(|&right| [right, hit.triangle]);
        pairs.into_iter().any(|pair| passes_contact(self.mesh(), ray, pair, self.nearby_ulps))
    }

    /// Searches for a nearby ray for which the hit is correct; returns the kind of error if there is one.
    fn right_nearby(
        &self,
        ray: &Ray,
        nearest: Option<&NearestHit>,
        found: Option<Hit>,
        (kind, met_at): (DisagreementKind, Option<&ExactT>),
    ) -> (DisagreementKind, Option<Ray>) {
        use DisagreementKind::{FalseHit, Leak, LeakThrough, Silhouette, Start, WrongTriangle};
        let excused = matches!(kind, Leak | LeakThrough | FalseHit | WrongTriangle);
        // Half-way between the missed surface and the surface hit behind it.
        let behind = nearest.zip(met_at).filter(|_| kind == LeakThrough);
        let middle = behind.map(|(nearest, met)| (nearest.t.to_f64() + met.to_f64()) / 2.0);
        let mut passed = false;
        let mut is_right = |ray: &Ray| {
            let nearest = self.tracer.nearest(ray, self.sides);
            passed |= middle.is_some_and(|middle| nearest.as_ref().is_none_or(|nearest| nearest.t.to_f64() > middle));
            match found {
                None => nearest.is_none(),
                Some(hit) => nearest.is_some_and(|nearest| nearest.ties.contains(&hit.triangle)),
            }
        };
        if let Some(right) = turned(ray, self.nearby_ulps).find(&mut is_right) {
            return (if excused { Silhouette } else { kind }, Some(right));
        }
        let triangles = nearest.and_then(|nearest| nearest.ties.first().copied()).into_iter();
        let triangles = triangles.chain(found.map(|hit| hit.triangle));
        let corners: Vec<_> = triangles.filter_map(|id| self.mesh().corners(id)).flatten().collect();
        let ts = nearest.map(|nearest| nearest.t.to_f64()).into_iter().chain(found.map(|hit| hit.t.into()));
        let first = ts.fold(f64::INFINITY, |first, t| if t.abs() < first { t.abs() } else { first });
        let right = moved(ray, corners, first, self.nearby_ulps).find(&mut is_right);
        match right {
            Some(_) if excused => (Start, right),
            None if passed => (Silhouette, None),
            _ => (kind, right),
        }
    }
}

#[track_caller]
fn assert_ok<R: JudgedRay>(result: Result<(), Box<Report>>, rays: &[R]) {
    if let Err(report) = result {
        panic!("{}", report.with_aims(rays));
    }
}
