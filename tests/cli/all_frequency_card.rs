//! `crossbar all-frequency card`, from the command line.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::answers::{document, number, place, refused};

const MODEL: &str = "docs/examples/step.obj";
const SIGHT: &str = "docs/examples/step_all.npz";
const CODED: &str = "docs/examples/step_all_small.npz";

/// Writes the model's visibility and its transfer compressed with ten glossy terms; returns both paths.
fn glossy(folder: &Path) -> [String; 2] {
    let [factors, sight, coded] = ["factors", "sight.npz", "coded.npz"].map(|name| place(folder, name));
    let of_factors = ["--brdf", "cook-torrance", "--side", "16", "--terms", "10"];
    document(&[&["all-frequency", "factor"], &of_factors[..], &["--out", &factors]].concat());
    let of_sight = ["--reflectance", &factors, "--out", &sight];
    document(&[&["all-frequency", "precompute", MODEL], &of_sight[..]].concat());
    let of_code = ["--model", MODEL, "--points-per-cluster", "20", "--vectors", "6", "--out", &coded];
    document(&[&["all-frequency", "compress", &sight], &of_code[..]].concat());
    [sight, coded]
}

fn drawn(file: &str, out: &str, options: &[&str]) -> Value {
    let fixed = ["all-frequency", "card", file, "--model", MODEL, "--size", "48x36", "--exposure", "0.5", "--out", out];
    document(&[&fixed[..], options].concat())
}

fn rms(found: &Value) -> f64 {
    number(&found["difference"]["rms_255ths"])
}

/// Both methods draw the host's picture up to rounding, on both cards; the diffuse example has one term, drawn as
/// colors.
#[test]
fn cards_draw_what_the_host_draws() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let out = place(folder.path(), "out");
    let [_, coded] = glossy(folder.path());
    let ideal = drawn(&coded, &out, &["--device", "ideal-fp32"]);
    let r350 = drawn(&coded, &out, &[]);
    // Rounding errors of the target, uniform up to half a 255th, have an RMS of 0.29.
    for found in [&ideal, &r350] {
        assert!(rms(found) > 0.1 && rms(found) < 0.35, "{}", rms(found));
    }
    assert!(ideal["time"].is_null());
    let size = |found: &Value, what: &str| {
        let rows = found["sizes"].as_array().expect("sizes");
        rows.iter().find(|row| row["what"] == what).unwrap_or_else(|| panic!("{what}"))["number"].clone()
    };
    assert_eq!((size(&r350, "numbers interpolated per pass"), size(&r350, "passes")), (32.into(), 1.into()));
    assert_eq!(
        (size(&r350, "texture reads of the pixel program"), size(&r350, "bytes sent per vertex")),
        (3.into(), 120.into())
    );
    assert_eq!(r350["time"].as_array().expect("times").len(), 6);
    let nv35 = drawn(&coded, &out, &["--device", "nv35"]);
    assert_eq!(size(&nv35, "texture reads of the pixel program"), 5, "two terms per texel of 16 bits");
    let colors = drawn(&coded, &out, &["--way", "colors"]);
    assert_eq!(size(&colors, "bytes sent per vertex"), 4);
    let step = |found: &Value, what: &str| {
        let rows = found["blame"].as_array().expect("blame");
        let row = rows.iter().find(|row| row["step"].as_str().is_some_and(|step| step.contains(what)));
        number(&row.unwrap_or_else(|| panic!("{what}"))["rms_255ths"])
    };
    // Both methods lose the same highlights between vertices, so this step compares equal pictures.
    assert_eq!(step(&colors, "interpolated, not products"), step(&r350, "interpolated, not products"));
    assert!(step(&r350, "single precision") < 1e-3);
    let diffuse = drawn(CODED, &out, &["--original", SIGHT, "--keep", "40"]);
    assert!(rms(&diffuse) < 0.8, "{}", rms(&diffuse));
    assert!(step(&diffuse, "light coefficients left out") > step(&diffuse, "single precision"));
    assert!(step(&diffuse, "compression and coding") > 0.0);
    let steps = diffuse["blame"].as_array().expect("blame").iter().map(|row| row["step"].to_string());
    assert!(steps.into_iter().all(|step| !step.contains("not products")), "one term has no other way");
}

/// More bits give smaller errors for each quantity; files and pages are in the folder of the command.
#[test]
fn a_sweep_says_what_shows() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let out = place(folder.path(), "out");
    let [sight, coded] = glossy(folder.path());
    let found = drawn(&coded, &out, &["--sweep", "--original", &sight]);
    let rows = found["precision"].as_array().expect("a sweep");
    let of = |what: &str, choice: &str| {
        let row = rows.iter().find(|row| row["what"] == what && row["choice"] == choice);
        number(&row.unwrap_or_else(|| panic!("{what} {choice}"))["rms_255ths"])
    };
    for what in ["representatives", "weights"] {
        // Four bits reduce the error 16 times on average. In one small picture under a sun, with few relevant
        // coefficients, the error is at least halved.
        for [coarse, fine] in [["8 bits", "12 bits"], ["10 bits", "14 bits"]] {
            assert!(of(what, coarse) > 2.0 * of(what, fine), "{what}: {coarse} against {fine}");
        }
    }
    assert!(of("bits of G", "8") > 4.0 * of("bits of G", "12") && of("bits of G", "12") > 4.0 * of("bits of G", "16"));
    assert!(of("pixel arithmetic", "ideal-fp24") < of("pixel arithmetic", "ideal-fp16"));
    assert!(of("vertex colors", "r350: bytes") > of("vertex colors", "floats, fp32"));
    for name in ["index.html", "precision.csv", "blame.csv", "card.exr", "timeline.json", "card.png"] {
        assert!(folder.path().join("out").join(name).exists(), "{name}");
    }
    // Raw transfer is drawn too; there are no weights to quantize.
    let raw = drawn(&sight, &out, &["--sweep"]);
    assert!(raw["precision"].as_array().expect("a sweep").iter().all(|row| row["what"] != "weights"));
}

/// Conflicting options, and options that suit no card, are refused with advice, and nothing is written.
#[test]
fn what_no_card_takes_is_refused() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [_, coded] = glossy(folder.path());
    let out = place(folder.path(), "out");
    for (file, options, words) in [
        ("docs/examples/step_small.npz", "--way colors", "`crossbar cpca` takes it"),
        (CODED, "--original docs/examples/step_all_small.npz", "expected visibility with the same reflectance"),
        (&coded, "--original docs/examples/step_all.npz", "expected visibility with the same reflectance"),
        (&coded, "--device r200", "runs no `ps_2_0` programs"),
        (CODED, "--model white-box", "expected transfer of a mesh with"),
    ] {
        let fixed = ["all-frequency", "card", file, "--size", "8x8", "--out", &out];
        let model = ["--model", MODEL];
        let options: Vec<&str> = options.split(' ').collect();
        let model = if options.contains(&"--model") { &[] } else { &model[..] };
        let said = refused(&[&fixed[..], model, &options].concat());
        assert!(said.contains(words), "{options:?}: {said}");
        assert!(fs::metadata(&out).is_err(), "{options:?}");
    }
}
