//! Line charts as SVG.
//!
//! Each series has its own style; its label is next to its end, in a column that is also the legend.

mod axis;
mod draw;
mod style;

pub use axis::Scale;

use plotters::prelude::*;

use self::axis::Axis;
use self::draw::Drawing;
use self::style::{MAX_SERIES, SeriesStyle, dark_rules};
use super::not_encoded;
use super::visible::visible;
use crate::error::InputError;

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

struct DrawnSeries<'a> {
    label: &'a str,
    /// Points that the axes admit.
    points: Vec<(f64, f64)>,
    joined: bool,
    style: SeriesStyle,
}

impl Chart {
    /// Encodes the chart as an SVG file. Fails if there is nothing to draw, or there are more series than
    /// distinguishable styles.
    pub fn svg(&self) -> Result<String, InputError> {
        let fail = |reason: String| not_encoded("SVG", reason);
        let count = self.lines.len() + self.dots.len();
        if count > MAX_SERIES {
            return Err(fail(format!("{count} lines and sets of points, of which {MAX_SERIES} can be told apart")));
        }
        let series = self.series();
        let points = || series.iter().flat_map(|series| &series.points);
        let x = if self.ticks.is_empty() {
            Axis::rightward(self.x_scale, points().map(|p| p.0))
        } else {
            Some(Axis::named(self.ticks.len() as u32))
        };
        let y = Axis::over(self.y_scale, points().map(|p| p.1)).filter(|_| points().next().is_some());
        let (Some(x), Some(y)) = (x, y) else {
            return Err(fail("no points that span both axes".to_owned()));
        };
        let drawing = Drawing::new(self, &series);
        let mut text = String::new();
        let area = SVGBackend::with_string(&mut text, drawing.size()).into_drawing_area();
        drawing.draw(&area, x, y).map_err(|e| fail(e.to_string()))?;
        drop(area);
        Ok(visible(&self.titled(&text)).into_owned())
    }

    /// Lines, points and printed points, in the order of their styles; empty series are omitted.
    fn series<'a>(&'a self) -> Vec<DrawnSeries<'a>> {
        let admitted = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
            points.iter().copied().filter(|p| self.x_scale.admits(p.0) && self.y_scale.admits(p.1)).collect()
        };
        let ours = self.lines.iter().map(|line| (line, true)).chain(self.dots.iter().map(|dots| (dots, false)));
        let ours = ours.enumerate().map(|(n, (series, joined))| (series, joined, SeriesStyle::nth(n)));
        let printed = self.printed.iter().map(|printed| (printed, false, SeriesStyle::PRINTED));
        let drawn = |(series, joined, style): (&'a Series, bool, SeriesStyle)| DrawnSeries {
            label: &series.label,
            points: admitted(&series.points),
            joined,
            style,
        };
        ours.chain(printed).map(drawn).filter(|series| !series.points.is_empty()).collect()
    }

    /// Adds the title for screen readers, and the colors of a dark page, to a drawing of plotters.
    fn titled(&self, drawing: &str) -> String {
        let title = maud::html! { title { (self.title) } }.into_string();
        let (head, body) = drawing.split_once('>').unwrap_or_default();
        let head = head.replacen("<svg", "<svg role=\"img\"", 1);
        format!("{head}>\n{title}\n<style>{}</style>{body}", dark_rules())
    }
}
