//! Sweeps over parameters that the papers do not print: the only source of explanations.

use super::{Explanation, PaperRow};
use crate::report::{Cell, Table};

/// Setting of the swept parameter, and the rows' values at it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Setting, such as "2" for a factor.
    pub at: String,
    /// One value per row, in the order of the rows and in their units.
    pub values: Vec<f64>,
}

/// Variation of a parameter that a paper does not print, with the resulting values of some rows. The rows themselves
/// use one of the settings, chosen beforehand.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Name by which rows refer to it.
    pub name: &'static str,
    /// Parameter, with its unit.
    pub parameter: &'static str,
    /// Settings.
    pub settings: Vec<Setting>,
}

impl Sweep {
    /// Explains rows outside their bounds by one setting at which they lie within them: the first of the settings that
    /// explain the most rows. A single card or host must satisfy all rows, so a setting explains nothing if it moves a
    /// row out of its bound. Calibrated rows are never explained; contradictory rows are ignored.
    pub fn explain<'a>(&self, rows: impl IntoIterator<Item = &'a mut PaperRow>) {
        let mut rows: Vec<&mut PaperRow> = rows.into_iter().collect();
        let open = |row: &PaperRow| {
            !row.is_contradictory() && !row.is_calibrated() && !row.holds() && row.explanation.is_none()
        };
        let lost = |row: &PaperRow| !row.is_contradictory() && row.holds();
        let mut best: Option<(&Setting, Vec<bool>, usize)> = None;
        for setting in &self.settings {
            let held: Vec<bool> = rows.iter().zip(&setting.values).map(|(row, value)| row.admits(*value)).collect();
            if rows.iter().zip(&held).any(|(row, held)| lost(row) && !held) {
                continue;
            }
            let explained = rows.iter().zip(&held).filter(|(row, held)| **held && open(row)).count();
            if explained > best.as_ref().map_or(0, |(.., most)| *most) {
                best = Some((setting, held, explained));
            }
        }
        let Some((setting, held, _)) = best else { return };
        let others = [held.iter().filter(|held| **held).count(), held.len()];
        for ((row, value), held) in rows.iter_mut().zip(&setting.values).zip(&held) {
            if *held && open(row) {
                row.explanation = Some(Explanation {
                    sweep: self.name,
                    parameter: self.parameter,
                    at: setting.at.clone(),
                    value: *value,
                    others,
                });
            }
        }
    }

    /// Table with a line per row and a column per setting; values within their bounds are marked. `show` gives a unit
    /// other than the row's, if there is one, and converts values to it.
    pub fn table(&self, title: &str, rows: &[PaperRow], show: (Option<&str>, fn(f64) -> f64)) -> Table {
        let (unit, show) = show;
        let settings =
            self.settings.iter().map(|setting| format!("{}={}", self.parameter.replace(' ', "_"), setting.at));
        let headings: Vec<String> =
            ["what", "place", "unit", "paper", "ours"].map(str::to_owned).into_iter().chain(settings).collect();
        let mut table = Table::new(format!("{title}; * within the bound"), &headings);
        for (i, row) in rows.iter().enumerate() {
            let unit = unit.unwrap_or(&row.target.unit);
            let cell = |value: f64| if unit == "%" { Cell::percent(show(value)) } else { Cell::measured(show(value)) };
            let judged = |value: f64| cell(value).marked(if row.admits(value) { "*" } else { "" });
            let head: [Cell; 5] = [
                row.target.what.as_str().into(),
                row.target.place.as_str().into(),
                unit.into(),
                cell(row.target.value),
                judged(row.ours),
            ];
            let value = |setting: &Setting| judged(setting.values.get(i).copied().unwrap_or(f64::NAN));
            table.push(head.into_iter().chain(self.settings.iter().map(value)));
        }
        table
    }
}
