//! Rows: a printed value of a paper and ours, with a bound and the verdict.
//!
//! Verdicts follow from the computation of a value ([`Method`], [`Dependence`], the range that confines it) and from
//! the bound. Only a [`Sweep`] of the same run creates [`Explanation`]s; only computations from printed values create
//! [`Contradiction`]s. Calibrated values are listed separately, and still have to lie within their bounds.

mod figure;
mod method;
mod sweep;
mod verdict;

pub use figure::{Bound, Contradiction, Judgement, MissClass, Origin, PaperEquation, PaperFigure};
pub use method::{Dependence, Method};
pub use sweep::{Setting, Sweep};
pub use verdict::{Explanation, RowVerdict};

use super::prose::ends;

/// Row: a value of a paper, compared with ours.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperRow {
    /// Card or host.
    pub device: &'static str,
    /// Method by which our value was computed.
    pub method: Method,
    /// Value of the paper.
    pub target: PaperFigure,
    /// Our value, in the unit of the printed value.
    pub ours: f64,
    /// Our values for the other readings and models that the text allows.
    pub readings: Vec<f64>,
    /// Dependence of our value on printed values.
    pub dependence: Dependence,
    /// Tolerance, stated on [`PaperFigure::stated`].
    pub bound: Bound,
    /// Source of our value.
    pub source: RowSource,
    /// Range of values that the computation can give, and the reason.
    confined: Option<([f64; 2], &'static str)>,
    /// Set only by [`Sweep::explain`].
    explanation: Option<Explanation>,
    contradiction: Option<Contradiction>,
}

/// Source of a row's value.
#[derive(Clone, Copy, Debug, PartialEq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum RowSource {
    /// Computed in this run.
    Computed,
    /// Read from a recorded run at full size.
    Recorded,
    /// Computed in this run at full size; the recorded value has the same bits.
    #[strum(to_string = "recorded and computed")]
    Confirmed,
    /// Computed in this run at full size; the recorded value has different bits.
    #[strum(to_string = "computed, not as recorded")]
    Differs {
        /// Recorded value.
        recorded: f64,
    },
}

impl PaperRow {
    /// Creates a row with a single reading, without explanation. `None` for a figure that is not judged.
    pub fn new(
        (device, method): (&'static str, Method),
        target: &PaperFigure,
        (ours, dependence): (f64, Dependence),
    ) -> Option<Self> {
        let Judgement::Within(bound) = target.judgement else { return None };
        let (target, readings) = (target.clone(), Vec::new());
        Some(Self {
            device,
            method,
            target,
            ours,
            readings,
            dependence,
            bound,
            source: RowSource::Computed,
            confined: None,
            explanation: None,
            contradiction: None,
        })
    }

    /// Adds the values of the other readings and models that the text allows: all of them must lie within the bound.
    #[must_use]
    pub fn with_readings(self, readings: impl IntoIterator<Item = f64>) -> Self {
        Self { readings: readings.into_iter().collect(), ..self }
    }

    /// States the range of values that the computation can give for any model, with the reason. A bound that admits all
    /// of them judges nothing ([`RowVerdict::ByConstruction`]).
    #[must_use]
    pub fn confined(self, range: [f64; 2], why: &'static str) -> Self {
        Self { confined: Some((range, why)), ..self }
    }

    /// Range of values that the computation can give, and the reason; `None` if nothing confines them.
    pub const fn confinement(&self) -> Option<([f64; 2], &'static str)> {
        self.confined
    }

    /// Adds a contradiction of the paper with itself; `None` adds nothing.
    #[must_use]
    pub fn contradicted(self, contradiction: Option<Contradiction>) -> Self {
        Self { contradiction, ..self }
    }

    /// Smallest and largest value within the bound; `None` if the text is too vague.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.bound.interval(self.target.value, self.target.rounding())
    }

    /// Returns `true` if `value` lies within the bound; always `false` if the text is too vague.
    pub fn admits(&self, value: f64) -> bool {
        self.bound.admits(self.target.value, self.target.rounding(), value)
    }

    /// Returns `true` if our value lies within the bound for every reading.
    pub fn holds(&self) -> bool {
        self.values().all(|value| self.admits(value))
    }

    /// Returns `true` if the row holds only because the printed value was rounded.
    pub fn holds_by_rounding(&self) -> bool {
        let unrounded = |value: f64| self.bound.admits(self.target.value, 0.0, value);
        self.holds() && self.bound != Bound::Print && !self.values().all(unrounded)
    }

    /// Smallest and largest value over all readings; `None` if there is only one reading.
    pub fn range(&self) -> Option<[f64; 2]> {
        (!self.readings.is_empty()).then(|| ends(self.values()))
    }

    /// All our values: the main value, then the other readings.
    pub(super) fn values(&self) -> impl Iterator<Item = f64> {
        std::iter::once(self.ours).chain(self.readings.iter().copied())
    }

    /// Relative difference: (ours - printed) / printed.
    pub fn difference(&self) -> f64 {
        (self.ours - self.target.value) / self.target.value
    }

    /// Verdict.
    pub fn verdict(&self) -> RowVerdict {
        if matches!(self.bound, Bound::TooVague) {
            RowVerdict::TooVague
        } else if self.is_contradictory() {
            RowVerdict::Contradictory
        } else if self.holds() {
            self.class()
        } else if self.explanation.is_some() {
            RowVerdict::Explained
        } else {
            RowVerdict::Missed
        }
    }

    /// Verdict on a row whose value lies within its bound.
    fn class(&self) -> RowVerdict {
        match (self.dependence, self.method, self.bound) {
            (Dependence::Calibrated { .. }, ..) => RowVerdict::Calibrated,
            (_, Method::Equation, _) => RowVerdict::Consistent,
            _ if self.cannot_fail() => RowVerdict::ByConstruction,
            (.., Bound::Order | Bound::AtLeast) => RowVerdict::OrderOnly,
            _ => RowVerdict::Predicted,
        }
    }

    /// Returns `true` if the bound admits every value that the computation can give. The ends of the range do not
    /// count: there, two values are equal, as with a method that changes nothing.
    fn cannot_fail(&self) -> bool {
        let range = self.confined.map(|(range, _)| range).zip(self.interval());
        range.is_some_and(|([least, most], [low, high])| low <= least.next_up() && most.next_down() <= high)
    }

    /// Returns `true` if the paper contradicts itself and our value agrees with one of its values: no verdict can tell
    /// which of them is right. A value that agrees with neither is missed in any case.
    pub(super) fn is_contradictory(&self) -> bool {
        let agrees =
            |printed: f64| self.values().all(|value| self.bound.admits(printed, self.target.rounding(), value));
        let found = self.contradiction.as_ref();
        found.is_some_and(|found| agrees(self.target.value) || found.value().is_some_and(agrees))
    }

    /// Returns `true` if the printed value determined a constant of the model: agreement is not evidence.
    pub const fn is_calibrated(&self) -> bool {
        matches!(self.dependence, Dependence::Calibrated { .. })
    }

    /// Returns `true` if a recorded run has a different value than this run at full size.
    pub const fn differs(&self) -> bool {
        matches!(self.source, RowSource::Differs { .. })
    }

    /// Reason for the miss; `None` for a row that is not missed.
    pub fn missed(&self) -> Option<MissClass> {
        self.target.missed.filter(|_| self.verdict() == RowVerdict::Missed)
    }

    /// Explanation of the row by a sweep, if it is outside its bound.
    pub fn explanation(&self) -> Option<&Explanation> {
        self.explanation.as_ref().filter(|_| self.verdict() == RowVerdict::Explained)
    }

    /// Computation that shows how the paper contradicts itself.
    pub fn contradiction(&self) -> Option<&Contradiction> {
        self.contradiction.as_ref()
    }
}
