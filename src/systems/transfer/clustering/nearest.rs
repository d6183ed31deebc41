//! The cluster that approximates each point best, by comparing every point with every cluster in f64, the lower of
//! equals. Signals of many dimensions are compared along their principal axes first ([`Axes`]): a cluster whose lower
//! bound exceeds an error already found is passed over, which changes only the time.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::axes::{AlongAxes, Axes};
use super::{AffineSubspace, CpcaForm};
use crate::transfer::Signal;

/// Points per block: a cluster's vectors are read once for all of them.
const BLOCK: usize = 64;

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
    axes: Option<Axes>,
    level: SimdLevel,
}

impl<'a> Points<'a> {
    pub(super) fn new(signal: &'a Signal, form: CpcaForm, level: SimdLevel) -> Self {
        Self { signal, axes: Axes::new(signal, form, level), level }
    }

    /// The best cluster of each point.
    pub(super) fn nearest(&self, subspaces: &[&AffineSubspace]) -> Nearest {
        let axes = self.axes.as_ref();
        let along = axes.map(|axes| {
            let along = subspaces.par_iter().map(|subspace| (axes, axes.along(subspace, self.level)));
            along.collect::<Vec<_>>()
        });
        let count = self.signal.points();
        let mut best = vec![(0, f64::INFINITY); count];
        let blocks = best.par_chunks_mut(BLOCK).enumerate();
        blocks.for_each_init(Vec::new, |residual, (block, best)| {
            self.level.run(
                #[inline(always)]
                || match &along {
                    Some(along) => self.search_by_bounds(subspaces, along, block * BLOCK, best, residual),
                    None => self.search(subspaces, block * BLOCK, best, residual),
                },
            );
        });
        let (cluster, squared_error) = best.into_iter().unzip();
        Nearest { cluster, squared_error }
    }

    /// Compares the points from `first` on with every cluster.
    #[inline(always)]
    fn search(&self, subspaces: &[&AffineSubspace], first: usize, best: &mut [(u32, f64)], residual: &mut Vec<f64>) {
        for (cluster, subspace) in (0..).zip(subspaces) {
            for (point, best) in (first..).zip(&mut *best) {
                let error = subspace.squared_error(self.signal.point(point), residual);
                if error < best.1 {
                    *best = (cluster, error);
                }
            }
        }
    }

    /// Compares the points from `first` on with the clusters that their bounds do not exclude: first with the one of
    /// the lowest bound.
    #[inline(always)]
    fn search_by_bounds(
        &self,
        subspaces: &[&AffineSubspace],
        along: &[(&Axes, AlongAxes)],
        first: usize,
        best: &mut [(u32, f64)],
        residual: &mut Vec<f64>,
    ) {
        let mut bounds = vec![[0.0; BLOCK]; along.len()];
        for (bounds, (axes, along)) in bounds.iter_mut().zip(along) {
            for (point, bound) in (first..).zip(&mut bounds[..best.len()]) {
                *bound = axes.bound(along, point, residual);
            }
        }
        for (at, best) in best.iter_mut().enumerate() {
            let point = self.signal.point(first + at);
            let lowest = (0..bounds.len()).fold(0, |low, k| if bounds[k][at] < bounds[low][at] { k } else { low });
            *best = (lowest as u32, subspaces[lowest].squared_error(point, residual));
            for (cluster, bounds) in bounds.iter().enumerate().filter(|&(cluster, _)| cluster != lowest) {
                if bounds[at] > best.1 {
                    continue;
                }
                let error = subspaces[cluster].squared_error(point, residual);
                if error < best.1 || (error == best.1 && (cluster as u32) < best.0) {
                    *best = (cluster as u32, error);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random::CounterRng;
    use crate::transfer::clustering::{CpcaMethod, CpcaOptions, StartPoints, compress};
    use crate::transfer::synthetic::torus_signal;

    /// The search holds every point against every cluster, with axes and without.
    fn assert_full(signal: &Signal, subspaces: &[AffineSubspace], form: CpcaForm, what: &str) {
        let subspaces: Vec<_> = subspaces.iter().collect();
        let mut residual = Vec::new();
        let mut search = |point| {
            let mut best = (0, f64::INFINITY);
            for (cluster, subspace) in (0..).zip(&subspaces) {
                let error = subspace.squared_error(signal.point(point), &mut residual);
                best = if error < best.1 { (cluster, error) } else { best };
            }
            best
        };
        let (cluster, squared_error) = (0..signal.points()).map(&mut search).unzip();
        let expected = Nearest { cluster, squared_error };
        for level in SimdLevel::available() {
            let points = Points::new(signal, form, level);
            assert_eq!(points.nearest(&subspaces), expected, "{what}, {} and {form:?}", level.name());
        }
    }

    /// Signals moved far from the origin, and subspaces of some of their points and differences.
    #[test]
    fn the_result_is_that_of_the_full_search() {
        for (dimension, vectors) in [(3, 0), (3, 3), (40, 5), (300, 0), (300, 7)] {
            for (scale, offset) in [(1.0, 0.0), (1.0, 1e4), (1e-38, 3.0), (1e33, 100.0)] {
                let signal = torus_signal(333, dimension, 9);
                let values = signal.values().iter().map(|value| scale * (value + offset));
                let signal = Signal::new(dimension, values.collect()).expect("a signal");
                let subspace = |at: usize| {
                    let mean: Vec<f64> = signal.point(at).iter().map(|&value| f64::from(value)).collect();
                    let axis = |i: usize| (0..dimension).map(move |j| f64::from(u8::from(j == (at + i) % dimension)));
                    let vectors: Vec<f64> = (0..vectors).flat_map(axis).collect();
                    AffineSubspace { mean, eigenvalues: vec![1.0; vectors.len() / dimension], vectors }
                };
                let subspaces: Vec<_> = (0..333).step_by(9).map(subspace).collect();
                for form in [CpcaForm::Affine, CpcaForm::Linear] {
                    assert_full(&signal, &subspaces, form, &format!("{dimension}, scale {scale}, offset {offset}"));
                }
            }
        }
    }

    /// Signals drawn at random, some with points that repeat, of low rank or 0, and subspaces fitted to them, some of
    /// them twice, so that there are ties.
    #[test]
    fn the_result_is_that_of_the_full_search_whatever_is_drawn() {
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
            assert_full(&signal, &subspaces, form, &format!("seed {seed}"));
        }
    }

    /// Bounds of a signal of many dimensions exclude most clusters, and never the best one.
    #[test]
    fn bounds_are_below_errors_and_exclude_most_clusters() {
        let signal = torus_signal(2000, 400, 3);
        let (method, form, start) = (CpcaMethod::Doubling, CpcaForm::Affine, StartPoints::Seed(1));
        let options = CpcaOptions { clusters: 40, vectors: 3, vq_iterations: 3, iterations: 3, method, form, start };
        let clustering = compress(&signal, &options, |_| ()).expect("compressed").clustering;
        let axes = Axes::new(&signal, form, SimdLevel::widest()).expect("axes");
        let (mut residual, mut left) = (Vec::new(), 0);
        for subspace in clustering.subspaces() {
            let along = axes.along(subspace, SimdLevel::widest());
            for point in 0..signal.points() {
                let bound = axes.bound(&along, point, &mut residual);
                assert!(bound <= subspace.squared_error(signal.point(point), &mut residual), "point {point}");
                left += usize::from(bound <= clustering.squared_error_of(point, &signal));
            }
        }
        let share = left as f64 / (40 * signal.points()) as f64;
        assert!(share < 0.1, "{share} of all pairs");
    }
}
