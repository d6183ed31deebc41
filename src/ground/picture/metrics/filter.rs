//! Separable filters over planes of numbers.

use rayon::prelude::*;

/// Plane of one number per pixel, rows from the top.
#[derive(Clone, Debug)]
pub(super) struct PixelPlane {
    pub(super) width: usize,
    pub(super) values: Vec<f64>,
}

impl PixelPlane {
    /// Convolves with the weights around each pixel: first along rows, then along columns. The number of weights is
    /// odd; outside the picture, the border pixels are repeated.
    pub(super) fn filtered(&self, along_rows: &[f64], along_columns: &[f64]) -> Self {
        let width = self.width.max(1);
        let last_row = (self.values.len() / width).saturating_sub(1);
        let near = |at: usize, tap: usize, radius: usize, last: usize| (at + tap).saturating_sub(radius).min(last);
        let mut rows = vec![0.0; self.values.len()];
        rows.par_chunks_mut(width).zip(self.values.par_chunks(width)).for_each(|(into, row)| {
            for (x, value) in into.iter_mut().enumerate() {
                let radius = along_rows.len() / 2;
                *value = weighted(along_rows, |tap| row[near(x, tap, radius, width - 1)]);
            }
        });
        let mut values = vec![0.0; self.values.len()];
        values.par_chunks_mut(width).enumerate().for_each(|(y, into)| {
            for (x, value) in into.iter_mut().enumerate() {
                let radius = along_columns.len() / 2;
                *value = weighted(along_columns, |tap| rows[near(y, tap, radius, last_row) * width + x]);
            }
        });
        Self { width: self.width, values }
    }
}

fn weighted(weights: &[f64], at: impl Fn(usize) -> f64) -> f64 {
    weights.iter().enumerate().fold(0.0, |sum, (tap, weight)| sum + weight * at(tap))
}

/// Evaluates `value` at -radius, ..., radius.
pub(super) fn taps(radius: u32, value: impl Fn(f64) -> f64) -> Vec<f64> {
    let radius = i64::from(radius);
    (-radius..=radius).map(|at| value(at as f64)).collect()
}

pub(super) fn normalized(weights: &[f64]) -> Vec<f64> {
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|weight| weight / sum).collect()
}
