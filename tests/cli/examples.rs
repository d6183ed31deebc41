//! docs/examples: copies of what the library and the program make equal their output.

use crate::environment::writes_files;
use std::fs;
use std::path::{Path, PathBuf};

use crossbar::geom::teapot;
use crossbar::io::{scene_files, scenes, write_obj};
use crossbar::ray_engine::kernels;

use crate::crossbar;
use crate::generated::hold_bytes;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/examples")
}

#[test]
fn examples_are_what_the_library_makes() {
    let mut mesh = Vec::new();
    write_obj(&teapot::teapot(4).expect("a teapot"), &mut mesh).expect("written");
    let mut files = vec![
        ("teapot.obj".to_owned(), mesh),
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
