//! Figures: a value, where it is from, and how sure we are of it.

use std::{collections::BTreeMap, fmt};

use serde::Deserialize;

use super::DeviceError;

/// How sure we are of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Confidence {
    /// From a maker's document or a specification.
    Documented,
    /// Somebody measured it on the card.
    Measured,
    /// Calculated from documented or measured figures; the source says how.
    Derived,
    /// No source was found: our choice.
    Guess,
}

impl fmt::Display for Confidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Documented => "documented",
            Self::Measured => "measured",
            Self::Derived => "derived",
            Self::Guess => "guess",
        })
    }
}

/// One line of the table that `crossbar devices NAME` prints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FigureRow {
    /// Path in the profile, as error messages name it: `limits.temporaries`.
    pub key: String,
    /// The value as text; several are separated by spaces.
    pub value: String,
    /// The unit, empty where there is none.
    pub unit: String,
    /// Where the value is from.
    pub source: String,
    /// How sure we are.
    pub confidence: Confidence,
}

/// A figure as a profile's TOML writes it. One with `values` is a switch.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFigure {
    pub(super) value: toml::Value,
    #[serde(default)]
    pub(super) unit: String,
    pub(super) source: String,
    pub(super) confidence: Confidence,
    #[serde(default)]
    pub(super) values: Vec<String>,
    #[serde(default)]
    pub(super) meaning: String,
}

impl RawFigure {
    /// The value as the text that rows and switches show.
    pub(super) fn text(&self) -> String {
        match &self.value {
            toml::Value::String(s) => s.clone(),
            toml::Value::Array(items) => {
                let words: Vec<String> = items.iter().map(|v| v.as_str().unwrap_or("?").to_owned()).collect();
                words.join(" ")
            }
            other => other.to_string(),
        }
    }

    pub(super) fn row(&self, key: String) -> FigureRow {
        FigureRow {
            key,
            value: self.text(),
            unit: self.unit.clone(),
            source: self.source.clone(),
            confidence: self.confidence,
        }
    }
}

/// A section of a profile; figures are taken out of it, and what is left over is an error.
pub(super) struct Section<'a> {
    pub(super) device: &'a str,
    pub(super) name: &'static str,
    pub(super) figures: BTreeMap<String, RawFigure>,
}

impl Section<'_> {
    pub(super) fn problem(&self, key: &str, problem: &str) -> DeviceError {
        DeviceError::Profile { device: self.device.to_owned(), problem: format!("{}.{key}: {problem}", self.name) }
    }

    /// A whole number, if the section has it.
    pub(super) fn number<T: TryFrom<i64>>(&mut self, key: &str) -> Result<Option<T>, DeviceError> {
        let Some(figure) = self.figures.remove(key) else { return Ok(None) };
        let value = figure.value.as_integer().and_then(|v| T::try_from(v).ok());
        value.map(Some).ok_or_else(|| self.problem(key, "expected a whole number that is not negative"))
    }

    /// A yes or no; no where the section does not have it.
    pub(super) fn flag(&mut self, key: &str) -> Result<bool, DeviceError> {
        let Some(figure) = self.figures.remove(key) else { return Ok(false) };
        figure.value.as_bool().ok_or_else(|| self.problem(key, "expected true or false"))
    }

    /// A list of names; empty where the section does not have it.
    pub(super) fn names(&mut self, key: &str) -> Result<Vec<String>, DeviceError> {
        let Some(figure) = self.figures.remove(key) else { return Ok(Vec::new()) };
        let words = figure
            .value
            .as_array()
            .and_then(|items| items.iter().map(|v| v.as_str().map(str::to_owned)).collect::<Option<Vec<_>>>());
        words.ok_or_else(|| self.problem(key, "expected a list of names"))
    }

    /// A text, if the section has it.
    pub(super) fn text(&mut self, key: &str) -> Option<String> {
        self.figures.remove(key).map(|f| f.text())
    }

    /// An error if figures are left that nobody asked for.
    pub(super) fn finish(self) -> Result<(), DeviceError> {
        match self.figures.keys().next() {
            Some(key) => Err(self.problem(key, "no such figure")),
            None => Ok(()),
        }
    }
}
