//! Form factors between triangles, by rays (integral: Goral et al. 1984; estimator: Cohen and Wallace 1993, section
//! 4.11).
//!
//! `F(a, b) = 1 / A_a` times the integral over both areas of `cos cos' / (pi r^2) V`: the fraction of the light leaving
//! the front of a that arrives at the front of b. A sample is a uniform point on each: `A_b cos cos' / (pi r^2) V`,
//! whose mean is F.

use std::f64::consts::PI;

use super::counting::CountingCaster;
use super::sampling::{DiscreteDistribution, triangle};
use super::visibility::visible;
use crate::geom::Ray;
use crate::geom::random::CounterRng;
use crate::scene::Scene;
use crate::tracer::offset::{SINGLE, SurfacePoint};
use crate::tracer::{CastError, Caster};

/// Estimated form factor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FormFactor {
    /// Estimate, dimensionless.
    pub value: f64,
    /// Estimated variance of the estimate; 0 for one sample.
    pub variance: f64,
}

/// Estimates the form factor from patch `a` to patch `b`, each a list of front-facing triangles: the fraction of the
/// light leaving `a` that arrives at `b`. Takes `samples` pairs of points; pairs that face away from each other cost no
/// ray. 0 if either has no area. Fails with [`CastError`] if the caster fails.
pub fn form_factor(
    scene: &Scene,
    a: &[u32],
    b: &[u32],
    samples: u32,
    seed: u64,
    caster: &mut dyn Caster,
) -> Result<FormFactor, CastError> {
    let (from, to) = (Patch::new(scene, a), Patch::new(scene, b));
    let pairs = (0..u64::from(samples)).map(|sample| pair(&from, &to, CounterRng::new(seed), sample));
    let pairs: Vec<Option<(f64, Ray)>> = pairs.collect();
    let rays: Vec<Option<Ray>> = pairs.iter().flatten().map(|pair| Some(pair.1)).collect();
    let mut ignore = |_| {};
    let seen = visible(&rays, &mut CountingCaster::new(caster, &mut ignore))?;
    let (mut sum, mut squares) = (0.0, 0.0);
    for ((value, _), seen) in pairs.into_iter().flatten().zip(seen) {
        if seen {
            sum += value;
            squares += value * value;
        }
    }
    let n = f64::from(samples.max(1));
    let value = sum / n;
    let variance = if samples > 1 { (squares - n * value * value).max(0.0) / (n * (n - 1.0)) } else { 0.0 };
    Ok(FormFactor { value, variance })
}

/// Samples two points that face each other: the integrand without V, and the ray between them.
fn pair(from: &Patch<'_>, to: &Patch<'_>, random: CounterRng, sample: u64) -> Option<(f64, Ray)> {
    let number = |dimension| random.unit(0, sample, dimension);
    let p = from.place(number(0), [number(1), number(2)])?;
    let q = to.place(number(3), [number(4), number(5)])?;
    let offset = q.at - p.at;
    let square = offset.dot(offset);
    let cosines = [offset.dot(p.normal), -offset.dot(q.normal)];
    if !(square > 0.0 && cosines.iter().all(|&cosine| cosine > 0.0)) {
        return None;
    }
    Some((to.area * cosines[0] * cosines[1] / (PI * square * square), p.ray_to(&q)?))
}

/// Triangles whose points are sampled uniformly by area.
struct Patch<'a> {
    scene: &'a Scene,
    triangles: &'a [u32],
    table: DiscreteDistribution,
    area: f64,
}

impl<'a> Patch<'a> {
    fn new(scene: &'a Scene, triangles: &'a [u32]) -> Self {
        let table = DiscreteDistribution::new(triangles.iter().map(|&id| scene.mesh().area(id)));
        let area = table.total();
        Self { scene, triangles, table, area }
    }

    fn place(&self, which: f64, u: [f64; 2]) -> Option<SurfacePoint> {
        let (entry, _) = self.table.draw(which)?;
        SurfacePoint::new(self.scene.mesh(), self.triangles[entry], triangle(u), SINGLE)
    }
}
