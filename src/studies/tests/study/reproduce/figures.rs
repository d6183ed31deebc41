//! Printed figures: the files of the papers, their format, and statements that cannot be changed silently.

use std::collections::BTreeSet;

use crossbar_studies::study::reproduce::tested::parse_figures;
use crossbar_studies::study::reproduce::{Bound, ENTRIES, Judgement, Origin, Paper, PaperFigure, figures, printed};

#[test]
fn every_figure_has_a_name_of_its_own_and_a_bound_or_a_reason() {
    let figures = figures().expect("the files");
    let names: BTreeSet<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
    assert_eq!(names.len(), figures.len());
    for figure in figures {
        assert!(figure.value.is_finite() && !figure.what.is_empty() && !figure.place.is_empty(), "{}", figure.id);
        assert!(!matches!(&figure.judgement, Judgement::Not(reason) if reason.is_empty()), "{}", figure.id);
    }
}

/// No figure of a paper is listed twice: a second row with the same value, unit and words is the same figure.
#[test]
fn each_printed_figure_stands_once() {
    let mut seen = BTreeSet::new();
    for figure in figures().expect("the files") {
        let key = (figure.paper.id(), figure.value.to_bits(), &figure.unit, &figure.what, &figure.place);
        assert!(seen.insert(key), "{} stands twice", figure.id);
    }
}

/// Every expression belongs to an entry of its paper.
#[test]
fn every_equation_has_its_entry() {
    let figures = figures().expect("the files");
    let equations = figures.iter().filter_map(|figure| Some((figure, figure.equation.as_ref()?)));
    for (figure, equation) in equations {
        let entry = ENTRIES.iter().find(|entry| entry.id == equation.entry);
        assert_eq!(entry.map(|entry| entry.paper), Some(figure.paper), "{}: {}", figure.id, equation.entry);
    }
}

#[test]
fn an_unknown_name_is_an_error() {
    let error = printed("ray-engine/host-alon").expect_err("a typo").to_string();
    assert!(error.contains("no figure is named `ray-engine/host-alon`"), "{error}");
}

/// A file with one group of figures; its digest is computed from `stated`.
fn file(figures: &str, stated: &str) -> String {
    let text = |figures: &str, digest: &str| {
        format!(
            "stated = [{{ date = \"2026-11-26\", digest = \"{digest}\" }}]\n[[group]]\nplace = \"table 1\"\n\
             unit = \"Hz\"\nbound = \"15 %\"\nfigures = [{figures}]"
        )
    };
    // Without a digest, the error states the correct one.
    let error = parse_figures(Paper::Cpca, &text(stated, "")).expect_err("another digest");
    let digest = error.split_once("the file now has ").map_or("", |(_, digest)| &digest[..16]);
    text(figures, digest)
}

fn parsed(figures: &str) -> Result<Vec<PaperFigure>, String> {
    parse_figures(Paper::Cpca, &file(figures, figures))
}

#[test]
fn values_have_the_digits_of_the_print() {
    let found = parsed(
        r#"{ id = "a", what = "a", value = "0.0540" }, { id = "b", what = "b", value = "2", bound = "at least" },
           { id = "c", what = "c", ratio = ["a", "b"], unit = "", bound = "order" },
           { id = "d", what = "d", value = "3", bound = "15 % of the gain over b" },
           { id = "e", what = "e", value = "3", unjudged = "printed as b again" }"#,
    );
    let found = found.expect("five figures");
    assert_eq!((found[0].value, found[0].decimals, found[0].judgement.clone()), (0.054, 4, within(0.15)));
    assert_eq!((found[1].decimals, found[1].judgement.clone()), (0, Judgement::Within(Bound::AtLeast)));
    assert_eq!((found[2].value, found[2].decimals), (0.027, 2));
    assert_eq!(found[2].origin, Origin::Implied("0.054 / 2".to_owned()));
    assert_eq!(found[3].judgement, Judgement::Within(Bound::Gain { share: 0.15, over: 2.0 }));
    assert_eq!(found[4].judgement, Judgement::Not("printed as b again".to_owned()));
}

fn within(share: f64) -> Judgement {
    Judgement::Within(Bound::Relative(share))
}

/// An expression may use figures below it, and names the entry to which its row belongs.
#[test]
fn expressions_are_of_printed_values() {
    let found = parsed(
        r#"{ id = "a", what = "a", value = "3", expression = "100 * b-1 / 8", readings = ["b-1"], entry = "e", uses = "b" },
           { id = "b-1", what = "b", value = "0.25" }"#,
    );
    let found = found.expect("two figures");
    let equation = found[0].equation.as_ref().expect("an expression");
    assert_eq!((equation.ours, equation.readings.as_slice(), equation.device.as_str()), (3.125, &[0.25][..], "host"));
    assert_eq!((&equation.uses, &equation.chose), (&Some("b".to_owned()), &None));
    assert_eq!(found[1].equation, None);
}

#[test]
fn malformed_figures_are_refused() {
    for (entry, reason) in [
        (r#"{ id = "a", what = "a" }"#, "expected one of `value` and `ratio`"),
        (r#"{ id = "a", what = "a", value = "1,5" }"#, "expected a number, found `1,5`"),
        (r#"{ id = "a", what = "a", ratio = ["b", "c"] }"#, "no figure above it is named `b`"),
        (r#"{ id = "a", what = "a", value = "1", bound = "about" }"#, "expected a bound, found `about`"),
        (r#"{ id = "a", what = "a", value = "1", bond = "15 %" }"#, "unknown"),
        (r#"{ id = "a", what = "a", value = "1", expression = "2 *", entry = "e" }"#, "at the end"),
        (r#"{ id = "a", what = "a", value = "1", expression = "b", entry = "e" }"#, "no figure is named `b`"),
        (r#"{ id = "a", what = "a", value = "1", expression = "1" }"#, "needs the `entry`"),
    ] {
        let error = parsed(entry).expect_err("malformed");
        assert!(error.contains(reason), "{error}");
    }
}

/// The current form `now` of a figure that was stated with the value 5 and a bound of 15 %.
fn restated(now: &str) -> Result<Vec<PaperFigure>, String> {
    let figure = |terms: &str| format!("{{ id = \"a\", what = \"a\", {terms} }}");
    parse_figures(Paper::Cpca, &file(&figure(now), &figure(r#"value = "5", bound = "15 %""#)))
}

/// A wider bound, another value, or a reading added later is rejected.
#[test]
fn silent_changes_are_refused() {
    for changed in [
        r#"value = "5", bound = "20 %""#,
        r#"value = "6", bound = "15 %""#,
        r#"value = "5", unjudged = "too hard""#,
        r#"value = "5", bound = "15 %", reading = "late""#,
    ] {
        let error = restated(changed).expect_err("a silent change");
        assert!(error.contains("List what it was before"), "{error}");
    }
}

#[test]
fn listed_changes_pass() {
    let before = r#"date = "2026-12-01", bound = "15 %", why = "the text says about""#;
    let listed = format!(r#"value = "5", bound = "20 %", changed = [{{ {before} }}]"#);
    assert!(restated(&listed).is_ok());
    let since = r#"date = "2026-12-02", reading = "", why = "the text allows two""#;
    let read = format!(r#"value = "5", bound = "15 %", reading = "late; early", changed = [{{ {since} }}]"#);
    assert!(restated(&read).is_ok(), "it had no reading");
    let without = listed.replace("the text says about", "");
    assert!(restated(&without).is_err(), "a change needs a reason");
}

fn value(text: &str) -> Result<f64, String> {
    let figure = format!(r#"{{ id = "a", what = "a", value = "1", expression = "{text}", entry = "e" }}"#);
    let found = parsed(&format!(r#"{figure}, {{ id = "a-b", what = "b", value = "8" }}"#))?;
    Ok(found[0].equation.as_ref().expect("an expression").ours)
}

#[test]
fn operators_have_their_ranks() {
    for (text, expected) in [
        ("2 + 3 * 4", 14.0),
        ("(2 + 3) * 4", 20.0),
        ("a-b / 2 / 2 - 1e-1", 1.9),
        ("100 * ((a-b - 2) / (1 + 2))", 200.0),
    ] {
        assert_eq!(value(text), Ok(expected), "{text}");
    }
}

#[test]
fn other_texts_are_refused() {
    for (text, reason) in [
        ("", "at the end"),
        ("1 +", "at the end"),
        ("(1", "expected `)`"),
        ("1 2", "found `2`"),
        ("1x", "found `1x`"),
        ("2*3", "found `2*3`"),
        ("* 2", "no figure is named `*`"),
        ("1 / c", "no figure is named `c`"),
    ] {
        assert!(value(text).expect_err(text).contains(reason), "{text}: {:?}", value(text));
    }
}

/// The implied fill rate is the solution of equation 11 for the rate.
#[test]
fn the_fill_rate_of_the_geforce4_is_implied() {
    let value = |id: &str| printed(id).expect("a figure").value;
    let tests = value("ray-engine/ten-triangles-geforce4") * 1e6;
    let readback = value("ray-engine/read-back") * 1e6;
    let implied = 10.0 / (10.0 / tests - 4.0 / readback) / 1e6;
    assert_eq!(format!("{implied:.1}"), format!("{:.1}", value("ray-engine/fill-geforce4")));
}
