//! Line charts as SVG.

use plotters::prelude::*;

use super::ReportError;
use super::visible::visible;
use crate::elementary::log10;

/// Pixels of a chart.
const SIZE: (u32, u32) = (720, 440);
/// Colours that differ in brightness too.
const PALETTE: [RGBColor; 6] = [
    RGBColor(0x1f, 0x4e, 0x9c),
    RGBColor(0xc4, 0x5a, 0x11),
    RGBColor(0x2c, 0x8a, 0x57),
    RGBColor(0x8a, 0x2c, 0x7a),
    RGBColor(0x6b, 0x6b, 0x6b),
    RGBColor(0xb0, 0x8a, 0x00),
];

/// A line of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is, for the legend.
    pub label: String,
    /// Its points, x and y, finite.
    pub points: Vec<(f64, f64)>,
}

/// How an axis grows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// From 0, evenly.
    #[default]
    Linear,
    /// By powers of ten; what is not above 0 is left out.
    Logarithmic,
}

/// Lines and points over an axis to the right that starts at 0 and an axis upward.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// What the chart shows.
    pub title: String,
    /// The axis to the right, with its unit; nothing where `ticks` say what stands there.
    pub x: String,
    /// The axis upward, with its unit.
    pub y: String,
    /// How the axis upward grows.
    pub y_scale: Scale,
    /// The lines; with `dots`, at most six of different colours.
    pub lines: Vec<Series>,
    /// Points that no line joins.
    pub dots: Vec<Series>,
    /// A paper's points: black rings, called "printed".
    pub printed: Vec<(f64, f64)>,
    /// What stands at 1, 2, ... of the axis to the right, where that has no numbers.
    pub ticks: Vec<String>,
}

impl Chart {
    /// The chart as an SVG file.
    ///
    /// # Errors
    /// [`ReportError::Encode`] if there is nothing to draw.
    pub fn svg(&self) -> Result<String, ReportError> {
        let fail = |reason: String| ReportError::Encode { format: "SVG", reason };
        let all = self.lines.iter().chain(&self.dots).map(|line| &line.points).chain([&self.printed]);
        let shown: Vec<Vec<(f64, f64)>> = all.map(|points| self.shown(points)).collect();
        let most = |of: fn(&(f64, f64)) -> f64| shown.iter().flatten().map(of).fold(f64::NEG_INFINITY, f64::max);
        // Names stand in the middle of as much room each.
        let right = if self.ticks.is_empty() { most(|p| p.0) } else { self.ticks.len() as f64 + 0.5 };
        let top = most(|p| p.1);
        let [low, high] = match self.y_scale {
            Scale::Linear => [0.0, top * 1.05],
            Scale::Logarithmic => {
                let least = shown.iter().flatten().map(|p| p.1).fold(f64::INFINITY, f64::min);
                [least.floor(), top.ceil().max(least.floor() + 1.0)]
            }
        };
        let space = |from: f64, to: f64| from.is_finite() && to.is_finite() && to > from;
        if !(space(0.0, right) && space(low, high)) {
            return Err(fail("no point with positive coordinates".to_owned()));
        }
        let mut text = String::new();
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        self.draw(&area, &shown, right, [low, high]).map_err(|e| fail(e.to_string()))?;
        drop(area);
        Ok(visible(&text).into_owned())
    }

    /// Points as they are drawn: on a logarithmic axis by the logarithms.
    fn shown(&self, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
        let finite = points.iter().copied().filter(|p| p.0.is_finite() && p.1.is_finite());
        match self.y_scale {
            Scale::Linear => finite.collect(),
            Scale::Logarithmic => finite.filter(|p| p.1 > 0.0).map(|(x, y)| (x, log10(y))).collect(),
        }
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, plotters::coord::Shift>,
        shown: &[Vec<(f64, f64)>],
        right: f64,
        [low, high]: [f64; 2],
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", 18))
            .margin(12)
            .x_label_area_size(42)
            .y_label_area_size(60)
            .build_cartesian_2d(0.0..right, low..high)?;
        let power = |y: &f64| format!("1e{y:.0}");
        let mut mesh = chart.configure_mesh();
        if self.y_scale == Scale::Logarithmic {
            // A label a power of ten while there are few, so that no label is rounded.
            mesh.y_labels(((high - low) as usize + 1).min(25)).y_label_formatter(&power);
        }
        let name = |x: &f64| {
            let place = x.round();
            let there = (x - place).abs() < 0.01 && place >= 1.0;
            self.ticks.get(place as usize - usize::from(there)).filter(|_| there).cloned().unwrap_or_default()
        };
        if !self.ticks.is_empty() {
            mesh.x_labels(self.ticks.len() + 1).x_label_formatter(&name);
        }
        mesh.x_desc(&self.x).y_desc(&self.y).light_line_style(WHITE).label_style(("sans-serif", 13)).draw()?;
        let (lines, points) = shown.split_at(self.lines.len());
        let (dots, printed) = points.split_at(self.dots.len());
        let mut colors = PALETTE.iter().cycle();
        for ((line, points), color) in self.lines.iter().zip(lines).zip(&mut colors) {
            chart
                .draw_series(LineSeries::new(points.iter().copied(), color.stroke_width(2)))?
                .label(&line.label)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
        }
        for ((line, points), color) in self.dots.iter().zip(dots).zip(&mut colors) {
            chart
                .draw_series(points.iter().map(|point| Circle::new(*point, MARK, color.filled())))?
                .label(&line.label)
                .legend(move |(x, y)| Circle::new((x + 9, y), MARK, color.filled()));
        }
        let ring = BLACK.stroke_width(2);
        let printed = chart.draw_series(printed.iter().flatten().map(|point| Circle::new(*point, MARK, ring)))?;
        if !self.printed.is_empty() {
            printed.label("printed").legend(move |(x, y)| Circle::new((x + 9, y), MARK, ring));
        }
        chart
            .configure_series_labels()
            .position(match self.y_scale {
                Scale::Linear => SeriesLabelPosition::LowerRight,
                // What is drawn by powers of ten falls, as residuals do.
                Scale::Logarithmic => SeriesLabelPosition::UpperRight,
            })
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 13))
            .draw()?;
        area.present()
    }
}

/// Radius of a point, in pixels.
const MARK: i32 = 5;

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
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
        assert!(svg.contains("a &lt;line&gt;") && svg.contains("polyline"));
    }

    #[test]
    fn powers_of_ten_are_labels() {
        let points = vec![(0.0, 1.0), (1.0, 0.01), (2.0, 0.0), (3.0, 1e-4)];
        let svg = Chart { y_scale: Scale::Logarithmic, ..chart(points) }.svg().expect("three points above 0");
        for label in ["1e0", "1e-2", "1e-4"] {
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
            assert!(svg.contains(text), "{text}");
        }
        // Two points each, and one in the legend.
        assert_eq!(svg.matches("<circle").count(), 6, "{svg}");
    }

    #[test]
    fn nothing_to_draw_is_said() {
        assert!(matches!(chart(vec![]).svg(), Err(ReportError::Encode { format: "SVG", .. })));
        assert!(chart(vec![(f64::NAN, 1.0)]).svg().is_err());
    }
}
