//! Errors of values and their sums. One rule for what is not finite, for `diff` and all studies: NaN equals NaN, an
//! infinity itself, and every other pair with a value that is not finite has an infinite error and is counted.

/// Error of a value: the value less the right one. 0 if they are equal or both NaN; otherwise infinite unless both are
/// finite.
pub fn value_error(found: f64, right: f64) -> f64 {
    match found == right || (found.is_nan() && right.is_nan()) {
        true => 0.0,
        false if found.is_finite() && right.is_finite() => found - right,
        false => f64::INFINITY,
    }
}

/// Absolute error as a share of the right value; 1 where a finite value is not 0 and the right one is.
pub fn relative_error(found: f64, right: f64) -> f64 {
    match value_error(found, right).abs() {
        error if error == 0.0 || error.is_infinite() => error,
        _ if right == 0.0 => 1.0,
        error => error / right.abs(),
    }
}

/// Weighted sums of errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorSums {
    /// Number of errors that are infinite.
    pub not_finite: u64,
    /// Largest absolute error.
    pub largest: f64,
    weight: f64,
    sum: f64,
    squares: f64,
}

impl ErrorSums {
    /// Adds an error.
    pub fn add(&mut self, error: f64, weight: f64) {
        self.largest = self.largest.max(error.abs());
        if error.is_finite() {
            self.weight += weight;
            self.sum += weight * error;
            self.squares += weight * error * error;
        } else {
            self.not_finite += 1;
        }
    }

    /// These sums without infinite errors, except for the largest.
    pub const fn of_finite(self) -> Self {
        Self { not_finite: 0, ..self }
    }

    /// Mean, with its sign; 0 without errors, infinite if one is.
    pub fn mean(&self) -> f64 {
        self.or_infinite(if self.weight > 0.0 { self.sum / self.weight } else { 0.0 })
    }

    /// Sum of squares; infinite if an error is.
    pub fn squares(&self) -> f64 {
        self.or_infinite(self.squares)
    }

    /// Root of the mean square; 0 without errors, infinite if one is.
    pub fn rms(&self) -> f64 {
        self.or_infinite(if self.weight > 0.0 { (self.squares / self.weight).sqrt() } else { 0.0 })
    }

    fn or_infinite(&self, value: f64) -> f64 {
        if self.not_finite > 0 { f64::INFINITY } else { value }
    }
}
