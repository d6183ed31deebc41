//! Files of printed figures: their format, and their conversion to figures.
//!
//! A file has groups of figures that share a section of the paper, and often a unit and a bound. A figure's value is
//! text with the printed number of decimals, or the ratio of two figures above it. The README of `src/studies/papers`
//! describes all keys.

use serde::Deserialize;

use super::expression::evaluate;
use crate::study::reproduce::Paper;
use crate::study::reproduce::row::{Bound, Judgement, MissClass, Origin, PaperEquation, PaperFigure};

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PaperFile {
    /// Dates on which bounds were stated, with a digest of the statements.
    pub(super) stated: Vec<Stated>,
    group: Vec<FigureGroup>,
}

/// Bounds that were stated on one day.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stated {
    pub(super) date: String,
    /// Digest of all figures of that date in their original form.
    pub(super) digest: String,
}

/// Figures from one section, table or figure of the paper, with their common data.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FigureGroup {
    pub(super) place: String,
    #[serde(flatten)]
    shared: FigureTerms,
    /// Changes of the statements of all its figures, oldest first.
    #[serde(default)]
    pub(super) changed: Vec<Change>,
    figures: Vec<FileFigure>,
}

/// Terms by which a figure is judged, and data of a row with an expression. A group's terms hold for all its figures.
#[derive(Clone, Debug, Default, Deserialize)]
pub(super) struct FigureTerms {
    pub(super) unit: Option<String>,
    /// Bound as text; without a bound, `unjudged` has the reason.
    pub(super) bound: Option<String>,
    pub(super) unjudged: Option<String>,
    /// Reading that our value follows, if the text allows several.
    pub(super) reading: Option<String>,
    /// Entry to which the row belongs.
    entry: Option<String>,
    /// Card or host; `host` by default.
    device: Option<String>,
    /// Printed values that the expression uses.
    uses: Option<String>,
    /// Printed values that determined a constant of the expression.
    chose: Option<String>,
    /// Description of the computation, if its value may contradict the printed value.
    contradicts: Option<String>,
}

/// Figure, as in the file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileFigure {
    pub(super) id: String,
    what: String,
    /// Value with its printed digits.
    pub(super) value: Option<String>,
    /// Two figures above this one: the value is their ratio, multiplied by `scale`.
    pub(super) ratio: Option<[String; 2]>,
    pub(super) scale: Option<f64>,
    /// Number of decimals of a ratio; two by default.
    decimals: Option<u8>,
    /// Formula of a value that follows from printed values.
    implied: Option<String>,
    /// Reason for a value that is not in the paper.
    inferred: Option<String>,
    /// Reason why its row is missed. It is added after the result, so it is not part of the statement.
    missed: Option<String>,
    /// Date on which its bound was stated; by default the file's first date.
    pub(super) stated: Option<String>,
    /// Changes of the statement, oldest first; the group's changes precede them.
    #[serde(default)]
    pub(super) changed: Vec<Change>,
    /// Expression of printed values for the row's own value.
    expression: Option<String>,
    /// Expressions of other readings.
    #[serde(default)]
    readings: Vec<String>,
    #[serde(flatten)]
    own: FigureTerms,
}

/// Change of a figure after its statement, with the earlier value; an empty reading if there was none.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Change {
    pub(super) date: String,
    pub(super) why: String,
    pub(super) value: Option<String>,
    #[serde(flatten)]
    pub(super) before: FigureTerms,
}

impl PaperFile {
    /// All figures, each with its group.
    pub(super) fn entries(&self) -> impl Iterator<Item = (&FigureGroup, &FileFigure)> {
        self.group.iter().flat_map(|group| group.figures.iter().map(move |figure| (group, figure)))
    }
}

impl FileFigure {
    /// Terms of the figure: its own, otherwise its group's.
    pub(super) fn terms(&self, group: &FigureGroup) -> FigureTerms {
        let (own, shared) = (self.own.clone(), group.shared.clone());
        // If the figure has its own bound or reason, it inherits neither from its group.
        let is_own = own.bound.is_some() || own.unjudged.is_some();
        let judged = if is_own { (own.bound, own.unjudged) } else { (shared.bound, shared.unjudged) };
        FigureTerms {
            unit: own.unit.or(shared.unit),
            bound: judged.0,
            unjudged: judged.1,
            reading: own.reading.or(shared.reading),
            entry: own.entry.or(shared.entry),
            device: own.device.or(shared.device),
            uses: own.uses.or(shared.uses),
            chose: own.chose.or(shared.chose),
            contradicts: own.contradicts.or(shared.contradicts),
        }
    }

    /// Changes of the figure, oldest first.
    pub(super) fn changes<'a>(&'a self, group: &'a FigureGroup) -> impl DoubleEndedIterator<Item = &'a Change> {
        group.changed.iter().chain(&self.changed)
    }
}

/// Converts a file to its figures; errors are sentences.
pub(super) fn figures(paper: Paper, file: &PaperFile) -> Result<Vec<PaperFigure>, String> {
    let mut figures: Vec<PaperFigure> = Vec::new();
    let first = file.stated.first().map_or("", |stated| &stated.date);
    let in_figure = |entry: &FileFigure, reason: String| format!("figure `{}/{}`: {reason}", paper.id(), entry.id);
    for (group, entry) in file.entries() {
        let figure = figure((paper, first), group, entry, &figures).map_err(|reason| in_figure(entry, reason))?;
        figures.push(figure);
    }
    for (at, (group, entry)) in file.entries().enumerate() {
        let equation = equation(paper, group, entry, &figures).map_err(|reason| in_figure(entry, reason))?;
        figures[at].equation = equation;
    }
    Ok(figures)
}

/// Value of a figure by its name within the paper.
fn named(paper: Paper, figures: &[PaperFigure], id: &str) -> Option<f64> {
    let id = format!("{}/{id}", paper.id());
    figures.iter().find(|figure| figure.id == id).map(|figure| figure.value)
}

/// Equation of a figure that has an expression.
fn equation(
    paper: Paper,
    group: &FigureGroup,
    entry: &FileFigure,
    figures: &[PaperFigure],
) -> Result<Option<PaperEquation>, String> {
    let Some(expression) = &entry.expression else { return Ok(None) };
    let value = |text: &String| {
        evaluate(text, &|id| named(paper, figures, id).ok_or_else(|| format!("no figure is named `{id}`")))
    };
    let terms = entry.terms(group);
    Ok(Some(PaperEquation {
        entry: terms.entry.ok_or("an expression needs the `entry` of its row")?,
        device: terms.device.unwrap_or_else(|| "host".to_owned()),
        ours: value(expression)?,
        readings: entry.readings.iter().map(value).collect::<Result<_, _>>()?,
        uses: terms.uses,
        chose: terms.chose,
        contradicts: terms.contradicts,
    }))
}

fn figure(
    (paper, first): (Paper, &str),
    group: &FigureGroup,
    entry: &FileFigure,
    above: &[PaperFigure],
) -> Result<PaperFigure, String> {
    let terms = entry.terms(group);
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
    let judgement = match (terms.bound, terms.unjudged) {
        (Some(text), None) => Judgement::Within(bound(&text, find)?),
        (None, Some(reason)) => Judgement::Not(reason),
        _ => return Err("expected one of `bound` and `unjudged`".to_owned()),
    };
    let class =
        |text: &String| text.parse::<MissClass>().map_err(|_| format!("expected a class of misses, found `{text}`"));
    let missed = entry.missed.as_ref().map(class).transpose()?;
    let changed = entry.changes(group).next_back().map(|change| change.date.as_str());
    let stated = changed.or(entry.stated.as_deref()).unwrap_or(first).to_owned();
    Ok(PaperFigure {
        paper,
        id: format!("{}/{}", paper.id(), entry.id),
        what: entry.what.clone(),
        value,
        decimals,
        unit: terms.unit.unwrap_or_default(),
        place: group.place.clone(),
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
