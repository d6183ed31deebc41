//! docs/examples: the files that documentation and help name are what the library makes today.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crossbar::geom::teapot;
use crossbar::io::{scene_files, write_obj};
use crossbar::ray_engine::kernels;
use crossbar::scene::built;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/examples")
}

/// 8 x 8 eye rays at the teapot.
fn rays() -> String {
    let mut text = "ox,oy,oz,dx,dy,dz\n".to_owned();
    for (row, column) in (0..8).flat_map(|row| (0..8).map(move |column| (row, column))) {
        let (x, z) = (f64::from(column) * 0.125 - 0.4375, 0.375 - f64::from(row) * 0.125);
        writeln!(text, "0,-10,1.5,{x},1,{z}").expect("writing to a string cannot fail");
    }
    text
}

#[test]
fn examples_are_what_the_library_makes() {
    let mut mesh = Vec::new();
    write_obj(&teapot::teapot(4).expect("a teapot"), &mut mesh).expect("written");
    let mut files = vec![
        ("teapot.obj".to_owned(), mesh),
        ("rays.csv".to_owned(), rays().into_bytes()),
        ("intersect.psa".to_owned(), kernels::ONE_ORIGIN_SIGNED.text.as_bytes().to_vec()),
    ];
    files.extend(scene_files(&built::build("cornell-box").expect("a scene"), "room").expect("files"));
    for (name, bytes) in files {
        let path = folder().join(&name);
        if std::env::var_os("CROSSBAR_BLESS").is_some() {
            fs::write(&path, &bytes).expect("written");
        }
        let there = fs::read(&path).expect("an example");
        assert!(there == bytes, "run with CROSSBAR_BLESS=1 to write {}", path.display());
    }
}
