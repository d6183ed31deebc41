//! Tables that name vertices: by their numbers in the model's file and their places, with errors and radiance.

use std::fs;
use std::path::Path;

use approx::assert_relative_eq;
use crossbar::io::{NumberTable, parse_npy};
use crossbar::picture::Picture;

use crate::answers::{document, place};

/// A square whose file has a vertex that no face uses, and others in another order than that of their first use.
const SQUARE: &str = "v 9 9 9\nv 1 1 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 1\nvt 0 0\nvt 1 0\nvt 0 1\n\
                      f 3/2 4/3 2/1\nf 3/2 2/1 5/4\n";
/// Its vertices, by number.
const PLACES: [[f64; 3]; 5] = [[9.0; 3], [1.0, 1.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// The lines of a table, as fields, without the headings, which must be these.
fn rows(path: &str, headings: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).expect("a table");
    let (first, rest) = text.split_once('\n').expect("headings");
    assert_eq!(first, headings, "{path}");
    rest.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// The number of a vertex belongs to its place.
fn is_named(fields: &[String]) {
    let [vertex, x, y, z] = fields else { panic!("{fields:?}") };
    let at = [x, y, z].map(|field| field.parse::<f64>().expect("a coordinate"));
    assert_eq!(PLACES[vertex.parse::<usize>().expect("a number") - 1], at);
}

#[test]
fn errors_are_told_by_the_models_own_vertices() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let of = |name: &str| place(folder.path(), name);
    let (model, csv) = (of("square.obj"), of("errors.csv"));
    fs::write(&model, SQUARE).expect("written");
    let [low, all] = ["low.npz", "all.npz"].map(of);
    let small = of("small.npz");
    document(&["cpca", "precompute", &model, "--order", "2", "--out", &low]);
    document(&["cpca", "compress", &low, "--clusters", "2", "--vectors", "0", "--out", &small]);
    let found = document(&["cpca", "error", &low, &small, "--model", &model, "--csv", &csv]);
    let table = rows(&csv, "point,cluster,squared_error,squares,model_vertex,x,y,z");
    assert_eq!(table.len(), 4);
    table.iter().for_each(|row| is_named(&row[4..]));
    let largest = &found["largest"];
    let vertex = usize::try_from(largest["of_model"]["model_vertex"].as_u64().expect("a number")).expect("small");
    assert_eq!(largest["of_model"]["position"], serde_json::json!(PLACES[vertex - 1]));
    document(&["cpca", "error", &low, &small, "--csv", &csv]);
    rows(&csv, "point,cluster,squared_error,squares");
    document(&["all-frequency", "precompute", &model, "--out", &all]);
    document(&["all-frequency", "compress", &all, "--model", &model, "--vectors", "1", "--out", &small]);
    document(&["all-frequency", "error", &all, &small, "--model", &model, "--csv", &csv]);
    let table = rows(&csv, "vertex,squared_error,squares,model_vertex,x,y,z");
    assert_eq!(table.len(), 4);
    table.iter().for_each(|row| is_named(&row[3..]));
}

#[test]
fn shown_vertices_have_the_models_numbers() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let of = |name: &str| place(folder.path(), name);
    let (model, file, csv) = (of("square.obj"), of("file.npz"), of("local.csv"));
    fs::write(&model, SQUARE).expect("written");
    for (command, options) in
        [("cpca", &["--order", "2"][..]), ("all-frequency", &[]), ("bi-scale", &["--directions", "2"])]
    {
        document(&[&[command, "precompute", &model, "--out", &file][..], options].concat());
        let at = document(&[command, "show", &file, "--at", "1,0.9,0", "--model", &model]);
        assert_eq!(at["vertex"]["of_model"]["model_vertex"], 2, "{command}");
        let found = at["vertex"]["number"].to_string();
        let same = document(&[command, "show", &file, "--vertex", &found, "--model", &model]);
        assert_eq!(same["vertex"], at["vertex"], "{command}");
        assert!(document(&[command, "show", &file, "--vertex", &found])["vertex"]["of_model"].is_null(), "{command}");
    }
    document(&["bi-scale", "multiply", &file, "--csv", &csv, "--model", &model]);
    let table = rows(&csv, "vertex,direction,r,g,b,model_vertex,x,y,z");
    assert_eq!(table.len(), 4 * 4);
    table.iter().for_each(|row| is_named(&row[5..]));
}

/// Errors of ways to store transfer are told by the model's own vertices.
#[test]
fn ways_to_store_transfer_are_off_at_vertices() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let of = |name: &str| place(folder.path(), name);
    let (model, file, csv) = (of("square.obj"), of("file.npz"), of("errors.csv"));
    fs::write(&model, SQUARE).expect("written");
    document(&["bi-scale", "precompute", &model, "--directions", "2", "--out", &file]);
    let small = ["--clusters", "2", "--vectors", "1", "--sample", "8", "--csv", &csv];
    let compare = |more: &[&str]| document(&[&["bi-scale", "compare", &file][..], &small, more].concat());
    let found = compare(&["--model", &model]);
    let text = fs::read_to_string(&csv).expect("a table");
    let (headings, lines) = text.split_once('\n').expect("headings");
    assert_eq!(headings, "way,vertex,squared_error,squares,model_vertex,x,y,z");
    let ways = found["ways"].as_array().expect("a list");
    assert_eq!(lines.lines().count(), 4 * ways.len());
    let rows: Vec<(String, Vec<String>)> = lines
        .lines()
        .map(|line| {
            let (way, fields) = line[1..].split_once("\",").expect("a name");
            (way.to_owned(), fields.split(',').map(str::to_owned).collect())
        })
        .collect();
    rows.iter().for_each(|(_, fields)| is_named(&fields[3..]));
    for (way, rows) in ways.iter().zip(rows.chunks_exact(4)) {
        assert!(rows.iter().all(|(name, _)| way["way"] == name.as_str()), "{way}");
        let error = |fields: &[String]| fields[1].parse::<f64>().expect("a number");
        let most = rows.iter().map(|(_, fields)| error(fields)).fold(0.0, f64::max);
        let at = usize::try_from(way["most"]["vertex"].as_u64().expect("a number")).expect("small");
        let of_model = &way["most"]["of_model"]["model_vertex"];
        assert_eq!((error(&rows[at].1), of_model.to_string()), (most, rows[at].1[3].clone()), "{way}");
        assert_relative_eq!(way["most"]["squared_error"].as_f64().expect("a number"), most);
        // The sum over vertices is what the whole is off by: 16 rows in 3 channels.
        let sum: f64 = rows.iter().map(|(_, fields)| error(fields)).sum();
        let rms = way["rms"].as_f64().expect("a number");
        assert_relative_eq!(sum, 48.0 * rms * rms, max_relative = 1e-9, epsilon = 1e-300);
    }
    compare(&[]);
    let text = fs::read_to_string(&csv).expect("a table");
    assert!(text.starts_with("way,vertex,squared_error,squares\n"), "{text}");
}

/// A card's study writes the radiance that `render` writes, from the numbers that the card draws.
#[test]
fn cards_write_radiance_of_vertices_too() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let of = |name: &str| place(folder.path(), name);
    let (model, file, small, page) = (of("square.obj"), of("file.npz"), of("small.npz"), of("page"));
    fs::write(&model, SQUARE).expect("written");
    let plain = of("plain.npy");
    document(&["bi-scale", "texture", "plain", "--texels", "2", "--directions", "2", "--views", "2", "--out", &plain]);
    let model_of = ["--model", model.as_str()];
    for (command, made, compress, drawn) in [
        ("cpca", &["--order", "3"][..], &["compress", &file, "--clusters", "1", "--vectors", "1"][..], &[][..]),
        ("all-frequency", &[], &["compress", &file, "--vectors", "1", "--model", &model], &[]),
        ("bi-scale", &["--directions", "2", "--tangents", "texture"], &["bicluster", &file], &["--texture", &plain]),
    ] {
        document(&[&[command, "precompute", &model, "--out", &file][..], made].concat());
        document(&[&[command][..], compress, &["--out", &small]].concat());
        let values = |verb: &str| {
            let fixed = [command, verb, &small, "--light", "constant:2,1,0.5", "--eye", "0.5,0.4,3"];
            let out = ["--up", "0,1,0", "--size", "12x12", "--out", &page, "--values", "csv"];
            document(&[&fixed[..], &model_of, &out, drawn].concat());
            rows(&format!("{page}/vertices.csv"), "vertex,model_vertex,x,y,z,red,green,blue")
        };
        let [on_host, on_card] = ["render", "card"].map(values);
        assert_eq!((on_host.len(), on_card.len()), (4, 4), "{command}");
        for (host, card) in on_host.iter().zip(&on_card) {
            is_named(&card[1..5]);
            assert_eq!(host[..5], card[..5]);
            for (host, card) in host[5..].iter().zip(&card[5..]) {
                let [host, card] = [host, card].map(|field| field.parse::<f64>().expect("a number"));
                assert!(host > 0.01, "{command}: {host}");
                assert_relative_eq!(host, card, max_relative = 1e-4);
            }
        }
    }
}

/// Vertices of a fold whose `v` lines stand twice, in the order in which its faces name them.
#[test]
fn vertices_at_one_place_have_the_numbers_that_faces_name() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let of = |name: &str| place(folder.path(), name);
    let (model, file, page) = (of("fold.obj"), of("file.npz"), of("page"));
    let text = "v 0 0 0\nv 0 0 0\nv 0 0 1\nv 0 1 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 1 0 0\n\
                f 2//1 5//1 6//1\nf 1//2 4//2 3//2\n";
    fs::write(&model, text).expect("written");
    document(&["cpca", "precompute", &model, "--order", "2", "--out", &file]);
    let view = ["--model", &model, "--light", "constant", "--eye", "2,2,2", "--size", "8x8", "--out", &page];
    document(&[&["cpca", "render", &file, "--values", "csv"][..], &view].concat());
    let table = rows(&format!("{page}/vertices.csv"), "vertex,model_vertex,x,y,z,red,green,blue");
    let numbers: Vec<&str> = table.iter().map(|row| row[1].as_str()).collect();
    assert_eq!(numbers, ["2", "5", "6", "1", "4", "3"]);
}

/// The array of a page.
fn array(page: &str) -> NumberTable<f64> {
    let path = Path::new(page).join("vertices.npy");
    parse_npy(&fs::read(&path).expect("an array"), &path).expect("an array")
}

/// Radiance of vertices is that of the pixels between them, in a table and in an array.
#[test]
fn radiance_of_vertices_is_written_as_numbers() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let of = |name: &str| place(folder.path(), name);
    let (model, file, page) = (of("square.obj"), of("file.npz"), of("page"));
    fs::write(&model, SQUARE).expect("written");
    let plain = of("plain.npy");
    document(&["bi-scale", "texture", "plain", "--texels", "2", "--directions", "2", "--views", "2", "--out", &plain]);
    for (command, made, drawn) in [
        ("cpca", &["--order", "3"][..], &[][..]),
        ("all-frequency", &[], &[]),
        ("bi-scale", &["--directions", "2", "--tangents", "texture"], &["--texture", &plain]),
    ] {
        document(&[&[command, "precompute", &model, "--out", &file][..], made].concat());
        let render = |format: &str| {
            let fixed =
                [command, "render", &file, "--model", &model, "--light", "constant:2,1,0.5", "--eye", "0.5,0.5,3"];
            let out = ["--up", "0,1,0", "--size", "12x12", "--out", &page, "--values", format];
            document(&[&fixed[..], &out, drawn].concat())
        };
        render("csv");
        let headings = "vertex,model_vertex,x,y,z,red,green,blue";
        let table = rows(&format!("{page}/vertices.csv"), headings);
        let bytes = fs::read(Path::new(&page).join("picture.exr")).expect("a picture");
        let pixels = Picture::decode(&bytes).and_then(|picture| picture.linear()).expect("a picture");
        render("npy");
        let array = array(&page);
        assert_eq!((table.len(), array.columns, array.values.len()), (4, 6, 24), "{command}");
        for (row, of_array) in table.iter().zip(array.values.chunks_exact(6)) {
            is_named(&row[1..5]);
            let numbers: Vec<f64> = row[2..].iter().map(|field| field.parse().expect("a number")).collect();
            for (number, of_array) in numbers.iter().zip(of_array) {
                assert_relative_eq!(*number, *of_array, max_relative = 1e-6);
            }
            for (channel, radiance) in numbers[3..].iter().enumerate() {
                let largest = pixels.iter().map(|pixel| pixel[channel]).fold(0.0, f32::max);
                assert_relative_eq!(*radiance, f64::from(largest), max_relative = 0.02);
            }
        }
    }
}
