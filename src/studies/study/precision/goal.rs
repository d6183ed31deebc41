//! Goals: a measure of a result with its bound.

use std::fmt;
use std::str::FromStr;

use crate::error::{InputError, input_error};
use crate::names::did_you_mean;
use crate::report::Series;
use crate::report::words::listed;
use crate::study::StudyError;

/// Relation of a measure to its bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum GoalRelation {
    AtMost,
    AtLeast,
    Below,
    Above,
    Equal,
}

/// Relations with their signs. A sign precedes its own prefixes, since parsing takes the first match.
const SIGNS: [(GoalRelation, &str); 5] = [
    (GoalRelation::AtMost, "<="),
    (GoalRelation::AtLeast, ">="),
    (GoalRelation::Below, "<"),
    (GoalRelation::Above, ">"),
    (GoalRelation::Equal, "="),
];

/// Goal of a study of precision: a measure and its bound, written `largest_codes<=1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// Name of the measure.
    pub measure: String,
    relation: GoalRelation,
    /// Finite.
    bound: f64,
}

impl FromStr for Goal {
    type Err = InputError;

    fn from_str(text: &str) -> Result<Self, InputError> {
        let parsed = || {
            let (measure, rest) = text.split_at(text.find(['<', '>', '='])?);
            let (relation, bound) = SIGNS.iter().find_map(|(r, sign)| Some((*r, rest.strip_prefix(sign)?)))?;
            let (measure, bound) = (measure.trim().to_owned(), bound.trim().parse().ok()?);
            Some(Self { measure, relation, bound }).filter(|goal| !goal.measure.is_empty() && goal.bound.is_finite())
        };
        let shown: String = text.chars().take(60).collect();
        parsed().ok_or_else(|| input_error!("expected a goal as `largest_codes<=1` or `ssim>=0.99`, found `{}`", shown))
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.measure, self.bound_text())
    }
}

impl Goal {
    /// Name of the measure in words.
    pub(super) fn words(&self) -> String {
        self.measure.replace('_', " ")
    }

    fn bound_text(&self) -> String {
        let sign = SIGNS.iter().find(|(relation, _)| *relation == self.relation).map_or("", |(_, sign)| sign);
        format!("{sign}{}", self.bound)
    }

    /// The bound as a line across the points of a chart.
    pub(super) fn line(&self, lines: &[Series]) -> Series {
        let across = || lines.iter().flat_map(|line| &line.points).map(|point| point.0);
        let ends = [across().min_by(f64::total_cmp), across().max_by(f64::total_cmp)];
        let points = ends.into_iter().flatten().map(|x| (x, self.bound)).collect();
        Series { label: format!("goal: {}", self.bound_text()), points }
    }

    /// The goal `given`, or else the default. Fails if the given goal is for a measure other than `names`.
    pub(super) fn chosen(given: Option<&Self>, names: &[&str], default: Self) -> Result<Self, StudyError> {
        let Some(goal) = given else { return Ok(default) };
        if names.contains(&goal.measure.as_str()) {
            return Ok(goal.clone());
        }
        let shown: String = goal.measure.chars().take(60).collect();
        let found = format!("expected a goal for {}, found `{shown}`", listed(names));
        let help = format!("{}for example `--goal \"{default}\"`", did_you_mean(&shown, names.iter().copied()));
        Err(StudyError::new("crossbar::precision::goal", found).with_help(help))
    }

    /// The goal that a measure is at most a bound.
    pub(super) fn at_most(measure: &str, bound: f64) -> Self {
        Self { measure: measure.to_owned(), relation: GoalRelation::AtMost, bound }
    }

    /// Returns `true` if a value meets the goal; NaN does not.
    pub fn met(&self, value: f64) -> bool {
        match self.relation {
            GoalRelation::AtMost => value <= self.bound,
            GoalRelation::Below => value < self.bound,
            GoalRelation::AtLeast => value >= self.bound,
            GoalRelation::Above => value > self.bound,
            GoalRelation::Equal => value == self.bound,
        }
    }

    /// Returns `true` if only values up to a bound meet the goal.
    pub(super) fn is_upper_bound(&self) -> bool {
        matches!(self.relation, GoalRelation::AtMost | GoalRelation::Below)
    }

    /// Badness of a value: the smaller, the better. NaN is worst.
    pub(super) fn badness(&self, value: f64) -> f64 {
        let badness = match self.relation {
            GoalRelation::AtMost | GoalRelation::Below => value,
            GoalRelation::AtLeast | GoalRelation::Above => -value,
            GoalRelation::Equal => (value - self.bound).abs(),
        };
        if badness.is_nan() { f64::INFINITY } else { badness }
    }

    /// Loss of a value compared with the exact run, at least 0.
    pub(super) fn loss(&self, value: f64, exact: f64) -> f64 {
        let [ours, exact] = [self.badness(value), self.badness(exact)];
        if ours == exact { 0.0 } else { (ours - exact).max(0.0) }
    }
}
