//! `crossbar atlas`: its output, its files, and refusals.

use crossbar::io::load_mesh;

use crate::answers::names_in;
use crate::{crossbar, crossbar_in};

const TEAPOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/examples/teapot.obj");

#[test]
fn what_it_says() {
    let ran = crossbar(&["atlas", "stand-in-head", "--side", "128"], "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    insta::assert_snapshot!("atlas_tables", ran.stdout);
}

#[test]
fn what_it_writes() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let arguments = ["atlas", TEAPOT, "--side", "64", "--size", "32x24", "--out", "atlas", "--json"];
    let ran = crossbar_in(folder.path(), &arguments, "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let document = ran.json();
    assert_eq!(document["side"], 64);
    assert_eq!(document["levels"].as_array().map(Vec::len), Some(7));
    insta::assert_snapshot!("atlas_files", names_in(&folder.path().join("atlas")).join("\n"));
    // The halves have the surface's area, and texture coordinates between 0 and 1.
    let [whole, halves] = [TEAPOT.into(), folder.path().join("atlas/atlas.obj")].map(|path: std::path::PathBuf| {
        let mesh = load_mesh(&path).expect("a mesh");
        ((0..mesh.len() as u32).map(|face| mesh.area(face)).sum::<f64>(), mesh.len())
    });
    assert_eq!(halves.1, 2 * whole.1);
    approx::assert_relative_eq!(halves.0, whole.0, max_relative = 1e-6);
    let text = std::fs::read_to_string(folder.path().join("atlas/atlas.obj")).expect("text");
    let coordinates: Vec<f64> = text
        .lines()
        .filter_map(|line| line.strip_prefix("vt "))
        .flat_map(|pair| pair.split(' ').map(|part| part.parse::<f64>().expect("a number")).collect::<Vec<_>>())
        .collect();
    assert_eq!(coordinates.len(), 8 * whole.1);
    assert!(coordinates.iter().all(|part| (0.0..=1.0).contains(part)));
    let rows = std::fs::read_to_string(folder.path().join("atlas/faces.csv")).expect("text");
    assert_eq!(rows.lines().count(), 1 + whole.1);
}
