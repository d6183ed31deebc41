//! Data of a chart.

use super::axis::Scale;
use super::style::SeriesStyle;

/// Named series of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Label.
    pub label: String,
    /// Finite points, x and y.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// Adds a point to the line with this label; a new label begins a line.
    pub fn add(lines: &mut Vec<Self>, label: String, point: (f64, f64)) {
        match lines.iter_mut().find(|line| line.label == label) {
            Some(line) => line.points.push(point),
            None => lines.push(Self { label, points: vec![point] }),
        }
    }
}

/// Chart of lines and points over a horizontal and a vertical axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Label of the horizontal axis, with its unit; empty if `ticks` name its categories.
    pub x: String,
    /// Label of the vertical axis, with its unit.
    pub y: String,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// The lines.
    pub lines: Vec<Series>,
    /// Series of unconnected points.
    pub dots: Vec<Series>,
    /// Points of a paper: crosses in rings.
    pub printed: Vec<Series>,
    /// Names at 1, 2, ... of the horizontal axis, if it has no numbers.
    pub ticks: Vec<String>,
}

pub(super) struct DrawnSeries<'a> {
    pub(super) label: &'a str,
    /// Points that the axes admit.
    pub(super) points: Vec<(f64, f64)>,
    pub(super) joined: bool,
    pub(super) style: SeriesStyle,
}
