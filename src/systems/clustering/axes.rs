//! Principal axes of a signal: along them a lower bound of a squared error is much cheaper than the error.
//!
//! Orthonormal axes B do not increase distances: |x - x_0 - V c| is at least |B (x - x_0) - B V c| for all weights c,
//! so the distance of B x from the affine span of B V is at most the distance of x from the subspace. Both are taken
//! relative to a center g. B V is orthonormalised; a vector is dropped if its remainder is at most [`NOTHING`] long.
//!
//! With S = |x - g| + |x_0 - g| and n' vectors, the dropped vectors lower a distance by at most sqrt(n') 2^-36 S, and
//! the rounding of B x to f32 changes it by at most 2^-24 S, or 2^-146 where f32 is subnormal. The exact comparison of
//! errors in f64 rounds far less, and errors up to 2^-40 S^2 count as 0. [`SLACK`] (S + [`TINY`])^2 exceeds the sum of
//! all these errors.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::fit::principal_vectors;
use super::products::{add_orthonormal, dots};
use super::{AffineSubspace, CpcaForm, Signal};
use crate::linalg::dot;

/// Signals of fewer dimensions use no axes, because their errors cost little more than bounds.
const LEAST_DIMENSION: usize = 128;
/// Dimensions per axis, and the largest number of axes.
const PER_AXIS: usize = 4;
const MOST: usize = 96;
/// Number of points from which the axes are computed.
const SAMPLE: usize = 512;
const NOTHING: f64 = 1.0 / (1u64 << 36) as f64;
const SLACK: f64 = 1.0 / (1u64 << 20) as f64;
const TINY: f64 = 1e-36;

/// A signal along its axes.
#[derive(Debug)]
pub(super) struct Axes {
    center: Vec<f64>,
    axes: Vec<f64>,
    /// Coordinates B (x - g) of each point x.
    points: Signal,
    /// |x - g| of each point.
    lengths: Vec<f64>,
}

#[derive(Debug)]
pub(super) struct AlongAxes {
    subspace: AffineSubspace,
    /// |x_0 - g|.
    length: f64,
}

impl Axes {
    /// Computes the principal axes of a sample of points; `None` if they would save no time, or coordinates along them
    /// exceed f32.
    pub(super) fn new(signal: &Signal, form: CpcaForm, level: SimdLevel) -> Option<Self> {
        let dimension = signal.dimension();
        if dimension < LEAST_DIMENSION {
            return None;
        }
        let center: Vec<f64> = match form {
            CpcaForm::Affine => (0..dimension).into_par_iter().map(|j| component_mean(signal, j)).collect(),
            // Linear subspaces have mean 0.
            CpcaForm::Linear => vec![0.0; dimension],
        };
        let count = signal.points().min(SAMPLE);
        let sample: Vec<u32> = (0..count).map(|at| (at * signal.points() / count) as u32).collect();
        let axes = principal_vectors(signal, &sample, &center, MOST.min(dimension / PER_AXIS), level).ok()?;
        let of_point = |point: usize| {
            let values = signal.point(point).iter().zip(&center);
            let residual: Vec<f64> = values.map(|(&value, g)| f64::from(value) - g).collect();
            let along = project(&axes, &residual, level).into_iter().map(|value| value as f32);
            (along.collect::<Vec<_>>(), dot(&residual, &residual).sqrt())
        };
        let (points, lengths): (Vec<_>, Vec<_>) = (0..signal.points()).into_par_iter().map(of_point).unzip();
        let points = Signal::new(axes.len() / dimension, points.concat()).ok()?;
        Some(Self { center, axes, points, lengths })
    }

    pub(super) fn along(&self, subspace: &AffineSubspace, level: SimdLevel) -> AlongAxes {
        let mut vectors = Vec::new();
        for vector in subspace.vectors() {
            add_orthonormal(&mut vectors, project(&self.axes, vector, level), NOTHING);
        }
        let offset: Vec<f64> = subspace.mean.iter().zip(&self.center).map(|(mean, g)| mean - g).collect();
        let mean = project(&self.axes, &offset, level);
        let eigenvalues = vec![0.0; vectors.len() / mean.len()];
        AlongAxes { subspace: AffineSubspace { mean, vectors, eigenvalues }, length: dot(&offset, &offset).sqrt() }
    }

    /// A lower bound of a point's squared error.
    #[inline(always)]
    pub(super) fn bound(&self, along: &AlongAxes, point: usize, residual: &mut Vec<f64>) -> f64 {
        let size = self.lengths[point] + along.length + TINY;
        along.subspace.squared_error(self.points.point(point), residual) - SLACK * size * size
    }
}

fn project(axes: &[f64], vector: &[f64], level: SimdLevel) -> Vec<f64> {
    let mut found = Vec::with_capacity(axes.len() / vector.len());
    level.run(
        #[inline(always)]
        || dots(axes, vector, |along| found.push(along)),
    );
    found
}

fn component_mean(signal: &Signal, component: usize) -> f64 {
    let values = signal.values().iter().skip(component).step_by(signal.dimension());
    values.map(|&value| f64::from(value)).sum::<f64>() / signal.points() as f64
}
