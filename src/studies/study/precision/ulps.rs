//! Ranges of results, and errors in units in the last place.

use std::collections::BTreeMap;

use refsim::num::power_of_two;

use super::bits::{FormatBits, FormatFamily};

/// Error of an instruction's results, in units in the last place of its format.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LocalError {
    /// Median.
    pub(super) median: f64,
    /// Largest.
    pub(super) largest: f64,
}

/// Range of an instruction's results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ResultRange {
    /// Smallest and largest binary exponent of the results that are neither 0 nor infinite nor NaN.
    pub(super) exponents: Option<[i32; 2]>,
    /// `true` if a result is infinite or NaN.
    pub(super) not_finite: bool,
}

/// Binary exponent of a number: that of the largest power of two in it. `None` for 0, infinities and NaN.
fn exponent(value: f64) -> Option<i32> {
    if value == 0.0 || !value.is_finite() {
        return None;
    }
    // Results are single precision, whose subnormal numbers are normal doubles.
    Some(((value.to_bits() >> 52) & 0x7ff) as i32 - 1023)
}

/// Range of results.
pub(super) fn range_of(results: &BTreeMap<(u32, u8), f64>) -> ResultRange {
    let mut exponents = results.values().filter_map(|value| exponent(*value));
    let first = exponents.next();
    let ends = |first: i32| exponents.fold([first; 2], |[low, high], e| [low.min(e), high.max(e)]);
    ResultRange { exponents: first.map(ends), not_finite: results.values().any(|value| !value.is_finite()) }
}

/// Unit in the last place of a format at a value: the distance of its neighbors there.
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

/// Median and largest error of results in a format against exact ones; `None` without a common result.
///
/// A finite result that should be infinite or NaN, or the reverse, has an infinite error.
pub(super) fn local_error(
    bits: FormatBits,
    exact: &BTreeMap<(u32, u8), f64>,
    rounded: &BTreeMap<(u32, u8), f64>,
) -> Option<LocalError> {
    let error = |(key, exact): (&(u32, u8), &f64)| {
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
    };
    let mut errors: Vec<f64> = exact.iter().filter_map(error).collect();
    errors.sort_by(f64::total_cmp);
    // Of an even number the lower one, which is one of the errors.
    let median = *errors.get(errors.len().checked_sub(1)? / 2)?;
    Some(LocalError { median, largest: *errors.last()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn results(values: &[f64]) -> BTreeMap<(u32, u8), f64> {
        (0..).zip(values).map(|(n, value)| ((n, 0), *value)).collect()
    }

    #[test]
    fn ranges_are_binary_exponents() {
        let range = range_of(&results(&[0.0, -0.75, 8.0, 15.9, f64::NAN, f64::from(f32::from_bits(1))]));
        assert_eq!(range, ResultRange { exponents: Some([-149, 3]), not_finite: true });
        assert_eq!(range_of(&results(&[0.0])), ResultRange { exponents: None, not_finite: false });
    }

    #[test]
    fn errors_are_in_units_of_the_format() {
        let error = |bits, exact: &[f64], rounded: &[f64]| {
            local_error(bits, &results(exact), &results(rounded)).map(|e| [e.median, e.largest])
        };
        assert_eq!(error(FormatBits::float(8, 2), &[1.0, 1.125, 8.0], &[1.0, 1.25, 12.0]), Some([0.5, 2.0]));
        assert_eq!(error(FormatBits::fixed(3, 4), &[1.0, 7.5], &[1.0, 7.96875]), Some([0.0, 7.5]));
        // e4m3 has exponents from -6, and 0 is as far from its neighbors as 2^-6.
        assert_eq!(error(FormatBits::float(4, 3), &[0.0], &[1.0 / 512.0]), Some([1.0, 1.0]));
        assert_eq!(error(FormatBits::float(8, 2), &[f64::INFINITY], &[2.0]), Some([f64::INFINITY; 2]));
        assert_eq!(error(FormatBits::float(8, 2), &[], &[]), None);
    }
}
