//! Which cluster approximates each point best: estimates in f32 with bounds of their errors, then f64 among those that
//! the bounds leave.
//!
//! Points and subspaces are taken relative to the mean g of all points and scaled by a power of two, so that no point
//! is longer than 1. With X = |x - g|, M = |x_0 - g|, S = X + M, D = |x - x_0| and n' vectors, an inner product of n
//! terms in f32, summed in chunks, is off by at most e times the lengths of its vectors,
//! `e = (CHUNK + n / CHUNK + 8) 2^-24`. A weight is then off by at most e S, a sum of n' squared weights by
//! `2 sqrt(n') D e S + n' (e S)^2` because it is at most D^2, and D^2 by e S^2. [`bound`] is their sum with the
//! rounding of the additions. The cluster with the least error in f64 is among those whose estimate less its bound is
//! at most the least estimate plus its bound.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::AffineSubspace;
use super::products::{Packed, ROWS, add_block};
use crate::linalg::dot;
use crate::prt::Signal;

/// Points that are estimated side by side.
const LANES: usize = 16;
/// Groups of them that share the rows in the cache.
const GROUPS: usize = 4;
/// Terms of an inner product that are summed in f32 before they join the rest.
const CHUNK: usize = 128;
/// The rounding of an operation in f32.
const UNIT: f32 = 1.0 / (1 << 24) as f32;
/// Added to each bound, against products too small for f32; lengths are at most 1.
const SMALL: f32 = 1e-30;

type Lanes = [f32; LANES];

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
    level: SimdLevel,
}

/// A row of the estimates: which vector of which cluster.
#[derive(Clone, Copy, Debug)]
enum RowKind {
    /// The cluster's mean, with its squared length.
    Mean(f32),
    /// One of its vectors, with the mean's weight on it.
    Vector(f32),
}

/// Subspaces in f32, scaled.
struct Estimator {
    rows: Packed<f32, ROWS>,
    kinds: Vec<(usize, RowKind)>,
    /// Per cluster the mean's length and the number of vectors.
    bounds: Vec<(f32, f32)>,
    error: f32,
}

/// Estimates of a group of points: per cluster the squared error and the squared distance from the mean.
struct Estimates {
    errors: Vec<Lanes>,
    distances: Vec<Lanes>,
    squares: Lanes,
}

impl<'a> Points<'a> {
    pub(super) fn new(signal: &'a Signal, level: SimdLevel) -> Self {
        let points = 0..signal.points();
        let center: Vec<f64> = (0..signal.dimension()).into_par_iter().map(|j| component_mean(signal, j)).collect();
        let square = |point| {
            let differences = signal.point(point).iter().zip(&center).map(|(&value, g)| f64::from(value) - g);
            differences.map(|d| d * d).sum::<f64>()
        };
        let largest = points.into_par_iter().map(square).reduce(|| 0.0, f64::max).sqrt();
        Self { signal, scale: to_at_most_one(largest), center, level }
    }

    /// The best cluster of each point.
    pub(super) fn nearest(&self, subspaces: &[&AffineSubspace]) -> Nearest {
        let estimator = self.estimator(subspaces);
        let points = self.signal.points();
        let mut found = Nearest { cluster: vec![0; points], squared_error: vec![0.0; points] };
        let clusters = found.cluster.par_chunks_mut(LANES * GROUPS);
        let blocks = clusters.zip(found.squared_error.par_chunks_mut(LANES * GROUPS)).enumerate();
        let scratch = || ([(); GROUPS].map(|()| Estimates::new(subspaces.len())), Vec::new());
        blocks.for_each_init(scratch, |(groups, scratch), (at, (clusters, errors))| {
            let first = at * LANES * GROUPS;
            self.level.run(
                #[inline(always)]
                || self.estimate(first, clusters.len(), &estimator, groups),
            );
            for (i, (cluster, error)) in clusters.iter_mut().zip(errors).enumerate() {
                let point = self.signal.point(first + i);
                let candidates = groups[i / LANES].candidates(i % LANES);
                (*cluster, *error) = least(point, subspaces, candidates, scratch);
            }
        });
        found
    }

    fn estimator(&self, subspaces: &[&AffineSubspace]) -> Estimator {
        let dimension = self.signal.dimension();
        let (mut kinds, mut bounds, mut rows) = (Vec::new(), Vec::new(), Vec::new());
        for (cluster, subspace) in subspaces.iter().enumerate() {
            let offset: Vec<f64> = subspace.mean.iter().zip(&self.center).map(|(m, g)| (m - g) * self.scale).collect();
            let square = dot(&offset, &offset);
            kinds.push((cluster, RowKind::Mean(square as f32)));
            kinds.extend(subspace.vectors().map(|v| (cluster, RowKind::Vector(dot(v, &offset) as f32))));
            bounds.push((square.sqrt() as f32, subspace.len() as f32));
            rows.push(offset);
            rows.extend(subspace.vectors().map(<[f64]>::to_vec));
        }
        let rows = Packed::new(rows.len(), dimension, |at, into: &mut [f32]| {
            into.iter_mut().zip(&rows[at]).for_each(|(into, &value)| *into = value as f32);
        });
        let error = (CHUNK + dimension / CHUNK + 8) as f32 * UNIT;
        Estimator { rows, kinds, bounds, error }
    }

    /// Estimates for `count` points from `first` on, in groups.
    #[inline(always)]
    fn estimate(&self, first: usize, count: usize, estimator: &Estimator, groups: &mut [Estimates; GROUPS]) {
        let columns = Packed::<f32, LANES>::new(count, self.signal.dimension(), |at, into| {
            let values = self.signal.point(first + at).iter().zip(&self.center);
            into.iter_mut().zip(values).for_each(|(into, (&x, g))| *into = ((f64::from(x) - g) * self.scale) as f32);
        });
        for (group, points) in groups.iter_mut().zip(columns.groups()) {
            group.square(points);
        }
        for (tile, rows) in estimator.rows.groups().enumerate() {
            let kinds = &estimator.kinds[tile * ROWS..];
            for (group, points) in groups.iter_mut().zip(columns.groups()) {
                let mut sums = [[0.0; LANES]; ROWS];
                for (rows, points) in rows.chunks(CHUNK).zip(points.chunks(CHUNK)) {
                    add_block(rows, points, &mut sums);
                }
                for (&(cluster, kind), sums) in kinds.iter().zip(&sums) {
                    group.fold(cluster, kind, sums);
                }
            }
        }
        for group in groups {
            group.subtract_bounds(estimator);
        }
    }
}

impl Estimates {
    fn new(clusters: usize) -> Self {
        let empty = vec![[0.0; LANES]; clusters];
        Self { errors: empty.clone(), distances: empty, squares: [0.0; LANES] }
    }

    /// Takes the points' squared lengths. What was estimated before is overwritten with the rows of the means.
    #[inline(always)]
    fn square(&mut self, points: &[Lanes]) {
        let mut squares = [0.0_f64; LANES];
        for values in points {
            for lane in 0..LANES {
                squares[lane] += f64::from(values[lane]) * f64::from(values[lane]);
            }
        }
        self.squares = squares.map(|square| square as f32);
    }

    /// Takes the products with one row of a cluster. A mean's row comes before those of its vectors.
    #[inline(always)]
    fn fold(&mut self, cluster: usize, kind: RowKind, products: &Lanes) {
        let (errors, distances) = (&mut self.errors[cluster], &mut self.distances[cluster]);
        match kind {
            RowKind::Mean(mean) => {
                for lane in 0..LANES {
                    distances[lane] = self.squares[lane] - 2.0 * products[lane] + mean;
                }
                *errors = *distances;
            }
            RowKind::Vector(offset) => {
                for lane in 0..LANES {
                    let along = products[lane] - offset;
                    errors[lane] -= along * along;
                }
            }
        }
    }

    /// Leaves the least possible errors in `errors`, and puts the least possible of the greatest into `squares`.
    #[inline(always)]
    fn subtract_bounds(&mut self, estimator: &Estimator) {
        let (lengths, mut least) = (self.squares.map(f32::sqrt), [f32::INFINITY; LANES]);
        for ((errors, distances), &(mean, vectors)) in
            self.errors.iter_mut().zip(&self.distances).zip(&estimator.bounds)
        {
            let root = vectors.sqrt();
            for lane in 0..LANES {
                let bound = bound(estimator.error, lengths[lane] + mean, distances[lane], vectors, root);
                least[lane] = least[lane].min(errors[lane] + bound);
                errors[lane] -= bound;
            }
        }
        self.squares = least;
    }

    fn candidates(&self, lane: usize) -> impl Iterator<Item = usize> {
        let least = self.squares[lane];
        self.errors.iter().enumerate().filter(move |(_, errors)| errors[lane] <= least).map(|(cluster, _)| cluster)
    }
}

/// How far an estimate may be off. `error` is e, `sum` is S, `distance` the estimate of D^2.
#[inline(always)]
fn bound(error: f32, sum: f32, distance: f32, vectors: f32, root_of_vectors: f32) -> f32 {
    let weight = error * sum;
    // The estimate of D^2 is itself off by at most e S^2.
    let distance = (distance + weight * sum).max(0.0);
    let squares = 2.0 * root_of_vectors * weight * distance.sqrt() + vectors * weight * weight;
    weight * sum + squares + 4.0 * (vectors + 8.0) * UNIT * distance + SMALL
}

/// The candidate of least error in f64, the lower of equals.
fn least(
    point: &[f32],
    subspaces: &[&AffineSubspace],
    candidates: impl Iterator<Item = usize>,
    scratch: &mut Vec<f64>,
) -> (u32, f64) {
    let mut best = (0, f64::INFINITY);
    for cluster in candidates {
        let error = subspaces[cluster].squared_error(point, scratch);
        if error < best.1 {
            best = (cluster as u32, error);
        }
    }
    best
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
    use crate::prt::synthetic::torus_signal;

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

    #[test]
    fn estimates_never_lose_the_best_cluster() {
        for (dimension, vectors) in [(3, 0), (3, 3), (40, 5), (300, 7)] {
            for (scale, offset) in [(1.0, 0.0), (1.0, 1e4), (1e-38, 3.0), (1e33, 100.0)] {
                let (signal, subspaces) = far_apart(dimension, scale, offset, vectors);
                let subspaces: Vec<_> = subspaces.iter().collect();
                let (mut scratch, all) = (Vec::new(), 0..subspaces.len());
                for level in SimdLevel::available() {
                    let found = Points::new(&signal, level).nearest(&subspaces);
                    for point in 0..signal.points() {
                        let best = least(signal.point(point), &subspaces, all.clone(), &mut scratch);
                        let found = (found.cluster[point], found.squared_error[point]);
                        assert_eq!(found, best, "{dimension} numbers, scale {scale}, offset {offset}, point {point}");
                    }
                }
            }
        }
    }

    #[test]
    fn errors_are_above_their_lower_bounds() {
        for (dimension, vectors) in [(3, 2), (40, 5), (300, 7)] {
            for offset in [0.0, 1e4] {
                let (signal, subspaces) = far_apart(dimension, 1.0, offset, vectors);
                let (subspaces, mut scratch): (Vec<_>, _) = (subspaces.iter().collect(), Vec::new());
                let points = Points::new(&signal, SimdLevel::widest());
                let mut groups = [(); GROUPS].map(|()| Estimates::new(subspaces.len()));
                points.estimate(0, LANES * GROUPS, &points.estimator(&subspaces), &mut groups);
                for point in 0..LANES * GROUPS {
                    let (group, lane) = (&groups[point / LANES], point % LANES);
                    for (subspace, lower) in subspaces.iter().zip(&group.errors) {
                        let error = subspace.squared_error(signal.point(point), &mut scratch);
                        let error = error * points.scale * points.scale;
                        assert!(f64::from(lower[lane]) <= error, "{} for {error}", lower[lane]);
                    }
                }
            }
        }
    }

    #[test]
    fn estimates_leave_few_candidates() {
        let signal = torus_signal(2000, 100, 3);
        let subspaces: Vec<AffineSubspace> = (0..2000)
            .step_by(40)
            .map(|at| AffineSubspace::at(signal.point(at).iter().map(|&value| f64::from(value)).collect()))
            .collect();
        let subspaces: Vec<_> = subspaces.iter().collect();
        let points = Points::new(&signal, SimdLevel::widest());
        let (estimator, mut groups) = (points.estimator(&subspaces), [(); GROUPS].map(|()| Estimates::new(50)));
        points.estimate(0, LANES * GROUPS, &estimator, &mut groups);
        let left: usize = groups.iter().flat_map(|group| (0..LANES).map(|lane| group.candidates(lane).count())).sum();
        assert!(left < 2 * LANES * GROUPS, "{left} candidates for {} points", LANES * GROUPS);
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
