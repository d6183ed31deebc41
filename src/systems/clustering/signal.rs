//! The data to be compressed: points with n numbers each.

use rayon::prelude::*;

use crate::error::{InputError, ensure, input_error};

/// Points per chunk of a sum over all points; it fixes the order of the additions.
const CHUNK: usize = 1024;

/// Points of n finite numbers each, point by point. There is at least one point, of at least one number.
///
/// Values are f32, as in files of transfer: transfer has few significant digits, and is the largest object in memory.
/// Results of computations are f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    points: usize,
    dimension: usize,
    values: Vec<f32>,
}

impl Signal {
    /// A signal of `dimension` numbers per point.
    pub fn new(dimension: usize, values: Vec<f32>) -> Result<Self, InputError> {
        ensure!(!values.is_empty() && dimension != 0, "crossbar::prt::signal" =>
            "expected at least one point of at least one number, found {} values at {dimension} per point",
            values.len());
        ensure!(values.len().is_multiple_of(dimension), "crossbar::prt::signal" =>
            "expected a multiple of {dimension} values, found {}", values.len());
        let points = values.len() / dimension;
        ensure!(points <= u32::MAX as usize, "crossbar::prt::signal" =>
            "expected at most {} points, found {points}", u32::MAX);
        match values.iter().position(|value| !value.is_finite()) {
            Some(at) => Err(input_error!("crossbar::prt::signal" =>
                    "expected finite numbers, found {} in component {} of point {} (counted from 0)", values[at],
                    at % dimension, at / dimension)),
            None => Ok(Self { points, dimension, values }),
        }
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Numbers per point.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The numbers of a point. Panics if there is no such point.
    pub fn point(&self, point: usize) -> &[f32] {
        &self.values[point * self.dimension..][..self.dimension]
    }

    /// All values, point by point.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The sum of the squares of all numbers.
    pub fn sum_of_squares(&self) -> f64 {
        self.sum(|point| self.point(point).iter().map(|&value| f64::from(value) * f64::from(value)).sum())
    }

    /// The sum over all points of `of_point`. Its bits do not depend on the number of threads.
    pub fn sum(&self, of_point: impl Fn(usize) -> f64 + Sync) -> f64 {
        let chunks = (0..self.points.div_ceil(CHUNK)).into_par_iter();
        let sums: Vec<f64> = chunks
            .map(|chunk| (chunk * CHUNK..self.points.min((chunk + 1) * CHUNK)).map(&of_point).sum::<f64>())
            .collect();
        sums.into_iter().sum()
    }
}
