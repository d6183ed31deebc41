//! The search for the fewest bits that meet a goal, and the smallest format of a family.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::ops::RangeInclusive;

use super::bits::{FormatBits, FormatFamily};
use super::goal::Goal;
use crate::report::Series;
use crate::report::words::counted;

/// Numbers of bits at which a curve is computed first, if its range contains them; the ends of the range are added.
const FIRST: [u8; 9] = [2, 3, 5, 7, 10, 12, 15, 16, 20];

/// Search for the fewest bits that meet a goal.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::study) struct BitScan {
    /// Values of the goal's measure, by bits.
    pub(super) points: BTreeMap<u8, f64>,
    /// Fewest bits at which the goal is met, there and at all larger computed numbers of bits.
    pub(in crate::study) smallest: Option<u8>,
    /// A number of bits, and a larger one with a worse value. If such a pair is found, all points are computed.
    pub(super) counterexample: Option<[u8; 2]>,
}

impl BitScan {
    /// Searches by bisection between the points `first` and the ends. If more bits are worse than fewer, computes all
    /// points.
    fn run<E>(
        &mut self,
        range: RangeInclusive<u8>,
        first: &[u8],
        goal: &Goal,
        mut value: impl FnMut(u8) -> Result<f64, E>,
    ) -> Result<(), E> {
        for bits in first.iter().copied().filter(|bits| range.contains(bits)) {
            self.add(bits, &mut value)?;
        }
        self.bisect(range.clone(), goal, &mut value)?;
        self.counterexample = self.worsening(goal);
        if self.counterexample.is_some() {
            range.clone().try_for_each(|bits| self.add(bits, &mut value))?;
        }
        self.conclude(&range, goal);
        Ok(())
    }

    /// Searches by bisection, as if more bits were never worse.
    pub(in crate::study) fn bisect<E>(
        &mut self,
        range: RangeInclusive<u8>,
        goal: &Goal,
        mut value: impl FnMut(u8) -> Result<f64, E>,
    ) -> Result<(), E> {
        for end in [*range.end(), *range.start()] {
            self.add(end, &mut value)?;
        }
        while let Some(next) = self.between(goal) {
            self.add(next, &mut value)?;
        }
        self.conclude(&range, goal);
        Ok(())
    }

    fn conclude(&mut self, range: &RangeInclusive<u8>, goal: &Goal) {
        let misses = self.points.iter().rfind(|(_, value)| !goal.met(**value));
        self.smallest = match misses {
            None => Some(*range.start()),
            Some((bits, _)) => bits.checked_add(1).filter(|bits| range.contains(bits)),
        };
    }

    fn add<E>(&mut self, bits: u8, value: &mut impl FnMut(u8) -> Result<f64, E>) -> Result<(), E> {
        if let Entry::Vacant(point) = self.points.entry(bits) {
            point.insert(value(bits)?);
        }
        Ok(())
    }

    /// Two neighboring points of which the one with more bits is worse; the one with fewer bits comes first.
    fn worsening(&self, goal: &Goal) -> Option<[u8; 2]> {
        let worse = |(a, b): &((&u8, &f64), (&u8, &f64))| goal.badness(*b.1) > goal.badness(*a.1);
        self.points.iter().zip(self.points.iter().skip(1)).find(worse).map(|((a, _), (b, _))| [*a, *b])
    }

    /// Middle between the widest point that misses the goal and the next, which meets it; `None` if they are neighbors.
    fn between(&self, goal: &Goal) -> Option<u8> {
        let missed = *self.points.iter().rfind(|(_, value)| !goal.met(**value))?.0;
        let met = *self.points.range(missed + 1..).next()?.0;
        (met - missed > 1).then(|| missed + (met - missed) / 2)
    }
}

/// Results for one family of formats, with every instruction in the same format.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Curve {
    pub(super) family: FormatFamily,
    /// Bits of range of all points; chosen large enough not to matter.
    pub(super) range: u8,
    /// Values by bits of precision.
    pub(super) scan: BitScan,
    /// Smallest uniform format: the fewest bits of precision, then the fewest of range.
    pub(super) minimum: Option<FormatBits>,
    /// `true` if the study computed all points that the search needs.
    pub(super) is_complete: bool,
}

/// Integer bits added to the smallest number that meets the goal. Clamping at the end of the range costs less than a
/// single-precision step in a wide format, but more in a narrower one.
const SPARE: u8 = 2;

impl Curve {
    /// Creates a curve without points.
    pub(super) fn empty(family: FormatFamily) -> Self {
        Self { family, range: *family.range_bits().end(), scan: BitScan::default(), minimum: None, is_complete: false }
    }

    /// Computes the points, as far as the budget allows. `value` computes the goal's measure in a format.
    pub(super) fn compute<E>(
        &mut self,
        goal: &Goal,
        value: &mut impl FnMut(FormatBits) -> Result<f64, E>,
    ) -> Result<(), E> {
        let family = self.family;
        if family == FormatFamily::Fixed {
            self.range = enough_integer_bits(goal, value)?;
        }
        let range = self.range;
        self.scan.run(family.digit_bits(range), &FIRST, goal, |digits| value(FormatBits { family, range, digits }))?;
        self.is_complete = true;
        let Some(digits) = self.scan.smallest else { return Ok(()) };
        let mut next = Some(FormatBits { family, range, digits });
        while let Some(bits) = next {
            if !goal.met(value(bits)?) {
                break;
            }
            self.minimum = Some(bits);
            next = bits.narrower().find(|less| less.digits == digits);
        }
        Ok(())
    }

    /// The points as a line of a chart: those that the axis of values can show.
    pub(super) fn line(&self, is_shown: impl Fn(f64) -> bool) -> Series {
        let what = match self.family {
            FormatFamily::Float => ["exponent bit", "exponent bits"],
            FormatFamily::Fixed => ["integer bit", "integer bits"],
        };
        let label = format!("{}, {}", self.family.name(), counted(self.range.into(), what[0], what[1]));
        let points = self.scan.points.iter().map(|(bits, value)| (f64::from(*bits), *value));
        Series { label, points: points.filter(|point| is_shown(point.1)).collect() }
    }
}

/// Fewest integer bits with which a 31-bit format meets the goal, plus [`SPARE`]; if no number does, the number with
/// the best value.
fn enough_integer_bits<E>(goal: &Goal, value: &mut impl FnMut(FormatBits) -> Result<f64, E>) -> Result<u8, E> {
    let family = FormatFamily::Fixed;
    let mut best = (0, f64::INFINITY);
    for range in family.range_bits() {
        let digits = *family.digit_bits(range).end();
        let value = value(FormatBits { family, range, digits })?;
        if goal.met(value) {
            return Ok((range + SPARE).min(*family.range_bits().end()));
        }
        if goal.badness(value) < best.1 {
            best = (range, goal.badness(value));
        }
    }
    Ok(best.0)
}
