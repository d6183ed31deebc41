//! Line charts as SVG.
//!
//! Each series has its own style and its label beside its end, in a column that is also the legend.

mod axis;
mod data;
mod draw;
mod labels;
mod style;

pub use axis::Scale;
pub use data::{Chart, Series};

use plotters::prelude::*;

use self::axis::Axis;
use self::data::DrawnSeries;
use self::draw::Drawing;
use self::style::{MAX_SERIES, SeriesStyle, dark_rules};
use super::ReportError;
use super::visible::visible;

impl Chart {
    /// Encodes the chart as an SVG file.
    ///
    /// # Errors
    /// [`ReportError::Encode`] if there is nothing to draw, or more series than distinguishable styles.
    pub fn svg(&self) -> Result<String, ReportError> {
        let fail = |reason: String| ReportError::Encode { format: "SVG", reason };
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

    /// Lines, points and the printed ones, in the order of their styles; empty ones are omitted.
    fn series(&self) -> Vec<DrawnSeries<'_>> {
        let admitted = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
            points.iter().copied().filter(|p| self.x_scale.admits(p.0) && self.y_scale.admits(p.1)).collect()
        };
        let all = self.lines.iter().map(|line| (line, true)).chain(self.dots.iter().map(|dots| (dots, false)));
        let ours = all.enumerate().map(|(n, (series, joined))| DrawnSeries {
            label: &series.label,
            points: admitted(&series.points),
            joined,
            style: SeriesStyle::nth(n),
        });
        let printed = DrawnSeries {
            label: "printed",
            points: admitted(&self.printed),
            joined: false,
            style: SeriesStyle::PRINTED,
        };
        ours.chain([printed]).filter(|series| !series.points.is_empty()).collect()
    }

    /// Adds the title for screen readers, and the colors of a dark page, to a drawing of plotters.
    fn titled(&self, drawing: &str) -> String {
        let title = maud::html! { title { (self.title) } }.into_string();
        let (head, body) = drawing.split_once('>').unwrap_or_default();
        let head = head.replacen("<svg", "<svg role=\"img\"", 1);
        format!("{head}>\n{title}\n<style>{}</style>{body}", dark_rules())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(points: Vec<(f64, f64)>) -> Chart {
        let line = Series { label: "a <line>".to_owned(), points };
        Chart { title: "title".to_owned(), x: "x".to_owned(), y: "y".to_owned(), lines: vec![line], ..Chart::default() }
    }

    #[test]
    fn a_chart_is_one_svg_with_its_words_escaped() {
        let svg = chart(vec![(0.0, 0.0), (1.0, 2.0)]).svg().expect("two points");
        assert!(svg.starts_with("<svg role=\"img\"") && svg.trim_end().ends_with("</svg>"));
        assert!(svg.contains("a &lt;line&gt;") && svg.contains("polyline") && svg.contains("<title>title</title>"));
    }

    #[test]
    fn powers_of_ten_are_labels() {
        let points = vec![(0.0, 1.0), (1.0, 0.01), (2.0, 0.0), (3.0, 1e-4)];
        let svg = Chart { y_scale: Scale::Logarithmic, ..chart(points) }.svg().expect("three points above 0");
        for label in ["1", "0.01", "1e-4"] {
            assert!(svg.contains(&format!("\n{label}\n")), "{label}: {svg}");
        }
        assert!(Chart { y_scale: Scale::Logarithmic, ..chart(vec![(1.0, 0.0)]) }.svg().is_err());
    }

    #[test]
    fn points_and_names_are_drawn() {
        let series = |label: &str| Series { label: label.to_owned(), points: vec![(1.0, 2.0), (2.0, 3.0)] };
        let ticks = ["an office", "a room"].map(str::to_owned).into();
        let dots = vec![series("ours")];
        let chart = Chart { dots, printed: vec![(1.0, 2.5), (2.0, 1.0)], ticks, ..chart(Vec::new()) };
        let svg = chart.svg().expect("four points");
        for text in ["an office", "a room", "ours", "printed"] {
            assert_eq!(svg.matches(&format!("\n{text}\n")).count(), 1, "{text}");
        }
        // A ring for each of two printed points, and one beside the label.
        assert_eq!(svg.matches("<circle").count(), 3, "{svg}");
    }

    /// Heights of the labels' texts.
    fn heights(svg: &str, labels: &[String]) -> Vec<f64> {
        let place = |label: &String| {
            let tag = svg.split("<text ").find(|tag| tag.contains(&format!(">\n{label}\n"))).expect("a label");
            let y = tag.split("y=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a height");
            y.parse().expect("a number")
        };
        labels.iter().map(place).collect()
    }

    /// More lines than colors, all of which end at the same point.
    #[test]
    fn many_lines_have_looks_of_their_own_and_labels_that_do_not_overlap() {
        let labels: Vec<String> = (0..40).map(|n| format!("line {n:02}")).collect();
        let line = |label: &String| Series { label: label.clone(), points: vec![(0.0, 0.0), (1.0, 1.0)] };
        let chart = Chart { lines: labels.iter().map(line).collect(), ..chart(Vec::new()) };
        let series = chart.series();
        for (n, one) in series.iter().enumerate() {
            assert!(series[..n].iter().all(|other| other.style != one.style), "{n}");
        }
        let svg = chart.svg().expect("forty lines");
        let mut heights = heights(&svg, &labels);
        let pixels: f64 =
            svg.split("height=\"").nth(1).and_then(|t| t.split('"').next()).expect("a size").parse().expect("a number");
        assert!(heights.iter().all(|height| (0.0..pixels).contains(height)), "{heights:?}");
        heights.sort_by(f64::total_cmp);
        assert!(heights.windows(2).all(|two| two[1] - two[0] >= 16.0), "{heights:?}");
    }

    #[test]
    fn what_cannot_be_told_apart_is_refused() {
        let lines = (0..=MAX_SERIES).map(|_| Series { label: String::new(), points: vec![(1.0, 1.0)] }).collect();
        let refused = Chart { lines, ..chart(Vec::new()) }.svg();
        assert!(matches!(refused, Err(ReportError::Encode { format: "SVG", .. })));
    }

    #[test]
    fn nothing_to_draw_is_said() {
        assert!(matches!(chart(vec![]).svg(), Err(ReportError::Encode { format: "SVG", .. })));
        assert!(chart(vec![(f64::NAN, 1.0)]).svg().is_err());
    }
}
