//! Files of low-frequency transfer: written files can be read back, damaged ones are refused.

use std::path::Path;

use crossbar::clustering::{CpcaMethod, CpcaOptions, Signal, compress};
use crossbar::geom::Mesh;
use crossbar::io::npz::MAGIC;
use crossbar::io::write_npy_array;
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
            (None, Err(_)) => (),
            (_, other) => panic!("{other:?}"),
        }
    }
}

/// The checksums of the archive, which all kinds of transfer share.
#[test]
fn every_flipped_bit_and_every_cut_is_seen() {
    let file = small();
    damage_is_seen(&file, &bytes(&file), by_form(1, 8), parsed);
}

#[test]
fn forged_metadata_are_refused() {
    let whole = bytes(&small());
    let forged = |from: &str, to: &str| {
        parsed(&with_metadata(&whole, |text| {
            assert!(text.contains(from), "{text}");
            text.replacen(from, to, 1)
        }))
    };
    assert_eq!(forged("points", "points"), Ok(small()), "the same again");
    for (from, to) in [
        ("\"version\":1", "\"version\":2"),
        ("low-frequency", "other"),
        ("\"channels\":1", "\"channels\":2"),
        ("[0,3]", "[3,0]"),
        ("\"light_order\":2", "\"light_order\":11"),
        ("\"vertices\":12", "\"vertices\":11"),
        ("0,-0.5,2", "0,0,0"),
        ("0,-0.5,2", "1,NaN,0"),
        ("\"clusters=3", "\"\\u0007"),
        ("{", "["),
    ] {
        assert!(forged(from, to).is_err(), "{to}");
    }
    // Counts far larger than the file are refused before anything of that size is allocated.
    for field in ["points", "count", "vectors", "weights", "light_order"] {
        for claim in ["1000", "4294967295", "18446744073709551615", "-1", "1e400"] {
            assert!(forged(&format!("\"{field}\":"), &format!("\"{field}\":{claim},\"x\":")).is_err());
        }
    }
    assert!(parsed(b"\x93NUMPY").is_err() && parsed(MAGIC).is_err());
}

#[test]
fn another_mesh_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.npz");
    save_prt(&small(), &path).expect("saved");
    let mesh = small().mesh.expect("a mesh");
    let others = [
        MeshDigest { vertices: 4, ..mesh },
        MeshDigest { tangents: Tangents::Any, ..mesh },
        digest(Tangents::Along(DVec3::X)),
    ];
    for other in others {
        let error = load_prt(&path, Some(&other)).expect_err("another mesh");
        let message = format!("{}: expected transfer of a mesh with {other}, found that of {mesh}", path.display());
        assert_eq!((error.error_code(), error.to_string()), ("crossbar::prt::mesh", message));
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

/// Arrays that are missing, superfluous, or have the wrong shape or type are refused.
#[test]
fn forged_arrays_are_refused() {
    let whole = bytes(&small());
    let array = |name: &str| members(&whole).into_iter().find(|(other, _)| other == name).expect("an array").1;
    for (name, other) in [("x_0.npy", "M_p.npy"), ("x_0.npy", "x_i.npy"), ("k_p.npy", "w_p.npy")] {
        assert!(parsed(&with_member(&whole, name, |_| array(other))).is_err(), "{name} {other}");
    }
    for name in members(&whole).into_iter().map(|(name, _)| name) {
        let without: Vec<_> = members(&whole).into_iter().filter(|(other, _)| *other != name).collect();
        let read = parsed(&archive(&without));
        // Transfer may be missing.
        assert_eq!(read.is_ok(), name == "M_p.npy", "{name}: {read:?}");
    }
    for name in ["else.npy", "else"] {
        let more = [members(&whole), vec![(name.to_owned(), array("x_0.npy"))]].concat();
        assert!(parsed(&archive(&more)).is_err(), "{name}");
    }
    let not_finite = with_member(&whole, "w_p.npy", |array| [&array[..array.len() - 2], &[0xf8, 0x7f]].concat());
    assert!(parsed(&not_finite).is_err());
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
    let path = folder.path().join("signal");
    let read = |bytes: &[u8]| {
        std::fs::write(&path, bytes).expect("written");
        load_signal(&path).ok().map(|(_, _, signal)| signal)
    };
    let signal = Signal::new(2, vec![1.0, 2.0, 3.0, 4.0]).expect("a signal");
    assert_eq!(read(b"x,y\n1,2\n3,4\n"), Some(signal.clone()));
    let mut npy = Vec::new();
    write_npy_array(&[2, 2], signal.values(), &mut npy).expect("written");
    assert_eq!(read(&npy), Some(signal));
    let end = npy.len() - 4;
    npy[end..].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!((read(&npy), read(b"")), (None, None));
    assert!(load_signal(&folder.path().join("none")).is_err());
}
