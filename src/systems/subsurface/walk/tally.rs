//! Shares of photons by where they ended, with their standard errors.

/// Groups that photons are counted in: their spread gives the error.
pub const BATCHES: usize = 32;

/// The 97.5 % quantile of Student's t distribution with 31 degrees of freedom.
const STUDENT: f64 = 2.0395;

/// A mean over batches and the half width of its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkEstimate {
    /// The mean.
    pub mean: f64,
    /// Half of the interval's width.
    pub half_width: f64,
}

impl WalkEstimate {
    /// The mean of the batches' values.
    pub fn of(values: [f64; BATCHES]) -> Self {
        let count = BATCHES as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        Self { mean, half_width: STUDENT * (squares / (count * (count - 1.0))).sqrt() }
    }

    /// The standard error of the mean.
    pub fn standard_error(self) -> f64 {
        self.half_width / STUDENT
    }

    /// The estimate times a number.
    pub fn times(self, factor: f64) -> Self {
        Self { mean: self.mean * factor, half_width: self.half_width * factor.abs() }
    }

    /// How many half widths `value` is away from the mean; 0 for an estimate without spread that is exactly it.
    pub fn distance(&self, value: f64) -> f64 {
        let off = (value - self.mean).abs();
        if off == 0.0 { 0.0 } else { off / self.half_width }
    }
}

/// Counts of one batch.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct BatchCounts {
    pub(super) entered: u64,
    pub(super) absorbed: u64,
    pub(super) cut: u64,
    pub(super) lost: u64,
    /// By bin; the last is for those that left beyond all bins.
    pub(super) left: Vec<u64>,
    /// Length of all paths in mean free paths.
    pub(super) path: f64,
}

impl BatchCounts {
    pub(super) fn new(bins: usize) -> Self {
        Self { left: vec![0; bins + 1], ..Self::default() }
    }
}

/// Counts and weights of all photons by where they ended.
#[derive(Clone, Debug, PartialEq)]
pub struct WalkTally {
    /// Areas of the bins, in mm^2.
    areas: Vec<f64>,
    batches: Vec<BatchCounts>,
    mean_free_path: f64,
}

impl WalkTally {
    pub(super) fn new(areas: Vec<f64>, batches: Vec<BatchCounts>, mean_free_path: f64) -> Self {
        Self { areas, batches, mean_free_path }
    }

    fn count(&self, of: impl Fn(&BatchCounts) -> u64) -> u64 {
        self.batches.iter().map(of).sum()
    }

    /// An estimate of a value per photon that entered.
    fn estimate(&self, of: impl Fn(&BatchCounts) -> f64) -> WalkEstimate {
        let mut values = [0.0; BATCHES];
        for (value, batch) in values.iter_mut().zip(&self.batches) {
            *value = of(batch) / batch.entered.max(1) as f64;
        }
        WalkEstimate::of(values)
    }

    /// Photons that entered.
    pub fn entered(&self) -> u64 {
        self.count(|batch| batch.entered)
    }

    /// Photons that left.
    pub fn left(&self) -> u64 {
        self.count(|batch| batch.left.iter().sum())
    }

    /// Photons that were absorbed.
    pub fn absorbed(&self) -> u64 {
        self.count(|batch| batch.absorbed)
    }

    /// Photons that were given up at the step limit.
    pub fn cut(&self) -> u64 {
        self.count(|batch| batch.cut)
    }

    /// Photons whose ray hit nothing: a mesh that is not closed, or a ray through the rounding of an edge.
    pub fn lost(&self) -> u64 {
        self.count(|batch| batch.lost)
    }

    /// Number of bins.
    pub fn bins(&self) -> usize {
        self.areas.len()
    }

    /// The fraction of photons that left.
    pub fn total(&self) -> WalkEstimate {
        self.estimate(|batch| batch.left.iter().sum::<u64>() as f64)
    }

    /// The fraction that left in a bin.
    pub fn fraction(&self, bin: usize) -> WalkEstimate {
        self.estimate(|batch| batch.left[bin] as f64)
    }

    /// The fraction that left in the first bins, up to `bins` of them.
    pub fn fraction_below(&self, bins: usize) -> WalkEstimate {
        self.estimate(|batch| batch.left[..bins].iter().sum::<u64>() as f64)
    }

    /// The mean exitance in a bin, per mm^2, for one photon.
    pub fn exitance(&self, bin: usize) -> WalkEstimate {
        self.fraction(bin).times(1.0 / self.areas[bin])
    }

    /// The mean length of a path in mm, of all photons that entered.
    pub fn mean_path(&self) -> WalkEstimate {
        self.estimate(|batch| batch.path).times(self.mean_free_path)
    }
}
