//! Settings of sweeps, and sweeps with the rows that they were applied to.

use serde::{Deserialize, Serialize};

/// Setting of the swept parameter, and the rows' values at it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setting {
    /// Setting, as in "2" of a factor.
    pub at: String,
    /// One value per row, in the order of the rows and in their units.
    pub values: Vec<f64>,
}

/// Sweep that was applied to rows: what a record needs to judge them by later bounds.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::study::reproduce) struct AppliedSweep {
    pub(in crate::study::reproduce) name: &'static str,
    pub(in crate::study::reproduce) parameter: &'static str,
    pub(in crate::study::reproduce) settings: Vec<Setting>,
    /// Names of the rows' figures, in the order of the values.
    pub(in crate::study::reproduce) figures: Vec<String>,
}
