//! Pictures of the page, in SVG: measured colors above the colors of each answer, with the difference in codes.

use super::rule::Measured;
use super::values::{Value, Values};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// Number of values that a strip shows.
const SHOWN: usize = 96;
/// Sizes in pixels: the labels, the strips, a strip of colors, the bars below it, an answer with the space below it.
const LEFT: usize = 380;
const WIDTH: usize = 564;
const COLORS: usize = 18;
const BARS: usize = 17;
const ROW: usize = 44;
/// Maximum height of a bar, and its height per code of difference.
const LONGEST: usize = 8;
const PER_CODE: usize = 3;

/// The drawn code is above the measured one, below it, or different in a way that the strip does not show.
const ABOVE: &str = "#d55e00";
const BELOW: &str = "#0072b2";
const ELSEWHERE: &str = "#000000";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/pictures/measured")
}

/// File name of a rule's picture, made of the first words of the rule's name.
fn file(measured: &Measured) -> String {
    let words = measured.rule.name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<String> = words.take(6).map(str::to_lowercase).collect();
    format!("{}.svg", words.join("-"))
}

/// The section of the page with all pictures.
pub(crate) fn section(all: &[Measured]) -> String {
    let files: BTreeSet<String> = all.iter().map(file).collect();
    assert_eq!(files.len(), all.len(), "a file for each rule");
    let picture = |measured: &Measured| format!("![{}](pictures/measured/{})\n", measured.rule.name, file(measured));
    all.iter().map(picture).collect::<Vec<_>>().join("\n")
}

/// Writes all pictures, or compares the existing files; the folder contains no other files.
pub(crate) fn hold(all: &[Measured], write: bool) {
    if write {
        fs::create_dir_all(folder()).expect("a folder");
    }
    let there = fs::read_dir(folder()).expect("the folder").map(|entry| entry.expect("a file").path());
    let expected: BTreeSet<PathBuf> = all.iter().map(|measured| folder().join(file(measured))).collect();
    for stale in there.filter(|path| !expected.contains(path)) {
        assert!(write, "{} belongs to no rule", stale.display());
        fs::remove_file(stale).expect("removed");
    }
    for measured in all {
        let (path, picture) = (folder().join(file(measured)), picture(measured));
        match write {
            true => fs::write(&path, picture).expect("written"),
            false => {
                let stored = fs::read_to_string(&path).unwrap_or_default().replace('\r', "");
                assert!(stored == picture, "{}: the picture of the rule", path.display());
            }
        }
    }
}

fn picture(measured: &Measured) -> String {
    let shown = shown(&measured.values);
    let all = measured.values[0].1.all();
    let (title, own) = (measured.rule.name, measured.own().0);
    let height = 30 + (measured.values.len() + 1) * ROW + 20;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"960\" height=\"{height}\" \
         viewBox=\"-8 0 960 {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect x=\"-8\" width=\"960\" height=\"{height}\" fill=\"#ffffff\"/>\n\
         <text y=\"18\" font-size=\"15\" font-weight=\"bold\">{title}</text>\n"
    );
    let measured_colors: Vec<_> = shown.iter().map(|&i| color(measured.values[0].1.0[i].measured)).collect();
    row(&mut out, 30, &format!("measured ({} of {all} values)", shown.len()), &measured_colors);
    for (number, (name, values)) in measured.values.iter().enumerate() {
        let top = 30 + (number + 1) * ROW;
        let own = if name == own { " (the cards' answer)" } else { "" };
        let drawn: Vec<_> = shown.iter().map(|&i| color(values.0[i].drawn)).collect();
        row(&mut out, top, &format!("{name}{own}: {} of {all}", values.right()), &drawn);
        let bars: Vec<_> = shown.iter().map(|&i| bar(values.0[i])).collect();
        strip(&mut out, top + COLORS + 1, BARS, &bars);
    }
    let y = height - 10;
    let _ = writeln!(
        out,
        "<text y=\"{y}\">right values are counted; wrong ones: <tspan \
         fill=\"{ABOVE}\">drawn above the measured code</tspan>, <tspan fill=\"{BELOW}\">below</tspan>, black: not \
         visible in grey</text>\n</svg>"
    );
    out
}

fn row(out: &mut String, top: usize, label: &str, colors: &[String]) {
    let _ = writeln!(out, "<text y=\"{}\">{label}</text>", top + 13);
    strip(out, top, COLORS, &colors.iter().map(|color| Some((color.as_str(), 0, COLORS))).collect::<Vec<_>>());
}

/// Draws a column per value, filled with a color from a row downward; equal neighbors form one rectangle.
fn strip(out: &mut String, top: usize, height: usize, columns: &[Option<(&str, usize, usize)>]) {
    let count = columns.len();
    let _ = writeln!(
        out,
        "<svg x=\"{LEFT}\" y=\"{top}\" width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 0 {count} {height}\" \
         preserveAspectRatio=\"none\" shape-rendering=\"crispEdges\"><rect width=\"{count}\" height=\"{height}\" \
         fill=\"#e8e8e8\"/>"
    );
    let mut x = 0;
    for run in columns.chunk_by(PartialEq::eq) {
        if let Some((color, y, rows)) = run[0] {
            let wide = run.len();
            let _ = writeln!(out, "<path fill=\"{color}\" d=\"M{x} {y}h{wide}v{rows}h-{wide}z\"/>");
        }
        x += run.len();
    }
    out.push_str("</svg>\n");
}

fn color([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Indices of the shown values. Values for which the same answers are right form a group; all groups show the same
/// number of values, evenly spaced.
fn shown(hypotheses: &[(String, Values)]) -> Vec<usize> {
    let mut alike: BTreeMap<Vec<bool>, Vec<usize>> = BTreeMap::new();
    for i in 0..hypotheses[0].1.all() {
        alike.entry(hypotheses.iter().map(|(_, values)| values.0[i].right).collect()).or_default().push(i);
    }
    let mut groups: Vec<Vec<usize>> = alike.into_values().collect();
    groups.sort_by_key(Vec::len);
    let mut chosen = Vec::new();
    for (number, group) in groups.iter().enumerate() {
        // Columns that a small group does not use go to the larger ones.
        let count = group.len().min((SHOWN - chosen.len()) / (groups.len() - number));
        chosen.extend((0..count).map(|i| group[i * group.len() / count]));
    }
    chosen.sort_unstable();
    chosen
}

/// The bar of a wrong value, for the component with the largest difference: color, first row and number of rows. It
/// points upward if the drawn code is larger.
fn bar(value: Value) -> Option<(&'static str, usize, usize)> {
    let off = |i: usize| isize::from(value.drawn[i]) - isize::from(value.measured[i]);
    let most = [0, 1, 2].map(off).into_iter().max_by_key(|off| off.unsigned_abs())?;
    let length = LONGEST.min(PER_CODE * most.unsigned_abs());
    let bar = match most {
        0 => (ELSEWHERE, LONGEST - 1, 2),
        1.. => (ABOVE, LONGEST - length, length),
        _ => (BELOW, LONGEST, length),
    };
    (!value.right).then_some(bar)
}
