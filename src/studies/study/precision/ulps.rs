//! Ranges of results, and errors in units in the last place.

use refsim::num::power_of_two;

use super::bits::{FormatBits, FormatFamily};
use super::subject::FragmentResults;

/// Error of an instruction's results, in units in the last place of its format.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LocalError {
    pub(super) median: f64,
    pub(super) largest: f64,
}

/// Range of an instruction's results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ResultRange {
    /// Smallest and largest binary exponent of the results, except for 0, infinities and NaN.
    pub(super) exponents: Option<[i32; 2]>,
    /// `true` if a result is infinite or NaN.
    pub(super) not_finite: bool,
}

/// Binary exponent of a number: floor of log2 of its magnitude. `None` for 0, infinities and NaN.
fn exponent(value: f64) -> Option<i32> {
    if value == 0.0 || !value.is_finite() {
        return None;
    }
    // Results are in single precision, whose subnormal numbers are normal doubles.
    Some(((value.to_bits() >> 52) & 0x7ff) as i32 - 1023)
}

pub(super) fn range_of<'r>(results: impl IntoIterator<Item = &'r f64>) -> ResultRange {
    let mut range = ResultRange { exponents: None, not_finite: false };
    for value in results {
        range.not_finite |= !value.is_finite();
        if let Some(e) = exponent(*value) {
            let [low, high] = range.exponents.unwrap_or([e; 2]);
            range.exponents = Some([low.min(e), high.max(e)]);
        }
    }
    range
}

/// Unit in the last place of a format at a value: the distance between neighboring numbers there.
fn unit(bits: FormatBits, value: f64) -> f64 {
    let digits = i32::from(bits.digits);
    match bits.family {
        FormatFamily::Fixed => power_of_two(-digits),
        FormatFamily::Float => {
            let least = 2 - (1 << (bits.range - 1));
            power_of_two(exponent(value).map_or(least, |e| e.max(least)) - digits)
        }
    }
}

/// Errors of results in a format compared with exact results, where both exist.
///
/// A finite result that should be infinite or NaN, or the reverse, has an infinite error.
pub(super) fn errors_of<'r>(
    bits: FormatBits,
    exact: &'r FragmentResults,
    rounded: &'r FragmentResults,
) -> impl Iterator<Item = f64> + 'r {
    exact.iter().filter_map(move |(key, exact)| {
        let rounded = rounded.get(key)?;
        let equal = exact == rounded || (exact.is_nan() && rounded.is_nan());
        let error = (exact - rounded).abs() / unit(bits, *exact);
        Some(if equal {
            0.0
        } else if error.is_nan() {
            f64::INFINITY
        } else {
            error
        })
    })
}

/// Median and largest of errors; `None` if there are none.
pub(super) fn local_error(errors: impl Iterator<Item = f64>) -> Option<LocalError> {
    let mut errors: Vec<f64> = errors.collect();
    errors.sort_by(f64::total_cmp);
    // For an even count, takes the lower of the two middle errors.
    let median = *errors.get(errors.len().checked_sub(1)? / 2)?;
    Some(LocalError { median, largest: *errors.last()? })
}
