//! Pages of studies: complete, balanced, self-contained HTML in which every wrong pixel stays visible.

use base64::{Engine as _, engine::general_purpose::STANDARD};
use crossbar::geom::exact::Sides;
use crossbar::geom::teapot::teapot;
use crossbar::picture::{RgbImage, rgb8};
use crossbar::ray_engine::RayBatch;
use crossbar::report::digits;
use crossbar::report::{
    Chart, Findings, NamedChart, NamedFile, NamedPicture, Provenance, Scale, Series, Table, Tone, Verdict,
};
use crossbar::scene::Camera;
use crossbar::study::Study as _;
use crossbar::study::configuration::Configuration;
use crossbar::study::leaky_teapot::{LeakyTeapotOptions, Parameters, PixelVerdict};
use crossbar::study::reproduce;
use refsim::machine::ExecutorKind;
use strum::VariantArray as _;

fn text(files: &[NamedFile], name: &str) -> String {
    String::from_utf8(file(files, name).to_vec()).expect("text")
}

fn file<'a>(files: &'a [NamedFile], name: &str) -> &'a [u8] {
    &files.iter().find(|file| file.0 == name).unwrap_or_else(|| panic!("{name}")).1
}

/// A page with every kind of content, with text that looks like tags.
fn everything() -> Vec<NamedFile> {
    let mut found = Findings::new("T & U");
    found.conclusion("Two of <three> rows hold.");
    found.conclusion("The third does not.");
    found.tally(2, ["row holds", "rows hold"], Tone::Good);
    found.tally(1, ["row fails", "rows fail"], Tone::Bad);
    found.conclude(Verdict::Failed);
    found.legend(vec![([1, 2, 3], "a colour".to_owned())]);
    let marked = NamedPicture::new("p", rgb8(700, 2, [[9; 3]; 1400]), "a \"wide\" picture");
    found.pictures(vec![marked, NamedPicture::new("q", rgb8(1, 1, [[0; 3]]), "a small picture")]);
    found.heading("A <section>");
    found.paragraph("Some text.");
    let mut table = Table::new("a <b> table", &["what", "long_name_%", "verdict"]);
    table.push(["<script>".into(), 3_u32.into(), "missed".into()]);
    found.table(table);
    found.table(Table::new("an empty table", &["x"]));
    found.heading("Another");
    let lines = vec![Series { label: "l <1>".to_owned(), points: vec![(1.0, 2.0), (100.0, 3.0)] }];
    let chart = Chart { title: "c".to_owned(), x_scale: Scale::Logarithmic, lines, ..Chart::default() };
    found.chart(NamedChart { name: "c".to_owned(), chart, caption: "a chart".to_owned() });
    found.take_files(&Provenance::new("crossbar leaky-teapot --size 8x8")).expect("all of it can be encoded")
}

/// Tags that have no end tag.
const VOID: [&str; 4] = ["meta", "img", "wbr", "br"];

/// The tags of a page, each with its attributes; panics if a tag is not closed, or is closed twice.
fn balanced(page: &str) -> Vec<String> {
    let (mut open, mut all): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    let mut rest = page;
    while let Some((_, tail)) = rest.split_once('<') {
        let (tag, tail) = tail.split_once('>').expect("a tag ends");
        rest = tail;
        let name = tag.split([' ', '/', '\n']).find(|part| !part.is_empty()).unwrap_or_default().to_owned();
        // Names of attributes precede `="`; values end at the next quote.
        let attributes = tag.strip_prefix(name.as_str()).unwrap_or("");
        let names: Vec<&str> =
            attributes.split('"').step_by(2).map(|name| name.trim_matches([' ', '\n', '=', '/'])).collect();
        let twice = |n: usize| names[n].contains('=') || (!names[n].is_empty() && names[..n].contains(&names[n]));
        assert!(!(1..names.len()).any(twice), "an attribute twice: {tag}");
        if tag.starts_with('!') || tag.ends_with('/') || VOID.contains(&name.as_str()) {
            all.push(tag.to_owned());
        } else if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name));
        } else {
            all.push(tag.to_owned());
            if ["style", "script"].contains(&name.as_str()) {
                rest = &rest[rest.find(&format!("</{name}>")).expect("its end")..];
            }
            open.push(name);
        }
    }
    assert_eq!(open, Vec::<String>::new());
    all
}

#[test]
fn a_page_is_balanced_and_stands_alone() {
    let page = text(&everything(), "index.html");
    let tags = balanced(&page);
    assert!(page.starts_with("<!DOCTYPE html><html lang=\"en\">"));
    assert!(page.contains("T &amp; U") && page.contains("&lt;script&gt;") && !page.contains("an empty table"));
    assert!(page.contains("crossbar leaky-teapot --size 8x8"), "the command is told");
    // The page fetches nothing: the only address is SVG's name space, and the only script is in the page.
    assert!(!page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "").contains("http") && !page.contains("url("));
    assert!(!tags.iter().any(|tag| tag.starts_with("script ") || tag.starts_with("link") || tag.contains(" on")));
    for image in tags.iter().filter(|tag| tag.starts_with("img")) {
        assert!(image.contains("src=\"data:image/png;base64,iVBORw0K") && image.contains(" alt=\""), "{image}");
        assert!(image.contains(" width=\"") && image.contains(" height=\""), "{image}");
    }
    for cell in tags.iter().filter(|tag| tag.starts_with("th ") || *tag == "th") {
        assert!(cell.contains("scope=\"col\"") || cell.contains("scope=\"row\""), "{cell}");
    }
    // Each link leads to one element of the page.
    let ids: Vec<&str> = tags.iter().filter_map(|tag| tag.split(" id=\"").nth(1)?.split('"').next()).collect();
    for link in tags.iter().filter_map(|tag| tag.split(" href=\"").nth(1)?.split('"').next()) {
        let id = link.strip_prefix('#').expect("links stay on the page");
        assert_eq!(ids.iter().filter(|other| **other == id).count(), 1, "{link}: {ids:?}");
    }
}

#[test]
fn conclusion_and_tally_come_first_and_go_to_machines() {
    let files = everything();
    let page = text(&files, "index.html");
    let places = [
        "<h1>",
        "Two of &lt;three&gt; rows hold.",
        "rows hold</li>",
        "<img",
        "<nav",
        "A &lt;section&gt;</h2>",
        "<table",
    ];
    let found = places.map(|what| page.find(what).unwrap_or_else(|| panic!("{what}")));
    assert!(found.is_sorted(), "{found:?}");
    let document: serde_json::Value = serde_json::from_str(&text(&files, "study.json")).expect("JSON");
    assert_eq!(document["conclusion"], serde_json::json!(["Two of <three> rows hold.", "The third does not."]));
}

fn decoded(png: &[u8]) -> RgbImage {
    image::load_from_memory(png).expect("a picture").to_rgb8()
}

/// The decoded picture of one figure of the page; asserts that the page shows it at its pixel size.
fn shown(page: &str, alt: &str) -> RgbImage {
    let mut images =
        page.split("<img ").filter(|image| image.split_once('>').is_some_and(|(tag, _)| tag.contains(alt)));
    let image = images.next().expect("a picture");
    assert!(images.next().is_none(), "one picture is {alt}");
    let value =
        |name: &str| image.split(&format!("{name}=\"")).nth(1).and_then(|rest| rest.split('"').next()).expect(name);
    let data = value("src").strip_prefix("data:image/png;base64,").expect("data");
    let picture = decoded(&STANDARD.decode(data).expect("base64"));
    assert_eq!([" width", " height"].map(|name| value(name).parse()), [picture.width(), picture.height()].map(Ok));
    picture
}

/// The page of a leaky teapot shows every pixel of the map and of the shaded picture, and its conclusion counts the
/// leaks.
#[test]
fn every_wrong_pixel_is_shown() {
    let (width, height) = (800, 160);
    let camera = Camera::teapot(width, height).expect("a camera");
    let parameters = Parameters {
        mesh: teapot(6).expect("a teapot"),
        view: RayBatch::new(width, height, camera.rays()).expect("rays"),
        configurations: vec![Configuration::device("r200").expect("a card")],
        model: None,
        listed: None,
        shared: Vec::new(),
        executor: ExecutorKind::Batch.into(),
        options: LeakyTeapotOptions { rays_per_edge: 0, sides: Sides::Front, all_pairs: false },
    };
    let mut found = parameters.findings(&mut |_, _, _| ()).expect("the study runs");
    let files = found.take_files(&Provenance::new("crossbar leaky-teapot")).expect("files");
    let page = text(&files, "index.html");
    balanced(&page);
    let verdict = |pixel: &image::Rgb<u8>| {
        let of = |verdict: &&PixelVerdict| verdict.color() == pixel.0;
        *PixelVerdict::VARIANTS.iter().find(of).expect("a colour of the legend")
    };
    let map = decoded(file(&files, "r200-map.png"));
    let wrong = map.pixels().filter(|pixel| verdict(pixel).is_error()).count();
    let leaks = map.pixels().filter(|pixel| verdict(pixel) == PixelVerdict::Leak).count();
    assert!(wrong > 100 && leaks > 20, "{wrong} {leaks}");
    // The conclusion counts these pixels.
    let said = found.conclusions().join(" ");
    let sentences = [(leaks, ": "), (wrong, "r200 is wrong in ")];
    for (count, before) in sentences {
        assert!(said.contains(&format!("{before}{} ", digits::count(count as u64))), "{said}");
    }
    assert!(
        said.starts_with("The 16-bit fixed-point arithmetic of the ATI Radeon 8500, rounded down, loses "),
        "{said}"
    );
    assert_eq!(shown(&page, "alt=\"ATI Radeon 8500, what is wrong where"), map);
    assert_eq!(shown(&page, "alt=\"ATI Radeon 8500: "), decoded(file(&files, "r200.png")));
}

/// On the `reproduce` page, the counts in the conclusion match the rows, and each verdict is in the column next to its
/// figure.
#[test]
fn papers_rows_are_tallied() {
    let entries = reproduce::choose(&["ray-engine-equation-11".to_owned(), "ray-engine-radeon-8500".to_owned()])
        .expect("two entries");
    let mut found =
        reproduce::Parameters { entries, full_size: false }.findings(&mut |_, _, _| ()).expect("the entries run");
    let files = found.take_files(&Provenance::new("crossbar reproduce")).expect("files");
    let rows: serde_json::Value = serde_json::from_str(&text(&files, "study.json")).expect("JSON");
    let rows = rows["rows"].as_array().expect("rows");
    let counted: u64 = found.tallied().iter().map(|entry| entry.count).sum();
    assert_eq!(counted, rows.len() as u64);
    for entry in found.tallied() {
        assert_eq!(rows.iter().filter(|row| row["verdict"] == entry.what.as_str()).count() as u64, entry.count);
    }
    let judged = rows.iter().filter(|row| row["dependence"] != "calibrated");
    let predicted = judged.clone().filter(|row| row["verdict"] == "predicted").count();
    let sentence = format!("Of {} figures to which no constant was fitted, {predicted} are predicted", judged.count());
    assert!(found.conclusions()[0].starts_with(&sentence), "{:?}", found.conclusions());
    let page = text(&files, "index.html");
    let tags = balanced(&page);
    assert!(page.contains("<th scope=\"col\">what</th><th scope=\"col\">verdict</th>"), "verdicts stand second");
    assert!(tags.iter().any(|tag| tag.starts_with("tr id=\"ray-engine-equation-11.1\"")), "rows have links");
    assert!(page.contains("<ul class=\"lines\">"), "a line per paper");
    assert!(!page.contains("class=\"summary failed\""), "a missed figure of the Radeon 8500 is no failure");
}
