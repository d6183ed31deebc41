//! `crossbar render` with the host renderers.

use crate::answers::refusals;
use crate::{ProgramOutput, crossbar_in};

fn render(arguments: &[&str]) -> (ProgramOutput, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let mut all = vec!["render"];
    all.extend(arguments);
    (crossbar_in(folder.path(), &all, ""), folder)
}

/// A square that the default camera sees nearly from the front.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3\nf 1 3 4\n";

/// A scene file with a misspelt field.
const FIELD: &str = "mesh = \"square.obj\"\n[[point_ligth]]\nposition = [0, 0, 1]\nintensity = [1, 1, 1]\n";

/// A model whose face names a vertex that does not exist.
const BROKEN: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                      element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n";

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
fn bad_input() {
    let cases: [(&str, &[&str]); 16] = [
        ("unknown_scene", &["teapot-rooms"]),
        ("unknown_view", &["cornell-box", "--view", "behind"]),
        ("view_and_eye", &["cornell-box", "--view", "front", "--eye", "0,0,0"]),
        ("field_of_the_first_view", &["cornell-box", "--tan-half-height", "-1"]),
        ("no_samples", &["cornell-box", "--samples", "0"]),
        ("bad_exposure", &["cornell-box", "--exposure", "-1"]),
        ("device_of_the_host", &["cornell-box", "--device", "r300"]),
        ("device_in_exact_arithmetic", &["square.obj", "--executor", "exact", "--device", "r200"]),
        ("one_point", &["point.obj"]),
        ("engine_in_exact_arithmetic", &["cornell-box", "--caster", "engine", "--executor", "exact"]),
        ("no_lights", &["square.obj", "--renderer", "path"]),
        ("missing_file", &["square2.obj", "--renderer", "eye"]),
        ("missing_file_on_a_card", &["square2.obj"]),
        ("missing_scene_file", &["room.toml"]),
        ("scene_file_field", &["field.toml"]),
        ("broken_ply", &["broken.ply"]),
    ];
    let point = "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n";
    let files = [("square.obj", SQUARE), ("point.obj", point), ("field.toml", FIELD), ("broken.ply", BROKEN)];
    insta::assert_snapshot!(refusals(&["render"], &files, &cases));
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
