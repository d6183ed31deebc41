//! Files of low-frequency transfer: written files can be read back, damaged ones are refused.

use std::path::Path;

use crossbar::clustering::{CpcaMethod, CpcaOptions, Signal, compress};
use crossbar::geom::Mesh;
use crossbar::io::npz::MAGIC;
use crossbar::io::{NumberTable, parse_npy, write_npy};
use crossbar::transfer::file::{MeshDigest, PrtFile, PrtMeaning, load_prt, parse_prt, save_prt, write_prt};
use crossbar::transfer::synthetic::torus_signal;
use crossbar::transfer::{Tangents, Vertices, load_signal};
use glam::DVec3;
use proptest::prelude::*;

use crate::archive::{archive, members, with_member, with_metadata};
use crate::environment::by_form;
use crate::support::{cluster_options, damage_is_seen, forgery_does_no_harm};

fn name() -> &'static Path {
    Path::new("a.npz")
}

fn bytes(file: &PrtFile) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_prt(file, &mut bytes).expect("written");
    bytes
}

fn parsed(bytes: &[u8]) -> Result<PrtFile, String> {
    parse_prt(bytes, name()).map_err(|error| error.to_string())
}

/// The digest of a mesh: a fan of 12 vertices.
fn digest(tangents: Tangents) -> MeshDigest {
    let corners = (0..12).map(|i| [i as f32, (i * i) as f32, 0.0]).collect();
    let mesh = Mesh::new(corners, (1..11).map(|i| [0, i, i + 1]).collect()).expect("a mesh");
    MeshDigest::new(&Vertices::new(&mesh, tangents).expect("vertices"))
}

/// A small file with all optional contents: 12 points of 2 x 4 numbers in 3 clusters with different numbers of vectors.
fn small() -> PrtFile {
    let signal = torus_signal(12, 8, 1);
    let options = CpcaOptions { method: CpcaMethod::Adaptive { rounds: 2 }, ..cluster_options(3, 2, 3, 1) };
    let clustering = compress(&signal, &options, |_| ()).expect("compressed").clustering;
    let meaning =
        PrtMeaning::Transfer { channels: 1, exit_functions: vec![0, 3], light_order: 2, includes_albedo: true };
    let mesh = Some(digest(Tangents::Along(DVec3::new(0.0, -0.5, 2.0))));
    let (transfer, clustering) = (Some(signal), Some(clustering));
    let provenance = Some("clusters=3 vectors=2".to_owned());
    PrtFile { meaning, mesh, transfer, clustering, provenance }
}

#[test]
fn what_is_written_is_read_in_all_its_parts() {
    let all = small();
    let plain = PrtFile { meaning: PrtMeaning::Numbers { dimension: 8 }, mesh: None, ..all.clone() };
    let transfer = PrtFile { clustering: None, ..all.clone() };
    let clusters = PrtFile { transfer: None, ..plain.clone() };
    let bare = PrtFile { provenance: None, ..all.clone() };
    let tangents = [Tangents::Any, Tangents::Texture].map(|tangents| {
        let mesh = all.mesh.map(|mesh| MeshDigest { tangents, ..mesh });
        PrtFile { mesh, ..all.clone() }
    });
    for file in [all, plain, transfer, clusters, bare].into_iter().chain(tangents) {
        assert_eq!(parsed(&bytes(&file)), Ok(file.clone()));
        assert_eq!(file.points(), 12);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.npz");
        save_prt(&file, &path).expect("saved");
        assert_eq!(load_prt(&path, file.mesh.as_ref()).expect("loaded"), file);
        match (&file.transfer, load_signal(&path).map(|(_, _, signal)| signal)) {
            (Some(transfer), Ok(signal)) => assert_eq!(&signal, transfer),
            (None, Err(error)) => assert!(error.to_string().ends_with("expected transfer, found clusters only")),
            (_, other) => panic!("{other:?}"),
        }
    }
}

/// The checksums of the archive, which all kinds of transfer share.
#[test]
fn every_flipped_bit_and_every_cut_is_seen() {
    let file = small();
    let whole = bytes(&file);
    damage_is_seen(&file, &whole, by_form(1, 8), parsed);
    // A checksum covers every bit of an array and of its header.
    let at = whole.windows(6).position(|bytes| bytes == b"\x93NUMPY").expect("an array");
    let mut damaged = whole;
    damaged[at + 100] ^= 1;
    let error = parsed(&damaged).expect_err("damaged");
    assert!(error.starts_with("a.npz: member `metadata.npy`: ") && error.contains("checksum"), "{error}");
}

#[test]
fn forged_metadata_are_refused_by_name() {
    let whole = bytes(&small());
    let forged = |from: &str, to: &str| {
        let changed = with_metadata(&whole, |text| {
            assert!(text.contains(from), "{text}");
            text.replacen(from, to, 1)
        });
        parsed(&changed)
    };
    assert_eq!(forged("points", "points"), Ok(small()), "the same again");
    let error = |from: &str, to: &str| forged(from, to).expect_err("refused");
    assert_eq!(error("\"version\":1", "\"version\":2"), "a.npz: version: expected 1, found 2");
    assert!(error("low-frequency", "other").contains("metadata: expected JSON as docs/npz.md has it, found unknown"));
    assert_eq!(error("\"channels\":1", "\"channels\":2"), "a.npz: channels: expected 1 or 3, found 2");
    assert!(error("[0,3]", "[3,0]").contains("exit functions: expected at least one of 0 to 99, in increasing order"));
    assert_eq!(error("\"light_order\":2", "\"light_order\":11"), "a.npz: light order: expected 1 to 10, found 11");
    assert_eq!(error("\"vertices\":12", "\"vertices\":11"), "a.npz: vertices of the mesh: expected 12, found 11");
    assert!(error("0,-0.5,2", "0,0,0").contains("an axis, found `0,0,0`"));
    assert!(error("0,-0.5,2", "1,NaN,0").contains("an axis, found `1,NaN,0`"));
    assert!(error("\"clusters=3", "\"\\u0007").contains("provenance: expected a line of 1 to 4096 bytes"));
    assert!(error("{", "[").contains("metadata: expected JSON"));
    // Counts far larger than the file are refused before anything of that size is allocated.
    for field in ["points", "count", "vectors", "weights", "light_order"] {
        for claim in ["1000", "4294967295", "18446744073709551615", "-1", "1e400"] {
            assert!(error(&format!("\"{field}\":"), &format!("\"{field}\":{claim},\"x\":")).starts_with("a.npz: "));
        }
    }
    assert_eq!(parsed(b"\x93NUMPY"), Err("a.npz: expected a .npz file, found other first bytes".to_owned()));
    assert!(parsed(MAGIC).expect_err("cut").starts_with("a.npz: "));
}

#[test]
fn another_mesh_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.npz");
    save_prt(&small(), &path).expect("saved");
    let mesh = small().mesh.expect("a mesh");
    let others = [
        (MeshDigest { vertices: 4, ..mesh }, "expected transfer of a mesh with 4 vertices ("),
        (MeshDigest { tangents: Tangents::Any, ..mesh }, "), any tangents, found that of 12 vertices ("),
        (digest(Tangents::Along(DVec3::X)), "tangents along 1,0,0, found that of 12 vertices ("),
    ];
    for (other, words) in others {
        let error = load_prt(&path, Some(&other)).expect_err("another mesh");
        let message = format!("{}: expected transfer of a mesh with {other}, found that of {mesh}", path.display());
        assert_eq!((error.error_code(), error.to_string()), ("crossbar::prt::mesh", message));
        assert!(error.to_string().contains(words), "{error}");
        assert!(error.to_string().ends_with("tangents along 0,-0.5,2"), "{error}");
    }
    assert!(load_prt(&path, Some(&mesh)).is_ok());
    assert!(load_prt(&path, None).is_ok());
}

#[test]
fn parts_that_do_not_go_together_are_not_written() {
    let file = small();
    let meaning = |channels, exit_functions: &[u16], light_order| {
        let exit_functions = exit_functions.to_vec();
        let meaning = PrtMeaning::Transfer { channels, exit_functions, light_order, includes_albedo: false };
        PrtFile { meaning, ..file.clone() }
    };
    let made = |line: &str| PrtFile { provenance: Some(line.to_owned()), ..file.clone() };
    for file in [
        meaning(2, &[0], 2),
        meaning(1, &[0], 11),
        meaning(1, &[], 2),
        meaning(1, &[0, 0], 2),
        meaning(1, &[1, 0], 2),
        meaning(1, &[100], 2),
        meaning(1, &[0], 2),
        PrtFile { transfer: None, clustering: None, ..file.clone() },
        PrtFile { mesh: file.mesh.map(|mesh| MeshDigest { vertices: 13, ..mesh }), ..file.clone() },
        PrtFile { transfer: Some(torus_signal(11, 8, 1)), ..file.clone() },
        made(""),
        made("two\nlines"),
        made("\u{9b}31m"),
        made(&"x".repeat(4097)),
    ] {
        let mut out = Vec::new();
        assert!(write_prt(&file, &mut out).is_err() && out.is_empty(), "{file:?}");
    }
}

/// Arrays that are missing, superfluous, or have the wrong shape or type are refused by name.
#[test]
fn forged_arrays_are_refused_by_name() {
    let whole = bytes(&small());
    let array = |name: &str| members(&whole).into_iter().find(|(other, _)| other == name).expect("an array").1;
    let put = |name: &str, other: &str| parsed(&with_member(&whole, name, |_| array(other))).expect_err("refused");
    assert_eq!(put("x_0.npy", "M_p.npy"), "a.npz: x_0: expected numbers of type <f8, found `<f4`");
    assert!(put("x_0.npy", "x_i.npy").starts_with("a.npz: x_0: expected the shape [3, 1, 2, 4], found ["));
    assert_eq!(
        put("k_p.npy", "w_p.npy"),
        "a.npz: k_p: expected numbers of type |u1 |i1 <u2 <i2 <u4 <i4 <i8, found `<f8`"
    );
    for name in members(&whole).into_iter().map(|(name, _)| name) {
        let without: Vec<_> = members(&whole).into_iter().filter(|(other, _)| *other != name).collect();
        let read = parsed(&archive(&without));
        // Transfer may be missing.
        assert_eq!(read.is_ok(), name == "M_p.npy", "{name}: {read:?}");
    }
    let mut more = members(&whole);
    more.push(("else.npy".to_owned(), array("x_0.npy")));
    assert_eq!(parsed(&archive(&more)), Err("a.npz: arrays: expected no others, found `else`".to_owned()));
    more.last_mut().expect("a member").0 = "else".to_owned();
    assert_eq!(parsed(&archive(&more)), Err("a.npz: member `else`: expected a name that ends in .npy".to_owned()));
    let not_finite = with_member(&whole, "w_p.npy", |array| [&array[..array.len() - 2], &[0xf8, 0x7f]].concat());
    assert!(parsed(&not_finite).expect_err("refused").contains("w_p: expected finite numbers, found another at"));
}

proptest! {
    #[test]
    fn any_signal_and_its_clusters_come_back(
        values in prop::collection::vec(-1e30_f32..1e30, 1..60), dimension in 1..=4_usize, keep in 1..=3_u8,
    ) {
        let whole = values.len() / dimension * dimension;
        prop_assume!(whole > 0);
        let signal = Signal::new(dimension, values[..whole].to_vec()).expect("a signal");
        let options = cluster_options(signal.points().min(3), 1, 2, 7);
        let clustering = compress(&signal, &options, |_| ()).expect("compressed").clustering;
        let file = PrtFile {
            meaning: PrtMeaning::Numbers { dimension: dimension as u32 },
            mesh: None,
            transfer: (keep & 1 != 0).then_some(signal),
            clustering: (keep & 2 != 0).then_some(clustering),
            provenance: None,
        };
        prop_assert_eq!(parsed(&bytes(&file)), Ok(file));
    }

    /// Changed members with valid checksums are refused or read without a panic.
    #[test]
    fn forged_members_do_no_harm(which: prop::sample::Index, at: prop::sample::Index, with: u8) {
        forgery_does_no_harm(&bytes(&small()), (which, at, with), parsed, bytes);
    }
}

#[test]
fn signals_are_read_from_tables_and_arrays() {
    let folder = tempfile::tempdir().expect("a folder");
    let read = |bytes: &[u8]| {
        let path = folder.path().join("signal");
        std::fs::write(&path, bytes).expect("written");
        load_signal(&path)
            .map(|(_, _, signal)| signal)
            .map_err(|error| error.to_string().replace(&path.display().to_string(), "signal"))
    };
    let signal = Signal::new(2, vec![1.0, 2.0, 3.0, 4.0]).expect("a signal");
    assert_eq!(read(b"x,y\n1,2\n3,4\n"), Ok(signal.clone()));
    let mut npy = Vec::new();
    write_npy(&NumberTable { columns: 2, values: signal.values().to_vec() }, &mut npy).expect("written");
    assert_eq!(read(&npy), Ok(signal));
    let end = npy.len() - 4;
    npy[end..].copy_from_slice(&f32::NAN.to_le_bytes());
    let nan = "signal: expected finite numbers, found NaN in component 1 of point 1 (counted from 0)";
    assert_eq!(read(&npy), Err(nan.to_owned()));
    assert!(read(b"").expect_err("empty").contains("expected at least one row of numbers"));
    assert!(
        load_signal(&folder.path().join("none")).expect_err("none").to_string().starts_with("cannot read the signal")
    );
}
