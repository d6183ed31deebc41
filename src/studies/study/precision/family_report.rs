//! Tables of one family of formats.

use super::bits::FormatFamily;
use super::outcome::{FamilyOutcome, MOST_SPARE, Precision};
use super::runs::Runs;
use super::tables::{self, number};
use crate::report::words::{counted, percent};
use crate::report::{Findings, FoundTable};

/// Adds the tables of one family.
pub(super) fn per_instruction(found: &mut Findings, study: &Precision, family: &FamilyOutcome, runs: &Runs<'_>) {
    let (Some(minimum), name) = (family.curve.minimum, family.curve.family.name()) else { return };
    let [csv, mixed_csv, refuted_csv] = match family.curve.family {
        FormatFamily::Float => ["instructions_float", "mixed_float", "refuted_float"],
        FormatFamily::Fixed => ["instructions_fixed", "mixed_fixed", "refuted_fixed"],
    };
    found.heading(format!("Instructions in {name} formats"));
    found.table(FoundTable::from(tables::instructions(family, minimum, runs)).csv(csv).field(csv));
    if let Some(blamed) = family.blamed {
        let sum: f64 = family.needs.iter().filter_map(|needs| needs.blame).fold(0.0, |sum, share| sum + share);
        found.paragraph(format!(
            "Alone: fewest {digits} with all other instructions exact; others at minimum: with all others in {minimum}. \
             Blame is the share of the loss with all instructions in {} that remains if only this one is; regained is \
             the share that disappears if only this one is exact. The shares of blame sum to {}: {}.",
            blamed.bits,
            percent(sum),
            additivity(sum),
            digits = family.curve.family.digits(),
        ));
    }
    let Some(mixed) = &family.mixed else { return };
    let state = if mixed.is_minimal { "1-minimal" } else { "the best so far" };
    found.heading(format!("Mixed {name} formats, {state}"));
    found.table(FoundTable::from(tables::mixed(mixed, study, runs)).csv(mixed_csv).field(mixed_csv).unprinted());
    if let Some(value) = family.held_back {
        let (measure, met) = (&runs.goal.measure, if runs.goal.met(value) { "meets" } else { "misses" });
        let value = number(value);
        found
            .paragraph(format!("On input that was held back from the search {measure} is {value}: it {met} the goal."));
    }
    match family.spare {
        Some(spare @ 1..) => found.paragraph(format!(
            "With {} more of range and the same number of precision for every instruction, the held-back input meets \
             it too.",
            counted(spare.into(), "bit", "bits"),
        )),
        None if family.held_back.is_some() => {
            found.paragraph(format!("With {MOST_SPARE} bits more for every instruction, it still misses the goal."));
        }
        _ => {}
    }
    found.table(FoundTable::from(tables::refuted(mixed, runs)).csv(refuted_csv).field(refuted_csv).unprinted());
}

/// Explains the sum of the blame shares.
fn additivity(sum: f64) -> &'static str {
    match sum {
        ..0.99 => "errors that are small alone add up, or one enables another",
        ..=1.01 => "errors add up",
        _ => {
            "more than all together, because errors cancel, or one hides another, as a clamp or a code of a target does"
        }
    }
}
