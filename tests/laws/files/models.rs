//! The model reader: written models can be read back, and no bytes cause a panic.

use crate::environment::writes_files;
use std::path::Path;

use crossbar::geom::{Mesh, Sides, exact, teapot};
use crossbar::io::{
    ModelOptions, load_mesh, load_mesh_with, load_rays, load_scene, load_scene_with, parse_obj, write_hits, write_obj,
};
use proptest::prelude::*;

use super::mutation::mutated;
use crate::support::file;

const GOOD: &str = "# good\nmtllib a.mtl\no thing\nv 0 0 0\nv 1.5 0 -0\nv 1e-3 +1 0 1\nv -1 .5 0 1 0 0\nvt 0 0\nvn 0 0 1\n\
                    usemtl red\ng part\ns 1\nf 1 2 3\nf 1/1/1 2//1 3/1 4\nf -1 -2 \\\n-3\nl 1 2\np 1\n";

fn soup(mesh: &Mesh) -> Vec<[[u32; 3]; 3]> {
    mesh.iter_corners().map(|corners| corners.map(|corner| corner.map(f32::to_bits))).collect()
}

fn round_trip(mesh: &Mesh) -> Mesh {
    let mut text = Vec::new();
    write_obj(mesh, &mut text).expect("written");
    parse_obj(&text, Path::new("m.obj")).expect("a mesh")
}

fn word() -> impl Strategy<Value = String> {
    const KNOWN: [&str; 26] = [
        "v", "f", "vt", "vn", "o", "g", "usemtl", "mtllib", "\n", "\n", "\n", "\\\n", "#", "0", "1", "2", "-1",
        "3/1/1", "1//", "/", "1e39", "nan", "inf", "-0", "1e-45", "é",
    ];
    const LONG: [&str; 3] = ["9223372036854775807", "-9223372036854775808", "18446744073709551616"];
    prop::sample::select([&KNOWN[..], &LONG].concat()).prop_map(str::to_owned)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn mutated_models_do_no_harm(bytes in mutated(GOOD, 1..12)) {
        if let Ok(mesh) = parse_obj(&bytes, Path::new("m.obj")) {
            prop_assert_eq!(soup(&round_trip(&mesh)), soup(&mesh));
        }
    }

    #[test]
    fn known_words_in_any_order_do_no_harm(words in prop::collection::vec(word(), 0..60)) {
        if let Ok(mesh) = parse_obj(words.join(" ").as_bytes(), Path::new("m.obj")) {
            prop_assert_eq!(round_trip(&mesh), mesh);
        }
    }

    #[test]
    fn meshes_read_back_to_the_same_bits(
        numbers in prop::collection::vec(any::<[u32; 3]>(), 3..20),
        picks in prop::collection::vec(any::<[prop::sample::Index; 3]>(), 1..20),
    ) {
        let finite = |bits: u32| Some(f32::from_bits(bits)).filter(|value| value.is_finite()).unwrap_or(0.0);
        let positions: Vec<_> = numbers.iter().map(|place| place.map(finite)).collect();
        let triangles = picks.iter().map(|corners| corners.map(|corner| corner.index(positions.len()) as u32)).collect();
        let mesh = Mesh::new(positions, triangles).expect("a mesh");
        let back = round_trip(&mesh);
        prop_assert_eq!(soup(&back), soup(&mesh));
        prop_assert_eq!(&round_trip(&back), &back, "numbered by first use, it stays as it is");
    }
}

/// Wavefront's format: `vt u v w`; v and w are 0 by default.
#[test]
fn texture_coordinates_have_one_to_three_numbers() {
    let read = |coordinate: &str| {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt {coordinate}\nf 1/1 2/1 3/1\n");
        parse_obj(text.as_bytes(), Path::new("m.obj"))
    };
    assert!(["0.5", "0.5 0.25", "0.5 0.25 1"].iter().all(|coordinate| read(coordinate).is_ok()));
    assert!(read("").is_err() && read("0.5 0 0 0").is_err());
}

#[test]
fn the_good_model_is_good() {
    let mesh = parse_obj(GOOD.as_bytes(), Path::new("m.obj")).expect("a mesh");
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 1, 2], [0, 2, 3], [3, 2, 1]]);
    assert_eq!(mesh.positions(), [[0.0, 0.0, 0.0], [1.5, 0.0, -0.0], [1e-3, 1.0, 0.0], [-1.0, 0.5, 0.0]]);
}

#[test]
fn the_fixture_is_the_teapot_at_rate_two() {
    let path = file("fixtures/models/teapot_2.obj");
    let mut text = Vec::new();
    write_obj(&teapot::teapot(2).expect("a teapot"), &mut text).expect("written");
    if writes_files() {
        std::fs::write(&path, &text).expect("written");
    }
    assert_eq!(
        std::fs::read(&path).expect("the fixture"),
        text,
        "run with INSTA_UPDATE=always to write {}",
        path.display()
    );
}

#[test]
fn the_square_is_hit_as_its_fixture_says() {
    let fixtures = file("fixtures");
    let mesh = load_mesh(&fixtures.join("models/square.obj")).expect("a mesh");
    let rays = load_rays(&fixtures.join("rays/square.csv")).expect("rays");
    let hits: Vec<Option<(u32, f64)>> = exact::nearest_all(&mesh, &rays, Sides::Front)
        .into_iter()
        .map(|hit| hit.map(|hit| (hit.triangle, f64::from(hit.t.to_f32()))))
        .collect();
    let mut text = Vec::new();
    write_hits(&hits, &mut text).expect("written");
    let expected = std::fs::read_to_string(fixtures.join("rays/square_front.csv")).expect("the fixture");
    assert_eq!(String::from_utf8(text).expect("text"), expected);
}

/// A `#` within a word is part of it, as in the NaN that old C libraries print.
#[test]
fn comments_begin_words() {
    let parse = |text: &str| parse_obj(text.as_bytes(), Path::new("m.obj")).map_err(|error| error.to_string());
    let rest = "v 0 0 0 # one\n#two\nv 1 0 0\t#three \\\nv 0 1 0 ## 5 \\\nf 1 2 3 #4\n";
    assert_eq!(parse(rest).expect("a mesh").triangles(), [[0, 1, 2]]);
    assert_eq!(parse("v 1.#QNAN 0 0"), Err("m.obj:1: expected a number, found `1.#QNAN`".to_owned()));
    assert_eq!(parse("v 0 0 -1.#IND"), Err("m.obj:1: expected a number, found `-1.#IND`".to_owned()));
}

#[test]
fn faces_with_a_fault_are_refused_or_noted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.obj");
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 1 1\n";
    for (faces, refused, note) in [
        (
            "f 1 2 3\nf 1 2 3 5\nf 2 3 4 5\n",
            "7: expected a flat face that does not touch itself, found one not flat",
            "2 faces not flat: cut as seen along an axis near the normal; first: m.obj:7",
        ),
        (
            "f 1 2 3 3\n",
            "6: expected a flat face that does not touch itself, found one with two corners at one position",
            "1 face with two corners at one position: cut as seen along an axis near the normal; first: m.obj:6",
        ),
        (
            "f 1 3 2 4\n",
            "6: expected a flat face that does not touch itself, found one of edges that cross or touch",
            "1 face of edges that cross or touch: cut into a fan around the first corner; first: m.obj:6",
        ),
    ] {
        let text = format!("{corners}{faces}");
        let error = parse_obj(text.as_bytes(), Path::new("m.obj")).expect_err(faces).to_string();
        assert_eq!(error, format!("m.obj:{refused}"));
        std::fs::write(&path, text).expect("written");
        assert!(load_scene(&path).is_err(), "{faces}");
        for notes in [
            load_mesh_with(&path, ModelOptions::default()).expect("a mesh").1,
            load_scene_with(&path, ModelOptions::default()).expect("a scene").1,
        ] {
            assert_eq!(notes[0].to_string().replace(&format!("{}/", folder.path().display()), ""), note);
        }
    }
}

#[test]
fn every_bad_model_is_refused() {
    let folder = file("fixtures/models/bad");
    let mut seen = 0;
    for entry in std::fs::read_dir(&folder).expect("the folder") {
        let path = entry.expect("an entry").path();
        assert!(load_mesh(&path).is_err(), "{}", path.display());
        seen += 1;
    }
    assert_eq!(seen, 7);
}
