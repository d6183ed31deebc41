//! STL files: both kinds yield the same mesh. `readers` holds that no bytes make the reader panic or allocate too much.

use std::path::Path;

use crossbar::error::InputError;
use crossbar::geom::Mesh;
use crossbar::io::{ModelOptions, load_mesh, load_mesh_with, parse_stl};

use crate::support::file;

const CORNERS: [[[f32; 3]; 3]; 2] =
    [[[0.0, 0.0, 0.0], [1.5, 0.0, 1e-3], [1.0, 1.0, 0.0]], [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-0.25, 1.0, 7.0]]];

/// Binary data with any text as its header.
fn binary(header: &[u8], count: u32) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for corners in CORNERS {
        let numbers = [0.0; 3].into_iter().chain(corners.into_iter().flatten());
        bytes.extend(numbers.flat_map(f32::to_le_bytes).chain([7, 7]));
    }
    bytes
}

fn ascii() -> Vec<u8> {
    let mut text = "solid two triangles\n".to_owned();
    for corners in CORNERS {
        text += "facet normal 0 0 1\nouter loop\n";
        for [x, y, z] in corners {
            text += &format!("vertex {x} {y} {z:e}\n");
        }
        text += "endloop\nendfacet\n";
    }
    (text + "endsolid two triangles\n").into_bytes()
}

fn parse(bytes: &[u8]) -> Result<Mesh, InputError> {
    parse_stl(bytes, Path::new("m.stl"))
}

#[test]
fn both_kinds_give_the_same_mesh() {
    let mesh = parse(&ascii()).expect("a mesh");
    assert_eq!(mesh.iter_corners().collect::<Vec<_>>(), CORNERS);
    assert_eq!((mesh.positions().len(), mesh.edges().len()), (4, 5), "corners at one place are one vertex");
    assert_eq!(parse(&binary(b"by a modeller", 2)).expect("a mesh"), mesh);
    assert_eq!(parse(&binary(b"solid as some modellers begin", 2)).expect("a mesh"), mesh);
}

#[test]
fn stl_is_found_by_ending_and_content() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in [("m.stl", ascii()), ("M.STL", binary(b"", 2)), ("m.dat", ascii()), ("b.dat", binary(b"", 2))]
    {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        assert_eq!(load_mesh(&path).expect("a mesh").iter_corners().collect::<Vec<_>>(), CORNERS, "{name}");
    }
    // Without `--strict`, a file may have trailing data.
    let longer = folder.path().join("longer.stl");
    std::fs::write(&longer, [binary(b"", 2), b"more".to_vec()].concat()).expect("written");
    let (mesh, notes) = load_mesh_with(&longer, ModelOptions::default()).expect("a mesh");
    assert_eq!(mesh.iter_corners().collect::<Vec<_>>(), CORNERS);
    assert_eq!(notes.iter().map(ToString::to_string).collect::<Vec<_>>(), ["4 bytes after the last triangle: ignored"]);
    let models = file("fixtures/models");
    let square = load_mesh(&models.join("square.stl")).expect("a mesh");
    assert_eq!(square, load_mesh(&models.join("square.obj")).expect("a mesh"));
}

/// Variants that programs write and readers accept: several solids, no names or names in Latin-1, keywords in capitals,
/// normals of NaN, blank lines, a byte order mark, lines that end in CR, everything in one line.
#[test]
fn text_in_all_its_forms_gives_the_same_mesh() {
    let plain = String::from_utf8(ascii()).expect("text");
    let mesh = parse(&ascii()).expect("a mesh");
    let facet = plain.find("facet normal 0 0 1\nouter loop\nvertex 0 0 0e0\nvertex 1 1").expect("the second facet");
    let (first, second) = plain.split_at(facet);
    let latin_1 = [&b"solid f\xfcr solid\n"[..], plain.split_once('\n').expect("lines").1.as_bytes()].concat();
    for bytes in [
        format!("{first}endsolid\n\nsolid\n{second}").into_bytes(),
        plain.replace(" two triangles", "").into_bytes(),
        latin_1,
        plain.to_uppercase().into_bytes(),
        format!("\n \r\n{plain}").replace('\n', "\r\n").into_bytes(),
        format!("\u{feff}{plain}").into_bytes(),
        plain.replace('\n', "\r").into_bytes(),
        plain.replace('\n', " ").into_bytes(),
        format!("{first}endsolid a solid\nsolid b {second}").replace('\n', " ").into_bytes(),
        plain.replace("normal 0 0 1", "normal nan -nan(ind) 1.#QNAN").into_bytes(),
        plain.replace("normal 0 0 1\n", "normal 0 0 1 ").replace("\nvertex", "  vertex").into_bytes(),
    ] {
        assert_eq!(parse(&bytes).expect("a mesh"), mesh, "{}", String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn broken_files_are_named() {
    let text = String::from_utf8(ascii()).expect("text");
    let lines = |count: usize| text.split_inclusive('\n').take(count).collect::<String>();
    let utf_16 = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    let mut endless = binary(b"", 2);
    endless[96..100].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let whole = [
        b"v 0 0 0".to_vec(),
        binary(b"solid", u32::MAX >> 8),
        [binary(b"", 2), b"\0more".to_vec()].concat(),
        utf_16(&"solid\n".repeat(40)),
        utf_16(&"\u{feff}solid\n".repeat(40)),
        b"solid nothing\nendsolid nothing\n".to_vec(),
        lines(15).into_bytes(),
        lines(5).into_bytes(),
        b"solid\nfacet normal 0 0".to_vec(),
        endless,
    ];
    let changed = [
        ("1.5", "nan"),
        ("1.5", "1,5"),
        ("vertex 1.5", "edge 1.5"),
        ("endloop", "vertex 0 0 0\nendloop"),
        ("normal 0 0 1", "normal 0 1"),
        ("two triangles\nfacet", "two\ntriangles\nfacet"),
    ];
    let changed = changed.map(|(from, to)| text.replace(from, to).into_bytes());
    let said = whole.iter().chain(&changed).map(|bytes| parse(bytes).expect_err("no mesh").to_string());
    insta::assert_snapshot!("stl_errors", said.collect::<Vec<_>>().join("\n"));
}
