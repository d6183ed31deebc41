//! Charts as SVG: axes, labels, and styles of series.

use crossbar_studies::report::{Chart, Scale, Series};
use proptest::prelude::*;

use super::between;
use super::colors::{Color, color, contrast, least_distance};

/// Number of series with different styles: 6 colors, 5 dashes and 7 markers.
const MAX_SERIES: usize = 6 * 5 * 7;
/// Distance of the centers of neighboring labels, in pixels.
const PITCH: f64 = 19.0;

fn series(label: &str, points: Vec<(f64, f64)>) -> Series {
    Series { label: label.to_owned(), points }
}

fn chart(points: Vec<(f64, f64)>) -> Chart {
    let (title, [x, y]) = ("title".to_owned(), ["x", "y"].map(str::to_owned));
    Chart { title, x, y, lines: vec![series("a <line>", points)], ..Chart::default() }
}

/// A chart of unconnected points in categories 1, 2, ... with names.
fn dots(scale: Scale, values: &[f64]) -> Chart {
    let points = (1..).map(f64::from).zip(values.iter().copied()).collect();
    let ticks = values.iter().map(|_| "name".to_owned()).collect();
    Chart { y_scale: scale, ticks, lines: Vec::new(), dots: vec![series("dots", points)], ..chart(Vec::new()) }
}

/// The numbers on the axes of a drawing.
fn numbers(svg: &str) -> Vec<&str> {
    between(svg, "\">\n", "\n</text>").filter(|text| text.parse::<f64>().is_ok()).collect()
}

fn ticks(scale: Scale, values: &[f64]) -> Vec<String> {
    let svg = dots(scale, values).svg().expect("an axis");
    numbers(&svg).into_iter().map(str::to_owned).collect()
}

/// Column and row of each disc except the first, which is next to the label.
fn discs(svg: &str) -> Vec<[f64; 2]> {
    let number = |tag: &str, name: &str| -> f64 {
        between(tag, &format!("{name}=\""), "\"").next().expect("a place").parse().expect("a number")
    };
    between(svg, "<circle ", ">").map(|tag| ["cx", "cy"].map(|name| number(tag, name))).skip(1).collect()
}

#[test]
fn a_chart_is_one_svg_with_its_words_escaped() {
    let svg = chart(vec![(0.0, 0.0), (1.0, 2.0)]).svg().expect("two points");
    assert!(svg.starts_with("<svg role=\"img\"") && svg.trim_end().ends_with("</svg>"));
    assert!(svg.contains("a &lt;line&gt;") && svg.contains("polyline") && svg.contains("<title>title</title>"));
}

#[test]
fn points_and_names_are_drawn() {
    let ticks = ["an office", "teapot, Monte Carlo", "a very long name of a room"].map(str::to_owned).into();
    let dots = vec![series("ours", vec![(1.0, 2.0), (2.0, 3.0)])];
    let printed = vec![series("printed", vec![(1.0, 2.5), (2.0, 1.0)])];
    let chart = Chart { dots, printed, ticks, ..chart(Vec::new()) };
    let svg = chart.svg().expect("four points");
    // Names that would overlap their neighbors break in the middle.
    for text in ["an office", "teapot, Monte Carlo", "a very long", "name of a room", "ours", "printed"] {
        assert_eq!(svg.matches(&format!("\n{text}\n")).count(), 1, "{text}");
    }
    // A ring for each of two printed points, and one next to the label.
    assert_eq!(svg.matches("<circle").count(), 3, "{svg}");
}

#[test]
fn what_cannot_be_told_apart_or_spans_no_axis_is_refused() {
    let lines = (0..=MAX_SERIES).map(|_| series("", vec![(1.0, 1.0)])).collect();
    let (linear, logarithmic) = (Scale::Linear, Scale::Logarithmic);
    for chart in [
        Chart { lines, ..chart(Vec::new()) },
        chart(Vec::new()),
        chart(vec![(f64::NAN, 1.0)]),
        dots(linear, &[0.0]),
        dots(logarithmic, &[]),
        dots(logarithmic, &[-1.0]),
        dots(linear, &[f64::MAX, f64::MIN]),
    ] {
        let refused = chart.svg().expect_err("nothing to draw").to_string();
        assert!(refused.starts_with("the SVG file cannot be encoded: "), "{refused}");
    }
}

#[test]
fn ticks_are_round_numbers() {
    assert_eq!(ticks(Scale::Linear, &[0.0, 50.0]), ["0", "10", "20", "30", "40", "50"]);
    assert_eq!(ticks(Scale::Linear, &[-0.1, 0.3]), ["-0.1", "0", "0.1", "0.2", "0.3"]);
    assert_eq!(ticks(Scale::Logarithmic, &[1.0, 213.0]), ["1", "2", "5", "10", "20", "50", "100", "200"]);
    assert_eq!(ticks(Scale::Logarithmic, &[1e-9, 1.0]), ["1e-8", "1e-6", "1e-4", "0.01", "1"]);
}

#[test]
fn there_are_two_ticks_at_least_and_few_at_most() {
    for most in [0.001, 0.7, 1.0, 3.0, 9.5, 42.0, 1e5, 7e8] {
        for low in [0.9, 0.3, 1e-3, 1e-12] {
            let ticks = ticks(Scale::Logarithmic, &[low * most, most]);
            assert!((2..=24).contains(&ticks.len()), "{low} {most}: {ticks:?}");
        }
        let ticks = ticks(Scale::Linear, &[0.0, most]);
        assert!((2..=9).contains(&ticks.len()), "{most}: {ticks:?}");
    }
}

/// A linear horizontal axis omits 0 if all values are far from 0.
#[test]
fn values_far_from_0_fill_the_axis() {
    let points = |values: &[f64]| -> Chart {
        let points = values.iter().map(|x| (*x, 1.0)).collect();
        Chart { lines: Vec::new(), dots: vec![series("dots", points)], ..chart(Vec::new()) }
    };
    let columns = |values: &[f64]| -> Vec<f64> {
        let svg = points(values).svg().expect("an axis");
        discs(&svg).iter().map(|[x, _]| *x).collect()
    };
    let [start, end] = columns(&[0.0, 512.0])[..] else { panic!("two discs") };
    let far = columns(&[60.0, 70.0]);
    assert!(far[0] - start < 0.1 * (end - start) && far[1] - start > 0.9 * (end - start), "{far:?} {start} {end}");
    let near = columns(&[64.0, 512.0]);
    assert!((near[0] - start - (end - start) / 8.0).abs() <= 1.0 && near[1] == end, "{near:?} {start} {end}");
    assert_eq!(columns(&[3.0]).len(), 1);
}

#[test]
fn values_lie_within_the_axis() {
    let svg = dots(Scale::Linear, &[-20.0, 40.0]).svg().expect("an axis");
    let rows: Vec<f64> = discs(&svg).iter().map(|[_, y]| *y).collect();
    assert!(rows[0] < 346.0 && rows[1] > 44.0, "{rows:?}");
    // The smallest of three counts of iterations is distinguishable from the axis.
    let svg = dots(Scale::Logarithmic, &[1.0, 8.0, 13.0, 213.0]).svg().expect("an axis");
    let rows: Vec<f64> = discs(&svg).iter().map(|[_, y]| *y).collect();
    let share = |at: usize| (rows[0] - rows[at]) / (rows[0] - rows[3]);
    assert!(share(1) > 0.3 && share(2) - share(1) > 0.06, "{rows:?}");
}

#[test]
fn a_large_factor_asks_for_powers_of_ten() {
    assert_eq!(Scale::fitting([8.0, 13.0, 23.0]), Scale::Linear);
    assert_eq!(Scale::fitting([8.0, 13.0, 213.0]), Scale::Logarithmic);
    assert_eq!(Scale::fitting([]), Scale::Linear);
}

/// Row of each label, in the order of the series.
fn heights(svg: &str, labels: &[String]) -> Vec<f64> {
    let place = |label: &String| {
        let tag = svg.split("<text ").find(|tag| tag.contains(&format!(">\n{label}\n"))).expect("a label");
        between(tag, "y=\"", "\"").next().expect("a row").parse().expect("a number")
    };
    labels.iter().map(place).collect()
}

/// Lines that end at the given values, with their labels.
fn lines_to(ends: &[f64]) -> (Chart, Vec<String>) {
    let labels: Vec<String> = (0..ends.len()).map(|n| format!("line {n:03}")).collect();
    let lines = labels.iter().zip(ends).map(|(label, &end)| series(label, vec![(0.0, 0.0), (1.0, end)])).collect();
    (Chart { lines, ..chart(Vec::new()) }, labels)
}

/// Row in which each line ends, where the thin line to its label begins.
fn end_rows(svg: &str) -> Vec<f64> {
    let row = |tag: &str| {
        let points = between(tag, "points=\"", " ").next().expect("points");
        points.split_once(',').expect("a place").1.parse().expect("a number")
    };
    between(svg, "opacity=\"0.45\"", "/>").map(row).collect()
}

#[test]
fn labels_with_room_stand_where_their_lines_end() {
    let (chart, labels) = lines_to(&[3.0, 1.0, 2.0]);
    let svg = chart.svg().expect("lines");
    assert_eq!(end_rows(&svg), heights(&svg, &labels));
    // Lines that end at the same point share the space above and below it.
    let (chart, labels) = lines_to(&[1.0, 1.0, 2.0]);
    let svg = chart.svg().expect("lines");
    let (end, together) = (end_rows(&svg)[0], heights(&svg, &labels));
    assert_eq!((together[0] - end, together[1] - end), (-10.0, 9.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn labels_never_overlap(ends in prop::collection::vec(1..500_u16, 1..40)) {
        let (chart, labels) = lines_to(&ends.iter().copied().map(f64::from).collect::<Vec<_>>());
        let svg = chart.svg().expect("lines");
        let mut heights = heights(&svg, &labels);
        // In order of the rows in which their lines end.
        let rows = end_rows(&svg);
        for (a, x) in rows.iter().zip(&heights) {
            for (b, y) in rows.iter().zip(&heights) {
                prop_assert!(x <= y || a >= b, "{} {} {} {}", a, b, x, y);
            }
        }
        heights.sort_by(f64::total_cmp);
        prop_assert!(heights.windows(2).all(|two| two[1] - two[0] >= PITCH), "{:?}", heights);
        let rows: f64 = between(&svg, "height=\"", "\"").next().expect("a size").parse().expect("a number");
        prop_assert!(heights.iter().all(|height| (44.0..rows - 54.0).contains(height)), "{:?}", heights);
    }
}

/// Each color of the drawing, with the color that replaces it on a dark page.
fn dark_forms(svg: &str) -> Vec<(Color, Color)> {
    let rules = between(svg, "[stroke=\"", "}").map(|rule| {
        let (light, dark) = rule.split_once("\"]{stroke:").expect("a rule");
        (color(light), color(dark))
    });
    rules.collect()
}

#[test]
fn lines_stand_out_from_both_pages() {
    let (chart, _) = lines_to(&[1.0; MAX_SERIES]);
    let svg = chart.svg().expect("lines");
    // Paper, ink, quiet text and rules, then the colors of lines.
    let forms = dark_forms(&svg);
    let ((paper, dark_paper), lines) = (forms[0], &forms[4..]);
    assert_eq!(lines.len(), 6);
    for (line, on_dark) in lines {
        assert!(contrast(*line, paper) >= 3.0 && contrast(*on_dark, dark_paper) >= 3.0, "{line:?}");
        let [r, g, b] = line;
        assert!(svg.contains(&format!("[fill=\"#{r:02X}{g:02X}{b:02X}\"]{{fill:")), "markers have it too");
    }
    let (light, on_dark): (Vec<Color>, Vec<Color>) = lines.iter().copied().unzip();
    for colors in [light, on_dark] {
        assert!(least_distance(&colors) > 10.0, "{}", least_distance(&colors));
    }
}
