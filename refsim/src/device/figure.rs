//! Figures: a value with its source and confidence.

use std::{collections::BTreeMap, fmt};

use serde::Deserialize;

use super::DeviceError;

/// Confidence in a figure, highest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Confidence {
    /// Stated by a manufacturer's document, a specification or a driver's register header.
    Documented,
    /// Measured on this chip.
    Measured,
    /// Measured on a chip with the same unit, which the source names.
    Sibling,
    /// Calculated from documented, measured or sibling figures; the source says how.
    Derived,
    /// Measured on a chip of an older or newer family, which the source names.
    Kin,
    /// Chosen by the driver, so that several values are right; the source names the driver and its choice.
    State,
    /// One developer's observation.
    Report,
    /// No source was found: our assumption.
    Guess,
}

impl Confidence {
    /// Every confidence, highest first.
    pub const ALL: [Self; 8] = [
        Self::Documented,
        Self::Measured,
        Self::Sibling,
        Self::Derived,
        Self::Kin,
        Self::State,
        Self::Report,
        Self::Guess,
    ];

    /// The word in profiles and tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Documented => "documented",
            Self::Measured => "measured",
            Self::Sibling => "sibling",
            Self::Derived => "derived",
            Self::Kin => "kin",
            Self::State => "state",
            Self::Report => "report",
            Self::Guess => "guess",
        }
    }

    /// `true` if measuring the card would settle the figure: no document states it, and it was measured neither on the
    /// chip nor on one with the same unit.
    pub fn is_open(self) -> bool {
        self >= Self::Kin
    }
}

impl fmt::Display for Confidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// A row of the table printed by `crossbar devices NAME`.
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
    /// Counts of a measurement, if it chose the value among hypotheses.
    pub counts: Option<MeasuredCounts>,
}

/// Counts of a measurement: how many measured values each hypothesis predicts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeasuredCounts {
    /// The chip that was measured.
    pub of: String,
    /// Number of values.
    pub all: u64,
    /// Hypotheses and the number of values that each predicts, best first. The hypotheses of a switch are its values.
    pub right: Vec<(String, u64)>,
}

impl fmt::Display for MeasuredCounts {
    /// Displays the counts as `NV2A: cut 52, nearest 24 of 52`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let right: Vec<String> = self.right.iter().map(|(hypothesis, right)| format!("{hypothesis} {right}")).collect();
        write!(f, "{}: {} of {}", self.of, right.join(", "), self.all)
    }
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
    /// `of`, `all` and `right` form [`MeasuredCounts`].
    #[serde(default)]
    of: Option<String>,
    #[serde(default)]
    all: Option<u64>,
    #[serde(default)]
    right: BTreeMap<String, u64>,
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

    /// The counts, if the figure states any.
    ///
    /// # Errors
    /// If the counts are incomplete, if another hypothesis predicts as many measurements as the figure's value, or if
    /// the hypotheses of a switch are not its values.
    fn counts(&self) -> Result<Option<MeasuredCounts>, &'static str> {
        if self.of.is_none() && self.all.is_none() && self.right.is_empty() {
            return Ok(None);
        }
        let (Some(of), Some(all)) = (self.of.clone(), self.all) else {
            return Err("counts consist of `of`, `all` and `right`");
        };
        if !matches!(self.confidence, Confidence::Measured | Confidence::Sibling) {
            return Err("only a figure that was measured, here or on a sibling, has counts");
        }
        let mut right: Vec<_> = self.right.iter().map(|(name, &right)| (name.clone(), right)).collect();
        right.sort_by_key(|(_, right)| std::cmp::Reverse(*right));
        match &right[..] {
            [best, next, ..] if best.0 == self.text() && best.1 > next.1 && best.1 <= all => {}
            _ => return Err("the value must predict more than another hypothesis, and no more than all"),
        }
        let named = |value: &String| self.right.contains_key(value);
        if !(self.values.is_empty() || self.values.len() == right.len() && self.values.iter().all(named)) {
            return Err("`right` must have every value of the switch");
        }
        Ok(Some(MeasuredCounts { of, all, right }))
    }

    pub(super) fn row(&self, key: String) -> Result<FigureRow, String> {
        let counts = self.counts().map_err(|problem| format!("{key}: {problem}"))?;
        Ok(FigureRow {
            key,
            value: self.text(),
            unit: self.unit.clone(),
            source: self.source.clone(),
            confidence: self.confidence,
            counts,
        })
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

    /// Removes and returns a list of values by name; empty if the section lacks it.
    pub(super) fn named<T: Copy>(
        &mut self,
        key: &str,
        all: &[T],
        name: fn(T) -> &'static str,
    ) -> Result<Vec<T>, DeviceError> {
        let names = self.names(key)?.into_iter();
        let known = |text: String| {
            let found = all.iter().copied().find(|&one| name(one) == text);
            found.ok_or_else(|| self.problem(key, &format!("no value has the name `{text}`")))
        };
        names.map(known).collect()
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
