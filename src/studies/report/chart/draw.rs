//! Drawing of a chart with plotters: it draws the axes; everything else is drawn in pixels. Labels are in a column to
//! the right, each as near as possible to the end of its line.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::super::palette::LIGHT;
use super::axis::Axis;
use super::data::{Chart, DrawnSeries};
use super::style::{Marker, SeriesStyle, rgb};

type Pixel = (i32, i32);
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type DrawResult<T = ()> = Result<T, DrawingAreaErrorKind<std::io::Error>>;

/// Size of the plot area, including the numbers of the axes, in pixels.
const PLOT: (i32, i32) = (580, 400);
/// Margins above and below the plot, for the title and for the numbers below, in pixels.
const MARGINS: [i32; 2] = [44, 54];
/// Horizontal extent of the line samples in the legend column, in pixels.
const SAMPLE: [i32; 2] = [PLOT.0 + 4, PLOT.0 + 28];
/// Sizes of fonts; plotters writes them divided by 1.24.
const FONTS: [f64; 2] = [20.0, 15.5];
/// Distance of the centres of neighbouring labels, in pixels.
const PITCH: i32 = 19;
/// Upper bound, in pixels, of the mean width of a label's letters in the smaller font: sans-serif letters are on
/// average at most 0.6 of their font's size wide.
const LETTER: i32 = 8;
const MARK: i32 = 4;
/// Minimum distance between markers of a line, in pixels.
const APART: i32 = 56;

pub(super) struct Drawing<'a> {
    chart: &'a Chart,
    series: &'a [DrawnSeries<'a>],
    height: i32,
}

struct PixelSeries<'a> {
    series: &'a DrawnSeries<'a>,
    points: Vec<Pixel>,
}

impl<'a> Drawing<'a> {
    pub(super) fn new(chart: &'a Chart, series: &'a [DrawnSeries<'a>]) -> Self {
        let labels = signed(series.len()) * PITCH + MARGINS[0] + MARGINS[1];
        Self { chart, series, height: PLOT.1.max(labels) }
    }

    pub(super) fn size(&self) -> (u32, u32) {
        let letters = self.series.iter().map(|series| signed(series.label.chars().count())).max().unwrap_or(0);
        let width = SAMPLE[1] + 10 + letters * LETTER;
        (width.unsigned_abs(), self.height.unsigned_abs())
    }

    pub(super) fn draw(&self, area: &Area<'_>, x: Axis, y: Axis) -> DrawResult {
        area.fill(&rgb(LIGHT.paper))?;
        area.draw(&Text::new(self.chart.title.clone(), (14, 12), font(FONTS[0])))?;
        let points = self.axes(area, x, y)?;
        let all: Vec<PixelSeries<'_>> =
            self.series.iter().zip(points).map(|(series, points)| PixelSeries { series, points }).collect();
        self.labels(area, &all)?;
        for one in &all {
            one.path(area)?;
        }
        all.iter().enumerate().try_for_each(|(n, one)| one.marks(area, n))?;
        area.present()
    }

    /// Draws the axes, and returns the series in pixels.
    fn axes(&self, area: &Area<'_>, x: Axis, y: Axis) -> DrawResult<Vec<Vec<Pixel>>> {
        let (plot, _) = area.split_horizontally(PLOT.0);
        let mut context = ChartBuilder::on(&plot)
            .margin_top(MARGINS[0])
            .margin_bottom(6)
            .margin_right(12)
            .margin_left(8)
            .x_label_area_size(MARGINS[1] - 6)
            .y_label_area_size(62)
            .build_cartesian_2d(x, y)?;
        let numbers = font(FONTS[1]);
        let mut mesh = context.configure_mesh();
        mesh.light_line_style(TRANSPARENT)
            .bold_line_style(rgb(LIGHT.rule))
            .axis_style(rgb(LIGHT.quiet))
            .label_style(numbers.clone())
            .axis_desc_style(numbers)
            .x_desc(self.chart.x.as_str())
            .y_desc(self.chart.y.as_str())
            .draw()?;
        let (_, bottom) = context.plotting_area().get_pixel_range();
        for (place, name) in (1..).zip(&self.chart.ticks) {
            let (middle, _) = context.backend_coord(&(f64::from(place), 0.0));
            self.name(area, name, (middle, bottom.end + 8))?;
        }
        let pixels = |series: &DrawnSeries<'_>| series.points.iter().map(|at| context.backend_coord(at)).collect();
        Ok(self.series.iter().map(pixels).collect())
    }

    /// Draws a category name below the axis, in two lines if one line would overlap its neighbors.
    fn name(&self, area: &Area<'_>, name: &str, (middle, top): Pixel) -> DrawResult {
        let room = (PLOT.0 - 82) / signed(self.chart.ticks.len().max(1));
        let long = signed(name.chars().count()) * LETTER > room;
        let lines = if long { halves(name) } else { vec![name] };
        let style = font(FONTS[1]).pos(Pos::new(HPos::Center, VPos::Top));
        lines
            .into_iter()
            .zip((top..).step_by(16))
            .try_for_each(|(line, y)| area.draw(&Text::new(line.to_owned(), (middle, y), style.clone())))
    }

    /// Draws the column of labels: a sample of each series, its name, and a thin line from the end of the series.
    fn labels(&self, area: &Area<'_>, all: &[PixelSeries<'_>]) -> DrawResult {
        let wanted: Vec<i32> = all.iter().map(|one| one.end().1).collect();
        let places = spread(&wanted, [MARGINS[0] + PITCH / 2, self.height - MARGINS[1] - PITCH / 2]);
        let style = font(FONTS[1]).pos(Pos::new(HPos::Left, VPos::Center));
        for (one, y) in all.iter().zip(places) {
            let SeriesStyle { color, .. } = one.series.style;
            area.draw(&PathElement::new([one.end(), (SAMPLE[0] - 3, y)], color.mix(0.45)))?;
            let points = if one.series.joined { SAMPLE.map(|x| (x, y)).to_vec() } else { Vec::new() };
            PixelSeries { series: one.series, points }.path(area)?;
            mark(area, ((SAMPLE[0] + SAMPLE[1]) / 2, y), one.series.style)?;
            area.draw(&Text::new(one.series.label.to_owned(), (SAMPLE[1] + 6, y), style.clone()))?;
        }
        Ok(())
    }
}

fn font(size: f64) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&rgb(LIGHT.ink))
}

/// Splits a name into two lines so that the longer one is shortest; a single word stays one line.
fn halves(name: &str) -> Vec<&str> {
    let longer = |(space, _): &(usize, &str)| (*space).max(name.len() - space - 1);
    let best = name.match_indices(' ').min_by_key(longer);
    best.map_or_else(|| vec![name], |(space, _)| vec![&name[..space], &name[space + 1..]])
}

impl PixelSeries<'_> {
    fn end(&self) -> Pixel {
        self.points.last().copied().unwrap_or_default()
    }

    /// Draws the line, dashed or solid; nothing for a series of points.
    fn path(&self, area: &Area<'_>) -> DrawResult {
        let style = self.series.style;
        let stroke = style.color.stroke_width(2);
        let points = self.points.iter().copied();
        match style.dash {
            _ if !self.series.joined => Ok(()),
            Some((dash, gap)) => area.draw(&DashedPathElement::new(points, dash, gap, stroke)),
            None => area.draw(&PathElement::new(points.collect::<Vec<_>>(), stroke)),
        }
    }

    /// Draws the markers: all points, or some points along a line, starting at a different point on each line.
    fn marks(&self, area: &Area<'_>, n: usize) -> DrawResult {
        let few = !self.series.joined || self.points.len() <= 10;
        let mut last = self.points.first().map_or(0, |p| p.0) - (signed(n) * 19).rem_euclid(APART);
        for point in &self.points {
            if few || point.0 - last >= APART {
                last = point.0;
                mark(area, *point, self.series.style)?;
            }
        }
        Ok(())
    }
}

fn mark(area: &Area<'_>, (x, y): Pixel, style: SeriesStyle) -> DrawResult {
    let square = [(-MARK, -MARK), (MARK, -MARK), (MARK, MARK), (-MARK, MARK)];
    let triangle = [(0, -MARK - 1), (MARK + 1, MARK), (-MARK - 1, MARK)];
    let diamond = [(0, -MARK - 2), (MARK + 2, 0), (0, MARK + 2), (-MARK - 2, 0)];
    let polygon = |corners: &[Pixel], open: bool| -> DrawResult {
        let mut corners: Vec<Pixel> = corners.iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
        let fill = if open { rgb(LIGHT.paper) } else { style.color };
        area.draw(&Polygon::new(corners.clone(), fill.filled()))?;
        corners.extend(corners.first().copied());
        area.draw(&PathElement::new(corners, style.color.stroke_width(if open { 2 } else { 1 })))
    };
    match style.marker {
        Marker::Disc => area.draw(&Circle::new((x, y), MARK, style.color.filled())),
        Marker::Square => polygon(&square, false),
        Marker::OpenSquare => polygon(&square, true),
        Marker::Triangle => polygon(&triangle, false),
        Marker::OpenTriangle => polygon(&triangle, true),
        Marker::Diamond => polygon(&diamond, false),
        Marker::OpenDiamond => polygon(&diamond, true),
        Marker::Printed => {
            let stroke = style.color.stroke_width(2);
            area.draw(&Circle::new((x, y), MARK + 3, stroke))?;
            area.draw(&PathElement::new([(x - MARK, y - MARK), (x + MARK, y + MARK)], stroke))?;
            area.draw(&PathElement::new([(x - MARK, y + MARK), (x + MARK, y - MARK)], stroke))
        }
    }
}

/// Converts a number of labels or letters to pixel arithmetic; a drawing has far fewer than the maximum.
fn signed(count: usize) -> i32 {
    const MOST: i32 = 100_000;
    i32::try_from(count).unwrap_or(MOST).min(MOST)
}

/// Places labels near the heights at which their lines end, in the same order: at least a pitch apart, between `top`
/// and `bottom` if there is room for all, otherwise downward from `top`.
fn spread(wanted: &[i32], [top, bottom]: [i32; 2]) -> Vec<i32> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by_key(|&n| (wanted[n], n));
    // Labels that touch move together: a group is centered on the mean of its labels' targets.
    let mut groups: Vec<Group> = Vec::new();
    for &n in &order {
        let mut group = Group { labels: vec![n], first: clamped(wanted[n], 1, [top, bottom]) };
        while let Some(above) = groups.pop_if(|above| above.end() > group.first) {
            group = above.joined(group, wanted, [top, bottom]);
        }
        groups.push(group);
    }
    let mut places = vec![0; wanted.len()];
    for group in groups {
        for (n, place) in group.labels.iter().zip((0..).map(|k| group.first + k * PITCH)) {
            places[*n] = place;
        }
    }
    places
}

struct Group {
    labels: Vec<usize>,
    first: i32,
}

impl Group {
    fn end(&self) -> i32 {
        self.first + signed(self.labels.len()) * PITCH
    }

    fn joined(mut self, below: Self, wanted: &[i32], room: [i32; 2]) -> Self {
        self.labels.extend(below.labels);
        let firsts = self.labels.iter().zip(0..).map(|(n, k)| i64::from(wanted[*n]) - i64::from(k * PITCH));
        let mean = firsts.sum::<i64>().div_euclid(i64::from(signed(self.labels.len())));
        self.first = clamped(mean as i32, self.labels.len(), room);
        self
    }
}

/// Position of a group's first label, clamped so that the group fits.
fn clamped(first: i32, labels: usize, [top, bottom]: [i32; 2]) -> i32 {
    first.min(bottom - (signed(labels) - 1) * PITCH).max(top)
}
