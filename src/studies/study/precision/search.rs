//! Search for a format per instruction such that together they meet the goal with few bits.

use std::ops::RangeInclusive;

use super::bits::{Assignment, FormatBits};
use super::curve::BitScan;
use super::runs::{RunError, Runs};

/// Bits of precision that a search adds to the smallest uniform format at its start: bits spent on some instructions
/// may save more on others.
pub(super) const STARTS: [u8; 3] = [0, 1, 2];

/// Formats of all instructions that meet the goal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MixedFormats {
    /// Format of each instruction.
    pub(super) formats: Vec<FormatBits>,
    /// `true` if one bit less in any one instruction misses the goal.
    pub(super) is_minimal: bool,
    /// Each format with one bit less. Complete if the assignment is minimal.
    pub(super) refuted: Vec<RefutedFormat>,
}

/// Format with one bit less that misses the goal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RefutedFormat {
    /// Index of the instruction.
    pub(super) place: usize,
    pub(super) bits: FormatBits,
    /// Value of the goal's measure.
    pub(super) value: f64,
    /// Location of the largest error.
    pub(super) worst: Option<String>,
}

impl MixedFormats {
    /// Sum of the formats' widths, in bits.
    pub(super) fn width(&self) -> u32 {
        self.formats.iter().map(|bits| bits.width()).sum()
    }
}

pub(super) fn assignment(formats: &[FormatBits]) -> Assignment {
    formats.iter().copied().map(Some).collect()
}

/// Searches from formats with `more` bits of precision than the smallest uniform format, and stores a result with fewer
/// bits in `best`.
///
/// The instructions are narrowed one after the other, in this `order`: least blamed first. Then single bits are removed
/// until none can be.
pub(super) fn search(
    (minimum, more): (FormatBits, u8),
    order: &[usize],
    runs: &mut Runs<'_>,
    best: &mut Option<MixedFormats>,
) -> Result<(), RunError> {
    let start = FormatBits { digits: minimum.digits.saturating_add(more), ..minimum };
    if !minimum.family.digit_bits(minimum.range).contains(&start.digits) {
        return Ok(());
    }
    runs.step(format!("mixed formats from {start}"));
    let mut formats = vec![start; runs.count()];
    if !runs.meets(&assignment(&formats))? {
        return Ok(());
    }
    let result = descend(&mut formats, order, runs);
    // Every step of the descent meets the goal, so the formats also meet it if the budget ends the search.
    let found = MixedFormats { is_minimal: result.is_ok(), refuted: refuted(&formats, runs), formats };
    if best.as_ref().is_none_or(|best| found.width() < best.width()) {
        *best = Some(found);
    }
    result
}

/// Narrows formats until one bit less in any instruction misses the goal. The goal is met after every step.
fn descend(formats: &mut [FormatBits], order: &[usize], runs: &mut Runs<'_>) -> Result<(), RunError> {
    for &place in order {
        let FormatBits { family, range, digits } = formats[place];
        let fewest = *family.digit_bits(range).start();
        narrow(formats, place, fewest..=digits, runs, |digits| FormatBits { family, range, digits })?;
        let digits = formats[place].digits;
        // A fixed-point format needs at least one bit in addition to its sign.
        let fewest = if digits == 0 { range.min(1) } else { *family.range_bits().start() };
        narrow(formats, place, fewest..=range, runs, |range| FormatBits { family, range, digits })?;
    }
    remove_bits(formats, order, runs)
}

/// Narrows one instruction by bisection of one field, starting from the bits of `field`.
fn narrow(
    formats: &mut [FormatBits],
    place: usize,
    field: RangeInclusive<u8>,
    runs: &mut Runs<'_>,
    with: impl Fn(u8) -> FormatBits,
) -> Result<(), RunError> {
    let (goal, mut fewest) = (runs.goal, *field.end());
    let mut tried = assignment(formats);
    let found = BitScan::default().bisect(field, goal, |bits| {
        tried[place] = Some(with(bits));
        let value = runs.value(&tried)?;
        if goal.met(value) {
            fewest = fewest.min(bits);
        }
        Ok(value)
    });
    formats[place] = with(fewest);
    found
}

/// Removes single bits, cycling through the instructions, until every further bit misses the goal.
fn remove_bits(formats: &mut [FormatBits], order: &[usize], runs: &mut Runs<'_>) -> Result<(), RunError> {
    let mut refuted = 0;
    for &place in order.iter().cycle() {
        if refuted == order.len() {
            break;
        }
        refuted += 1;
        while remove_one(formats, place, runs)? {
            refuted = 1;
        }
    }
    Ok(())
}

/// Removes one bit of an instruction if the goal is still met; returns `false` if it is not.
fn remove_one(formats: &mut [FormatBits], place: usize, runs: &mut Runs<'_>) -> Result<bool, RunError> {
    let now = formats[place];
    for less in now.narrower() {
        formats[place] = less;
        match runs.meets(&assignment(formats)) {
            Ok(true) => return Ok(true),
            found => {
                formats[place] = now;
                found?;
            }
        }
    }
    Ok(false)
}

/// Formats with one bit less whose runs were made.
fn refuted(formats: &[FormatBits], runs: &Runs<'_>) -> Vec<RefutedFormat> {
    let mut found = Vec::new();
    for (place, now) in formats.iter().enumerate() {
        for bits in now.narrower() {
            let mut less = assignment(formats);
            less[place] = Some(bits);
            if let Some((value, worst)) = runs.made_before(&less) {
                found.push(RefutedFormat { place, bits, value, worst });
            }
        }
    }
    found
}
