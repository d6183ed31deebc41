//! Contradictions between printed values of one paper.

use serde::{Deserialize, Serialize};

use super::PaperFigure;
use crate::study::reproduce::prose::number;

/// Computation from printed values alone whose result differs from the printed value. The functions below create it,
/// and reject values that agree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contradiction {
    text: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    value: Option<f64>,
}

impl Contradiction {
    /// Contradiction of a figure by a value computed from other printed values, with a description of the computation;
    /// `None` if the value rounds to the printed value.
    pub fn between(figure: &PaperFigure, computed: f64, how: &str) -> Option<Self> {
        let decimals = figure.decimals + u8::from(figure.value.abs() < 1000.0);
        let text = || format!("{} {}: {how}", number(computed, decimals), figure.unit);
        let contradicts = (computed - figure.value).abs() > figure.rounding();
        contradicts.then(|| Self { text: text().trim().to_owned(), value: Some(computed) })
    }

    /// Contradiction that exists if a condition on printed values holds; `None` if it does not.
    pub fn if_holds(condition: bool, computation: impl Into<String>) -> Option<Self> {
        condition.then(|| Self { text: computation.into(), value: None })
    }

    /// The computation.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Value that contradicts the figure; `None` if the contradiction gives no value.
    pub const fn value(&self) -> Option<f64> {
        self.value
    }
}
