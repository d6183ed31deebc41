//! `crossbar subsurface`.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use crossbar::report::layout::wrapped;
use rayon::prelude::*;

use crate::answers::{folder_with, names_in, words};
use crate::generated::{filled, hold};
use crate::{ProgramOutput, crossbar_in};

/// A tetrahedron.
const MODEL: &str = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const SMALL: [&str; 10] =
    ["subsurface", "m.obj", "--mm-per-unit", "5", "--material", "marble", "--atlas", "16", "--size", "16x16"];

fn subsurface(more: &[&str]) -> (ProgramOutput, tempfile::TempDir) {
    let folder = folder_with(&[("m.obj", MODEL)]);
    (crossbar_in(folder.path(), &[&SMALL[..], more].concat(), ""), folder)
}

#[test]
fn what_it_says_and_writes() {
    let more = "--choice fixed --choice adaptive --links 4,16 --map 8bit --map fp32 --light directional:1,1,1:2,2,1 \
                --light ambient:0.1,0.1,0.2";
    let (ran, folder) = subsurface(&more.split_whitespace().collect::<Vec<_>>());
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    insta::assert_snapshot!("subsurface_tables", ran.stdout);
    insta::assert_snapshot!("subsurface_files", names_in(&folder.path().join("out/subsurface")).join("\n"));
    let page = std::fs::read_to_string(folder.path().join("out/subsurface/index.html")).expect("a page");
    assert_eq!(page.matches("<img").count(), 3 + 2 + 8 + 8, "lead, maps, ways, their errors");
    let faces = std::fs::read_to_string(folder.path().join("out/subsurface/faces.csv")).expect("a table");
    assert_eq!(faces.lines().filter(|line| !line.starts_with('#')).count(), 5, "a heading and four faces: {faces}");
}

/// Rows of one of the study's tables, as cells by heading; comments are skipped.
fn table(folder: &tempfile::TempDir, name: &str) -> Vec<BTreeMap<String, String>> {
    let text = std::fs::read_to_string(folder.path().join("out/subsurface").join(name)).expect("a table");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let headings: Vec<String> = lines.next().expect("headings").split(',').map(str::to_owned).collect();
    lines.map(|line| headings.iter().cloned().zip(line.split(',').map(str::to_owned)).collect()).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: expected a number, found `{}`", row[column]))
}

/// The page's command on a sphere.
fn angles() -> &'static str {
    "subsurface docs/examples/sphere.obj --material skin1 --mm-per-unit 10 --atlas 32 --choice fixed --choice adaptive \
     --links 64 --link-format fp32 --map fp32 --light directional:0,0,1:1,1,1 --all-pairs yes"
}

/// docs/studies/subsurface.md states for each choice of links at which angles from the light it is more accurate. The
/// test runs the command that the page names; the page's table and sentence must match the study's.
#[test]
fn the_page_says_where_each_choice_of_links_is_nearer() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().expect("a folder for the test");
    std::fs::create_dir_all(folder.path().join("docs/examples")).expect("a folder");
    let model = "docs/examples/sphere.obj";
    std::fs::copy(root.join(model), folder.path().join(model)).expect("copied");
    let command: Vec<&str> = angles().split_whitespace().collect();
    let ran = crossbar_in(folder.path(), &[&command[..], &["--size", "8x8"]].concat(), "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let rows = table(&folder, "angles.csv");
    assert_eq!(rows.len(), 2 * 12, "twelve bins of each way");
    let of = |choice: &str| rows.iter().filter(|row| row["way"].starts_with(choice)).collect::<Vec<_>>();
    let (fixed, adaptive) = (of("fixed"), of("adaptive"));
    // Each choice is better at some angles, which a mean over the sphere hides.
    let nearer = |(one, other): (&&BTreeMap<String, String>, &&BTreeMap<String, String>)| {
        number(one, "links_rms_percent") < number(other, "links_rms_percent")
    };
    assert!(nearer((&adaptive[0], &fixed[0])) && nearer((&fixed[11], &adaptive[11])), "{rows:?}");
    let whole: f64 = fixed.iter().map(|row| number(row, "area_percent")).sum();
    assert!((whole - 100.0).abs() < 1e-9, "the bins are the whole sphere: {whole}");
    let line = |(fixed, adaptive): (&&BTreeMap<String, String>, &&BTreeMap<String, String>)| {
        let percent = |row: &BTreeMap<String, String>, column| format!("{:+.1}", number(row, column));
        let rms = |row: &BTreeMap<String, String>| format!("{:.1}", number(row, "links_rms_percent"));
        let b = number(fixed, "B_all_pairs");
        format!(
            "| {} to {} | {b:.5} | {} | {} | {} | {} |\n",
            fixed["from_degrees"],
            fixed["to_degrees"],
            percent(fixed, "links_percent"),
            rms(fixed),
            percent(adaptive, "links_percent"),
            rms(adaptive),
        )
    };
    let body: String = fixed.iter().zip(&adaptive).map(line).collect();
    let head = "| degrees | B | fixed: mean | rms | adaptive: mean | rms |\n|---|---|---|---|---|---|\n";
    let begin = "With 64 links per texel, by the angle between normal and light, ";
    let spoken = words(&ran.stdout);
    let sentence = spoken.split(begin).nth(1).and_then(|rest| rest.split(". ").next()).expect("the sentence");
    let expected = format!("\n\n{head}{body}\n{}\n\n", wrapped(&format!("{begin}{sentence}."), 120, "").join("\n"));
    hold_on_page("angles", angles(), &expected);
}

/// Checks that docs/studies/subsurface.md names the command and has its results between the markers, or writes the
/// results.
fn hold_on_page(name: &str, command: &str, expected: &str) {
    // Tests that write the page do so one after another.
    static PAGE: Mutex<()> = Mutex::new(());
    let _alone = PAGE.lock().unwrap_or_else(PoisonError::into_inner);
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/studies/subsurface.md");
    let text = std::fs::read_to_string(&page).expect("the page");
    let split = |name: &str| text.split_once(&format!("<!-- subsurface: {name} -->")).expect("the mark");
    let block = |other: &str| match split(other).1.split_once("<!-- /subsurface -->") {
        Some((there, _)) if other != name => there.to_owned(),
        _ => expected.to_owned(),
    };
    assert!(split(name).0.contains(&format!("crossbar {command}")), "the page names the command");
    hold(&page, &filled(&text, "subsurface", block));
}

/// The page's errors of links for each size of the model match the study's.
#[test]
fn the_page_says_how_errors_grow_with_the_model() {
    let command = |radius: &str| {
        format!(
            "subsurface docs/examples/sphere.obj --sigma-s 2.19 --sigma-a 0.0021 --eta 1.5 --mm-per-unit {radius} \
             --atlas 32 --choice fixed --choice adaptive --links 4,16,64 --channels scalar --link-format fp32 \
             --link-format fp16 --map fp32 --light directional:0,0,1:1,1,1 --all-pairs yes"
        )
    };
    let sphere = "docs/examples/sphere.obj";
    let found = |radius: &str| {
        let folder = tempfile::tempdir().expect("a folder for the test");
        std::fs::create_dir_all(folder.path().join("docs/examples")).expect("a folder");
        std::fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join(sphere), folder.path().join(sphere)).expect("copied");
        let line = command(radius) + " --size 8x8";
        let ran = crossbar_in(folder.path(), &line.split(' ').collect::<Vec<_>>(), "");
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
        table(&folder, "rows.csv")
    };
    let radii = ["1", "2", "4"];
    let sizes: Vec<_> = radii.into_par_iter().map(found).collect();
    let mut text =
        "\n\n| links | card alone, fp32 | fp16 | radius 1 mm | 2 mm | 4 mm |\n|---|---|---|---|---|---|\n".to_owned();
    let mut before = [[100.0; 3]; 2];
    for way in 0..6 {
        let [single, half] = [0, 1].map(|format| number(&sizes[0][2 * way + format], "card_rms_percent"));
        let errors = [0, 1, 2].map(|size| number(&sizes[size][2 * way], "links_rms_percent"));
        assert!(
            errors.iter().zip(before[way / 3]).all(|(&now, before)| now < before),
            "{errors:?}: more links are nearer"
        );
        assert!(way >= 3 || errors.is_sorted(), "{errors:?}: fixed links are farther off on a larger model");
        before[way / 3] = errors;
        let name = ["fixed, 4", "fixed, 16", "fixed, 64", "adaptive, 4", "adaptive, 16", "adaptive, 64"][way];
        let seams = [0, 1, 2].map(|size| number(&sizes[size][2 * way], "links_seams_percent"));
        let [one, two, four] = [0, 1, 2].map(|size| format!("{:.1} ({:.1})", errors[size], seams[size]));
        text += &format!("| {name} | {single:.2} | {half:.2} | {one} | {two} | {four} |\n");
    }
    // Section 4.3: 16 adaptive links show seams where as many fixed links do not, and fewer seams with more links.
    for size in &sizes {
        let [fixed, adaptive, more] = [2, 8, 10].map(|row: usize| number(&size[row], "links_seams_percent"));
        assert!(adaptive > 1.5 * fixed && more < 0.5 * adaptive, "{fixed}, {adaptive}, {more}");
    }
    hold_on_page("sizes", &command("4"), &format!("{text}\n"));
}

/// Help, page and program agree on the largest atlas for which all pairs are gathered by default.
#[test]
fn all_pairs_are_gathered_up_to_the_side_that_help_and_page_say() {
    let help = crossbar_in(Path::new("."), &["subsurface", "--help"], "");
    assert!(words(&help.stdout).contains("[default: yes for atlases up to 32]"), "{}", help.stdout);
    for (side, is_gathered) in [("16", true), ("64", false)] {
        let folder = folder_with(&[("m.obj", MODEL)]);
        let arguments = SMALL.map(|word| if word == "16" { side } else { word });
        let ran = crossbar_in(folder.path(), &[&arguments[..], &["--links", "4", "--channels", "scalar"]].concat(), "");
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let page = std::fs::read_to_string(folder.path().join("out/subsurface/index.html")).expect("a page");
        assert!(page.contains("the default of atlases above 32 x 32)"));
        assert_eq!(table(&folder, "faces.csv")[0].contains_key("all_pairs_g"), is_gathered, "{side}");
    }
}

/// A tetrahedron whose slanted face is listed twice, the second time starting at a different corner.
#[test]
fn a_face_that_stands_twice_is_said() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let run = |model: &str| {
        std::fs::write(folder.path().join("m.obj"), model).expect("written");
        let ran = crossbar_in(folder.path(), &[&SMALL[..], &["--all-pairs", "no", "--links", "4"]].concat(), "");
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        words(&ran.stdout)
    };
    let said = "1 face of the model lies on another face";
    assert!(!run(MODEL).contains(said));
    let text = run(&format!("{MODEL}f 3 4 2\n"));
    assert!(text.contains(said), "{text}");
}

/// A corner at 1e12 makes texels whose areas differ by 1e20: factors with such ratios overflow half precision.
#[test]
fn factors_beyond_their_format_are_refused() {
    let folder = folder_with(&[("m.obj", MODEL.replace("v 0 0 2", "v 0 0 1e12"))]);
    let run = |format| {
        let more = ["--all-pairs", "no", "--links", "16", "--link-format", format];
        crossbar_in(folder.path(), &[&SMALL[..], &more].concat(), "")
    };
    let told = run("fp16").refusal(["fp16"]);
    assert!(told.contains("expected factors of links of at most 6.5504e4 in textures of fp16 texels"), "{told}");
    let ran = run("fp32");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    for name in ["faces.csv", "rows.csv", "vertices.csv"] {
        let text = std::fs::read_to_string(folder.path().join("out/subsurface").join(name)).expect("a table");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
}
