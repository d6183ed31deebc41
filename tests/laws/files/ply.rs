//! PLY files: every encoding yields the same mesh, and no bytes make the reader panic.

use std::path::Path;

use crossbar::error::InputError;
use crossbar::geom::Mesh;
use crossbar::io::{ModelOptions, load_mesh, load_mesh_with, parse_ply};
use proptest::prelude::*;

use crate::support::file;

const ENCODINGS: [&str; 3] = ["ascii", "binary_little_endian", "binary_big_endian"];

const HEADER: &str = "comment caf\u{e9}\nobj_info none\nelement vertex 5\nproperty float x\n\
                      property double y\nproperty short z\nproperty float nx\nproperty float ny\nproperty float nz\n\
                      property uchar red\nproperty float u\nproperty float v\nelement edge 1\nproperty int vertex1\n\
                      property list ushort double weights\nelement face 2\nproperty uchar flags\n\
                      property list uint8 int32 vertex_indices\nend_header\n";

const VERTICES: [[f32; 3]; 5] =
    [[0.0, 0.0, 0.0], [1.5, 0.0, 3.0], [1.0, 1e-3, 2.0], [-0.5, 1.0, -1.0], [0.5, 7.0, 3.0]];

/// Numbers in an encoding.
struct Encoder {
    encoding: &'static str,
    bytes: Vec<u8>,
}

impl Encoder {
    fn put<const N: usize>(&mut self, value: impl ToString, big_endian: [u8; N]) {
        match self.encoding {
            "ascii" => self.bytes.extend(format!("{} ", value.to_string()).bytes()),
            "binary_big_endian" => self.bytes.extend(big_endian),
            _ => self.bytes.extend(big_endian.iter().rev()),
        }
    }

    fn end(&mut self) {
        if self.encoding == "ascii" {
            self.bytes.push(b'\n');
        }
    }
}

fn encoded(encoding: &'static str) -> Vec<u8> {
    let mut out = Encoder { encoding, bytes: format!("ply\nformat {encoding} 1.0\n{HEADER}").into_bytes() };
    let float = |out: &mut Encoder, value: f32| out.put(value, value.to_be_bytes());
    for (red, [x, y, z]) in (0_u8..).zip(VERTICES) {
        float(&mut out, x);
        out.put(f64::from(y), f64::from(y).to_be_bytes());
        out.put(z as i16, (z as i16).to_be_bytes());
        [0.0, 0.6, 0.8].into_iter().for_each(|value| float(&mut out, value));
        out.put(red, [red]);
        [x, 0.5].into_iter().for_each(|value| float(&mut out, value));
        out.end();
    }
    out.put(7, 7_i32.to_be_bytes());
    out.put(2, 2_u16.to_be_bytes());
    [0.5_f64, -3.25].into_iter().for_each(|value| out.put(value, value.to_be_bytes()));
    out.end();
    for face in [&[0_i32, 1, 2, 3][..], &[4, 2, 1]] {
        out.put(1, [1]);
        out.put(face.len(), [face.len() as u8]);
        face.iter().for_each(|index| out.put(index, index.to_be_bytes()));
        out.end();
    }
    out.bytes
}

fn parse(bytes: &[u8]) -> Result<Mesh, InputError> {
    parse_ply(bytes, Path::new("m.ply"))
}

#[test]
fn every_encoding_gives_the_same_mesh() {
    for encoding in ENCODINGS {
        let mesh = parse(&encoded(encoding)).expect(encoding);
        assert_eq!(mesh.positions(), VERTICES, "{encoding}");
        assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [4, 2, 1]], "{encoding}");
        assert_eq!(mesh.normals().map(|normals| normals[4]), Some([0.0, 0.6, 0.8]), "{encoding}");
        assert_eq!(mesh.texcoords().map(|uv| uv[1]), Some([1.5, 0.5]), "{encoding}");
        if encoding == "ascii" {
            let by_cr: Vec<u8> =
                encoded(encoding).iter().map(|&byte| if byte == b'\n' { b'\r' } else { byte }).collect();
            assert_eq!(parse(&by_cr).expect("lines that end in CR"), mesh);
        }
        // Without `--strict`, a file may have trailing data.
        let longer = [encoded(encoding), b"3 0 1 2".to_vec()].concat();
        let error = parse(&longer).expect_err("longer").to_string();
        assert_eq!(error, "m.ply: expected the end of the file after the last element, found 7 bytes more");
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("m.ply");
        std::fs::write(&path, longer).expect("written");
        let (read, notes) = load_mesh_with(&path, ModelOptions::default()).expect("a mesh");
        assert_eq!(read.len(), mesh.len());
        assert_eq!(notes[0].to_string(), "7 bytes after the last element: ignored");
    }
}

#[test]
fn a_file_cut_short_anywhere_is_refused() {
    for encoding in ENCODINGS {
        let bytes = encoded(encoding);
        for end in 0..bytes.len() - 3 {
            assert!(parse(&bytes[..end]).is_err(), "{encoding}: {end} of {} bytes", bytes.len());
        }
    }
}

/// A concave face, not all of which is visible from its first corner.
const ARROW: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
                     property list uchar int vertex_indices\nend_header\n";

#[test]
fn numbers_need_a_digit_on_one_side_of_their_point() {
    let read = |x: &str| {
        let text =
            format!("\u{feff}ply\nformat ascii 1.0\n{ARROW}{x} -1. 0\n0 3 0\n-2 -1.0 0\n.0 -.0e1 0.\n4 0 1 2 3\n");
        parse(text.as_bytes()).map(|mesh| (mesh.positions()[0][0], mesh.triangles().to_vec()))
    };
    for (text, x) in [("2.", 2.0), ("+.5", 0.5), ("2.e0", 2.0), (".2E1", 2.0), ("2", 2.0)] {
        assert_eq!(read(text).expect(text), (x, vec![[3, 0, 1], [1, 2, 3]]), "{text}");
    }
    for text in [".", "1..", ".e1", "1.5.", "nan", "1.#QNAN", "-"] {
        let error = read(text).expect_err(text).to_string();
        assert!(error.starts_with("m.ply:10: expected a `vertex` of `x y z`, found `"), "{error}");
    }
}

#[test]
fn faces_with_a_fault_are_named() {
    let text = format!("ply\nformat ascii 1.0\n{ARROW}0 0 0\n1 0 0\n1 1 0\n0 1 1\n4 0 1 2 3\n");
    let fault = "expected a flat face that does not touch itself, found one not flat";
    assert_eq!(parse(text.as_bytes()).expect_err("bent").to_string(), format!("m.ply:14: {fault}"));
    let mut bytes = format!("ply\nformat binary_little_endian 1.0\n{ARROW}").into_bytes();
    bytes.extend(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 1]].as_flattened().iter().flat_map(|&x| (x as f32).to_le_bytes()),
    );
    bytes.extend([4_u8].into_iter().chain((0..4_i32).flat_map(i32::to_le_bytes)));
    let error = parse(&bytes).expect_err("bent").to_string();
    assert_eq!(error, format!("m.ply: face 0 (counted from 0): {fault}"));
}

#[test]
fn the_fixture_is_the_square() {
    let models = file("fixtures/models");
    let ply = load_mesh(&models.join("square.ply")).expect("a mesh");
    let obj = load_mesh(&models.join("square.obj")).expect("a mesh");
    assert!(ply.iter_corners().eq(obj.iter_corners()));
    assert_eq!(ply.normals(), Some(&[[0.0, 0.0, 1.0]; 4][..]));
    assert_eq!(ply.texcoords().map(|uv| uv[2]), Some([ply.positions()[2][0], ply.positions()[2][1]]));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn arbitrary_data_behind_a_header_does_no_harm(
        encoding in prop::sample::select(&ENCODINGS[..]),
        counts in any::<[u64; 2]>(),
        data in prop::collection::vec(any::<u8>(), 0..300),
    ) {
        let [vertices, faces] = counts.map(|count| count >> (count % 64));
        let header = HEADER.replace("vertex 5", &format!("vertex {vertices}")).replace("face 2", &format!("face {faces}"));
        let mut bytes = format!("ply\nformat {encoding} 1.0\n{header}").into_bytes();
        bytes.extend(data);
        let _ = parse(&bytes);
    }
}
