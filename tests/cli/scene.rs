//! `crossbar scene`: the list, one scene, and its files.

use crate::answers::listed;
use crate::{crossbar, crossbar_in};

#[test]
fn all_scenes_and_one() {
    let cases = [("scenes", "scene"), ("scene_office", "scene office"), ("scene_json", "scene cornell-box --json")];
    let said = cases.map(|(name, line)| (name, crossbar(&line.split(' ').collect::<Vec<_>>(), "").transcript()));
    insta::assert_snapshot!(listed(said));
}

#[test]
fn files_are_written_together() {
    let folder = tempfile::tempdir().expect("a folder");
    let ran = crossbar_in(folder.path(), &["scene", "cornell-box", "--out", "made"], "");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let scene = crossbar::io::scene_file::load(&folder.path().join("made/cornell_box.toml")).expect("the scene");
    assert_eq!(Some(scene), crossbar::io::scenes::named("cornell-box"));
}

/// Snapshots of the messages about faulty scene files.
#[test]
fn bad_scenes() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/scenes/bad");
    let entries = std::fs::read_dir(&folder).expect("the folder");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending != "mtl"));
    files.sort();
    let mut text = String::new();
    for path in files {
        let error = crossbar::io::scene_file::load(&path).expect_err("a mistake");
        let message = error.to_string().replace(&format!("{}{}", folder.display(), std::path::MAIN_SEPARATOR), "");
        text.push_str(&format!("{}\n    {message}\n", path.file_name().expect("a name").display()));
    }
    insta::assert_snapshot!("bad_scenes", text);
}
