//! `crossbar render` with the host renderers.

use crate::{ProgramOutput, crossbar_in};

fn render(arguments: &[&str]) -> (ProgramOutput, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let mut all = vec!["render"];
    all.extend(arguments);
    (crossbar_in(folder.path(), &all, ""), folder)
}

/// A square that the default camera sees nearly from the front.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3\nf 1 3 4\n";

#[test]
fn what_it_says() {
    let (ran, _folder) = render(&["cornell-box", "--size", "8x8", "--samples", "1"]);
    insta::assert_snapshot!("render_cornell_box", ran.transcript());
    let engine = ["cornell-box", "--size", "16x16", "--samples", "1", "--caster", "engine", "--json"];
    let (ran, _folder) = render(&engine);
    let found = ran.json();
    assert_eq!(found["pixels"], 256);
    assert_eq!(found["not_finite"], 0);
    assert_eq!(found["rays"]["total"], found["engine"]["rays"]);
}

#[test]
fn a_mesh_without_lights_is_seen_by_its_eye_rays() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    std::fs::write(folder.path().join("square.obj"), SQUARE).expect("written");
    for more in [&["--samples", "4"][..], &["--renderer", "eye"], &["--caster", "engine"], &[]] {
        let mut all = vec!["render", "square.obj", "--size", "8x8"];
        all.extend(more);
        let ran = crossbar_in(folder.path(), &all, "");
        assert_eq!(ran.code, Some(0), "{more:?}: {}", ran.stderr);
        assert!(ran.stdout.contains("pixels hit"), "{more:?}");
    }
}
