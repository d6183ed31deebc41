//! Which cluster approximates each point best: lower bounds of all errors in f32, then f64 among those clusters that
//! the bounds leave.
//!
//! The cluster whose bound is least is tried first. The one of least error in f64 is this one, or among those whose
//! bound is at most its error. So the result is that of comparing every point with every cluster; bounds along a few
//! axes alone ([`Axes`]), or no bounds at all, change the time it takes.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::axes::Axes;
use super::estimate::{Estimator, LANES, LowerBounds, ScaledSubspace};
use super::least::{LeastScratch, least};
use super::products::Packed;
use super::{AffineSubspace, CpcaForm};
use crate::linalg::dot;
use crate::transfer::Signal;

/// Groups of points that share the rows in the cache.
const GROUPS: usize = 4;
const BLOCK: usize = LANES * GROUPS;

/// Each point's best cluster, and the squared error of its approximation there.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Nearest {
    pub(super) cluster: Vec<u32>,
    pub(super) squared_error: Vec<f64>,
}

/// A signal about to be held against subspaces.
#[derive(Debug)]
pub(super) struct Points<'a> {
    signal: &'a Signal,
    center: Vec<f64>,
    scale: f64,
    axes: Option<Axes>,
    level: SimdLevel,
}

impl<'a> Points<'a> {
    pub(super) fn new(signal: &'a Signal, form: CpcaForm, level: SimdLevel) -> Self {
        let center = match form {
            CpcaForm::Affine => {
                (0..signal.dimension()).into_par_iter().map(|j| component_mean(signal, j)).collect::<Vec<_>>()
            }
            // That of the subspaces.
            CpcaForm::Linear => vec![0.0; signal.dimension()],
        };
        let square = |point| {
            let differences = signal.point(point).iter().zip(&center).map(|(&value, g)| f64::from(value) - g);
            differences.map(|d| d * d).sum::<f64>()
        };
        let largest = (0..signal.points()).into_par_iter().map(square).reduce(|| 0.0, f64::max).sqrt();
        let scale = to_at_most_one(largest);
        let axes = Axes::new(signal, &center, scale, level);
        Self { signal, center, scale, axes, level }
    }

    /// The best cluster of each point. Points are taken in a given order, all of them once; the nearer those that
    /// follow each other, the faster.
    pub(super) fn nearest(&self, subspaces: &[&AffineSubspace], order: &[u32]) -> Nearest {
        let estimator = self.estimator(subspaces);
        let mut found = vec![(0, 0.0); order.len()];
        let blocks = found.par_chunks_mut(BLOCK).zip(order.par_chunks(BLOCK));
        let scratch = || (vec![LowerBounds::new(subspaces.len()); GROUPS], LeastScratch::default());
        blocks.for_each_init(scratch, |(groups, scratch), (found, points)| {
            self.level.run(
                #[inline(always)]
                || estimator.estimate(&self.packed(points), groups),
            );
            let points: Vec<&[f32]> = points.iter().map(|&point| self.signal.point(point as usize)).collect();
            self.level.run(
                #[inline(always)]
                || least(&points, subspaces, (groups, self.scale), scratch, found),
            );
        });
        let mut nearest = Nearest { cluster: vec![0; order.len()], squared_error: vec![0.0; order.len()] };
        for (&point, (cluster, error)) in order.iter().zip(found) {
            (nearest.cluster[point as usize], nearest.squared_error[point as usize]) = (cluster, error);
        }
        nearest
    }

    fn estimator(&self, subspaces: &[&AffineSubspace]) -> Estimator {
        let dimension = self.axes.as_ref().map_or(self.signal.dimension(), Axes::count);
        let scaled: Vec<_> = subspaces.par_iter().map(|subspace| self.scaled(subspace)).collect();
        Estimator::new(dimension, &scaled)
    }

    fn scaled(&self, subspace: &AffineSubspace) -> ScaledSubspace {
        let offset: Vec<f64> = subspace.mean.iter().zip(&self.center).map(|(m, g)| (m - g) * self.scale).collect();
        let offset = if offset.iter().all(|&value| value == 0.0) { Vec::new() } else { offset };
        match &self.axes {
            Some(axes) => axes.project(subspace, &offset, self.level),
            None => {
                let length = dot(&offset, &offset).sqrt();
                ScaledSubspace { length, offset, vectors: subspace.vectors.clone() }
            }
        }
    }

    /// Points relative to the center and scaled, along the axes if there are any.
    #[inline(always)]
    fn packed(&self, points: &[u32]) -> Packed<f32, LANES> {
        match &self.axes {
            Some(axes) => Packed::new(points.len(), axes.count(), |at, into| {
                into.copy_from_slice(axes.point(points[at] as usize));
            }),
            None => Packed::new(points.len(), self.signal.dimension(), |at, into| {
                let values = self.signal.point(points[at] as usize).iter().zip(&self.center);
                into.iter_mut()
                    .zip(values)
                    .for_each(|(into, (&x, g))| *into = ((f64::from(x) - g) * self.scale) as f32);
            }),
        }
    }
}

fn component_mean(signal: &Signal, component: usize) -> f64 {
    let values = signal.values().iter().skip(component).step_by(signal.dimension());
    values.map(|&value| f64::from(value)).sum::<f64>() / signal.points() as f64
}

/// A power of two that brings a length to at most 1 and, if it is not 0, to more than 1/4.
fn to_at_most_one(length: f64) -> f64 {
    let exponent = (length.to_bits() >> 52) & 0x7ff;
    if length == 0.0 { 1.0 } else { f64::from_bits((2045 - exponent.clamp(1, 2044)) << 52) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random::CounterRng;
    use crate::transfer::clustering::{CpcaMethod, CpcaOptions, StartPoints, compress};
    use crate::transfer::synthetic::torus_signal;

    /// A signal moved far from the origin, and subspaces of some of its points and differences.
    fn far_apart(dimension: usize, scale: f32, offset: f32, vectors: usize) -> (Signal, Vec<AffineSubspace>) {
        let signal = torus_signal(333, dimension, 9);
        let values = signal.values().iter().map(|value| scale * (value + offset));
        let signal = Signal::new(dimension, values.collect()).expect("a signal");
        let subspace = |at: usize| {
            let mean: Vec<f64> = signal.point(at).iter().map(|&value| f64::from(value)).collect();
            let axis = |i: usize| (0..dimension).map(move |j| f64::from(u8::from(j == (at + i) % dimension)));
            AffineSubspace { mean, vectors: (0..vectors).flat_map(axis).collect(), eigenvalues: vec![1.0; vectors] }
        };
        (signal.clone(), (0..333).step_by(9).map(subspace).collect())
    }

    /// The decision without bounds: every cluster, as one reads it.
    fn full_search(signal: &Signal, subspaces: &[&AffineSubspace]) -> Nearest {
        let (mut nearest, mut residual) = (Nearest::default(), Vec::new());
        for point in 0..signal.points() {
            let mut best = (0, f64::INFINITY);
            for (cluster, subspace) in subspaces.iter().enumerate() {
                let error = subspace.squared_error(signal.point(point), &mut residual);
                best = if error < best.1 { (cluster as u32, error) } else { best };
            }
            nearest.cluster.push(best.0);
            nearest.squared_error.push(best.1);
        }
        nearest
    }

    fn assert_full(signal: &Signal, subspaces: &[&AffineSubspace], what: &str) {
        let (expected, points) = (full_search(signal, subspaces), signal.points() as u32);
        let orders: [Vec<u32>; 2] = [(0..points).collect(), (0..points).rev().collect()];
        for level in SimdLevel::available() {
            for form in [CpcaForm::Affine, CpcaForm::Linear] {
                for order in &orders {
                    let found = Points::new(signal, form, level).nearest(subspaces, order);
                    assert_eq!(found, expected, "{what}, {} and {form:?}", level.name());
                }
            }
        }
    }

    #[test]
    fn the_result_is_that_of_the_full_search() {
        for (dimension, vectors) in [(3, 0), (3, 3), (40, 5), (300, 0), (300, 7)] {
            for (scale, offset) in [(1.0, 0.0), (1.0, 1e4), (1e-38, 3.0), (1e33, 100.0)] {
                let (signal, subspaces) = far_apart(dimension, scale, offset, vectors);
                let what = format!("{dimension} numbers, scale {scale}, offset {offset}");
                assert_full(&signal, &subspaces.iter().collect::<Vec<_>>(), &what);
            }
        }
    }

    /// Signals drawn at random, some with points that repeat, of low rank or 0, and subspaces fitted to them, some of
    /// them twice, so that there are ties.
    #[test]
    fn the_result_is_that_of_the_full_search_whatever_is_drawn() {
        let mut axes = 0;
        for seed in 0..40 {
            let random = CounterRng::new(seed);
            let draw = |what: u64, range: u64| random.bits(what, 0, 0) % range;
            let (points, dimension) = (60 + draw(0, 200) as usize, 100 + draw(1, 300) as usize);
            let rank = 1 + draw(2, 40) as usize;
            let waves = torus_signal(points, rank, seed);
            let mix = |i: u64, j: u64| (random.unit(i, 1, j) - 0.5) * if draw(3, 2) == 0 { 1.0 } else { 1e-3 };
            let noise = [0.0, 1e-5, 0.1][draw(4, 3) as usize];
            let value = |point: usize, j: usize| {
                let point = if draw(5, 3) == 0 { point / 2 } else { point };
                let wave = waves.point(point).iter().enumerate();
                let sum: f64 = wave.map(|(i, &value)| f64::from(value) * mix(i as u64, j as u64)).sum();
                let dark = draw(6, 3) == 0 && point.is_multiple_of(5);
                if dark { 0.0 } else { (sum + noise * (random.unit(point as u64, 2, j as u64) - 0.5)) as f32 }
            };
            let values = (0..points * dimension).map(|at| value(at / dimension, at % dimension)).collect();
            let signal = Signal::new(dimension, values).expect("a signal");
            let form = [CpcaForm::Affine, CpcaForm::Linear][draw(7, 2) as usize];
            let (method, start) = (CpcaMethod::Doubling, StartPoints::Seed(seed));
            let (clusters, vectors) = (1 + draw(8, 9) as usize, 1 + draw(9, 6) as usize);
            let options = CpcaOptions { clusters, vectors, iterations: 2, method, form, start };
            let fitted = compress(&signal, &options, |_| ()).expect("compressed").clustering;
            let mut subspaces: Vec<_> = fitted.subspaces().iter().collect();
            subspaces.extend(fitted.subspaces().iter().take(2));
            assert_full(&signal, &subspaces, &format!("seed {seed}"));
            axes += usize::from(Points::new(&signal, form, SimdLevel::Baseline).axes.is_some());
        }
        assert!((20..40).contains(&axes), "with axes and without: {axes}");
    }

    #[test]
    fn errors_are_above_their_lower_bounds() {
        for (dimension, vectors) in [(3, 2), (40, 5), (300, 7)] {
            for offset in [0.0, 1e4] {
                for form in [CpcaForm::Affine, CpcaForm::Linear] {
                    let (signal, subspaces) = far_apart(dimension, 1.0, offset, vectors);
                    let (subspaces, mut scratch): (Vec<_>, _) = (subspaces.iter().collect(), Vec::new());
                    let points = Points::new(&signal, form, SimdLevel::widest());
                    let mut groups = vec![LowerBounds::new(subspaces.len()); GROUPS];
                    let some: Vec<u32> = (0..BLOCK as u32).collect();
                    points.estimator(&subspaces).estimate(&points.packed(&some), &mut groups);
                    for point in 0..BLOCK {
                        let bounds = groups[point / LANES].of(point % LANES);
                        for (subspace, lower) in subspaces.iter().zip(bounds) {
                            let error = subspace.squared_error(signal.point(point), &mut scratch);
                            let error = error * points.scale * points.scale;
                            assert!(f64::from(lower) <= error, "{lower} for {error}");
                        }
                    }
                }
            }
        }
    }

    /// Bounds that hold no cluster back would pass every other test.
    #[test]
    fn bounds_leave_few_clusters() {
        for (dimension, vectors, most) in [(100, 0, 0.05), (100, 3, 0.2), (400, 0, 0.05), (400, 3, 0.2)] {
            let signal = torus_signal(2000, dimension, 3);
            let (method, form, start) = (CpcaMethod::Doubling, CpcaForm::Affine, StartPoints::Seed(1));
            let options = CpcaOptions { clusters: 50, vectors, iterations: 2, method, form, start };
            let fitted = compress(&signal, &options, |_| ()).expect("compressed").clustering;
            let subspaces: Vec<_> = fitted.subspaces().iter().collect();
            let points = Points::new(&signal, form, SimdLevel::widest());
            let mut groups = vec![LowerBounds::new(50); GROUPS];
            let some: Vec<u32> = (0..BLOCK as u32).collect();
            points.estimator(&subspaces).estimate(&points.packed(&some), &mut groups);
            let left = |at: usize| {
                let error = fitted.squared_error_of(at, &signal) * points.scale * points.scale;
                groups[at / LANES].of(at % LANES).filter(|&lower| f64::from(lower) <= error).count()
            };
            let left = (0..BLOCK).map(left).sum::<usize>() as f64 / (50 * BLOCK) as f64;
            assert!(left < most, "{dimension} numbers, {vectors} vectors: {left} of all clusters");
        }
    }

    #[test]
    fn lengths_come_to_at_most_one() {
        for length in [1.0, 0.999, 2.0, 3.5e38, 1e-300, f64::MIN_POSITIVE] {
            let scaled = length * to_at_most_one(length);
            assert!(scaled <= 1.0 && scaled > 0.2, "{length} to {scaled}");
        }
        assert_eq!(to_at_most_one(0.0), 1.0);
    }
}
