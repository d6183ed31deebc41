//! Error of a compressed signal.

use crate::clustering::{Clustering, Signal};
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Table};

/// Powers of ten that the histogram distinguishes, relative to a point's mean square.
const DECADES: std::ops::RangeInclusive<i32> = -10..=-1;

/// The squared error of every point.
#[derive(Clone, Debug, PartialEq)]
pub struct CompressionError {
    /// Squared error per point.
    pub squared: Vec<f64>,
    /// Sum over all points.
    pub total: f64,
    /// The sum of squares of the signal.
    pub energy: f64,
    /// Numbers per point.
    dimension: usize,
}

impl CompressionError {
    /// Errors of a clustering, which must have as many points, and as many numbers per point, as the signal.
    pub fn new(signal: &Signal, clustering: &Clustering) -> Self {
        let squared: Vec<f64> = (0..signal.points()).map(|point| clustering.squared_error_of(point, signal)).collect();
        let square = |&value: &f32| f64::from(value) * f64::from(value);
        let energy = signal.sum(|point| signal.point(point).iter().map(square).sum());
        let total = signal.sum(|point| squared[point]);
        Self { squared, total, energy, dimension: signal.dimension() }
    }

    /// Total error relative to the signal's sum of squares; 0 if there is no error.
    pub fn relative(&self) -> f64 {
        if self.total > 0.0 { self.total / self.energy } else { 0.0 }
    }

    /// RMS over all numbers.
    pub fn root_mean_square(&self) -> f64 {
        (self.total / (self.squared.len() * self.dimension) as f64).sqrt()
    }

    /// The first point with the largest error.
    pub fn largest(&self) -> usize {
        let larger = |best: usize, point: usize| if self.squared[point] > self.squared[best] { point } else { best };
        (0..self.squared.len()).fold(0, larger)
    }

    /// Histogram of points by their squared error, in powers of ten of a point's mean square.
    pub fn histogram(&self) -> Table {
        let mean = self.energy / self.squared.len() as f64;
        let edge = |decade: i32| format!("1e{decade}").parse().unwrap_or(0.0);
        let edges: Vec<f64> = DECADES.map(edge).collect();
        let mut counts = vec![0_usize; edges.len() + 1];
        for &squared in &self.squared {
            counts[edges.partition_point(|edge| edge * mean <= squared)] += 1;
        }
        let mut table = Table::new(
            "Points by squared error, in means of a point's squares",
            &["from", "below", "points", "share (%)"],
        );
        let share = |count: usize| Cell::percent(100.0 * count as f64 / self.squared.len() as f64);
        for (bin, &count) in counts.iter().enumerate() {
            let at = |edge: Option<&f64>| edge.map_or(Cell::Empty, |&edge| shown(edge, Quantity::Exact).into());
            let from = bin.checked_sub(1).and_then(|below| edges.get(below));
            table.push([at(from), at(edges.get(bin)), count.into(), share(count)]);
        }
        table
    }
}
