//! Figures: a value with its source and confidence.

use std::{collections::BTreeMap, fmt};

use serde::Deserialize;

use super::DeviceError;

/// Confidence in a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Confidence {
    /// From a manufacturer's document or a specification.
    Documented,
    /// Measured on the card.
    Measured,
    /// Calculated from documented or measured figures; the source says how.
    Derived,
    /// No source was found: our assumption.
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

/// A row of the table that `crossbar devices NAME` prints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FigureRow {
    /// Path in the profile, as error messages name it: `limits.temporaries`.
    pub key: String,
    /// The value as text; multiple values are separated by spaces.
    pub value: String,
    /// The unit; empty if there is none.
    pub unit: String,
    /// Source of the value.
    pub source: String,
    /// Confidence in the value.
    pub confidence: Confidence,
}

/// A figure as stored in a profile's TOML. A figure with `values` is a switch.
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
    /// The value as text, as shown in rows and switches.
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

/// A section of a profile. Reading a figure removes it; figures left over are an error.
pub(super) struct Section<'a> {
    pub(super) device: &'a str,
    pub(super) name: &'static str,
    pub(super) figures: BTreeMap<String, RawFigure>,
}

impl Section<'_> {
    pub(super) fn problem(&self, key: &str, problem: &str) -> DeviceError {
        DeviceError::Profile { device: self.device.to_owned(), problem: format!("{}.{key}: {problem}", self.name) }
    }

    /// Removes and returns a non-negative integer, if the section has it.
    pub(super) fn number<T: TryFrom<i64>>(&mut self, key: &str) -> Result<Option<T>, DeviceError> {
        let Some(figure) = self.figures.remove(key) else { return Ok(None) };
        let value = figure.value.as_integer().and_then(|v| T::try_from(v).ok());
        value.map(Some).ok_or_else(|| self.problem(key, "expected a whole number that is not negative"))
    }

    /// Removes and returns a boolean; `false` if the section lacks it.
    pub(super) fn flag(&mut self, key: &str) -> Result<bool, DeviceError> {
        let Some(figure) = self.figures.remove(key) else { return Ok(false) };
        figure.value.as_bool().ok_or_else(|| self.problem(key, "expected true or false"))
    }

    /// Removes and returns a list of names; empty if the section lacks it.
    pub(super) fn names(&mut self, key: &str) -> Result<Vec<String>, DeviceError> {
        let Some(figure) = self.figures.remove(key) else { return Ok(Vec::new()) };
        let words = figure
            .value
            .as_array()
            .and_then(|items| items.iter().map(|v| v.as_str().map(str::to_owned)).collect::<Option<Vec<_>>>());
        words.ok_or_else(|| self.problem(key, "expected a list of names"))
    }

    /// Removes and returns a text, if the section has it.
    pub(super) fn text(&mut self, key: &str) -> Option<String> {
        self.figures.remove(key).map(|f| f.text())
    }

    /// Returns an error if unread figures are left.
    pub(super) fn finish(self) -> Result<(), DeviceError> {
        match self.figures.keys().next() {
            Some(key) => Err(self.problem(key, "no such figure")),
            None => Ok(()),
        }
    }
}
