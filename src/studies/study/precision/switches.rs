//! Sensitivity to the open switches of a device.

use super::bits::FormatBits;
use super::curve::BitScan;
use super::runs::{RunError, Runs};
use crate::study::StudyError;

/// Value of a switch with its effect.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SwitchRow {
    pub(super) switch: String,
    pub(super) value: String,
    /// `true` if the device has this value.
    pub(super) is_current: bool,
    /// Findings, or the reason why the device cannot run the subject with this value.
    pub(super) found: Result<SwitchFindings, String>,
}

/// Findings with one value of a switch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SwitchFindings {
    /// Value of the goal's measure on the device, unchanged except for the switch.
    pub(super) given: f64,
    /// Value of the exact run.
    pub(super) exact: f64,
    /// Smallest uniform format with the same bits of range as the points of the curve; `None` if no format meets the
    /// goal.
    pub(super) minimum: Option<FormatBits>,
}

impl SwitchRow {
    /// Returns `true` if both rows have the same findings.
    pub(super) fn same_as(&self, other: &Self) -> bool {
        let key = |row: &Self| {
            let found = row.found.as_ref();
            found.map(|found| ([found.given, found.exact].map(f64::to_bits), found.minimum)).map_err(String::clone)
        };
        key(self) == key(other)
    }
}

/// Runs with each value of each switch that has several values. `minimum` is the smallest uniform format of the curve's
/// range.
pub(super) fn sensitivity(
    minimum: Option<FormatBits>,
    runs: &mut Runs<'_>,
    rows: &mut Vec<SwitchRow>,
) -> Result<(), RunError> {
    let given = runs.subject.profile();
    for switch in given.switches().iter().filter(|switch| switch.values.len() > 1) {
        for value in &switch.values {
            let found = match under(&switch.name, value, minimum, runs) {
                Ok(found) => Ok(found),
                Err(RunError::Study(error)) => Err(error.to_string()),
                Err(RunError::Budget) => return Err(RunError::Budget),
            };
            rows.push(SwitchRow {
                switch: switch.name.clone(),
                value: value.clone(),
                is_current: *value == switch.current,
                found,
            });
        }
    }
    Ok(())
}

fn under(
    switch: &str,
    value: &str,
    minimum: Option<FormatBits>,
    runs: &mut Runs<'_>,
) -> Result<SwitchFindings, RunError> {
    let mut given = runs.subject.profile().clone();
    given.set_switch(switch, value).map_err(StudyError::from)?;
    let goal = runs.goal;
    let as_given = runs.measure(&given)?.value(&goal.measure);
    // Some switches decide which program a system chooses; formats of another program's instructions have no effect.
    let exact = runs.uniform_device(&given, None);
    let exact = runs.measure(&exact)?.value(&goal.measure);
    if runs.subject.chooses_other_programs(&given)? {
        return Err(StudyError::new("crossbar::precision::program", "other programs are chosen").into());
    }
    let mut found = SwitchFindings { given: as_given, exact, minimum };
    let Some(FormatBits { family, range, digits }) = minimum else { return Ok(found) };
    let mut value = |digits| {
        let device = runs.uniform_device(&given, Some(FormatBits { family, range, digits }));
        Ok::<_, RunError>(runs.measure(&device)?.value(&goal.measure))
    };
    let all = family.digit_bits(range);
    // Most switches change nothing: the smallest format meets the goal, and one bit less misses it.
    let is_same = goal.met(value(digits)?) && (digits == *all.start() || !goal.met(value(digits - 1)?));
    if !is_same {
        let mut scan = BitScan::default();
        scan.bisect(all, goal, value)?;
        found.minimum = scan.smallest.map(|digits| FormatBits { family, range, digits });
    }
    Ok(found)
}
