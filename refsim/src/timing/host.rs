//! Cost of host work: the number of operations of each kind times the kind's weight, and all times one scale.
//!
//! The weights are relative guesses. The scale is calibrated once, on a published figure
//! ([`CPU_ONLY_RAYS_PER_SECOND`]) and the operation counts of the same run. So the total host time of that run is right
//! by construction, but its distribution over operations is not.

use std::ops::AddAssign;

use super::Picoseconds;
use crate::device::{Confidence, FigureRow};

pub use crate::event::HostOperation;

/// Rays per second on the host alone for the teapot room: Ray Engine paper, Table 3, first row. The scale of
/// [`HostModel`] is calibrated on this figure only.
pub const CPU_ONLY_RAYS_PER_SECOND: u64 = 135_812;

/// Error of calibrating the host model: the run has no counted operations with a weight above 0, no rays, or a rate of
/// 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error(
    "expected a weight of the counted operations, a number of rays and a rate above 0, to calibrate the host; found a \
     weight of {weight}, and {rays} rays at {rays_per_second} a second"
)]
#[diagnostic(code(timing::host), help("count the run of the printed figure"))]
pub struct HostError {
    /// Weighted sum of the counted operations.
    pub weight: u128,
    /// Number of rays.
    pub rays: u64,
    /// The published rate.
    pub rays_per_second: u64,
}

/// Number of operations by kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct HostCounts([u64; HostOperation::ALL.len()]);

impl HostCounts {
    /// Adds `count` operations.
    pub const fn add(&mut self, operation: HostOperation, count: u64) {
        let held = &mut self.0[operation.index()];
        *held = held.saturating_add(count);
    }

    /// Returns the counts with `count` operations added.
    #[must_use]
    pub const fn with(mut self, operation: HostOperation, count: u64) -> Self {
        self.add(operation, count);
        self
    }

    /// Number of operations of a kind.
    pub const fn of(&self, operation: HostOperation) -> u64 {
        self.0[operation.index()]
    }
}

impl AddAssign for HostCounts {
    fn add_assign(&mut self, other: Self) {
        for operation in HostOperation::ALL {
            self.add(*operation, other.of(*operation));
        }
    }
}

/// Cost of each operation relative to the others, roughly in additions on a processor of 2002. All are guesses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HostWeights([u64; HostOperation::ALL.len()]);

impl Default for HostWeights {
    fn default() -> Self {
        let mut weights = [0; HostOperation::ALL.len()];
        for operation in HostOperation::ALL {
            weights[operation.index()] = operation.weight();
        }
        Self(weights)
    }
}

impl HostWeights {
    /// The weight of an operation.
    pub const fn of(&self, operation: HostOperation) -> u64 {
        self.0[operation.index()]
    }

    /// The weights with source and confidence; keys start with `host.`.
    pub fn rows(&self) -> Vec<FigureRow> {
        let row = |operation: &HostOperation| FigureRow {
            key: format!("host.{operation}"),
            value: self.of(*operation).to_string(),
            unit: String::new(),
            source: operation.source().to_owned(),
            confidence: Confidence::Guess,
            counts: None,
        };
        HostOperation::ALL.iter().map(row).collect()
    }

    /// Mutable access to the weight with this key; `None` if there is no such key.
    pub fn figure_mut(&mut self, key: &str) -> Option<&mut u64> {
        let name = key.strip_prefix("host.")?;
        let operation = HostOperation::ALL.iter().find(|operation| operation.name() == name)?;
        Some(&mut self.0[operation.index()])
    }

    fn total(&self, counts: &HostCounts) -> u128 {
        let weighted = |kind: &HostOperation| u128::from(counts.of(*kind)) * u128::from(self.of(*kind));
        HostOperation::ALL.iter().map(weighted).fold(0, u128::saturating_add)
    }
}

/// The cost of host work: weights and a scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HostModel {
    weights: HostWeights,
    /// Picoseconds per unit of weight are `picoseconds / units`, exactly, so that the calibration run takes its
    /// published time.
    picoseconds: u128,
    units: u128,
}

impl HostModel {
    /// Calibrates the scale, with the default weights, so that a run with these counts and number of rays (or frames)
    /// reaches `rays_per_second`.
    ///
    /// # Errors
    /// [`HostError`] if one of the arguments is 0.
    pub fn calibrate(counts: &HostCounts, rays: u64, rays_per_second: u64) -> Result<Self, HostError> {
        Self::calibrate_with(HostWeights::default(), counts, rays, rays_per_second)
    }

    /// [`Self::calibrate`] with other weights: the calibration run still takes the same time.
    ///
    /// # Errors
    /// [`HostError`] if one of the arguments is 0, or all counted operations have weight 0.
    pub fn calibrate_with(
        weights: HostWeights,
        counts: &HostCounts,
        rays: u64,
        rays_per_second: u64,
    ) -> Result<Self, HostError> {
        let units = weights.total(counts);
        if units == 0 || rays == 0 || rays_per_second == 0 {
            return Err(HostError { weight: units, rays, rays_per_second });
        }
        // The total weight takes `rays / rate` seconds. The numerator is up to 2^104, the denominator up to 2^64 times
        // the weight.
        let (picoseconds, units) = (u128::from(rays) * 1_000_000_000_000, units.saturating_mul(rays_per_second.into()));
        let common = gcd(picoseconds, units);
        Ok(Self { weights, picoseconds: picoseconds / common, units: units / common })
    }

    /// The weights.
    pub const fn weights(&self) -> &HostWeights {
        &self.weights
    }

    /// Picoseconds per unit of weight, for display.
    pub fn picoseconds_a_unit(&self) -> f64 {
        self.picoseconds as f64 / self.units as f64
    }

    /// Duration of `count` operations of one kind, rounded up to a picosecond.
    pub fn time_of(&self, operation: HostOperation, count: u64) -> Picoseconds {
        self.time_of_all(&HostCounts::default().with(operation, count))
    }

    /// Duration of all counted operations, rounded up once; saturates.
    pub fn time_of_all(&self, counts: &HostCounts) -> Picoseconds {
        let exact = self.weights.total(counts).checked_mul(self.picoseconds).map(|time| time.div_ceil(self.units));
        Picoseconds(exact.and_then(|time| u64::try_from(time).ok()).unwrap_or(u64::MAX))
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    let (mut a, mut b) = (a, b);
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}
