//! The cluster that approximates each point best: lower bounds of errors in f32, then errors in f64 for the remaining
//! clusters.
//!
//! - A point's previous cluster is tried first, in f64. The best cluster is this one, or one whose lower bounds do not
//!   exceed its error.
//! - Points are in groups of near ones ([`Groups`]). The distance from a subspace changes by at most the distance
//!   between two points, so a bound for the group's center bounds all its points, for a sixteenth of the work. A few
//!   clusters in a hundred remain. Where a subspace has moved little, the previous bound is sufficient ([`Carried`]).
//! - For these each point has a bound of its own ([`Estimator`]). The remaining clusters are compared in f64.
//!
//! The result is that of comparing every point with every cluster, the lower among equals; bounds along a few axes
//! ([`Axes`]), other groups, other initial clusters, or no bounds at all change only the time.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::axes::Axes;
use super::carried::Carried;
use super::estimate::{Estimator, LANES, LowerBounds, ScaledSubspace};
use super::groups::{Groups, PointGroup};
use super::least::ErrorRequests;
use super::{AffineSubspace, CpcaForm};
use crate::linalg::dot;
use crate::transfer::Signal;

/// Each point's best cluster, and the squared error of its approximation there.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Nearest {
    pub(super) cluster: Vec<u32>,
    pub(super) squared_error: Vec<f64>,
    /// Number of bounds and errors computed, for pairs of a cluster and a point or a group's center.
    pub(super) looked_at: usize,
}

/// A signal about to be held against subspaces.
#[derive(Debug)]
pub(super) struct Points<'a> {
    signal: &'a Signal,
    center: Vec<f64>,
    scale: f64,
    axes: Option<Axes>,
    groups: Groups,
    level: SimdLevel,
}

impl<'a> Points<'a> {
    pub(super) fn new(signal: &'a Signal, form: CpcaForm, level: SimdLevel) -> Self {
        let dimension = signal.dimension();
        let center = match form {
            CpcaForm::Affine => (0..dimension).into_par_iter().map(|j| component_mean(signal, j)).collect::<Vec<_>>(),
            // That of the subspaces.
            CpcaForm::Linear => vec![0.0; dimension],
        };
        let square = |point| {
            let differences = signal.point(point).iter().zip(&center).map(|(&value, g)| f64::from(value) - g);
            differences.map(|d| d * d).sum::<f64>()
        };
        let largest = (0..signal.points()).into_par_iter().map(square).reduce(|| 0.0, f64::max).sqrt();
        let scale = to_at_most_one(largest);
        let (axes, groups) = match Axes::new(signal, &center, scale, level) {
            Some((axes, points)) => {
                let groups = Groups::new(&points, axes.count());
                (Some(axes), groups)
            }
            None => {
                let values = signal.values().iter().zip(center.iter().cycle());
                let values: Vec<f32> = values.map(|(&x, g)| ((f64::from(x) - g) * scale) as f32).collect();
                (None, Groups::new(&values, dimension))
            }
        };
        Self { signal, center, scale, axes, groups, level }
    }

    /// The best cluster of each point. `before` are clusters to begin with, one per point, or none, and `carried` is
    /// what the last search left: the better they are, the faster.
    pub(super) fn nearest(&self, subspaces: &[&AffineSubspace], before: &[u32], carried: &mut Carried) -> Nearest {
        let scaled: Vec<_> = subspaces.par_iter().map(|subspace| self.scaled(subspace)).collect();
        let search = NearestSearch { points: self, subspaces, before, estimator: Estimator::new(&scaled) };
        let batches: Vec<_> = self.groups.batches().collect();
        let distances = carried.follow(batches.len(), scaled);
        let batches_with = batches.par_iter().zip(distances);
        let found = batches_with.map_init(Scratch::default, |scratch, ((centers, groups), distances)| {
            self.level.run(
                #[inline(always)]
                || search.batch(centers, groups, distances, scratch),
            )
        });
        let found: Vec<(Vec<(u32, f64)>, usize)> = found.collect();
        let count = self.signal.points();
        let looked_at = found.iter().map(|(_, looked_at)| looked_at).sum();
        let mut nearest = Nearest { cluster: vec![0; count], squared_error: vec![0.0; count], looked_at };
        let order = batches.iter().flat_map(|(_, groups)| groups).flat_map(|group| group.order);
        for (&point, (cluster, error)) in order.zip(found.into_iter().flat_map(|(found, _)| found)) {
            (nearest.cluster[point as usize], nearest.squared_error[point as usize]) = (cluster, error);
        }
        nearest
    }

    fn scaled(&self, subspace: &AffineSubspace) -> ScaledSubspace {
        let offset: Vec<f64> = subspace.mean.iter().zip(&self.center).map(|(m, g)| (m - g) * self.scale).collect();
        let offset = if offset.iter().all(|&value| value == 0.0) { Vec::new() } else { offset };
        match &self.axes {
            Some(axes) => axes.project(subspace, &offset, self.level),
            None => {
                let length = dot(&offset, &offset).sqrt();
                let dimension = self.signal.dimension();
                ScaledSubspace { dimension, length, offset, vectors: subspace.vectors.clone() }
            }
        }
    }
}

/// Room for a batch of groups.
#[derive(Debug, Default)]
struct Scratch {
    clusters: Vec<u32>,
    bounds: LowerBounds,
    asked: ErrorRequests,
}

/// A search for the best clusters.
#[derive(Debug)]
struct NearestSearch<'a> {
    points: &'a Points<'a>,
    subspaces: &'a [&'a AffineSubspace],
    before: &'a [u32],
    estimator: Estimator,
}

impl NearestSearch<'_> {
    /// The best cluster of each point of some groups, and its error; and how many pairs were looked at. `distances` are
    /// at most those of the centers, cluster by cluster.
    #[inline(always)]
    fn batch(
        &self,
        centers: &[[f32; LANES]],
        groups: &[PointGroup<'_>],
        distances: &mut [[f32; LANES]],
        scratch: &mut Scratch,
    ) -> (Vec<(u32, f64)>, usize) {
        let Scratch { clusters, bounds, asked } = scratch;
        let numbers: Vec<u32> = groups.iter().flat_map(|group| group.order).copied().collect();
        let point = |at: u32| self.points.signal.point(numbers[at as usize] as usize);
        let (mut found, mut looked_at) = (vec![(0, 0.0); numbers.len()], 0);
        if self.before.is_empty() {
            looked_at += self.measure(centers, groups.len(), |_| true, distances, (clusters, bounds));
        }
        for (at, &number) in numbers.iter().enumerate() {
            let first = self.before.get(number as usize).copied();
            asked.push(first.unwrap_or_else(|| nearest_of(distances, at / LANES)), at as u32);
        }
        looked_at += asked.answer(self.subspaces, point, |cluster, at, error| found[at as usize] = (cluster, error));
        let square = self.points.scale * self.points.scale;
        let mut reaches = [f32::NEG_INFINITY; LANES];
        for (reach, (group, found)) in reaches.iter_mut().zip(groups.iter().zip(found.chunks(LANES))) {
            let each = found.iter().zip(group.distances).map(|(found, &distance)| reach_of(found.1 * square, distance));
            *reach = each.fold(0.0, f32::max);
        }
        let within =
            |distances: &[f32; LANES]| distances.iter().zip(&reaches).any(|(distance, reach)| distance <= reach);
        looked_at += self.measure(centers, groups.len(), within, distances, (clusters, bounds));
        for (lane, (group, found)) in groups.iter().zip(found.chunks(LANES)).enumerate() {
            clusters.clear();
            clusters
                .extend((0..).zip(&*distances).filter(|(_, of)| of[lane] <= reaches[lane]).map(|(cluster, _)| cluster));
            self.estimator.estimate(group.points, clusters, bounds);
            looked_at += clusters.len() * found.len();
            for (&cluster, lower) in clusters.iter().zip(bounds.lanes()) {
                for (at, (found, &lower)) in found.iter().zip(lower).enumerate() {
                    if cluster != found.0 && f64::from(lower) <= found.1 * square {
                        asked.push(cluster, (lane * LANES + at) as u32);
                    }
                }
            }
        }
        looked_at += asked.answer(self.subspaces, point, |cluster, at, error| {
            let best = &mut found[at as usize];
            if error < best.1 || (error == best.1 && cluster < best.0) {
                *best = (cluster, error);
            }
        });
        (found, looked_at)
    }

    /// Distances anew of those clusters of which the present ones are `wanted`; gives the number of pairs.
    #[inline(always)]
    fn measure(
        &self,
        centers: &[[f32; LANES]],
        count: usize,
        wanted: impl Fn(&[f32; LANES]) -> bool,
        distances: &mut [[f32; LANES]],
        (clusters, bounds): (&mut Vec<u32>, &mut LowerBounds),
    ) -> usize {
        clusters.clear();
        clusters.extend((0..).zip(&*distances).filter(|(_, of)| wanted(of)).map(|(cluster, _)| cluster));
        self.estimator.estimate(centers, clusters, bounds);
        for (&cluster, lower) in clusters.iter().zip(bounds.lanes()) {
            distances[cluster as usize] = lower.map(|lower| self.estimator.distance(cluster, lower));
        }
        clusters.len() * count
    }
}

/// Upper bound of a center's distance from any subspace that has at most this error at a point `distance` away from it.
#[inline(always)]
fn reach_of(squared_error: f64, distance: f32) -> f32 {
    ((squared_error.sqrt() + f64::from(distance)) as f32).next_up()
}

/// The cluster of a lane's least distance, the first of equals.
#[inline(always)]
fn nearest_of(distances: &[[f32; LANES]], lane: usize) -> u32 {
    let mut first = 0;
    for (cluster, of) in distances.iter().enumerate() {
        first = if of[lane] < distances[first][lane] { cluster } else { first };
    }
    first as u32
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
    use crate::transfer::clustering::products::add_orthonormal;
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
    fn full_search(signal: &Signal, subspaces: &[&AffineSubspace]) -> (Vec<u32>, Vec<f64>) {
        let mut residual = Vec::new();
        let mut search = |point| {
            let mut best = (0, f64::INFINITY);
            for (cluster, subspace) in (0..).zip(subspaces) {
                let error = subspace.squared_error(signal.point(point), &mut residual);
                best = if error < best.1 { (cluster, error) } else { best };
            }
            best
        };
        (0..signal.points()).map(&mut search).unzip()
    }

    /// Searches one after another, each with what the last one left, are full searches: begun with nothing, with the
    /// clusters of the search before, and with others.
    fn assert_full(signal: &Signal, searches: &[Vec<&AffineSubspace>], what: &str) {
        let expected: Vec<_> = searches.iter().map(|subspaces| full_search(signal, subspaces)).collect();
        let random = CounterRng::new(1);
        for level in SimdLevel::available() {
            for form in [CpcaForm::Affine, CpcaForm::Linear] {
                let points = Points::new(signal, form, level);
                for begun in 0..3 {
                    let (mut before, mut carried) = (Vec::new(), Carried::default());
                    for (at, (subspaces, expected)) in searches.iter().zip(&expected).enumerate() {
                        let found = points.nearest(subspaces, &before, &mut carried);
                        let what = format!("{what}, {} and {form:?}, search {at}, begun {begun}", level.name());
                        assert_eq!((&found.cluster, &found.squared_error), (&expected.0, &expected.1), "{what}");
                        let drawn = |point| (random.bits(point, begun, at as u64) % subspaces.len() as u64) as u32;
                        before = match begun {
                            0 => Vec::new(),
                            1 => found.cluster,
                            _ => (0..signal.points() as u64).map(drawn).collect(),
                        };
                    }
                }
            }
        }
    }

    /// Subspaces of which every `every`-th moves by a fraction of its size.
    fn moved(subspaces: &[AffineSubspace], share: f64, every: usize, seed: u64) -> Vec<AffineSubspace> {
        let random = CounterRng::new(seed);
        let change = |(at, subspace): (usize, &AffineSubspace)| {
            let size = dot(&subspace.mean, &subspace.mean).sqrt();
            let by = |what: u64, j: usize| share * (random.unit(at as u64, what, j as u64) - 0.5);
            let (mut mean, mut vectors) = (subspace.mean.clone(), Vec::new());
            if !at.is_multiple_of(every) {
                return subspace.clone();
            }
            let linear = mean.iter().all(|&value| value == 0.0);
            mean.iter_mut().enumerate().filter(|_| !linear).for_each(|(j, value)| *value += size * by(0, j));
            for (what, vector) in (1..).zip(subspace.vectors()) {
                let turned = vector.iter().enumerate().map(|(j, value)| value + by(what, j)).collect();
                add_orthonormal(&mut vectors, turned, 1e-3);
            }
            let eigenvalues = vec![1.0; vectors.len() / mean.len()];
            AffineSubspace { mean, vectors, eigenvalues }
        };
        subspaces.iter().enumerate().map(change).collect()
    }

    /// Subspaces that stay, move little, some of them or all, then far, and lose their last vectors.
    fn moves(subspaces: Vec<AffineSubspace>, seed: u64) -> Vec<Vec<AffineSubspace>> {
        let mut all = vec![subspaces.clone(), subspaces];
        for (share, every) in [(1e-9, 1), (1e-3, 3), (0.03, 1), (1.0, 2)] {
            all.push(moved(&all[all.len() - 1], share, every, seed + all.len() as u64));
        }
        let mut last = all[all.len() - 1].clone();
        last.iter_mut().step_by(2).for_each(|subspace| subspace.truncate(subspace.len() / 2));
        all.push(last);
        all
    }

    fn assert_full_while_they_move(signal: &Signal, subspaces: Vec<AffineSubspace>, what: &str) {
        let all = moves(subspaces, 5);
        let searches: Vec<Vec<_>> = all.iter().map(|subspaces| subspaces.iter().collect()).collect();
        assert_full(signal, &searches, what);
    }

    #[test]
    fn the_result_is_that_of_the_full_search() {
        for (dimension, vectors) in [(3, 0), (3, 3), (40, 5), (300, 0), (300, 7)] {
            for (scale, offset) in [(1.0, 0.0), (1.0, 1e4), (1e-38, 3.0), (1e33, 100.0)] {
                let (signal, subspaces) = far_apart(dimension, scale, offset, vectors);
                let what = format!("{dimension} numbers, scale {scale}, offset {offset}");
                assert_full_while_they_move(&signal, subspaces, &what);
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
            let (points, dimension) = (60 + draw(0, 200) as usize, [100, 5][draw(10, 2) as usize]);
            let dimension = dimension + draw(1, 3 * dimension as u64) as usize;
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
            let (clusters, vectors) = (1 + draw(8, 9) as usize, 1 + draw(9, 5) as usize);
            let options = CpcaOptions { clusters, vectors, vq_iterations: 2, iterations: 2, method, form, start };
            let fitted = compress(&signal, &options, |_| ()).expect("compressed").clustering;
            let mut subspaces: Vec<_> = fitted.subspaces().to_vec();
            subspaces.extend_from_within(..2.min(clusters));
            assert_full_while_they_move(&signal, subspaces, &format!("seed {seed}"));
            axes += usize::from(Points::new(&signal, form, SimdLevel::Baseline).axes.is_some());
        }
        assert!((8..32).contains(&axes), "with axes and without: {axes}");
    }

    #[test]
    fn errors_are_above_their_lower_bounds() {
        for (dimension, vectors) in [(3, 2), (40, 5), (300, 7)] {
            for offset in [0.0, 1e4] {
                for form in [CpcaForm::Affine, CpcaForm::Linear] {
                    let (signal, subspaces) = far_apart(dimension, 1.0, offset, vectors);
                    let (mut bounds, mut scratch) = (LowerBounds::default(), Vec::new());
                    let points = Points::new(&signal, form, SimdLevel::widest());
                    let scaled: Vec<_> = subspaces.iter().map(|subspace| points.scaled(subspace)).collect();
                    let (estimator, all) = (Estimator::new(&scaled), (0..scaled.len() as u32).collect::<Vec<_>>());
                    let square = points.scale * points.scale;
                    for (centers, groups) in points.groups.batches() {
                        for (lane, group) in groups.iter().enumerate() {
                            estimator.estimate(centers, &all, &mut bounds);
                            let of_center: Vec<f32> = bounds.lanes().iter().map(|lower| lower[lane]).collect();
                            estimator.estimate(group.points, &all, &mut bounds);
                            for (at, (&point, &distance)) in group.order.iter().zip(group.distances).enumerate() {
                                for (cluster, subspace) in subspaces.iter().enumerate() {
                                    let error = subspace.squared_error(signal.point(point as usize), &mut scratch);
                                    let lower = bounds.lanes()[cluster][at];
                                    assert!(f64::from(lower) <= error * square, "{lower} for {error}");
                                    let center = estimator.distance(cluster as u32, of_center[cluster]);
                                    assert!(center <= reach_of(error * square, distance), "{center} for {error}");
                                }
                            }
                        }
                    }
                }
            }
        }
    }

    /// Bounds that hold no cluster back would pass every other test.
    #[test]
    fn few_pairs_are_looked_at_and_fewer_later() {
        for (dimension, vectors) in [(25, 0), (25, 3), (100, 3), (400, 0), (400, 3)] {
            let signal = torus_signal(6000, dimension, 3);
            let fitted = |iterations| {
                let (method, form, start) = (CpcaMethod::Doubling, CpcaForm::Affine, StartPoints::Seed(1));
                let options =
                    CpcaOptions { clusters: 60, vectors, vq_iterations: iterations, iterations, method, form, start };
                compress(&signal, &options, |_| ()).expect("compressed").clustering
            };
            let points = Points::new(&signal, CpcaForm::Affine, SimdLevel::widest());
            let (mut before, mut carried, mut shares) = (Vec::new(), Carried::default(), Vec::new());
            for clustering in [7, 8, 9].map(fitted) {
                let subspaces: Vec<_> = clustering.subspaces().iter().collect();
                let found = points.nearest(&subspaces, &before, &mut carried);
                before = found.cluster;
                shares.push(found.looked_at as f64 / (60 * 6000) as f64);
            }
            let what = format!("{dimension} numbers, {vectors} vectors: shares {shares:?} of all pairs");
            assert!(shares[0] < 0.6 && shares[1].max(shares[2]) < 0.3, "{what}");
            assert!(shares[1].max(shares[2]) < 0.75 * shares[0], "{what}");
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
