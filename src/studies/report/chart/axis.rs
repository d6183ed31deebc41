//! Axes: range, ticks, and positions of values.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use crate::elementary::log10;

/// Scale of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Linear, from 0 or from the smallest value if that is negative.
    #[default]
    Linear,
    /// Logarithmic; values that are not above 0 are omitted.
    Logarithmic,
}

/// Ratio of values above which [`Scale::fitting`] chooses a logarithmic axis. On a linear axis the smallest value would
/// lie in the first eighth.
const MAX_LINEAR_FACTOR: f64 = 8.0;

impl Scale {
    /// Chooses the scale for positive values: logarithmic if they differ by a large factor.
    pub fn fitting(values: impl IntoIterator<Item = f64>) -> Self {
        let positive = values.into_iter().filter(|value| *value > 0.0 && value.is_finite());
        let [least, most] = ends(positive);
        if most > MAX_LINEAR_FACTOR * least { Self::Logarithmic } else { Self::Linear }
    }

    pub(super) fn admits(self, value: f64) -> bool {
        value.is_finite() && (self == Self::Linear || value > 0.0)
    }
}

/// Smallest and largest value; infinity and -infinity for no values.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// Axis in the form that plotters requires.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    ticks: Vec<(f64, String)>,
}

const MARGIN: f64 = 1.06;
/// Ratio of positive values below which a horizontal axis does not begin at 0.
const MAX_FACTOR_FROM_0: f64 = 4.0;
const MAX_INTERVALS: usize = 8;

impl Axis {
    /// Builds a horizontal axis for values that its scale admits. It omits 0 if all values are far from 0. `None` if
    /// the range is empty.
    pub(super) fn rightward(scale: Scale, values: impl Iterator<Item = f64> + Clone) -> Option<Self> {
        let [least, most] = ends(values.clone());
        let margin = (MARGIN - 1.0) * (most - least);
        let far = scale == Scale::Linear && least > most / MAX_FACTOR_FROM_0 && most > least;
        if far { Self::between(scale, least - margin, most + margin) } else { Self::over(scale, values) }
    }

    /// Builds an axis for values that its scale admits; a linear axis includes 0. `None` if the range is empty.
    pub(super) fn over(scale: Scale, values: impl Iterator<Item = f64>) -> Option<Self> {
        let [least, most] = ends(values);
        match scale {
            Scale::Linear => Self::between(scale, least.min(0.0) * MARGIN, most.max(0.0) * MARGIN),
            Scale::Logarithmic => Self::between(scale, least / MARGIN, most * MARGIN),
        }
    }

    fn between(scale: Scale, low: f64, high: f64) -> Option<Self> {
        let spans = low.is_finite() && high.is_finite() && high > low && (high - low).is_finite();
        spans.then(|| {
            let ticks = match scale {
                Scale::Linear => linear_ticks(low, high),
                Scale::Logarithmic => logarithmic_ticks(low, high),
            };
            Self { scale, low, high, ticks: ticks.into_iter().map(|tick| (tick, tick_text(tick))).collect() }
        })
    }

    /// Builds an axis of `names` categories at 1, 2, ..., each in the middle of an equal interval; the drawing writes
    /// the names.
    pub(super) fn named(names: u32) -> Self {
        let ticks = (1..=names).map(|place| (f64::from(place), String::new())).collect();
        Self { scale: Scale::Linear, low: 0.5, high: f64::from(names) + 0.5, ticks }
    }

    /// Relative position of a value along the axis, from 0 to 1.
    fn share(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Logarithmic => (log10(value) - log10(self.low)) / (log10(self.high) - log10(self.low)),
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        from + (self.share(*value).clamp(0.0, 1.0) * f64::from(to - from)).round() as i32
    }

    fn key_points<H: KeyPointHint>(&self, _hint: H) -> Vec<f64> {
        self.ticks.iter().map(|(tick, _)| *tick).collect()
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(value: &f64) -> String {
        tick_text(*value)
    }

    fn format_ext(&self, value: &f64) -> String {
        self.ticks.iter().find(|(tick, _)| tick == value).map_or_else(String::new, |(_, text)| text.clone())
    }
}

/// Ticks at multiples of 1, 2 or 5 times a power of ten.
fn linear_ticks(low: f64, high: f64) -> Vec<f64> {
    let exponent = log10((high - low) / MAX_INTERVALS as f64).floor() as i32;
    // Parsing decimal text gives the nearest double; the product 3 * 0.1 does not.
    let at = |multiple: i64, step: i64, exponent: i32| format!("{}e{exponent}", multiple * step).parse().unwrap_or(0.0);
    let steps = [(1, exponent), (2, exponent), (5, exponent), (1, exponent + 1), (2, exponent + 1)];
    let fits = |&&(step, exponent): &&(i64, i32)| (high - low) / at(1, step, exponent) <= MAX_INTERVALS as f64;
    let Some(&(step, exponent)) = steps.iter().find(fits) else { return Vec::new() };
    let first = (low / at(1, step, exponent)).ceil() as i64;
    let all = (first..).map(|multiple| at(multiple, step, exponent)).take_while(|tick| *tick <= high);
    // Adding 0 turns -0 into 0.
    all.take(2 * MAX_INTERVALS).map(|tick| tick + 0.0).collect()
}

/// Ticks at powers of ten, and at 2 and 5 times each over up to three decades; linear ticks if fewer than two remain.
fn logarithmic_ticks(low: f64, high: f64) -> Vec<f64> {
    let (first, last) = (log10(low).floor() as i32, log10(high).ceil() as i32);
    let decades = (log10(high) - log10(low)).ceil() as usize;
    let mantissas: &[u32] = if decades <= 3 { &[1, 2, 5] } else { &[1] };
    let every = decades.div_ceil(MAX_INTERVALS).max(1);
    let at = |exponent: i32, mantissa: &u32| format!("{mantissa}e{exponent}").parse().unwrap_or(0.0);
    let wanted = (first..=last).filter(|exponent| (exponent.unsigned_abs() as usize).is_multiple_of(every));
    let ticks = wanted.flat_map(|exponent| mantissas.iter().map(move |mantissa| at(exponent, mantissa)));
    let ticks: Vec<f64> = ticks.filter(|tick| (low..=high).contains(tick)).collect();
    if ticks.len() >= 2 { ticks } else { linear_ticks(low, high) }
}

/// Formats a tick: plain digits near 1, a power of ten far from 1.
fn tick_text(tick: f64) -> String {
    let magnitude = tick.abs();
    if tick == 0.0 || (1e-3..1e6).contains(&magnitude) { format!("{tick}") } else { format!("{tick:e}") }
}
