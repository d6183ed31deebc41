//! What all ways to store transfer have in common, and how far the light that one of them gives is off.

/// Transfer, stored in some way.
pub trait StoredTransfer {
    /// Bytes by layout. The first layout holds the numbers that [`Self::multiply`] computes with.
    fn sizes(&self) -> Vec<StoredSize>;

    /// L~: a number per row of T, from a number per column, in f64.
    ///
    /// # Panics
    /// If the light has not as many numbers as T has columns.
    fn multiply(&self, light: &[f64]) -> Vec<f64>;
}

/// How many bytes a layout takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StoredSize {
    /// The layout, in a few words.
    pub layout: &'static str,
    /// Bytes of everything that depends on the transfer.
    pub bytes: u64,
}

/// How far light that arrives is from T L, over all rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalLightError {
    /// The root of the mean square of differences, in the unit of the light.
    pub root_mean_square: f64,
    /// The largest difference, in the unit of the light.
    pub largest: f64,
    /// The first as a share of the root mean square of T L; 0 where nothing differs.
    pub relative: f64,
}

impl LocalLightError {
    /// Of light found and light expected, row by row.
    ///
    /// # Panics
    /// If there are not as many of both, or none.
    pub fn new(found: &[f64], expected: &[f64]) -> Self {
        assert!(!expected.is_empty() && found.len() == expected.len(), "a number per row");
        let (mut squares, mut whole, mut largest) = (0.0, 0.0, 0.0_f64);
        for (found, expected) in found.iter().zip(expected) {
            let difference = found - expected;
            squares += difference * difference;
            whole += expected * expected;
            largest = largest.max(difference.abs());
        }
        let relative = if squares > 0.0 { (squares / whole).sqrt() } else { 0.0 };
        Self { root_mean_square: (squares / expected.len() as f64).sqrt(), largest, relative }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_means_and_shares() {
        let error = LocalLightError::new(&[1.0, 5.0, 0.0, 0.0], &[4.0, 1.0, 0.0, 0.0]);
        assert_eq!((error.root_mean_square, error.largest), (2.5, 4.0));
        assert_eq!(error.relative, (25.0_f64 / 17.0).sqrt());
        let none = LocalLightError { root_mean_square: 0.0, largest: 0.0, relative: 0.0 };
        assert_eq!(LocalLightError::new(&[0.0, 0.0], &[0.0, 0.0]), none);
    }
}
