//! The visible fraction of the exchange of two patches, by rays between stratified points weighted with the integrand.
//!
//! The estimate is consistent, and exactly 1 where every ray is unoccluded: an empty room keeps its unoccluded factors
//! to the bit.

use rayon::prelude::*;

use super::exchange::kernel;
use crate::error::{InputError, ensure};
use crate::geom::random::CounterRng;
use crate::geom::vector::narrow;
use crate::geom::{Hit, Ray};
use crate::linalg::Matrix;
use crate::radiosity::Patches;
use crate::tracer::Caster;
use crate::tracer::offset::scene_clearance;

/// Parameters of the visibility estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VisibilityParameters {
    /// Strata along a side of a patch, at least 1; a pair has the square of this number of rays.
    pub side: u32,
    /// Random seed.
    pub seed: u64,
    /// Approximate number of rays traced at a time.
    pub bundle: usize,
}

impl Default for VisibilityParameters {
    fn default() -> Self {
        Self { side: 3, seed: 1, bundle: 1 << 18 }
    }
}

/// Ray between two patches with its weight.
#[derive(Clone, Copy, Debug)]
struct VisibilitySample {
    weight: f64,
    ray: Option<Ray>,
    /// Ray parameter from which a hit counts as the far end.
    arrives: f32,
}

/// Multiplies the factors above the diagonal by the visible fraction.
pub(super) fn hide(
    patches: &Patches,
    factors: &mut Matrix,
    caster: &mut dyn Caster,
    parameters: VisibilityParameters,
    done: &mut dyn FnMut(usize, usize),
) -> Result<(), InputError> {
    ensure!(parameters.side > 0, "radiosity::form_factors" =>
        "expected 1 sample or more along a side of a patch, found 0");
    let pairs: Vec<[u32; 2]> = factors
        .rows()
        .enumerate()
        .flat_map(|(i, row)| (i + 1..row.len()).filter(|&j| row[j] > 0.0).map(move |j| [i as u32, j as u32]))
        .collect();
    let rays_a_pair = (parameters.side as usize).saturating_mul(parameters.side as usize);
    let at_a_time = (parameters.bundle / rays_a_pair).max(1);
    for (round, bundle) in pairs.chunks(at_a_time).enumerate() {
        let samples: Vec<VisibilitySample> =
            bundle.par_iter().flat_map_iter(|&pair| samples(patches, pair, parameters)).collect();
        let rays: Vec<Ray> = samples.iter().filter_map(|sample| sample.ray).collect();
        let hits = caster.cast(&rays).map_err(|error| InputError::of("radiosity::form_factors", error))?;
        let mut hits = hits.into_iter();
        for (&[i, j], samples) in bundle.iter().zip(samples.chunks(rays_a_pair)) {
            let faces = [i, j].map(|patch| patches.list()[patch as usize].face);
            factors.row_mut(i as usize)[j as usize] *= share(patches, faces, samples, &mut hits);
        }
        done((round * at_a_time + bundle.len()).min(pairs.len()), pairs.len());
    }
    Ok(())
}

/// The rays of a pair: a jittered point in each stratum of one patch, with one in a random stratum of the other.
fn samples(patches: &Patches, [i, j]: [u32; 2], parameters: VisibilityParameters) -> Vec<VisibilitySample> {
    let pair = [i, j].map(|patch| &patches.list()[patch as usize]);
    let (random, index) = (CounterRng::new(parameters.seed), u64::from(i) << 32 | u64::from(j));
    let (side, lift) = (parameters.side as usize, scene_clearance(patches.extent()));
    let at = |patch: u32, stratum: usize, sample: u64, dimension: u64| {
        let along = |k: usize, d| (k as f64 + random.unit(index, sample, dimension + d)) / side as f64;
        let point = patches.open_point(patch as usize, [along(stratum % side, 0), along(stratum / side, 1)]);
        (point.at, point.density)
    };
    let mut far: Vec<usize> = (0..side * side).collect();
    let mut dealt = Vec::with_capacity(far.len());
    for sample in 0..side * side {
        let number = sample as u64;
        // Fisher-Yates: each stratum of the other patch is used exactly once.
        let left = (far.len() - sample) as u64;
        far.swap(sample, sample + (random.bits(index, number, 4) % left) as usize);
        let ((x, dx), (y, dy)) = (at(i, sample, number, 0), at(j, far[sample], number, 2));
        let start = x + lift * pair[0].normal();
        let to = y - start;
        let (ray, arrives) = (Ray::new(narrow(start), narrow(to)).ok(), (1.0 - 2.0 * lift / to.length()) as f32);
        dealt.push(VisibilitySample { weight: dx * dy * kernel(pair, x, y), ray, arrives });
    }
    dealt
}

/// Unoccluded fraction of the samples' weight; consumes one hit per ray.
fn share(
    patches: &Patches,
    faces: [u32; 2],
    samples: &[VisibilitySample],
    hits: &mut impl Iterator<Item = Option<Hit>>,
) -> f64 {
    let (mut open, mut all) = (0.0, 0.0);
    for sample in samples {
        all += sample.weight;
        // A hit does not occlude if it is the far end, or on the face at which the ray starts or ends: a flat face
        // cannot hide its own points.
        let passes = |hit: Hit| hit.t >= sample.arrives || faces.contains(&patches.face_of(hit.triangle));
        let hit = if sample.ray.is_some() { hits.next().flatten() } else { None };
        if hit.is_none_or(passes) {
            open += sample.weight;
        }
    }
    // If all weights are 0, the quotient would be NaN.
    if open == all { 1.0 } else { open / all }
}
