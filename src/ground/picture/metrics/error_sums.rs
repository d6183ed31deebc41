//! Errors of values and their sums, with one rule for NaN and infinities in `diff` and all studies: NaN equals NaN, and
//! an infinity equals itself. Every other pair with a NaN or an infinity has an infinite error and is counted.

/// Error of a value: `found` - `right`. 0 if the two are equal or both NaN; otherwise infinite unless both are finite.
pub fn value_error(found: f64, right: f64) -> f64 {
    match found == right || (found.is_nan() && right.is_nan()) {
        true => 0.0,
        false if found.is_finite() && right.is_finite() => found - right,
        false => f64::INFINITY,
    }
}

/// Absolute error relative to the right value; 1 if the right value is 0 and the found value is finite and not 0.
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

    /// The sums of the finite errors alone; the largest error is kept even if it is infinite.
    pub const fn of_finite(self) -> Self {
        Self { not_finite: 0, ..self }
    }

    /// Signed mean; 0 if there are no errors, infinite if an error is infinite.
    pub fn mean(&self) -> f64 {
        self.or_infinite(if self.weight > 0.0 { self.sum / self.weight } else { 0.0 })
    }

    /// Sum of squares; infinite if an error is infinite.
    pub fn squares(&self) -> f64 {
        self.or_infinite(self.squares)
    }

    /// Root of the mean square; 0 if there are no errors, infinite if an error is infinite.
    pub fn rms(&self) -> f64 {
        self.or_infinite(if self.weight > 0.0 { (self.squares / self.weight).sqrt() } else { 0.0 })
    }

    fn or_infinite(&self, value: f64) -> f64 {
        if self.not_finite > 0 { f64::INFINITY } else { value }
    }
}
