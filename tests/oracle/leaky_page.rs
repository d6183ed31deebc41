//! Checks that pages quote the program's figures on the leaky teapot: this test generates the blocks between marks.
//! `INSTA_UPDATE=always` updates the pages.

use crate::environment::{is_full, writes_files};
use crate::pages;
use std::path::{Path, PathBuf};

use crossbar::ray_engine::EdgeRule;
use crossbar::report::Cell;
use crossbar::report::digits::count;
use crossbar::report::words::{counted, percent};
use crossbar::study::configuration::Configuration;
use crossbar::study::leaky_teapot::{TeapotOutcome, TeapotRow};

use refsim::device::{Confidence, Profile};

use super::teapot_study::{formats, parameters, study};

const END: &str = "<!-- /leaky-teapot -->";

/// Pages with blocks; the study's page comes first.
const PAGES: [&str; 4] = ["docs/studies/leaky_teapot.md", "README.md", "docs/devices.md", "docs/papers/ray_engine.md"];

fn file(page: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(page)
}

/// The text of a page.
fn read(page: &str) -> String {
    std::fs::read_to_string(file(page)).expect("the page").replace('\r', "")
}

/// The number, in words, of the Radeon 8500's rules that are guesses.
fn guesses() -> String {
    let figures = Profile::named("r200").expect("a card").figures();
    let rules: Vec<_> = figures.iter().filter(|row| row.key.starts_with("rules.")).collect();
    let guessed = rules.iter().filter(|row| row.confidence == Confidence::Guess).count();
    format!("{guessed} of {}", rules.len())
}

/// The text between the marks of a block.
fn block<'a>(text: &'a str, name: &str) -> &'a str {
    let (_, rest) = text.split_once(&format!("<!-- leaky-teapot: {name} -->")).expect("a mark");
    rest.split_once(END).expect("its end").0
}

/// Configurations of the rows that the program computes without options.
fn defaults() -> Vec<Configuration> {
    let mut all = Configuration::device_under_each_switch("r200").expect("a card");
    all.extend(formats(&["fp16", "fp24", "fp32"]));
    all
}

fn switch(configuration: &Configuration) -> String {
    configuration.switch.as_ref().map(|(name, value)| format!("`{name}={value}`")).unwrap_or_default()
}

/// Returns `true` if the rows have the same hits, bit for bit, and the same counts of aimed rays.
fn alike(a: &TeapotRow, b: &TeapotRow) -> bool {
    let bits = |row: &TeapotRow| row.t.iter().map(|t| t.to_bits()).collect::<Vec<_>>();
    (&a.triangle, a.edges, a.vertices) == (&b.triangle, b.edges, b.vertices) && bits(a) == bits(b)
}

/// Rows that the program, run without options, also computes with shared edges.
const CURED: [&str; 5] = ["r200", "r200-rounding-rne", "fp16", "fp24", "fp32"];

/// A table row for one configuration and edge rule: leaks inside the surface, and the cost of an intersection.
fn program(row: &TeapotRow) -> String {
    let [eye, edges, vertices] = row.holes;
    let rule = match row.edge_rule {
        EdgeRule::Paper => "paper",
        EdgeRule::SharedEdges => "shared edges",
    };
    let label = row.configuration.label.trim_end_matches("-shared-edges");
    let clocks = row.cost.clocks.map_or_else(|| "-".to_owned(), |clocks| clocks.to_string());
    format!(
        "| {label} | {rule} | {} of {} | {} of {} | {} of {} | {} | {} | {clocks} |\n",
        count(edges.leaks),
        count(edges.rays),
        count(vertices.leaks),
        count(vertices.rays),
        count(eye.leaks),
        count(eye.rays),
        row.cost.arithmetic,
        row.cost.texture,
    )
}

/// The table of the programs: each configuration with the paper's and with shared edges.
fn programs(outcome: &TeapotOutcome) -> String {
    let of = |rule: EdgeRule, label: &str| {
        let wanted = match rule {
            EdgeRule::Paper => label.to_owned(),
            EdgeRule::SharedEdges => format!("{label}-shared-edges"),
        };
        program(outcome.rows.iter().find(|row| row.configuration.label == wanted).expect("a row of the defaults"))
    };
    let rows = CURED.iter().flat_map(|label| [EdgeRule::Paper, EdgeRule::SharedEdges].map(|rule| of(rule, label)));
    format!(
        "\n| card or format | kernel | edges | vertices | eye rays | arithmetic slots | texture slots | clocks |\n\
         |---|---|---|---|---|---|---|---|\n{}",
        rows.collect::<String>()
    )
}

fn row(row: &TeapotRow) -> String {
    let (t, edges, vertices) = (&row.tally, &row.edges, &row.vertices);
    format!(
        "| {} | {} | {} | {} | {} ({}) | {} | {} | {} % | {} % |\n",
        row.configuration.label,
        count(t.hits),
        count(t.leaks),
        count(t.false_hits),
        count(t.wrong_triangle),
        count(t.wrong_triangle - t.wrong_adjacent),
        Cell::error(t.largest_t_error).text(),
        count(row.pixels_differing),
        Cell::percent(100.0 * edges.leak_share()).text(),
        Cell::percent(100.0 * vertices.leak_share()).text(),
    )
}

/// The page with every block regenerated. `same` lists the switches that change nothing.
fn filled(text: &str, outcome: &TeapotOutcome, same: &[String]) -> String {
    let named = |label: &str| outcome.rows.iter().find(|row| row.configuration.label == label).expect("a row");
    let (r200, fp24, fp32) = (named("r200"), named("fp24"), named("fp32"));
    let said = |name: &str| match name {
        "scene" => format!(
            "{} eye rays; {} rays aimed at shared edges and {} at vertices that truly hit",
            count(r200.tally.rays),
            count(r200.edges.surface),
            count(r200.vertices.surface)
        ),
        "rows" => format!(
            "\n| row | hits | leaks | false hits | wrong triangle (not adjacent) | largest t error | pixels differing | \
             leaks of edge-aimed rays | of vertex-aimed rays |\n|---|---|---|---|---|---|---|---|---|\n{}",
            outcome.rows.iter().filter(|row| row.edge_rule == EdgeRule::Paper).map(row).collect::<String>()
        ),
        "programs" => programs(outcome),
        "cured" => count(named("r200-shared-edges").tally.leaks),
        "same" => format!("\n{}\n", same.join(",\n")),
        "surface" => percent(r200.tally.leak_share()),
        "guesses" => guesses(),
        "rdn" => count(r200.tally.leaks),
        "rne" => count(named("r200-rounding-rne").tally.leaks),
        "fp24" => format!(
            "{} and {}",
            counted(fp24.tally.leaks, "leak", "leaks"),
            counted(fp24.tally.wrong_triangle, "wrong triangle", "wrong triangles")
        ),
        "fp32" => count(fp32.tally.wrong()),
        "seams" => percent(fp32.edges.leak_share()),
        _ => panic!("unknown block `{name}`"),
    };
    pages::filled(text, "leaky-teapot", said)
}

/// The figures at full size. Rows that the page lists as bit-identical to the first are checked on a smaller picture;
/// with `CROSSBAR_FULL=1`, and when the page is written, they are also computed at full size.
#[test]
fn the_pages_say_what_the_program_prints() {
    let text = read(PAGES[0]);
    let mut configurations = defaults();
    let full = writes_files() || is_full();
    let said: Vec<String> = block(&text, "same").trim().split(",\n").map(str::to_owned).collect();
    if !full {
        assert!(said.iter().all(|name| configurations.iter().any(|row| switch(row) == *name)), "{said:?}");
        let small = study(&parameters(48, 8, configurations.clone()));
        for row in small.rows.iter().filter(|row| said.contains(&switch(&row.configuration))) {
            let tallies = |row: &TeapotRow| format!("{:?} {:?} {:?}", row.tally, row.edges, row.vertices);
            let (ours, first) = (tallies(row), tallies(&small.rows[0]));
            assert!(alike(row, &small.rows[0]), "{}: {ours}\nnot {first}", row.configuration.label);
        }
        configurations.retain(|row| !said.contains(&switch(row)));
    }
    let mut parameters = parameters(512, 8, configurations);
    parameters.options.rays_per_edge = 4;
    let is_cured = |row: &&Configuration| CURED.contains(&row.label.as_str());
    parameters.shared = parameters.configurations.iter().filter(is_cured).cloned().collect();
    let mut outcome = study(&parameters);
    let (first, others) = outcome.rows.split_first().expect("a row");
    let same: Vec<String> = others
        .iter()
        .filter(|row| row.configuration.switch.is_some() && alike(row, first))
        .map(|row| switch(&row.configuration))
        .collect();
    outcome.rows.retain(|row| row.edge_rule == EdgeRule::SharedEdges || !same.contains(&switch(&row.configuration)));
    assert!(full || same.is_empty(), "the same bits as r200 too: {same:?}");
    for page in PAGES {
        let text = read(page);
        assert!(text.contains(END), "{page} has no block");
        pages::hold(&file(page), &filled(&text, &outcome, if full { &same } else { &said }));
    }
}

/// Every figure of README.md is checked: a number is between marks, or a year, a name, or in this list of numbers that
/// other tests check.
#[test]
fn every_figure_of_the_front_page_is_held() {
    let years_and_names = ["2002", "2003", "2004", "2011", "4", "8500"];
    let widths_in_bits_and_texels = ["8", "16", "16-bit", "32"];
    // `tests/watertight.rs` checks the first two, `.ci/run` the third.
    let figures = ["115", "5,880", "25", env!("CARGO_PKG_RUST_VERSION")];
    let known = [&years_and_names[..], &widths_in_bits_and_texels, &figures].concat();
    let text: String = read("README.md").split("```").step_by(2).collect();
    let text: String = text.split('`').step_by(2).collect();
    let marked = text.split("<!-- leaky-teapot: ").map(|part| part.split_once(END).map_or(part, |(_, rest)| rest));
    let marked = "]()".to_owned() + &marked.collect::<String>();
    let links = marked.split("](").map(|part| part.split_once(')').map_or(part, |(_, rest)| rest));
    let words: Vec<String> = links.flat_map(str::split_whitespace).map(str::to_owned).collect();
    let bare =
        |word: &String| word.trim_matches(|c: char| !c.is_ascii_alphanumeric()).trim_end_matches("'s").to_owned();
    let mut numbers: Vec<String> = words.iter().map(bare).collect();
    numbers.retain(|word| word.starts_with(|c: char| c.is_ascii_digit()));
    let unknown: Vec<&String> = numbers.iter().filter(|number| !known.contains(&number.as_str())).collect();
    assert!(unknown.is_empty() && numbers.len() > 15, "hold them by a test, or leave them out: {unknown:?}");
}
