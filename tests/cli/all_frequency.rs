//! `crossbar all-frequency`, from the command line.

use std::fs;

use serde_json::Value;

use crate::answers::{document_of as document, number, place, refused_line};
use crate::crossbar;

const STEP: &str = "docs/examples/step.obj";
const SIGHT: &str = "docs/examples/step_all.npz";
const CODED: &str = "docs/examples/step_all_small.npz";

#[test]
fn the_examples_are_made_by_the_commands() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let out = place(folder.path(), "out.npz");
    for threads in [1, 3] {
        let made = document(&format!("all-frequency precompute {STEP} --out {out} --threads {threads}"));
        assert_eq!(fs::read(&out).expect("written"), fs::read(SIGHT).expect("an example"), "{threads} threads");
        assert_eq!((&made["segments_below_horizon"]["least"], &made["terms"]), (&Value::from(4), &Value::from(1)));
        let options = format!("--points-per-cluster 40 --vectors 4 --out {out} --threads {threads}");
        let made = document(&format!("all-frequency compress {SIGHT} --model {STEP} {options}"));
        assert_eq!(fs::read(&out).expect("written"), fs::read(CODED).expect("an example"), "{threads} threads");
        assert_eq!(made["bytes"]["raw"], 70 * 6144 * 4);
        assert!(number(&made["bytes"]["coded"]) < number(&made["bytes"]["clustered"]));
        let [before, after] = ["squared_error_before_coding", "squared_error"].map(|field| number(&made[field]));
        assert!(before > 1e-4 && before < 2e-3 && (after - before).abs() < 1e-3 * before, "{before}, {after}");
    }
}

/// An interrupted compression resumes and writes the same file; finished segments are reused only for the same work.
#[test]
fn finished_segments_are_kept() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [out, kept] = ["out.npz", "kept"].map(|name| place(folder.path(), name));
    let options =
        format!("all-frequency compress {SIGHT} --model {STEP} --points-per-cluster 40 --vectors 4 --resume {kept}");
    let in_all = document(&format!("{options} --out {out}"));
    assert_eq!(in_all["segments_kept"], 0);
    // Same as after an interruption before segment 9: missing segments are computed, existing ones are read.
    for segment in 9..24 {
        fs::remove_file(folder.path().join(format!("kept/segment-{segment:02}.kept"))).expect("a finished segment");
    }
    let again = document(&format!("{options} --out {out}"));
    assert_eq!(again["segments_kept"], 9);
    assert_eq!(fs::read(&out).expect("written"), fs::read(CODED).expect("an example"));
    for field in ["squared_error", "squared_error_before_coding", "bytes", "omega"] {
        assert_eq!(again[field], in_all[field], "{field}");
    }
    let other = refused_line(&format!("{options} --bits 12 --out {out}"));
    assert!(other.contains("segment-00.kept: expected a result of crossbar"), "{other}");
    assert!(
        other.contains("--bits 12") && other.contains("found a result of crossbar all-frequency compress"),
        "{other}"
    );
    assert!(other.contains("--bits 16") && other.contains("choose another folder"), "{other}");
    let signal = place(folder.path(), "signal.npz");
    fs::copy(SIGHT, &signal).expect("a copy");
    let of_copy = options.replace(SIGHT, &signal);
    refused_line(&format!("{of_copy} --out {out}"));
    // A damaged segment is computed again.
    fs::write(folder.path().join("kept/segment-03.kept"), "{}").expect("written");
    assert_eq!(document(&format!("{options} --out {out}"))["segments_kept"], 23);
    assert_eq!(fs::read(&out).expect("written"), fs::read(CODED).expect("an example"));
}

/// The picture differs from the original's picture by little.
#[test]
fn the_picture_of_a_code_is_near_the_original() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let page = place(folder.path(), "page");
    let options = format!("--light sky:1,-1,1 --size 32x24 --original {SIGHT} --out {page}");
    let drawn = document(&format!("all-frequency render {CODED} --model {STEP} {options}"));
    let apart = number(&drawn["picture_rms_percent"]);
    assert!(apart > 0.01 && apart < 5.0, "{apart} %");
    assert_eq!(drawn["kept"], drawn["nonzero"]);
    assert!(fs::metadata(folder.path().join("page/index.html")).is_ok());
}

/// A ground is precomputed, compressed and drawn with its model; each blocks light from the other.
#[test]
fn a_model_stands_on_a_ground() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [out, ground, ground_model, small, page] =
        ["on.npz", "on.ground.npz", "on.ground.obj", "small/g.npz", "page"].map(|name| place(folder.path(), name));
    fs::create_dir(folder.path().join("small")).expect("a folder");
    let alone = document(&format!("all-frequency precompute {STEP} --out {out}"));
    assert_eq!(alone["ground"], Value::Null);
    let made = document(&format!("all-frequency precompute {STEP} --ground 8 --out {out}"));
    assert_eq!((&made["ground"]["vertices"], &made["ground"]["terms"]), (&Value::from(64), &Value::from(1)));
    assert_eq!(
        (made["ground"]["out"].as_str(), made["ground"]["model"].as_str()),
        (Some(ground.as_str()), Some(ground_model.as_str()))
    );
    // The example's base is flat, at 0, and 2 wide: a ground in its plane would z-fight.
    let ground_text = fs::read_to_string(&ground_model).expect("a model");
    let heights =
        ground_text.lines().filter_map(|line| line.strip_prefix("v ")?.split(' ').nth(2)?.parse::<f32>().ok());
    assert!(
        heights.clone().count() == 64 && heights.clone().all(|z| z == -2.0 / 1024.0),
        "{:?}",
        heights.min_by(f32::total_cmp)
    );
    let sees = |found: &Value| number(&found["directions_visible"]);
    assert!(sees(&made) <= sees(&alone), "a ground hides light");
    // Half of all directions, minus those that the model blocks.
    assert!(sees(&made["ground"]) < 64.0 * 49_152.0 && sees(&made["ground"]) > 32.0 * 49_152.0);
    document(&format!(
        "all-frequency compress {ground} --model {ground_model} --points-per-cluster 16 --vectors 3 --out {small}"
    ));
    assert_eq!(document(&format!("all-frequency show {small}"))["model"], "../on.ground.obj");
    for (verb, picture) in [("render", "picture"), ("card --device ideal-fp32 --exposure 0.5", "host")] {
        let pictures = ["", &format!(" --ground {ground}"), &format!(" --ground {small}")].map(|options| {
            document(&format!(
                "all-frequency {verb} {out} --model {STEP} --light constant --size 32x24 --out {page}{options}"
            ));
            fs::read(folder.path().join(format!("page/{picture}.png"))).expect("a picture")
        });
        assert!(pictures[0] != pictures[1] && pictures[1] != pictures[2], "{verb}: the ground, and its compression");
    }
    let kept = fs::read(&ground_model).expect("a model");
    let over = crossbar(&["all-frequency", "precompute", &ground_model, "--ground", "8", "--out", &out], "");
    assert_eq!(over.code, Some(2), "the ground's model would overwrite the model: {}", over.stderr);
    assert_eq!(fs::read(&ground_model).expect("a model"), kept);
    let other = crossbar(&["all-frequency", "render", &out, "--model", STEP, "--ground", SIGHT, "--out", &page], "");
    assert_eq!(other.code, Some(2), "a file that names no model is no ground: {}", other.stderr);
}
