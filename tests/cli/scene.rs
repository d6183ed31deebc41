//! `crossbar scene`: the list, one scene, its files, and what is said of a wrong name.

use crate::{crossbar, crossbar_in};

#[test]
fn all_scenes_and_one() {
    insta::assert_snapshot!("scenes", crossbar(&["scene"], "").transcript());
    insta::assert_snapshot!("scene_office", crossbar(&["scene", "office"], "").transcript());
    insta::assert_snapshot!("scene_json", crossbar(&["scene", "cornell-box", "--json"], "").transcript());
    insta::assert_snapshot!("scene_unknown", crossbar(&["scene", "kitchen"], "").transcript());
}

#[test]
fn files_are_written_together() {
    let folder = tempfile::tempdir().expect("a folder");
    let ran = crossbar_in(folder.path(), &["scene", "cornell-box", "--out", "made"], "");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let scene = crossbar::io::scene_file::load(&folder.path().join("made/cornell_box.toml")).expect("the scene");
    assert_eq!(Some(scene), crossbar::scene::built::build("cornell-box"));
}
