//! `crossbar subsurface`.

use crate::{Ran, crossbar_in};

/// A tetrahedron.
const MODEL: &str = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const SMALL: [&str; 10] =
    ["subsurface", "m.obj", "--mm-per-unit", "5", "--material", "marble", "--atlas", "16", "--size", "16x16"];

fn subsurface(more: &[&str]) -> (Ran, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    std::fs::write(folder.path().join("m.obj"), MODEL).expect("written");
    (crossbar_in(folder.path(), &[&SMALL[..], more].concat(), ""), folder)
}

fn files(folder: &tempfile::TempDir) -> Vec<String> {
    let entries = std::fs::read_dir(folder.path().join("out/subsurface")).expect("a folder").flatten();
    let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn what_it_says_and_writes() {
    let more = [
        "--choice",
        "fixed",
        "--choice",
        "adaptive",
        "--links",
        "4,16",
        "--map",
        "8bit",
        "--map",
        "fp32",
        "--frames",
        "2",
        "--probe",
        "0.5,0.5,0",
        "--light",
        "directional:1,1,1:2,2,1",
        "--light",
        "sky:0.1,0.1,0.2",
    ];
    let (ran, folder) = subsurface(&more);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    insta::assert_snapshot!("subsurface_tables", ran.stdout);
    insta::assert_snapshot!("subsurface_files", files(&folder).join("\n"));
    let page = std::fs::read_to_string(folder.path().join("out/subsurface/index.html")).expect("a page");
    assert_eq!(page.matches("<img").count(), 3 + 2 + 8 + 8 + 2, "lead, maps, ways, their errors, frames");
    let faces = std::fs::read_to_string(folder.path().join("out/subsurface/faces.csv")).expect("a table");
    assert_eq!(faces.lines().filter(|line| !line.starts_with('#')).count(), 5, "a heading and four faces: {faces}");
}

/// Each other value of each rounding switch is a row; what they change is small, and not nothing.
#[test]
fn rounding_switches_are_swept() {
    let (ran, folder) = subsurface(&["--roundings", "--map", "8bit", "--links", "4"]);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    let text = std::fs::read_to_string(folder.path().join("out/subsurface/roundings.csv")).expect("a table");
    let rows: Vec<Vec<&str>> =
        text.lines().filter(|line| line.starts_with("fixed-4")).map(|line| line.split(',').collect()).collect();
    let switches: Vec<(&str, &str)> = rows.iter().map(|row| (row[1], row[2])).collect();
    let expected =
        [("mad", "fused"), ("mipmap-rounding", "truncate"), ("rounding", "rtz"), ("target-rounding", "truncate")];
    assert_eq!(switches, expected);
    let changes: Vec<f64> = rows.iter().map(|row| row[3].parse().expect("per cent")).collect();
    // Of bytes a step is 0.4 %: rounded twice, in the map and in its levels. Arithmetic of 32 bits is lost in that.
    assert!(changes.iter().all(|&change| change < 3.0), "{changes:?}");
    assert!(changes[1] > 0.0 && changes[3] > 0.0, "{changes:?}");
    assert!(ran.stdout.contains("Of the card's rounding switches "), "{}", ran.stdout);
}

/// A face that nothing shines on is lit from behind, and twice the light is twice as bright.
#[test]
fn irradiances_of_faces_are_gathered_linearly() {
    let lit = |factor: f64| -> Vec<f64> {
        let folder = tempfile::tempdir().expect("a folder for the test");
        std::fs::write(folder.path().join("m.obj"), MODEL).expect("written");
        let table = format!("r,g,b\n{factor},{factor},{factor}\n0,0,0\n0,0,0\n0,0,0\n");
        std::fs::write(folder.path().join("e.csv"), table).expect("written");
        let more = ["--all-pairs", "no", "--irradiance", "e.csv", "--link-format", "fp32", "--map", "fp32"];
        let ran = crossbar_in(folder.path(), &[&SMALL[..], &more].concat(), "");
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
        let text = std::fs::read_to_string(folder.path().join("out/subsurface/faces.csv")).expect("a table");
        let rows = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
        rows.map(|row| row.rsplit(',').next().expect("a column").parse().expect("a number")).collect()
    };
    let (one, two) = (lit(1.0), lit(2.0));
    assert_eq!(one.len(), 4);
    assert!(one.iter().all(|&b| b > 0.0), "{one:?}");
    let doubled: Vec<f64> = one.iter().map(|b| 2.0 * b).collect();
    assert_eq!(two, doubled, "a power of two changes no rounding");
}

#[test]
fn the_same_bytes_for_every_executor_and_thread_count() {
    let ways =
        [&["--executor", "scalar"][..], &["--executor", "batch", "--threads", "1"], &["--threads", "3"]].map(|more| {
            let (ran, folder) = subsurface(&[&["--map", "8bit", "--map", "fp16", "--all-pairs", "no"], more].concat());
            assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{more:?}");
            folder
        });
    for file in files(&ways[0]) {
        let read = |folder: &tempfile::TempDir| {
            std::fs::read(folder.path().join("out/subsurface").join(&file)).expect("written")
        };
        assert!(ways.iter().all(|folder| read(folder) == read(&ways[0])), "{file}");
    }
}

#[test]
fn a_table_of_another_model_is_refused() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    std::fs::write(folder.path().join("m.obj"), MODEL).expect("written");
    std::fs::write(folder.path().join("e.csv"), "r,g,b\n1,1,1\n").expect("written");
    let ran = crossbar_in(folder.path(), &[&SMALL[..], &["--irradiance", "e.csv"]].concat(), "");
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("expected an irradiance for each of 4 faces, found 1"), "{}", ran.stderr);
}
