//! Goals: a measure of a result with its bound.

use std::fmt;
use std::str::FromStr;

/// Relation of a measure to its bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoalRelation {
    /// `<=`
    AtMost,
    /// `<`
    Below,
    /// `>=`
    AtLeast,
    /// `>`
    Above,
    /// `=`
    Equal,
}

impl GoalRelation {
    /// Relations with their signs; a sign that begins with another one stands before it.
    const ALL: [(Self, &str); 5] =
        [(Self::AtMost, "<="), (Self::AtLeast, ">="), (Self::Below, "<"), (Self::Above, ">"), (Self::Equal, "=")];

    fn sign(self) -> &'static str {
        Self::ALL.iter().find(|(relation, _)| *relation == self).map_or("", |(_, sign)| sign)
    }
}

/// Goal of a study of precision: a measure and its bound, written `largest_codes<=1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Goal {
    /// Name of the measure.
    pub measure: String,
    /// Relation of the measure to the bound.
    pub relation: GoalRelation,
    /// Bound, finite.
    pub bound: f64,
}

/// Text that is not a goal.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a goal as `largest_codes<=1` or `ssim>=0.99`, found `{text}`")]
pub struct GoalError {
    text: String,
}

impl FromStr for Goal {
    type Err = GoalError;

    fn from_str(text: &str) -> Result<Self, GoalError> {
        let error = || GoalError { text: text.chars().take(60).collect() };
        let at = text.find(['<', '>', '=']).ok_or_else(error)?;
        let (measure, rest) = (text[..at].trim(), &text[at..]);
        let signs = GoalRelation::ALL.iter();
        let (relation, bound) =
            signs.clone().find_map(|(r, sign)| Some((*r, rest.strip_prefix(sign)?))).ok_or_else(error)?;
        let bound: f64 = bound.trim().parse().map_err(|_| error())?;
        if measure.is_empty() || !bound.is_finite() {
            return Err(error());
        }
        Ok(Self { measure: measure.to_owned(), relation, bound })
    }
}

impl fmt::Display for Goal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}{}", self.measure, self.relation.sign(), self.bound)
    }
}

impl Goal {
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

    /// Badness of a value: the smaller, the better. NaN is worst.
    pub(super) fn badness(&self, value: f64) -> f64 {
        let badness = match self.relation {
            GoalRelation::AtMost | GoalRelation::Below => value,
            GoalRelation::AtLeast | GoalRelation::Above => -value,
            GoalRelation::Equal => (value - self.bound).abs(),
        };
        if badness.is_nan() { f64::INFINITY } else { badness }
    }

    /// Loss of a value against that of the exact run, at least 0.
    pub(super) fn loss(&self, value: f64, exact: f64) -> f64 {
        let [ours, exact] = [self.badness(value), self.badness(exact)];
        if ours == exact { 0.0 } else { (ours - exact).max(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn goal(text: &str) -> Goal {
        text.parse().expect("a goal")
    }

    #[test]
    fn goals_read_back() {
        for text in ["leaks=0", "ssim>=0.99", "mean_relative<0.01", "largest_codes<=1", "x>-2.5"] {
            assert_eq!(goal(text).to_string(), text);
        }
        assert_eq!(goal(" flip <= 1e-3 "), goal("flip<=0.001"));
    }

    #[test]
    fn other_text_is_refused() {
        for text in ["", "ssim", "<=1", "ssim<=", "ssim<=x", "ssim==1", "ssim<=inf", "ssim<=NaN", "=<1", "ssim<=>1"] {
            let error = text.parse::<Goal>().expect_err(text);
            assert!(error.to_string().ends_with(&format!("found `{text}`")), "{error}");
        }
    }

    #[test]
    fn a_value_meets_its_bound_and_nan_meets_none() {
        let met = |text: &str| [0.5, 1.0, 2.0, f64::NAN].map(|value| goal(text).met(value));
        assert_eq!(met("a<=1"), [true, true, false, false]);
        assert_eq!(met("a<1"), [true, false, false, false]);
        assert_eq!(met("a>=1"), [false, true, true, false]);
        assert_eq!(met("a>1"), [false, false, true, false]);
        assert_eq!(met("a=1"), [false, true, false, false]);
    }

    #[test]
    fn losses_are_against_the_exact_run() {
        assert_eq!([0.5, 0.0].map(|value| goal("a<=1").loss(value, 0.25)), [0.25, 0.0]);
        assert_eq!([0.5, 1.0].map(|value| goal("a>=1").loss(value, 1.0)), [0.5, 0.0]);
        assert_eq!([0.5, 1.5].map(|value| goal("a=1").loss(value, 1.0)), [0.5, 0.5]);
        assert_eq!(goal("a<=1").loss(f64::NAN, 0.0), f64::INFINITY);
        assert_eq!(goal("a<=1").loss(f64::INFINITY, f64::INFINITY), 0.0);
    }
}
