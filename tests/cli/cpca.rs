//! `crossbar cpca`: transfer, compression, errors and pictures from the command line.

use std::fs;

use approx::assert_relative_eq;
use crossbar::transfer::file::load_prt;

use crate::answers::{document, number, place, refused};

const STEP: [&str; 3] = ["docs/examples/step.obj", "docs/examples/step.npz", "docs/examples/step_small.npz"];

/// The commands write the example files, on any number of threads.
#[test]
fn the_examples_are_made_by_the_commands() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [model, transfer, small] = STEP;
    for threads in ["1", "3"] {
        let out = place(folder.path(), "out.npz");
        document(&["cpca", "precompute", model, "--order", "3", "--out", &out, "--threads", threads]);
        assert_eq!(fs::read(&out).expect("written"), fs::read(transfer).expect("an example"), "{threads} threads");
        let options = ["--clusters", "8", "--vectors", "3", "--out", &out, "--threads", threads];
        document(&[&["cpca", "compress", transfer][..], &options].concat());
        assert_eq!(fs::read(&out).expect("written"), fs::read(small).expect("an example"), "{threads} threads");
    }
}

/// Light at a place in a scene: a lamp has the flux of its solid angle in closed form, and the model's picture depends on
/// the place.
#[test]
fn light_comes_from_a_place_in_a_scene() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [lamp, page] = ["lamp.obj", "page"].map(|name| place(folder.path(), name));
    fs::write(folder.path().join("lamp.mtl"), "newmtl lamp\nKd 0 0 0\nKe 5 2 1\n").expect("written");
    let square = "v -1 -1 2\nv -1 1 2\nv 1 1 2\nv 1 -1 2";
    fs::write(&lamp, format!("mtllib lamp.mtl\nusemtl lamp\n{square}\nf 1 2 3 4\n")).expect("written");
    let light = |at: &str| format!("scene:{lamp}@{at}");
    let sampled = document(&["all-frequency", "lighting", "--light", &light("0,0,0")]);
    // Solid angle of a square of half width a at distance d: 4 asin(a^2 / (a^2 + d^2)).
    let solid_angle = 4.0 * libm::asin(0.2);
    for (channel, radiance) in [5.0, 2.0, 1.0].into_iter().enumerate() {
        assert_relative_eq!(number(&sampled["flux"][channel]), radiance * solid_angle, max_relative = 1e-9);
    }
    let [model, transfer, _] = STEP;
    let exposures = ["0,0,0", "0,0,-8"].map(|at| {
        let options = ["--light", &light(at), "--size", "16x12", "--out", &page];
        number(&document(&[&["cpca", "render", transfer, "--model", model][..], &options].concat())["exposure"])
    });
    assert!(exposures[1] > 10.0 * exposures[0], "a lamp at a fifth of the distance: {exposures:?}");
}

/// A square whose first texture coordinate grows with y: the anisotropic material follows it, the file stores the
/// tangents, and commands that read the file need no option for them.
#[test]
fn tangents_come_from_the_texture_and_stay_with_the_file() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let (model, page) = (place(folder.path(), "textured.obj"), place(folder.path(), "page"));
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\nf 1/1 2/2 3/3 4/4\n";
    fs::write(&model, text).expect("written");
    let made = |name: &str, tangents: &str| {
        let out = place(folder.path(), name);
        let options = ["--kind", "glossy", "--rows", "16", "--brdf", "ward:0.1,0.4,0.1,0.4", "--order", "4"];
        let command = ["cpca", "precompute", &model, "--tangents", tangents, "--out", &out];
        document(&[&command[..], &options].concat());
        assert_eq!(document(&["cpca", "show", &out])["mesh"]["tangents"], tangents);
        let transfer = load_prt(out.as_ref(), None).expect("a file").transfer.expect("transfer");
        (out, transfer.values().to_vec())
    };
    let (texture, along_texture) = made("texture.npz", "texture");
    let (axis, along_y) = made("axis.npz", "0,1,0");
    let (_, along_x) = made("other.npz", "1,0,0");
    assert_eq!(along_texture, along_y);
    assert_ne!(along_texture, along_x);
    let render = ["cpca", "render", &texture, "--model", &model, "--size", "8x8", "--out", &page];
    document(&[&render[..], &["--original", &texture]].concat());
    let said = refused(&[&render[..], &["--original", &axis]].concat());
    for words in ["expected transfer of a mesh with 4 vertices", "tangents from texture coordinates", "along 0,1,0"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    // A square without texture coordinates is a different mesh and is refused.
    let square = ["cpca", "render", &texture, "--model", "fixtures/models/square.obj", "--size", "8x8", "--out", &page];
    refused(&square);
}
