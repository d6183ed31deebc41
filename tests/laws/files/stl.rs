//! STL files: both kinds give the same mesh, and no bytes make the reader panic or take more than they support.

use std::path::Path;

use crossbar::geom::Mesh;
use crossbar::io::{ModelError, load_mesh, load_obj, parse_stl};
use proptest::prelude::*;

use super::mutation::mutated;

const CORNERS: [[[f32; 3]; 3]; 2] =
    [[[0.0, 0.0, 0.0], [1.5, 0.0, 1e-3], [1.0, 1.0, 0.0]], [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-0.25, 1.0, 7.0]]];

/// Binary data with any text as their header.
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

fn parse(bytes: &[u8]) -> Result<Mesh, ModelError> {
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
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/models");
    let square = load_mesh(&models.join("square.stl")).expect("a mesh");
    assert_eq!(square, load_obj(&models.join("square.obj")).expect("a mesh"));
}

#[test]
fn broken_files_are_named() {
    let message = |bytes: &[u8]| parse(bytes).expect_err("no mesh").to_string();
    let expected = "m.stl: expected an STL file: `solid`, or binary data of the length that they claim, found ";
    assert_eq!(message(b"v 0 0 0"), format!("{expected}7 bytes"));
    assert_eq!(message(&binary(b"", u32::MAX)), format!("{expected}184 bytes of 214748364834"));
    assert_eq!(message(b"solid nothing\nendsolid nothing\n"), "m.stl: expected at least one triangle, found none");
    let cut = &ascii()[..100];
    assert!(
        message(cut).starts_with("m.stl: expected an STL file, found one that stl_io refuses: "),
        "{}",
        message(cut)
    );
    let nan = String::from_utf8(ascii()).expect("text").replace("1.5", "nan");
    let refused = "m.stl: expected an STL file, found one that stl_io refuses: expected finite f32";
    assert!(message(nan.as_bytes()).starts_with(refused), "{}", message(nan.as_bytes()));
    let mut endless = binary(b"", 2);
    endless[96..100].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert!(parse(&endless).is_err(), "in binary data, too");
}

proptest! {
    #[test]
    fn mutated_files_do_no_harm(text in mutated(ascii(), 1..8), data in mutated(binary(b"solid", 2), 1..8)) {
        for bytes in [text, data] {
            if let Ok(mesh) = parse(&bytes) {
                prop_assert!(mesh.len() <= 2);
            }
        }
    }

    #[test]
    fn arbitrary_data_do_no_harm(
        head in prop::sample::select(vec![&b""[..], b"solid ", b"solid x\nfacet normal 0 0 1\nouter loop\nvertex "]),
        bytes in prop::collection::vec(any::<u8>(), 0..400),
    ) {
        if let Ok(mesh) = parse(&[head, &bytes].concat()) {
            prop_assert!(mesh.len() * 50 <= bytes.len() + head.len());
        }
    }
}
