//! Fractions of photons by fate, with their errors.

/// Number of batches in which photons are counted: their spread determines the error.
pub(crate) const BATCHES: usize = 32;

/// The 97.5 % quantile of Student's t distribution with 31 degrees of freedom.
const STUDENT: f64 = 2.0395;

/// A mean over batches and the half width of its 95 % confidence interval.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WalkEstimate {
    pub(crate) mean: f64,
    pub(crate) half_width: f64,
}

impl WalkEstimate {
    fn of(values: &[f64]) -> Self {
        let count = BATCHES as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        Self { mean, half_width: STUDENT * (squares / (count * (count - 1.0))).sqrt() }
    }

    /// Distance of `value` from the mean in half widths.
    pub(crate) fn distance(self, value: f64) -> f64 {
        (value - self.mean).abs() / self.half_width
    }
}

/// Counts of one batch.
#[derive(Clone, Debug, Default)]
pub(crate) struct BatchCounts {
    pub(crate) entered: u64,
    pub(crate) absorbed: u64,
    pub(crate) cut: u64,
    /// Number of photons that left, by bin; the last bin is for photons beyond all others.
    pub(crate) left: Vec<u64>,
    /// Length of all paths in mean free paths.
    pub(crate) path: f64,
}

impl BatchCounts {
    pub(crate) fn new(bins: usize) -> Self {
        Self { left: vec![0; bins + 1], ..Self::default() }
    }
}

/// Counts of all photons by fate.
#[derive(Clone, Debug)]
pub(crate) struct WalkTally {
    batches: Vec<BatchCounts>,
    mean_free_path: f64,
}

impl WalkTally {
    pub(crate) fn new(batches: Vec<BatchCounts>, mean_free_path: f64) -> Self {
        Self { batches, mean_free_path }
    }

    /// An estimate of a value per photon that entered.
    fn estimate(&self, of: impl Fn(&BatchCounts) -> f64) -> WalkEstimate {
        let values: Vec<f64> = self.batches.iter().map(|batch| of(batch) / batch.entered.max(1) as f64).collect();
        WalkEstimate::of(&values)
    }

    /// Photons that left, were absorbed, and were given up at the step limit.
    pub(crate) fn fates(&self) -> [u64; 3] {
        let count = |of: fn(&BatchCounts) -> u64| self.batches.iter().map(of).sum();
        [count(|batch| batch.left.iter().sum()), count(|batch| batch.absorbed), count(|batch| batch.cut)]
    }

    /// The fraction of photons that left.
    pub(crate) fn total(&self) -> WalkEstimate {
        self.estimate(|batch| batch.left.iter().sum::<u64>() as f64)
    }

    pub(crate) fn fraction(&self, bin: usize) -> WalkEstimate {
        self.estimate(|batch| batch.left[bin] as f64)
    }

    /// The mean length of a path in mm, of all photons that entered.
    pub(crate) fn mean_path(&self) -> WalkEstimate {
        let WalkEstimate { mean, half_width } = self.estimate(|batch| batch.path);
        WalkEstimate { mean: mean * self.mean_free_path, half_width: half_width * self.mean_free_path }
    }
}
