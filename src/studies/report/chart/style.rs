//! Styles of series: each has its own combination of color, dash and marker, on a light page and on a dark one.
//!
//! The colors are those of Okabe and Ito (2008), which readers with red-green color blindness can distinguish; on a
//! light page, sky blue and reddish purple are darkened for contrast, and orange to brown. Yellow is omitted, and black
//! is reserved for the papers' points.

use plotters::style::RGBColor;

use super::super::palette::{Color, DARK, LIGHT, Theme};

/// Colors of lines on a light page, and on a dark one.
const COLORS: [(Color, Color); 6] = [
    // Blue.
    ([0x00, 0x72, 0xb2], [0x4b, 0xa3, 0xdb]),
    // Vermilion.
    ([0xd5, 0x5e, 0x00], [0xf0, 0x7b, 0x1f]),
    // Bluish green.
    ([0x00, 0x8f, 0x68], [0x1f, 0xc3, 0x97]),
    // Reddish purple.
    ([0xb3, 0x55, 0x8a], [0xdd, 0x93, 0xbc]),
    // Orange; brown on paper.
    ([0x7a, 0x56, 0x00], [0xe6, 0xb0, 0x20]),
    // Sky blue.
    ([0x42, 0x98, 0xd0], [0x8c, 0xcd, 0xf2]),
];
/// Lengths of dashes and of the gaps between them, in pixels; `None` for a solid line.
const DASHES: [Option<(i32, i32)>; 5] = [None, Some((9, 5)), Some((2, 4)), Some((18, 6)), Some((5, 11))];
const MARKERS: [Marker; 7] = [
    Marker::Disc,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::OpenSquare,
    Marker::OpenTriangle,
    Marker::OpenDiamond,
];

/// Maximum number of distinguishable series: the lengths of the lists are pairwise coprime.
pub(super) const MAX_SERIES: usize = COLORS.len() * DASHES.len() * MARKERS.len();

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    OpenSquare,
    OpenTriangle,
    OpenDiamond,
    /// Cross in a ring: printed values of a paper.
    Printed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SeriesStyle {
    pub(super) color: RGBColor,
    pub(super) dash: Option<(i32, i32)>,
    pub(super) marker: Marker,
}

impl SeriesStyle {
    pub(super) const PRINTED: Self = Self { color: rgb(LIGHT.ink), dash: None, marker: Marker::Printed };

    pub(super) fn nth(n: usize) -> Self {
        let (light, _) = COLORS[n % COLORS.len()];
        Self { color: rgb(light), dash: DASHES[n % DASHES.len()], marker: MARKERS[n % MARKERS.len()] }
    }
}

pub(super) const fn rgb([r, g, b]: Color) -> RGBColor {
    RGBColor(r, g, b)
}

/// CSS rules for the colors of a dark page. Colors are attributes, so that a viewer without style sheets shows the
/// light colors.
pub(super) fn dark_rules() -> String {
    let of = |theme: &Theme| [theme.paper, theme.ink, theme.quiet, theme.rule];
    let pairs = of(&LIGHT).into_iter().zip(of(&DARK)).chain(COLORS);
    let rule = |(light, dark): (Color, Color)| {
        let (light, dark) = (hex(light).to_uppercase(), hex(dark));
        format!("[fill=\"{light}\"]{{fill:{dark}}}[stroke=\"{light}\"]{{stroke:{dark}}}")
    };
    format!("@media (prefers-color-scheme:dark){{{}}}", pairs.map(rule).collect::<String>())
}

fn hex([r, g, b]: Color) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
