//! Methods by which values were computed, and their dependence on printed values.

use serde::{Deserialize, Serialize};

use crate::card::frame_time::FrameTime;

/// Method by which our value was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, strum::Display)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Method {
    /// The paper's own equations, its printed values and constants calibrated on them. Nothing is drawn or measured.
    Equation,
    /// Drawn on an emulated card, or counted on our models; time modelled from clocks, slots and bytes.
    Pipeline,
    /// Rendered through the whole engine, with its work counted and timed.
    Engine,
    /// A model of the paper's host.
    #[serde(rename = "host model")]
    #[strum(to_string = "host model")]
    Host,
    /// Solved in f64.
    Solver,
}

/// Method of a modelled frame rate. If the host is busy for the whole frame, it alone determines the rate, so the
/// method is an equation: work from printed sizes, at a calibrated rate.
impl From<&FrameTime> for Method {
    fn from(time: &FrameTime) -> Self {
        if time.host >= time.frame { Self::Equation } else { Self::Pipeline }
    }
}

/// Dependence of our value on printed values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Dependence {
    /// Prediction: the value itself was not used; other printed values were.
    Predicted {
        /// Printed values that were used; may be empty.
        from: &'static str,
    },
    /// Calibration: the value itself, or a value that follows from it, determined a constant of the model, so agreement
    /// is not evidence.
    Calibrated {
        /// Printed values that determined the constant.
        on: &'static str,
    },
    /// Count: from a run that uses no time and no printed value.
    Counted,
}

impl Dependence {
    /// Dependence on printed values: `on` determined a constant, `from` predicted the value; without both, a count.
    pub(in crate::study::reproduce) fn new(on: Option<&'static str>, from: Option<&'static str>) -> Self {
        match (on, from) {
            (Some(on), _) => Self::Calibrated { on },
            (None, Some(from)) => Self::Predicted { from },
            (None, None) => Self::Counted,
        }
    }

    /// Printed values on which our value depends.
    pub const fn inputs(self) -> &'static str {
        match self {
            Self::Predicted { from: inputs } | Self::Calibrated { on: inputs } => inputs,
            Self::Counted => "",
        }
    }
}
