//! `crossbar diff`: its output, its files, and refusals.

use std::path::Path;

use crossbar::picture::{ChannelUnit, Picture, Samples, exr, hdr, png};

use crate::answers::{folder_with, listed, names_in};
use crate::{ProgramOutput, crossbar_in};

/// A color gradient of 16 x 12 pixels.
fn slope(red: f32) -> Picture {
    let pixels: Vec<[f32; 3]> = (0..192).map(|at| [red, (at % 16) as f32 / 15.0, (at / 16) as f32 / 11.0]).collect();
    Picture::rgb(16, 12, &pixels)
}

/// The gradient with channels of ids and depths, among them a NaN.
fn layers(id: u32, depth: f32) -> Picture {
    let (mut ids, mut depths) = (vec![3; 192], vec![2.0; 192]);
    (ids[17], depths[40]) = (id, depth);
    let picture = slope(0.25).with("id", ChannelUnit::Id, Samples::Uint(ids)).expect("ids");
    picture.with("Z", ChannelUnit::RayLength, Samples::Float(depths)).expect("depths")
}

/// Pictures that differ in known ways.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let shown = |picture: &Picture| png(&picture.display(1.0).expect("color")).expect("a file");
    let mut changed = slope(0.25).display(1.0).expect("color");
    changed.put_pixel(3, 4, crossbar::picture::Rgb([255, 0, 0]));
    let depth = Picture::new(4, 4).with("Z", ChannelUnit::RayLength, Samples::Float(vec![1.0; 16])).expect("depths");
    let nearer = Picture::new(4, 4).with("Z", ChannelUnit::RayLength, Samples::Float(vec![0.5; 16])).expect("depths");
    vec![
        ("a.png", shown(&slope(0.25))),
        ("changed.png", png(&changed).expect("a file")),
        ("a.exr", exr(&slope(0.25)).expect("a file")),
        ("brighter.exr", exr(&slope(0.5)).expect("a file")),
        ("a.hdr", hdr(&slope(0.25)).expect("a file")),
        ("layers.exr", exr(&layers(3, f32::NAN)).expect("a file")),
        ("other_layers.exr", exr(&layers(4, 2.5)).expect("a file")),
        ("depth.exr", exr(&depth).expect("a file")),
        ("nearer.exr", exr(&nearer).expect("a file")),
        ("broken.png", b"\x89PNG\r\n\x1a\nnothing".to_vec()),
        ("text.png", b"hello".to_vec()),
    ]
}

fn diff(folder: &Path, arguments: &[&str]) -> ProgramOutput {
    crossbar_in(folder, &[&["diff"], arguments].concat(), "")
}

#[test]
fn what_it_says() {
    let folder = folder_with(&files());
    let cases: [(&str, &[&str], i32); 8] = [
        ("equal", &["a.exr", "a.exr"], 0),
        ("one_pixel", &["a.png", "changed.png"], 1),
        ("brighter", &["a.exr", "brighter.exr"], 1),
        (
            "within_bounds",
            &["a.exr", "brighter.exr", "--max-rmse", "0.3", "--max-error", "0.25", "--max-flip", "0.5"],
            0,
        ),
        ("beyond_bounds", &["a.exr", "brighter.exr", "--max-rmse", "0.2"], 1),
        ("formats", &["a.png", "a.hdr", "--max-error", "0.01", "--min-ssim", "0.99"], 0),
        ("layers", &["layers.exr", "other_layers.exr", "--ppd", "20"], 1),
        ("depth", &["depth.exr", "nearer.exr"], 1),
    ];
    let said = listed(cases.map(|(name, arguments, code)| {
        let ran = diff(folder.path(), arguments);
        assert_eq!(ran.code, Some(code), "{name}: {}", ran.stderr);
        (name, ran.transcript())
    }));
    insta::assert_snapshot!(said);
}

#[test]
fn bad_input() {
    let cases: [(&str, &[&str]); 9] = [
        ("sizes", &["a.exr", "depth.exr"]),
        ("channels", &["a.exr", "layers.exr"]),
        ("no_channel", &["a.exr", "a.exr", "--channel", "A"]),
        ("missing", &["a.exr", "nowhere.exr"]),
        ("broken", &["a.png", "broken.png"]),
        ("text", &["text.png", "a.png"]),
        ("no_color", &["depth.exr", "nearer.exr", "--max-flip", "0.1"]),
        ("ppd", &["a.exr", "a.exr", "--ppd", "0.5"]),
        ("window", &["a.exr", "a.exr", "--min-ssim", "nan"]),
    ];
    insta::assert_snapshot!(listed(cases.map(|(name, arguments)| {
        let folder = folder_with(&files());
        let ran = diff(folder.path(), &[arguments, &["--out", "maps"]].concat());
        assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{name}: {}", ran.stderr);
        assert_eq!(names_in(folder.path()).len(), files().len(), "{name} left something behind");
        (name, ran.stderr)
    })));
}

#[test]
fn maps_and_numbers_are_written() {
    let folder = folder_with(&files());
    let ran = diff(folder.path(), &["a.exr", "brighter.exr", "--out", "maps", "--scale", "0.1", "--json"]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let found = ran.json();
    assert_eq!((&found["equal"], &found["held"], &found["scale"]), (&false.into(), &false.into(), &0.1.into()));
    assert_eq!((&found["channels"][2]["channel"], &found["channels"][2]["mean"]), (&"R".into(), &0.25.into()));
    assert!(found["flip"]["mean"].as_f64().is_some_and(|mean| mean > 0.0 && mean < 1.0), "{found}");
    let inputs = found["provenance"]["inputs"].as_array().expect("two inputs");
    assert!(inputs.len() == 2 && inputs[0][0] == "a.exr" && inputs[0][1].as_str().is_some_and(|hex| hex.len() == 64));
    let read = |name: &str| std::fs::read(folder.path().join("maps").join(name)).expect("written");
    let numbers = Picture::decode(&read("difference.exr")).expect("our own EXR");
    assert!(numbers.floats("R").expect("red").1.iter().all(|&difference| difference == 0.25));
    assert!(numbers.floats("G").expect("green").1.iter().all(|&difference| difference == 0.0));
    assert_eq!(numbers.floats("FLIP").expect("FLIP").1.len(), 192);
    // 12 rows, a gap of one row, and a color bar of two.
    assert_eq!(Picture::decode(&read("difference.png")).expect("our own PNG").height(), 15);
    for name in ["flip.png", "first.png", "second.png", "index.html", "study.json", "channels.csv"] {
        assert!(!read(name).is_empty(), "{name}");
    }
    let software = b"crossbar 0.1.0";
    for name in ["difference.png", "difference.exr"] {
        assert!(read(name).windows(software.len()).any(|bytes| bytes == software), "{name} says what made it");
    }
    let again = diff(folder.path(), &["a.exr", "brighter.exr", "--out", "again", "--scale", "0.1", "--threads", "1"]);
    assert_eq!(again.code, Some(1));
    for name in ["difference.png", "difference.exr", "flip.png", "index.html"] {
        let other = std::fs::read(folder.path().join("again").join(name)).expect("written");
        assert!(other == read(name), "{name} is the same whatever the folder and the threads");
    }
}
