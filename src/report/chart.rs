//! Line charts as SVG.

use plotters::prelude::*;

use super::ReportError;

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
pub struct Line {
    /// What it is, for the legend.
    pub label: String,
    /// Its points, x and y, finite.
    pub points: Vec<(f64, f64)>,
}

/// Lines over two linear axes that start at 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What the chart shows.
    pub title: String,
    /// The axis to the right, with its unit.
    pub x: String,
    /// The axis upward, with its unit.
    pub y: String,
    /// The lines, at most six of different colours.
    pub lines: Vec<Line>,
}

impl Chart {
    /// The chart as an SVG file.
    ///
    /// # Errors
    /// [`ReportError::Encode`] if there is nothing to draw.
    pub fn svg(&self) -> Result<String, ReportError> {
        let fail = |reason: String| ReportError::Encode { format: "SVG", reason };
        let most = |of: fn(&(f64, f64)) -> f64| {
            self.lines.iter().flat_map(|line| &line.points).map(of).filter(|v| v.is_finite()).fold(0.0, f64::max)
        };
        let (right, top) = (most(|p| p.0), most(|p| p.1) * 1.05);
        if right <= 0.0 || top <= 0.0 {
            return Err(fail("no point with positive coordinates".to_owned()));
        }
        let mut text = String::new();
        let drawn = self.draw(&SVGBackend::with_string(&mut text, SIZE).into_drawing_area(), right, top);
        drawn.map_err(|e| fail(e.to_string()))?;
        Ok(text)
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, plotters::coord::Shift>,
        right: f64,
        top: f64,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", 18))
            .margin(12)
            .x_label_area_size(42)
            .y_label_area_size(60)
            .build_cartesian_2d(0.0..right, 0.0..top)?;
        chart
            .configure_mesh()
            .x_desc(&self.x)
            .y_desc(&self.y)
            .light_line_style(WHITE)
            .label_style(("sans-serif", 13))
            .draw()?;
        for (line, color) in self.lines.iter().zip(PALETTE.iter().cycle()) {
            let points = line.points.iter().copied().filter(|p| p.0.is_finite() && p.1.is_finite());
            chart
                .draw_series(LineSeries::new(points, color.stroke_width(2)))?
                .label(&line.label)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::LowerRight)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 13))
            .draw()?;
        area.present()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(points: Vec<(f64, f64)>) -> Chart {
        let line = Line { label: "a <line>".to_owned(), points };
        Chart { title: "title".to_owned(), x: "x".to_owned(), y: "y".to_owned(), lines: vec![line] }
    }

    #[test]
    fn a_chart_is_one_svg_with_its_words_escaped() {
        let svg = chart(vec![(0.0, 0.0), (1.0, 2.0)]).svg().expect("two points");
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
        assert!(svg.contains("a &lt;line&gt;") && svg.contains("polyline"));
    }

    #[test]
    fn nothing_to_draw_is_said() {
        assert!(matches!(chart(vec![]).svg(), Err(ReportError::Encode { format: "SVG", .. })));
        assert!(chart(vec![(f64::NAN, 1.0)]).svg().is_err());
    }
}
