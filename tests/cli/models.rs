//! Model files of all kinds, for every command that reads them: repairs are reported, and options change how a file is
//! read.

use std::fs;
use std::path::Path;

use crate::answers::{folder_with, line_in as run};

const BLENDER: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nusemtl m\nf 1 2 3\nf 1 4 3\n";
const RAYS: &str = "ox,oy,oz,dx,dy,dz\n0.75,-1,0.25,0,1,0\n0.25,-1,0.75,0,1,0\n";

fn folder() -> tempfile::TempDir {
    let mtl = "newmtl m\nNs 225\nKd 0.8 0.8 0.8\nKs 0.5 0.5 0.5\nd 1\nillum 2\n";
    folder_with(&[("m.obj", BLENDER), ("m.mtl", mtl), ("r.csv", RAYS)])
}

/// Every command that reads a model reports its repaired defects in the same words.
#[test]
fn what_is_mended_is_said_by_every_command() {
    let folder = folder();
    let turned = "warning: m.obj: 1 triangle flipped, to face like the neighbours\n";
    let scaled = "warning: m.obj: m.mtl:1: material m: `Kd` and `Ks` scaled by 1 / 1.3, to reflect at most all light\n";
    for (line, materials) in [
        ("intersect --mesh m.obj --rays r.csv --out h.csv", false),
        ("render m.obj --size 4x4 --out p", false),
        ("render m.obj --renderer eye --size 4x4 --out q", true),
        ("atlas m.obj --side 16", true),
        ("leaks --mesh m.obj --size 4x4 --device r300 --out l", true),
    ] {
        let ran = run(folder.path(), line);
        assert_eq!(ran.code, Some(0), "{line}: {}", ran.transcript());
        assert!(ran.stderr.contains(turned), "{line}: {}", ran.stderr);
        assert_eq!(ran.stderr.contains(scaled), materials, "{line}: {}", ran.stderr);
        assert_eq!(ran.stderr.matches(turned).count(), 1, "{line}: said once");
    }
    // With `--json`, each warning is a document on a line of its own.
    let json = run(folder.path(), "atlas m.obj --side 16 --json").stderr;
    let warnings: Vec<serde_json::Value> =
        json.lines().map(|line| serde_json::from_str(line).expect("a document")).collect();
    assert!(warnings.len() == 2 && warnings.iter().all(|warning| warning["severity"] == "warning"), "{json}");
    let hits = fs::read_to_string(folder.path().join("h.csv")).expect("hits");
    assert_eq!(hits, "ray,triangle,t\n0,0,1.0\n1,1,1.0\n".replace(".0", ""), "both faces look the same way");
}

#[test]
fn a_model_with_y_up_stands_up() {
    let folder = folder();
    let stl = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/models/square.stl");
    fs::copy(stl, folder.path().join("square.stl")).expect("copied");
    // The square lies in z = 0 of its file; with y up it lies in y = 0.
    let hits = |options: &str| {
        let ran =
            run(folder.path(), &format!("intersect --mesh square.stl --rays r.csv --sides both{options} --out h.csv"));
        assert_eq!(ran.code, Some(0), "{}", ran.transcript());
        ran.stdout.split(' ').next().map(str::to_owned)
    };
    assert_eq!([hits(""), hits(" --model-up z"), hits(" --model-up y")].map(Option::unwrap), ["0", "0", "2"]);
    for line in ["render office --model-up y --size 4x4", "atlas stand-in-head --model-up y"] {
        let ran = run(folder.path(), line);
        assert_eq!(ran.code, Some(2), "{line}");
        assert!(ran.stderr.contains("is for model files, but `"), "{}", ran.stderr);
    }
    for line in ["alu add --model-up y", "leaky-teapot --model-up y", "intersect --mesh square.stl --model-up x"] {
        assert_eq!(run(folder.path(), line).code, Some(2), "{line}");
    }
}

/// The distance is 2^33 / 2^-100 = 2^133.
#[test]
fn a_hit_beyond_f32_has_its_distance() {
    let folder = folder();
    let [near, z] = [27, 160].map(|exponent: u32| f32::from_bits(exponent << 23));
    let far = format!("v -1 -1 {z}\nv 1 -1 {z}\nv 0 1 {z}\nf 1 2 3\n");
    fs::write(folder.path().join("far.obj"), far).expect("written");
    let rays = format!("\u{feff}ox,oy,oz,dx,dy,dz\n0,0,0,0,0,{near}\n9,0,0,0,0,1\n");
    fs::write(folder.path().join("far.csv"), rays).expect("written");
    for caster in ["", " --device ideal-fp32", " --caster host", " --caster engine"] {
        let line = format!("intersect --mesh far.obj --rays far.csv --sides both{caster} --out h.csv");
        let ran = run(folder.path(), &line);
        assert_eq!(ran.code, Some(0), "{}", ran.transcript());
        let hits = fs::read_to_string(folder.path().join("h.csv")).expect("hits");
        assert_eq!(hits, "ray,triangle,t\n0,0,1.0889035741470031e40\n1,-1,inf\n", "{caster}");
    }
}

/// `crossbar leaks` accepts any model and rays, and writes verdicts, map and page as for the teapot.
#[test]
fn leaks_of_any_model() {
    let folder = folder();
    let project = |path: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join(path).display().to_string();
    let (mesh, rays) = (project("docs/examples/teapot.obj"), project("docs/examples/rays.csv"));
    let line = format!("leaks --mesh {mesh} --size 24x24 --device r200 --rays-per-edge 1 --out a --json");
    let ran = run(folder.path(), &line);
    assert_eq!(ran.code, Some(0), "{}", ran.transcript());
    let report = ran.json();
    assert!(report["rows"][0]["hits"].as_u64().is_some_and(|hits| hits > 50), "{report}");
    assert!(report["edges"][0]["edge_rays"].as_u64().is_some_and(|rays| rays > 50), "{report}");
    let page = fs::read_to_string(folder.path().join("a/index.html")).expect("the page");
    assert!(page.contains("Leaks of ") && page.contains("a leak: no hit where there is a surface"));

    let line = format!("leaks --mesh {mesh} --rays {rays} --device r200 --device r300 --out b --json");
    let ran = run(folder.path(), &line);
    assert_eq!(ran.code, Some(0), "{}", ran.transcript());
    let report = ran.json();
    let rows = report["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 2);
    // `intersect` finds the same number of hits.
    for (row, device) in rows.iter().zip(["r200", "r300"]) {
        let line = format!("intersect --mesh {mesh} --rays {rays} --device {device} --out h.csv --json");
        let asked = run(folder.path(), &line).json();
        assert_eq!(row["hits"], asked["hits"], "{device}");
    }
    for name in ["r200-map.png", "r300-map.png", "exact.exr", "rows.csv"] {
        assert!(folder.path().join("b").join(name).is_file(), "{name}");
    }
}

/// Rays with separate origins at small triangles leave no significant bits of t on a 16-bit card; the program warns
/// about it.
#[test]
fn a_format_without_bits_is_said() {
    let folder = folder();
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/examples/teapot.obj").display().to_string();
    let mut rays = "ox,oy,oz,dx,dy,dz\n".to_owned();
    for step in 0..40 {
        for place in 0..20 {
            let (x, z) = (f64::from(step) * 0.15 - 3.0, f64::from(place) * 0.15);
            rays += &format!("{x},{},{z},0,1,0\n", -12.0 - 0.5 * f64::from(step % 3));
        }
    }
    fs::write(folder.path().join("many.csv"), rays).expect("written");
    let said = |device: &str| {
        let line = format!("intersect --mesh {mesh} --rays many.csv --device {device} --out h.csv");
        let ran = run(folder.path(), &line);
        assert_eq!(ran.code, Some(0), "{}", ran.transcript());
        ran.stderr
    };
    let warning = said("r200");
    assert!(warning.starts_with("warning: ") && warning.contains("the hit distance t has only "), "{warning}");
    assert_eq!(said("r300"), "");
    let ran = run(folder.path(), &format!("leaks --mesh {mesh} --rays many.csv --device r200 --device r300 --out l"));
    let text = crate::answers::words(&ran.stdout);
    assert!(text.contains("In r200, the hit distance t has only "), "{text}");
}
