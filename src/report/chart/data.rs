//! What a chart shows.

use super::axis::Scale;
use super::style::SeriesStyle;

/// Points with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is, for the label.
    pub label: String,
    /// Its points, x and y, finite.
    pub points: Vec<(f64, f64)>,
}

/// Lines and points over an axis to the right and an axis upward.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// What the chart shows.
    pub title: String,
    /// The axis to the right, with its unit; nothing where `ticks` say what stands there.
    pub x: String,
    /// The axis upward, with its unit.
    pub y: String,
    /// How the axis to the right grows.
    pub x_scale: Scale,
    /// How the axis upward grows.
    pub y_scale: Scale,
    /// The lines.
    pub lines: Vec<Series>,
    /// Points that no line joins.
    pub dots: Vec<Series>,
    /// A paper's points: crosses in rings, called "printed".
    pub printed: Vec<(f64, f64)>,
    /// What stands at 1, 2, ... of the axis to the right, where that has no numbers.
    pub ticks: Vec<String>,
}

/// A line or set of points as it is drawn.
pub(super) struct DrawnSeries<'a> {
    pub(super) label: &'a str,
    /// Those that the axes admit.
    pub(super) points: Vec<(f64, f64)>,
    pub(super) joined: bool,
    pub(super) style: SeriesStyle,
}
