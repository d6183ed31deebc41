//! `crossbar bi-scale`, from the command line.

use std::fs;

use approx::assert_relative_eq;
use serde_json::Value;

use crate::answers::{document_of as document, number, place, refused_line};
use crate::generated::hold_bytes;

const STEP: &str = "docs/examples/step.obj";
const BICLUSTERS: &str = "docs/examples/step_biclusters.npz";

/// From the model to its biclusters, which sum to its matrix; identical bits with any number of threads.
#[test]
fn biclusters_sum_to_transfer() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [matrix, text, biclusters] = ["t.npz", "t.mtx", "b.npz"].map(|name| place(folder.path(), name));
    let mut before: Option<Vec<Vec<u8>>> = None;
    for threads in [1, 3] {
        let made = document(&format!("bi-scale precompute {STEP} --out {matrix} --threads {threads}"));
        document(&format!("bi-scale show {matrix} --matrix {text}"));
        assert_eq!((&made["rows"], &made["columns"]), (&Value::from(70 * 64), &Value::from(6144)));
        let found = document(&format!("bi-scale bicluster {matrix} --out {biclusters} --threads {threads}"));
        assert_eq!(&found["nonzeros"], &made["nonzeros"]);
        assert!(10.0 * number(&found["flops_after"]) < number(&found["flops_before"]), "flat steps are coherent");
        let counts = found["values"].as_array().expect("a histogram");
        assert_eq!(counts.iter().map(|value| number(&value["count"])).sum::<f64>(), number(&made["nonzeros"]));
        assert!(counts.iter().all(|value| (4.0 * number(&value["value"])).fract() == 0.0), "quarters");
        let files = [&matrix, &text, &biclusters].map(|path| fs::read(path).expect("written")).to_vec();
        assert!(before.get_or_insert_with(|| files.clone()) == &files, "{threads} threads");
    }
    hold_bytes(BICLUSTERS.as_ref(), &fs::read(&biclusters).expect("written"));
    let back = place(folder.path(), "back.mtx");
    document(&format!("bi-scale show {biclusters} --matrix {back}"));
    let [made, again] = [&text, &back].map(|path| crossbar::io::load_matrix_market(path.as_ref()).expect("a matrix"));
    assert_eq!(made, again, "the sum of the biclusters");
}

const COURT: &str = "docs/examples/court.obj";
const COURT_BICLUSTERS: &str = "docs/examples/court_biclusters.npz";

/// Fields of the JSON document of a picture of the court scene.
fn drawn(options: &str, out: &str) -> Value {
    document(&format!("bi-scale render {COURT_BICLUSTERS} --model {COURT} --size 24x18 {options} --out {out}"))
}

fn picture(folder: &str, name: &str) -> Vec<[f32; 3]> {
    let bytes = fs::read(format!("{folder}/{name}.exr")).expect("written");
    crossbar::picture::Picture::decode(&bytes).expect("a picture").linear().expect("colors")
}

/// The commands reproduce the example files that the pictures use.
#[test]
fn the_court_has_its_transfer() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [matrix, biclusters] = ["t.npz", "b.npz"].map(|name| place(folder.path(), name));
    let options = "--directions 4 --tangents texture";
    document(&format!("bi-scale precompute {COURT} {options} --out {matrix}"));
    document(&format!("bi-scale bicluster {matrix} --out {biclusters}"));
    hold_bytes(COURT_BICLUSTERS.as_ref(), &fs::read(&biclusters).expect("written"));
    // The matrix and its biclusters produce the same picture, up to single precision.
    let [one, other] = [&matrix, COURT_BICLUSTERS].map(|file| {
        let out = place(folder.path(), "p");
        let options = "--texture mail --texture-size 8 --texture-views 3 --repeat 2 --size 24x18";
        document(&format!("bi-scale render {file} --model {COURT} {options} --out {out}"));
        picture(&out, "picture")
    });
    for (one, other) in one.as_flattened().iter().zip(other.as_flattened()) {
        assert_relative_eq!(one, other, max_relative = 1e-4, epsilon = 1e-6);
    }
}

/// A picture with a texture file equals the picture with the patch from which the file was made; the bits do not depend
/// on the number of threads.
#[test]
fn textures_take_every_way() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [file, sheet, out] = ["b.npy", "s.png", "p"].map(|name| place(folder.path(), name));
    let sizes = "--texels 8 --directions 4 --views 3";
    let mut before: Option<(Vec<u8>, Vec<[f32; 3]>)> = None;
    for threads in [1, 3] {
        let made =
            document(&format!("bi-scale texture tiles {sizes} --out {file} --sheet {sheet} --threads {threads}"));
        assert_eq!(
            (&made["views"], &made["lights"], &made["bytes"]),
            (&9.into(), &16.into(), &(9 * 16 * 64 * 12).into())
        );
        assert!(number(&made["mean_reflectance"][0]) > 0.1);
        let found = drawn(&format!("--texture {file} --repeat 2 --threads {threads}"), &out);
        assert_eq!(found["way"], "biclusters");
        assert!(number(&found["pixels_shown"]) > 100.0);
        let now = (fs::read(&file).expect("written"), picture(&out, "picture"));
        assert!(before.get_or_insert_with(|| now.clone()) == &now, "{threads} threads");
    }
    let (_, of_file) = before.expect("a picture");
    drawn("--texture tiles --texture-size 8 --texture-views 3 --repeat 2", &out);
    assert_eq!(picture(&out, "picture"), of_file);
    // Another texture on the wall changes only the wall's pixels.
    drawn(&format!("--texture {file} --texture wall=bricks --texture-size 8 --texture-views 3 --repeat 2"), &out);
    let both = picture(&out, "picture");
    let changed = both.iter().zip(&of_file).filter(|(a, b)| a != b).count();
    assert!((20..200).contains(&changed), "{changed}");
}

/// Under uniform light, the light's texels and single precision cause no error; a texture with more views and texels
/// has a smaller error; the last step is the difference of both pictures.
#[test]
fn errors_are_told_apart() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let out = place(folder.path(), "p");
    let causes = |texture: &str| {
        let options = format!("--texture bumps {texture} --reference --size 16x12 --light constant --out {out}");
        let document = document(&format!("bi-scale render {COURT_BICLUSTERS} --model {COURT} {options}"));
        document["causes"].as_array().expect("a table").clone()
    };
    let of_coarse = causes("--texture-size 8 --texture-views 4");
    let causes = causes("--texture-size 32 --texture-views 12");
    assert_eq!((causes.len(), of_coarse.len()), (7, 7));
    let step = |cause: &Value| number(&cause["step_percent"]);
    // Uniform light does not depend on the number of texels.
    assert!(step(&causes[0]) < 1e-6 && step(&causes[6]) < 1e-3, "{causes:?}");
    for at in [3, 4] {
        assert!(step(&causes[at]) < 0.6 * step(&of_coarse[at]), "{causes:?}, {of_coarse:?}");
    }
    let last = number(&causes[6]["up_to_here_percent"]);
    let (exact, drawn) = (picture(&out, "reference"), picture(&out, "picture"));
    let squares = |values: &mut dyn Iterator<Item = f32>| values.map(|value| f64::from(value * value)).sum::<f64>();
    let apart = squares(&mut exact.as_flattened().iter().zip(drawn.as_flattened()).map(|(a, b)| a - b));
    let whole = squares(&mut exact.as_flattened().iter().copied());
    assert_relative_eq!(100.0 * (apart / whole).sqrt(), last, max_relative = 1e-3);
}

#[test]
fn transfer_is_shown() {
    let found = document(&format!("bi-scale show {BICLUSTERS}"));
    assert_eq!(found["mesh"]["local_directions"], 64);
    let sizes = found["biclusters"]["sizes"].as_array().expect("sizes");
    let sum = |key: &str| sizes.iter().map(|size| number(&size[key])).sum::<f64>();
    assert_eq!(sum("biclusters"), number(&found["biclusters"]["count"]));
    assert_eq!(sum("operations"), number(&found["biclusters"]["operations"]));
    let of_matrix = document("bi-scale show docs/examples/quarters.mtx");
    let counts: f64 = of_matrix["values"].as_array().expect("values").iter().map(|value| number(&value["count"])).sum();
    assert_eq!(counts, number(&of_matrix["nonzeros"]));
}

#[test]
fn textures_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let file = place(folder.path(), "b.npy");
    document(&format!("bi-scale texture plain --texels 1 --directions 3 --views 2 --out {file}"));
    let damaged = place(folder.path(), "nan.npy");
    let mut bytes = fs::read(&file).expect("written");
    let end = bytes.len();
    bytes[end - 4..].copy_from_slice(&f32::NAN.to_le_bytes());
    fs::write(&damaged, &bytes).expect("written");
    let cut = place(folder.path(), "cut.npy");
    fs::write(&cut, &bytes[..end - 12]).expect("written");
    for (options, said) in [
        (format!("--texture {file}"), "expected 16 directions of light, as in the transfer, found 9"),
        (format!("--texture {damaged}"), "view 3, light 8, row 0, column 0"),
        (format!("--texture {cut}"), "expected 108 x 4 bytes"),
        (format!("--texture {file} --texture-size 8"), "`--texture-size` is for textures of named patches"),
    ] {
        let words = refused_line(&format!("bi-scale render {COURT_BICLUSTERS} --model {COURT} --size 8x6 {options}"));
        assert!(words.contains(said), "{options}: {words}");
    }
}

/// A crease angle below a right angle separates the vertices of floor and wall; a picture must be drawn with the same
/// angle.
#[test]
fn creases_keep_vertices_apart() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [file, out] = ["c.npz", "p"].map(|name| place(folder.path(), name));
    let made = |crease: &str| {
        let options = format!("--directions 2 --tangents texture {crease}");
        number(&document(&format!("bi-scale precompute {COURT} {options} --out {file}"))["vertices"])
    };
    assert_eq!([made(""), made("--crease 100"), made("--crease 30")], [35.0, 35.0, 40.0]);
    let options = "--texture bricks --texture-size 4 --texture-views 2 --size 8x6";
    let render = format!("bi-scale render {file} --model {COURT} {options} --out {out}");
    document(&format!("{render} --crease 30"));
    refused_line(&render);
}

/// A file that a command reads, or has written, is not overwritten by another output.
#[test]
fn inputs_are_not_overwritten() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [file, texture, other] = ["b.npz", "b.npy", "./b.npy"].map(|name| place(folder.path(), name));
    fs::copy(BICLUSTERS, &file).expect("copied");
    for command in [
        format!("bi-scale show {file} --matrix {file}"),
        format!("bi-scale bicluster {file} --out {file}"),
        format!("bi-scale texture plain --texels 1 --directions 1 --views 1 --out {texture} --sheet {texture}"),
        format!("bi-scale texture plain --texels 1 --directions 1 --views 1 --out {texture} --sheet {other}"),
    ] {
        assert!(refused_line(&command).contains("also reads or writes"), "{command}");
    }
    assert_eq!(fs::read(&file).expect("kept"), fs::read(BICLUSTERS).expect("an example"));
}
