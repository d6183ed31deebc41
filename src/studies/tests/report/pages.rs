//! The script, the overview and the style of a page.

use std::collections::BTreeMap;

use crossbar_studies::report::{Findings, SummaryLine, TallyEntry, Tone};

use super::colors::{Color, color, contrast, least_distance};
use super::{between, page};

/// The script loads nothing, does not end its own element, and is the only script.
#[test]
fn the_script_stands_alone() {
    let page = page(Findings::new("t"));
    assert_eq!(page.matches("<script").count(), 1);
    assert_eq!(page.matches("</script>").count(), 1);
    let script = between(&page, "<script>", "</script>").next().expect("a script");
    assert!(!script.is_empty());
    for word in ["http", "fetch", "import", "XMLHttp", "eval", "innerHTML", "</", "<!--"] {
        assert!(!script.contains(word), "{word}");
    }
}

#[test]
fn a_line_links_to_its_heading() {
    let counted = |count, what: &str| TallyEntry { count, what: what.to_owned(), tone: Tone::Good };
    let line = |heading: &str| SummaryLine {
        title: "One".to_owned(),
        heading: heading.to_owned(),
        tally: vec![counted(3, "held"), counted(0, "missed")],
        text: "A sentence.".to_owned(),
    };
    let mut found = Findings::new("t");
    found.counted_heading("Section <1>", vec![counted(3, "held")]);
    found.summary_lines(vec![line("Section <1>"), line("none")]);
    let html = page(found);
    let lines = between(&html, "<ul class=\"lines\">", "</section>").next().expect("lines");
    assert_eq!(lines.matches("<a href=\"#section-0\">One</a>").count(), 1, "{html}");
    assert!(lines.contains("<b>3</b> held") && !lines.contains("missed"), "{html}");
    let contents = between(&html, "<nav", "</nav>").next().expect("contents");
    assert!(
        contents.contains("Section &lt;1&gt;</a><ul class=\"tally\"><li class=\"good\"><b>3</b> held"),
        "{contents}"
    );
}

/// The style sheet without its variables, and the variables of the light page and of the dark page.
fn sheet() -> (String, [BTreeMap<String, Color>; 2]) {
    let page = page(Findings::new("t"));
    let sheet = between(&page, "<style>", "</style>").next().expect("a style sheet");
    let (head, rest) = sheet.split_once("@media (prefers-color-scheme: dark)").expect("a dark page");
    let (dark, css) = rest.split_once("} }").expect("its end");
    let variables = |text: &str| {
        let pairs = between(text, "--", ";").filter_map(|pair| pair.split_once(": "));
        pairs.map(|(name, value)| (name.to_owned(), color(value))).collect()
    };
    (css.to_owned(), [variables(head), variables(dark)])
}

/// Text needs a contrast of 4.5 to 1 (WCAG 2, AA), other marks 3 to 1.
#[test]
fn text_and_accents_stand_out_from_both_pages() {
    for colors in sheet().1 {
        for text in ["ink", "quiet"] {
            for ground in ["paper", "soft"] {
                assert!(contrast(colors[text], colors[ground]) >= 4.5, "{text} on {ground}");
            }
        }
        assert!(contrast(colors["link"], colors["paper"]) >= 4.5, "links are text");
        let accents = ["good", "fair", "neutral", "excused", "odd", "bad"].map(|name| colors[name]);
        assert!(accents.iter().all(|accent| contrast(*accent, colors["paper"]) >= 3.0), "{accents:?}");
        assert!(least_distance(&accents) > 20.0, "{accents:?}");
    }
}

/// Every color of the sheet is a variable, so a dark page uses no color of a light page.
#[test]
fn the_sheet_has_no_color_of_its_own() {
    let (css, themes) = sheet();
    assert!(!css.contains('#') && !css.contains("rgb("));
    // A picture sets its own width.
    for name in between(&css, "var(--", ")").filter(|name| !["shown", "zoomed"].contains(name)) {
        assert!(themes.iter().all(|theme| theme.contains_key(name)), "{name}");
    }
}
