//! `intersect`, `render` and `leaky-teapot`.

use std::fs;
use std::path::Path;

use crate::answers::{line_in, names_in};
use crate::crossbar_in;

fn in_project(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path).to_string_lossy().into_owned()
}

#[test]
fn casting_is_timed_apart_from_building() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mesh, rays) = (in_project("fixtures/models/square.obj"), in_project("fixtures/rays/square.csv"));
    let all = ["intersect", "--mesh", &mesh, "--rays", &rays, "--out", "hits.csv", "--time"];
    for more in [&[][..], &["--device", "r200"], &["--caster", "host"], &["--caster", "engine"]] {
        let ran = crossbar_in(folder.path(), &[&all[..], more].concat(), "");
        assert_eq!(ran.code, Some(0), "{}", ran.transcript());
        let [cast, build] = [" s to cast, ", " s to build"].map(|what| ran.stderr.contains(what));
        assert!(cast && build && ran.stderr.starts_with("time: "), "{}", ran.stderr);
        assert_eq!(ran.stdout.contains("engine: "), more.contains(&"engine"), "{}", ran.stdout);
        let ran = crossbar_in(folder.path(), &[&all[..], more, &["--json"]].concat(), "");
        let report = ran.json();
        let seconds = |what: &str| report["time"][what].as_f64().expect("seconds");
        assert!(seconds("cast_s") > 0.0 && seconds("build_s") >= 0.0 && seconds("rays_per_s") > 0.0, "{report}");
        assert_eq!(report["engine"]["rays"].is_u64(), more.contains(&"engine"), "{report}");
    }
}

/// For every command that casts rays, a Ray Engine in single precision finds the same hits as the host.
#[test]
fn the_engine_in_single_precision_computes_what_the_host_does() {
    let (step, court) = (in_project("docs/examples/step.obj"), in_project("docs/examples/court.obj"));
    for line in [
        &["cpca", "precompute", &step, "--order", "3", "--degree", "18"][..],
        &["bi-scale", "precompute", &court, "--directions", "2"],
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let file = |more: &[&str]| {
            let ran = crossbar_in(folder.path(), &[line, &["--out", "a.npz"], more].concat(), "");
            assert_eq!(ran.code, Some(0), "{}", ran.transcript());
            (fs::read(folder.path().join("a.npz")).expect("written"), ran.stdout)
        };
        let [(host, _), (engine, said)] = [file(&[]), file(&["--caster", "engine", "--pass-rays", "32"])];
        assert!(host == engine, "{line:?}");
        assert!(said.contains("rays were tested on the card") && said.contains("engine: 0 of "), "{said}");
    }
}

/// Rays in fixed point leak and change the form factors of a room; in single precision no ray leaks.
#[test]
fn short_formats_leak_into_the_room() {
    let folder = tempfile::tempdir().expect("a folder");
    let line = "radiosity cornell-room-blocks --patches 60 --size 8x8 --solver direct --caster engine \
                --caster-format fp32 --caster-format s3.12 --out r --json";
    let report = line_in(folder.path(), line).json();
    let cell = |row: usize, name: &str| report["casters"][row][name].as_f64().expect("a number");
    for name in ["differing", "factors_percent", "largest_relative", "mean_relative"] {
        assert!(cell(0, name) == 0.0 && cell(1, name) > 0.0, "{name}: {report}");
    }
    assert!(cell(0, "rays") == cell(1, "rays") && cell(0, "on_card_percent") > 50.0, "{report}");
}

#[test]
fn leaky_teapot_writes_everything_it_promises() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments =
        "leaky-teapot --size 20x16 --tessellation 2 --device r200 --device r300 --rays-per-edge 1 --out a/b --json";
    let ran = line_in(folder.path(), arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.transcript());
    let report = ran.json();
    assert_eq!(report["rows"].as_array().map(Vec::len), Some(2), "a row a device");
    assert_eq!(report["provenance"]["version"], env!("CARGO_PKG_VERSION"), "provenance");
    let out = folder.path().join("a/b");
    let names = names_in(&out);
    let expected = "edges.csv exact.exr exact.png index.html r200-map.png \
                    r200.exr r200.png r300-map.png r300.exr r300.png rows.csv study.json";
    assert_eq!(names.join(" "), expected, "these files and no others");
    let page = fs::read_to_string(out.join("index.html")).expect("the page");
    assert!(page.matches("data:image/png;base64,").count() == 5, "exact, two pictures, two maps");
    assert!(!page.contains("http://") && !page.contains("https://"), "self-contained");
    let again = line_in(folder.path(), arguments);
    assert_eq!(again.stdout, ran.stdout, "the same run gives the same report");
    assert_eq!(fs::read_to_string(out.join("index.html")).expect("the page"), page, "and the same page");
}

/// Device files that differ only in rounding keep their roundings if `--format` replaces their format.
#[test]
fn a_format_keeps_the_rounding_of_device_files() {
    let folder = tempfile::tempdir().expect("a folder");
    for rounding in ["rne", "rdn"] {
        let file = format!("device = \"r200\"\n[switches]\nrounding = \"{rounding}\"\n");
        fs::write(folder.path().join(format!("{rounding}.toml")), file).expect("written");
    }
    let arguments = "leaky-teapot --size 32x32 --tessellation 2 --rays-per-edge 0 --device rne.toml --device rdn.toml \
                     --format s3.11 --json";
    let ran = line_in(folder.path(), arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.transcript());
    let report = ran.json();
    assert_eq!([0, 1].map(|row| report["rows"][row]["format"].as_str()), [Some("s3.11"), Some("s3.11:rdn")]);
    assert_eq!(report["same_bits"], serde_json::json!({}), "they trace otherwise");
}
