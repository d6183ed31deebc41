//! Style sheet of a page: colors from the palette, and everything else from `page.css`.

use super::super::palette::{Color, DARK, LIGHT, Theme};

/// Accent colors of links and outcomes. Good, neutral and bad outcomes are blue, grey and orange of Okabe and Ito
/// (2008), adjusted for contrast with each page. All accents can be told apart with any color vision.
type Accents = [(&'static str, Color); 7];

const ON_LIGHT: Accents = [
    ("link", [0x00, 0x5a, 0x8f]),
    ("good", [0x00, 0x72, 0xb2]),
    ("fair", [0x06, 0x4c, 0x29]),
    ("neutral", [0x85, 0x8b, 0x93]),
    ("excused", [0x51, 0x4d, 0x00]),
    ("odd", [0xbf, 0x0d, 0xfa]),
    ("bad", [0xd5, 0x5e, 0x00]),
];
const ON_DARK: Accents = [
    ("link", [0x7c, 0xc0, 0xee]),
    ("good", [0x4b, 0xa3, 0xdb]),
    ("fair", [0xb4, 0xfb, 0xab]),
    ("neutral", [0x85, 0x8b, 0x93]),
    ("excused", [0xf6, 0xf3, 0x11]),
    ("odd", [0xcc, 0x0e, 0xff]),
    ("bad", [0xf0, 0x7b, 0x1f]),
];

/// Returns the style sheet, which follows the reader's choice of a light or dark page.
pub(crate) fn sheet() -> String {
    format!(
        "\n:root {{ color-scheme: light dark; {} }}\n@media (prefers-color-scheme: dark) {{ :root {{ {} }} }}\n{}",
        variables(&LIGHT, ON_LIGHT),
        variables(&DARK, ON_DARK),
        include_str!("page.css"),
    )
}

fn variables(theme: &Theme, accents: Accents) -> String {
    let Theme { paper, ink, quiet, rule, soft } = *theme;
    let all = [("paper", paper), ("ink", ink), ("quiet", quiet), ("rule", rule), ("soft", soft)].into_iter();
    let variable = |(name, [r, g, b]): (&str, Color)| format!("--{name}: #{r:02x}{g:02x}{b:02x};");
    all.chain(accents).map(variable).collect::<Vec<_>>().join(" ")
}
