//! Line charts as SVG.
//!
//! Each series has its own style; its label is next to its end, in a column that is also the legend.

mod axis;
mod data;
mod draw;
mod style;

pub use axis::Scale;
pub use data::{Chart, Series};

use plotters::prelude::*;

use self::axis::Axis;
use self::data::DrawnSeries;
use self::draw::Drawing;
use self::style::{MAX_SERIES, SeriesStyle, dark_rules};
use super::not_encoded;
use super::visible::visible;
use crate::error::InputError;

impl Chart {
    /// Encodes the chart as SVG; fails with nothing to draw, or with more series than distinguishable styles.
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
