//! Files of printed figures: their format, and their conversion to figures.
//!
//! A file has groups of figures that share a section of the paper, and often a unit and a bound. A figure's value is
//! text with the printed number of decimals, or the ratio of two figures above it. The README of `src/studies/papers`
//! describes all keys.

use serde::Deserialize;
use toml::{Table, Value};

use super::expression::evaluate;
use crate::study::reproduce::Paper;
use crate::study::reproduce::row::{Bound, Judgement, MissClass, Origin, PaperEquation, PaperFigure};

/// A file, with the keys of its groups copied into their figures.
pub(super) struct PaperFile {
    /// Dates on which bounds were stated, with a digest of the statements.
    pub(super) stated: Vec<Stated>,
    pub(super) figures: Vec<FileFigure>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GroupedFile {
    stated: Vec<Stated>,
    group: Vec<FigureGroup>,
}

/// Figures, and the keys that they share.
#[derive(Deserialize)]
struct FigureGroup {
    figures: Vec<Table>,
    #[serde(flatten)]
    shared: Table,
}

/// Bounds that were stated on one day.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stated {
    pub(super) date: String,
    /// Digest of all figures of that date in their original form.
    pub(super) digest: String,
}

/// Figure with the keys of its group.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileFigure {
    pub(super) id: String,
    what: String,
    pub(super) place: String,
    pub(super) unit: Option<String>,
    pub(super) value: Option<String>,
    pub(super) ratio: Option<[String; 2]>,
    pub(super) scale: Option<f64>,
    decimals: Option<u8>,
    implied: Option<String>,
    inferred: Option<String>,
    pub(super) bound: Option<String>,
    pub(super) unjudged: Option<String>,
    pub(super) reading: Option<String>,
    missed: Option<String>,
    /// Date on which its bound was stated; by default the file's first date.
    pub(super) stated: Option<String>,
    /// Changes of the statement, oldest first; those of the group precede the figure's own.
    #[serde(default)]
    pub(super) changed: Vec<Change>,
    expression: Option<String>,
    #[serde(default)]
    readings: Vec<String>,
    entry: Option<String>,
    device: Option<String>,
    uses: Option<String>,
    chose: Option<String>,
    contradicts: Option<String>,
}

/// Change of a figure after its statement, with what was replaced; an empty reading if there was none.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Change {
    pub(super) date: String,
    pub(super) why: String,
    pub(super) value: Option<String>,
    pub(super) unit: Option<String>,
    pub(super) bound: Option<String>,
    pub(super) unjudged: Option<String>,
    pub(super) reading: Option<String>,
}

impl PaperFile {
    /// Parses a file; errors are sentences.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let GroupedFile { stated, group } = toml::from_str(text).map_err(|error| error.to_string())?;
        let all = group.into_iter().flat_map(|FigureGroup { figures, shared }| {
            figures.into_iter().map(move |own| {
                let id = own.get("id").and_then(Value::as_str).unwrap_or("without id").to_owned();
                with_shared(own, &shared).try_into().map_err(|e: toml::de::Error| format!("figure `{id}`: {e}"))
            })
        });
        Ok(Self { stated, figures: all.collect::<Result<_, String>>()? })
    }
}

/// Adds the group's keys to a figure that does not have them itself. If the figure has its own bound or reason, it
/// inherits neither.
fn with_shared(mut own: Table, shared: &Table) -> Table {
    let is_judged = own.contains_key("bound") || own.contains_key("unjudged");
    for (key, value) in shared {
        match (own.get_mut(key), value) {
            (Some(Value::Array(changes)), Value::Array(of_group)) if key == "changed" => {
                changes.splice(0..0, of_group.iter().cloned());
            }
            (None, _) if !(is_judged && matches!(key.as_str(), "bound" | "unjudged")) => {
                own.insert(key.clone(), value.clone());
            }
            _ => {}
        }
    }
    own
}

/// Converts a file to its figures; errors are sentences.
pub(super) fn figures(paper: Paper, file: &PaperFile) -> Result<Vec<PaperFigure>, String> {
    let mut figures: Vec<PaperFigure> = Vec::new();
    let first = file.stated.first().map_or("", |stated| &stated.date);
    let in_figure = |entry: &FileFigure, reason: String| format!("figure `{}/{}`: {reason}", paper.id(), entry.id);
    for entry in &file.figures {
        let figure = figure((paper, first), entry, &figures).map_err(|reason| in_figure(entry, reason))?;
        figures.push(figure);
    }
    // Expressions may use figures below them.
    for (at, entry) in file.figures.iter().enumerate() {
        figures[at].equation = equation(paper, entry, &figures).map_err(|reason| in_figure(entry, reason))?;
    }
    Ok(figures)
}

/// Value of a figure by its name within the paper.
fn named(paper: Paper, figures: &[PaperFigure], id: &str) -> Option<f64> {
    let id = format!("{}/{id}", paper.id());
    figures.iter().find(|figure| figure.id == id).map(|figure| figure.value)
}

/// Equation of a figure that has an expression.
fn equation(paper: Paper, entry: &FileFigure, figures: &[PaperFigure]) -> Result<Option<PaperEquation>, String> {
    let Some(expression) = &entry.expression else { return Ok(None) };
    let value = |text: &String| {
        evaluate(text, &|id| named(paper, figures, id).ok_or_else(|| format!("no figure is named `{id}`")))
    };
    Ok(Some(PaperEquation {
        entry: entry.entry.clone().ok_or("an expression needs the `entry` of its row")?,
        device: entry.device.clone().unwrap_or_else(|| "host".to_owned()),
        ours: value(expression)?,
        readings: entry.readings.iter().map(value).collect::<Result<_, _>>()?,
        uses: entry.uses.clone(),
        chose: entry.chose.clone(),
        contradicts: entry.contradicts.clone(),
    }))
}

fn figure((paper, first): (Paper, &str), entry: &FileFigure, above: &[PaperFigure]) -> Result<PaperFigure, String> {
    let find = |id: &str| named(paper, above, id).ok_or_else(|| format!("no figure above it is named `{id}`"));
    let (value, decimals, formula) = match (&entry.value, &entry.ratio) {
        (Some(text), None) => {
            let value = text.parse().map_err(|_| format!("expected a number, found `{text}`"))?;
            (value, text.split_once('.').map_or(0, |(_, digits)| digits.len() as u8), None)
        }
        (None, Some([numerator, denominator])) => {
            let [one, other] = [find(numerator)?, find(denominator)?];
            let ratio = entry.scale.unwrap_or(1.0) * one / other;
            (ratio, entry.decimals.unwrap_or(2), Some(format!("{one} / {other}")))
        }
        _ => return Err("expected one of `value` and `ratio`".to_owned()),
    };
    let origin = match (entry.implied.clone().or(formula), entry.inferred.clone()) {
        (None, None) => Origin::Printed,
        (Some(formula), None) => Origin::Implied(formula),
        (None, Some(reason)) => Origin::Inferred(reason),
        _ => return Err("expected one of `implied` and `inferred`".to_owned()),
    };
    let judgement = match (&entry.bound, &entry.unjudged) {
        (Some(text), None) => Judgement::Within(bound(text, find)?),
        (None, Some(reason)) => Judgement::Not(reason.clone()),
        _ => return Err("expected one of `bound` and `unjudged`".to_owned()),
    };
    let class =
        |text: &String| text.parse::<MissClass>().map_err(|_| format!("expected a class of misses, found `{text}`"));
    let missed = entry.missed.as_ref().map(class).transpose()?;
    let changed = entry.changed.last().map(|change| change.date.as_str());
    let stated = changed.or(entry.stated.as_deref()).unwrap_or(first).to_owned();
    Ok(PaperFigure {
        paper,
        id: format!("{}/{}", paper.id(), entry.id),
        what: entry.what.clone(),
        value,
        decimals,
        unit: entry.unit.clone().unwrap_or_default(),
        place: entry.place.clone(),
        origin,
        judgement,
        stated,
        missed,
        equation: None,
    })
}

/// Parses a bound: `every digit`, `at least`, `order`, `none`, `15 %`, `15 % of the gain over host-alone`.
fn bound(text: &str, value: impl Fn(&str) -> Result<f64, String>) -> Result<Bound, String> {
    let unknown = || format!("expected a bound, found `{text}`");
    let share = |percent: &str| percent.parse().map(|percent: f64| percent / 100.0).map_err(|_| unknown());
    Ok(match text {
        "every digit" => Bound::Print,
        "at least" => Bound::AtLeast,
        "order" => Bound::Order,
        "none" => Bound::TooVague,
        _ => match text.split_once(" %").ok_or_else(unknown)? {
            (percent, "") => Bound::Relative(share(percent)?),
            (percent, rest) => {
                let over = rest.strip_prefix(" of the gain over ").ok_or_else(unknown)?;
                Bound::Gain { share: share(percent)?, over: value(over)? }
            }
        },
    })
}
