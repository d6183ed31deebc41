//! The TOML structure of a profile's file.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::cards::CARDS;
use super::figure::{FigureRow, RawFigure};
use super::rules::Rules;
use super::switch::{FORMAT_RULES, Switch};

/// Switches that change limits instead of rules.
pub(super) const LIMIT_SWITCHES: [&str; 2] = ["ray-textures", "instruction-slots"];

/// A profile's file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawProfile {
    pub(super) name: String,
    pub(super) title: String,
    /// The card whose figures apply where this file does not state them.
    pub(super) base: Option<String>,
    pub(super) versions: Option<RawFigure>,
    #[serde(default)]
    pub(super) rules: BTreeMap<String, RawFigure>,
    #[serde(default)]
    pub(super) limits: BTreeMap<String, RawFigure>,
    #[serde(default)]
    pub(super) formats: BTreeMap<String, RawFigure>,
    #[serde(default)]
    pub(super) rates: BTreeMap<String, RawFigure>,
    #[serde(default)]
    pub(super) clocks: BTreeMap<String, RawFigure>,
    #[serde(default)]
    pub(super) bus: BTreeMap<String, RawFigure>,
}

impl RawProfile {
    /// Parses a file and fills in the figures of its base.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let mut own: Self = toml::from_str(text).map_err(|e| e.to_string())?;
        let Some(name) = &own.base else { return Ok(own) };
        let base = CARDS.iter().find(|(card, _)| card == name).ok_or_else(|| format!("base: no card `{name}`"))?;
        let base = Self::read(base.1)?;
        own.versions = own.versions.or(base.versions);
        for (figures, more) in [
            (&mut own.rules, base.rules),
            (&mut own.limits, base.limits),
            (&mut own.formats, base.formats),
            (&mut own.rates, base.rates),
            (&mut own.clocks, base.clocks),
            (&mut own.bus, base.bus),
        ] {
            for (key, figure) in more {
                figures.entry(key).or_insert(figure);
            }
        }
        Ok(own)
    }

    pub(super) fn rows(&self) -> Result<Vec<FigureRow>, String> {
        let mut rows: Vec<FigureRow> =
            self.versions.iter().map(|figure| figure.row("versions".to_owned())).collect::<Result<_, _>>()?;
        let sections = [
            ("rules", &self.rules),
            ("limits", &self.limits),
            ("formats", &self.formats),
            ("rates", &self.rates),
            ("clocks", &self.clocks),
            ("bus", &self.bus),
        ];
        for (name, figures) in sections {
            for (key, figure) in figures {
                rows.push(figure.row(format!("{name}.{key}"))?);
            }
        }
        Ok(rows)
    }

    /// The switches: rules with several possible values.
    pub(super) fn switches(&self) -> Vec<Switch> {
        let open = self.rules.iter().filter(|(_, figure)| !figure.values.is_empty());
        open.map(|(name, figure)| Switch {
            name: name.clone(),
            values: figure.values.clone(),
            current: figure.text(),
            default: figure.text(),
            source: figure.source.clone(),
            confidence: figure.confidence,
            meaning: figure.meaning.clone(),
        })
        .collect()
    }

    /// Reads the rules. Every rule must be stated: a default would have no source.
    pub(super) fn rules(&self) -> Result<Rules, String> {
        let figures = &self.rules;
        let rules = Rules::read(|name| figures.get(name).map(RawFigure::text))?;
        let known =
            |name: &str| Rules::NAMES.contains(&name) || FORMAT_RULES.contains(&name) || LIMIT_SWITCHES.contains(&name);
        for (name, figure) in figures {
            if !known(name) {
                return Err(format!("rules.{name}: no such rule"));
            }
            if !Rules::NAMES.contains(&name.as_str()) && figure.values.is_empty() {
                return Err(format!("rules.{name} must be a switch, but has no `values`"));
            }
        }
        Ok(rules)
    }
}
