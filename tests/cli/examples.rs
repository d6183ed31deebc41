//! docs/examples: the files that documentation and help texts name equal the library's output.

use crate::environment::writes_files;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crossbar::all_frequency::factor::{FactorSampling, Lobe};
use crossbar::geom::{Mesh, teapot};
use crossbar::io::scenes;
use crossbar::io::{scene_files, write_matrix_market, write_obj};
use crossbar::ray_engine::kernels;
use glam::DVec3;

use crate::crossbar;
use crate::generated::hold_bytes;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/examples")
}

/// A table of 8 x 8 eye rays toward the teapot.
fn rays() -> String {
    let mut text = "ox,oy,oz,dx,dy,dz\n".to_owned();
    for (row, column) in (0..8).flat_map(|row| (0..8).map(move |column| (row, column))) {
        let (x, z) = (f64::from(column) * 0.125 - 0.4375, 0.375 - f64::from(row) * 0.125);
        writeln!(text, "0,-10,1.5,{x},1,{z}").expect("writing to a string cannot fail");
    }
    text
}

/// A table of reflectance times cosine on maps of 4 x 4 texels.
fn reflectance() -> String {
    let sampling = FactorSampling { side: 4, ..FactorSampling::default() };
    let table = sampling.table(&Lobe::cook_torrance(0.5, 0.5), &mut |_, _| ()).expect("a table");
    let line =
        |row: &[f64]| row.iter().map(|&value| format!("{:e}", value as f32)).collect::<Vec<_>>().join(",") + "\n";
    table.values().rows().map(line).collect()
}

/// A sparse matrix of quarters in blocks, with some values off.
fn quarters() -> String {
    let value = |row: usize, column: usize| {
        let in_block = (7 * (row / 8) + 3 * column) % 5 < 2;
        let is_off = (5 * row + column).is_multiple_of(23);
        if is_off { 0.25 * (1 + row % 3) as f64 } else { f64::from(u8::from(in_block)) }
    };
    let places = (0..40).flat_map(|row| (0..32).map(move |column| (row, column)));
    let entries: Vec<_> = places.map(|(row, column)| (row, column, value(row, column))).collect();
    let entries = entries.into_iter().filter(|entry| entry.2 != 0.0);
    let mut text = Vec::new();
    let size = [40, 32, entries.clone().count()];
    write_matrix_market(size, "Blocks of ones, and some quarters.", entries, &mut text).expect("written");
    String::from_utf8(text).expect("numbers")
}

/// The unit sphere in 512 triangles: an octahedron whose faces are divided three times.
fn sphere() -> Mesh {
    let mut corners: Vec<DVec3> = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z].to_vec();
    let mut faces: Vec<[u32; 3]> = (0..4_u32).flat_map(|i| [[i, (i + 1) % 4, 4], [(i + 1) % 4, i, 5]]).collect();
    for _ in 0..3 {
        let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                corners.push((corners[a as usize] + corners[b as usize]).normalize());
                corners.len() as u32 - 1
            })
        };
        let divided = |&[a, b, c]: &[u32; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        faces = faces.iter().flat_map(divided).collect();
    }
    Mesh::new(corners.iter().map(|corner| corner.as_vec3().to_array()).collect(), faces).expect("a sphere")
}

#[test]
fn examples_are_what_the_library_makes() {
    let mut mesh = Vec::new();
    write_obj(&teapot::teapot(4).expect("a teapot"), &mut mesh).expect("written");
    let mut round = Vec::new();
    write_obj(&sphere(), &mut round).expect("written");
    let mut files = vec![
        ("teapot.obj".to_owned(), mesh),
        ("sphere.obj".to_owned(), round),
        ("rays.csv".to_owned(), rays().into_bytes()),
        ("quarters.mtx".to_owned(), quarters().into_bytes()),
        ("reflectance.csv".to_owned(), reflectance().into_bytes()),
        ("intersect.psa".to_owned(), kernels::ONE_ORIGIN_SIGNED.text.as_bytes().to_vec()),
    ];
    files.extend(scene_files(&scenes::named("cornell-box").expect("a scene"), "room").expect("files"));
    for (name, bytes) in files {
        hold_bytes(&folder().join(&name), &bytes);
    }
}

/// The pictures of the examples of `diff` equal the pictures that `render` makes of the example scenes, except for
/// their metadata.
#[test]
fn example_pictures_are_what_the_program_draws() {
    let teapot = "docs/examples/teapot.obj --eye 0,-10,4 --target 0,0,1 --size 96x96";
    let room = "docs/examples/room.toml --renderer path --size 48x48 --samples";
    let pictures = [
        ("exact.png", "picture.png", teapot.to_owned()),
        ("leaky.png", "picture.png", format!("{teapot} --device r200")),
        ("rough.exr", "layers.exr", format!("{room} 1")),
        ("smooth.exr", "layers.exr", format!("{room} 16")),
    ];
    for (name, file, options) in pictures {
        let out = tempfile::tempdir().expect("a folder for the test");
        let path = out.path().to_str().expect("a name in UTF-8");
        let arguments: Vec<&str> = ["render"].into_iter().chain(options.split(' ')).chain(["--out", path]).collect();
        let ran = crossbar(&arguments, "");
        assert_eq!(ran.code, Some(0), "{}", ran.transcript());
        let (drawn, example) = (out.path().join(file), folder().join(name));
        if writes_files() {
            fs::copy(&drawn, &example).expect("written");
        }
        let [drawn, example] = [&drawn, &example].map(|path| path.to_str().expect("a name in UTF-8"));
        let ran = crossbar(&["diff", example, drawn], "");
        assert_eq!(ran.code, Some(0), "run with INSTA_UPDATE=always to write {example}\n{}", ran.transcript());
    }
}
