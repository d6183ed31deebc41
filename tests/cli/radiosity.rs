//! `crossbar radiosity`.

use std::collections::BTreeSet;

use crate::answers::{folder_with, names_in};
use crate::{ProgramOutput, crossbar_in};

fn radiosity(arguments: &[&str]) -> (ProgramOutput, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let mut all = vec!["radiosity"];
    all.extend(arguments);
    (crossbar_in(folder.path(), &all, ""), folder)
}

const SMALL: [&str; 9] =
    ["cornell-room", "--patches", "60", "--factors", "unoccluded", "--size", "24x24", "--solver", "card"];

#[test]
fn what_it_says_and_writes() {
    let mut arguments = SMALL.to_vec();
    arguments.extend(["--solver", "gauss-seidel", "--solver", "direct", "--packing", "rgb", "--packing", "luminance"]);
    arguments.extend(["--storage", "fp32", "--storage", "fp16", "--picture-after", "1,4,5000"]);
    let (ran, folder) = radiosity(&arguments);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    insta::assert_snapshot!("radiosity_tables", ran.stdout);
    let written = names_in(&folder.path().join("out/radiosity"));
    insta::assert_snapshot!("radiosity_files", written.join("\n"));
    let page = std::fs::read_to_string(folder.path().join("out/radiosity/index.html")).expect("a page");
    assert_eq!(page.matches("<img").count(), 6 * 2 + 4 + 2, "two pictures a way, one error on a card, two frames");
}

/// The file of radiosities lists the model's vertices by number; each value is a mean over the vertex's patches.
#[test]
fn vertices_have_radiosities() {
    let (ran, folder) = radiosity(&["white-box", "--patches", "24", "--size", "8x8", "--solver", "direct"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let rows = |name: &str| -> Vec<Vec<String>> {
        let text = std::fs::read_to_string(folder.path().join("out/radiosity").join(name)).expect("a table");
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let (vertices, patches) = (rows("vertices.csv"), rows("patches.csv"));
    let names = ["vertex", "x", "y", "z", "of_model", "material", "patches", "direct_r", "direct_g", "direct_b"];
    assert_eq!(vertices[0], names);
    // 9 vertices per side of a box with sharp edges.
    assert_eq!(vertices.len() - 1, 6 * 9);
    let of_model: BTreeSet<&str> =
        vertices[1..].iter().map(|row| row[4].as_str()).filter(|row| !row.is_empty()).collect();
    assert_eq!(of_model.len(), 8, "the corners of the box");
    let number = |text: &String| text.parse::<f64>().expect("a number");
    let reds = || patches[1..].iter().map(|row| number(&row[8]));
    let [least, most] = [reds().fold(f64::INFINITY, f64::min), reds().fold(0.0, f64::max)];
    let within = |row: &Vec<String>| (least * (1.0 - 1e-12)..=most * (1.0 + 1e-12)).contains(&number(&row[7]));
    assert!(vertices[1..].iter().all(within), "{least} to {most}");
    assert!(vertices[1..].iter().any(|row| row[6] == "4") && vertices[1..].iter().any(|row| row[6] == "1"));
}

/// If no patch sees another, every solver ends at once, without a curve to draw. All patches emit, so the conclusion
/// names none that does not.
#[test]
fn a_flat_scene_has_no_residuals_to_draw() {
    let model = "mtllib m.mtl\nusemtl shining\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let folder = folder_with(&[("m.obj", model), ("m.mtl", "newmtl shining\nKd 0.5 0.5 0.5\nKe 1 1 1\n")]);
    for solver in ["gauss-seidel", "shooting", "jacobi"] {
        let arguments = ["radiosity", "m.obj", "--patches", "16", "--size", "8x8", "--solver", solver, "--out", solver];
        let ran = crossbar_in(folder.path(), &[&arguments[..], &["--solver", "direct"]].concat(), "");
        assert_eq!(ran.code, Some(0), "{solver}: {}", ran.stderr);
        assert!(ran.stdout.contains("is the least accurate: its largest relative error is"), "{}", ran.stdout);
        assert!(!folder.path().join(solver).join("residual.svg").exists(), "{solver}");
    }
}

#[test]
fn a_document_for_machines() {
    let mut arguments = SMALL.to_vec();
    arguments.extend(["--solver", "direct", "--enforce-closure", "--json"]);
    let (ran, _folder) = radiosity(&arguments);
    let found = ran.json();
    assert_eq!(found["room"][0]["enforced"], "closure");
    let [card, direct] = &found["ways"].as_array().expect("ways")[..] else { panic!("{found}") };
    assert_eq!((card["way"].as_str(), direct["way"].as_str()), (Some("nv35-rgb-fp32"), Some("direct")));
    assert!(card["largest_error"].as_f64().expect("a number") < 1e-3, "{card}");
    assert!(direct["light_unaccounted"].as_f64().expect("a number") < 1e-12, "{direct}");
    assert_eq!(found["card"][0]["passes"], 1);
    assert_eq!(found["provenance"]["profiles"][0], "nv35");
}

/// Every command accepts a model with triangles without area, and reports their number.
#[test]
fn a_triangle_without_area_is_no_patch() {
    let model = "mtllib lamp.mtl\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 0 1\nusemtl lamp\nf 1 2 4\nf 1 2 3\n";
    let folder = folder_with(&[("flat.obj", model), ("lamp.mtl", "newmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n")]);
    let ran = crossbar_in(folder.path(), &["radiosity", "flat.obj", "--patches", "8", "--size", "8x8"], "");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert_eq!(ran.stderr, "warning: flat.obj: 1 triangle without area: never hit\n");
}
