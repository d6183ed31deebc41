//! Per instruction: the fewest bits, and its share of the loss.

use super::bits::{Assignment, FormatBits};
use super::curve::BitScan;
use super::runs::{RunError, Runs};

/// Findings on one instruction, in one family of formats.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct InstructionNeeds {
    /// Fewest bits of precision if all other instructions are exact.
    pub(super) alone: Option<u8>,
    /// Fewest bits of precision if all other instructions have the smallest uniform format.
    pub(super) in_company: Option<u8>,
    /// Share of the loss when only this instruction is rounded.
    pub(super) blame: Option<f64>,
    /// Share of the loss that is regained when only this instruction is exact.
    pub(super) regained: Option<f64>,
}

/// Loss of the goal with an assignment.
pub(super) fn loss(runs: &mut Runs<'_>, assignment: &Assignment) -> Result<f64, RunError> {
    let exact = runs.value(&vec![None; runs.count()])?;
    let value = runs.value(assignment)?;
    Ok(runs.goal.loss(value, exact))
}

/// Computes the blame of each instruction for the loss with all of them in a format that is too small.
pub(super) fn blame(
    needs: &mut [InstructionNeeds],
    (bits, all): (FormatBits, f64),
    runs: &mut Runs<'_>,
) -> Result<(), RunError> {
    // Without a loss every blame is zero.
    let share = |loss: f64| match (loss == 0.0, loss.is_finite() && all.is_finite()) {
        (true, _) => Some(0.0),
        (_, true) if all > 0.0 => Some(loss / all),
        (_, false) if !loss.is_finite() => Some(1.0),
        _ => None,
    };
    for (place, needs) in needs.iter_mut().enumerate() {
        let mut others = runs.uniform(bits);
        others[place] = None;
        needs.blame = share(loss(runs, &runs.alone(place, bits))?);
        let left = loss(runs, &others)?;
        needs.regained = match (all.is_finite(), left.is_finite()) {
            (true, true) => share(all - left),
            (false, true) => Some(1.0),
            _ => Some(0.0),
        };
    }
    Ok(())
}

/// Finds the fewest bits of precision of one instruction, with the same bits of range as the points of the curve.
pub(super) fn fewest_bits(
    needs: &mut InstructionNeeds,
    place: usize,
    minimum: FormatBits,
    range: u8,
    runs: &mut Runs<'_>,
) -> Result<(), RunError> {
    let FormatBits { family, digits, .. } = minimum;
    let mut scan = |most: u8, others: Option<FormatBits>| {
        let (mut scan, goal) = (BitScan::default(), runs.goal);
        let mut tried: Assignment = vec![others; runs.count()];
        scan.bisect(*family.digit_bits(range).start()..=most, goal, |digits| {
            tried[place] = Some(FormatBits { family, range, digits });
            runs.value(&tried)
        })?;
        Ok::<_, RunError>(scan.smallest)
    };
    needs.alone = scan(*family.digit_bits(range).end(), None)?;
    needs.in_company = scan(digits, Some(minimum))?;
    Ok(())
}
