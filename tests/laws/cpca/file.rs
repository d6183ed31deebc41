//! The `.prt` file: what is written is read, what is damaged is refused.

use std::path::Path;

use crossbar::geom::Mesh;
use crossbar::io::{NumberTable, parse_number_table, parse_single_npy, write_npy};
use crossbar::transfer::clustering::{CpcaForm, CpcaMethod, CpcaOptions, StartPoints, compress};
use crossbar::transfer::file::{MAGIC, MeshDigest, PrtFile, PrtMeaning, load_prt, parse_prt, save_prt, write_prt};
use crossbar::transfer::synthetic::torus_signal;
use crossbar::transfer::{Signal, Tangents, Vertices, load_signal};
use glam::DVec3;
use proptest::prelude::*;

fn name() -> &'static Path {
    Path::new("a.prt")
}

fn bytes(file: &PrtFile) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_prt(file, &mut bytes).expect("written");
    bytes
}

fn parsed(bytes: &[u8]) -> Result<PrtFile, String> {
    parse_prt(bytes, name()).map_err(|error| error.to_string())
}

/// Of a fan of 12 vertices.
fn digest(tangents: Tangents) -> MeshDigest {
    let corners = (0..12).map(|i| [i as f32, (i * i) as f32, 0.0]).collect();
    let mesh = Mesh::new(corners, (1..11).map(|i| [0, i, i + 1]).collect()).expect("a mesh");
    MeshDigest::new(&Vertices::new(&mesh, tangents).expect("vertices"))
}

/// A small file with everything: 12 points of 2 x 4 numbers in 3 clusters with different numbers of vectors.
fn small() -> PrtFile {
    let signal = torus_signal(12, 8, 1);
    let method = CpcaMethod::Adaptive { rounds: 2 };
    let options = CpcaOptions {
        clusters: 3,
        vectors: 2,
        vq_iterations: 3,
        iterations: 3,
        method,
        form: CpcaForm::Affine,
        start: StartPoints::Seed(1),
    };
    let clustering = compress(&signal, &options, |_| ()).expect("compressed").clustering;
    let meaning =
        PrtMeaning::Transfer { channels: 1, exit_functions: vec![0, 3], light_order: 2, includes_albedo: true };
    let mesh = Some(digest(Tangents::Along(DVec3::new(0.0, -0.5, 2.0))));
    let (transfer, clustering) = (Some(signal), Some(clustering));
    let superclusters = Some(vec![0, 1, 0]);
    let provenance = Some("clusters=3 vectors=2".to_owned());
    PrtFile { meaning, mesh, transfer, clustering, superclusters, provenance }
}

#[test]
fn what_is_written_is_read_in_all_its_parts() {
    let all = small();
    let plain = PrtFile { meaning: PrtMeaning::Numbers { dimension: 8 }, mesh: None, ..all.clone() };
    let transfer = PrtFile { clustering: None, superclusters: None, ..all.clone() };
    let clusters = PrtFile { transfer: None, superclusters: None, ..plain.clone() };
    let bare = PrtFile { superclusters: None, provenance: None, ..all.clone() };
    let tangents = [Tangents::Any, Tangents::Texture].map(|tangents| {
        let mesh = all.mesh.map(|mesh| MeshDigest { tangents, ..mesh });
        PrtFile { mesh, ..all.clone() }
    });
    for file in [all, plain, transfer, clusters, bare].into_iter().chain(tangents) {
        assert_eq!(parsed(&bytes(&file)), Ok(file.clone()));
        assert_eq!(file.points(), 12);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.prt");
        save_prt(&file, &path).expect("saved");
        assert_eq!(load_prt(&path, file.mesh.as_ref()).expect("loaded"), file);
        match (&file.transfer, load_signal(&path)) {
            (Some(transfer), Ok(signal)) => assert_eq!(&signal, transfer),
            (None, Err(error)) => assert!(error.to_string().ends_with("expected transfer, found clusters alone")),
            (_, other) => panic!("{other:?}"),
        }
    }
}

#[test]
fn every_flipped_bit_and_every_cut_is_seen() {
    let whole = bytes(&small());
    for length in 0..whole.len() {
        assert!(parsed(&whole[..length]).is_err(), "{length} of {} bytes", whole.len());
    }
    for at in 0..whole.len() {
        for bit in 0..8 {
            let mut damaged = whole.clone();
            damaged[at] ^= 1 << bit;
            assert!(parsed(&damaged).is_err(), "bit {bit} of byte {at}");
        }
    }
    let longer = [&whole[..], b"x"].concat();
    let message = format!("a.prt: expected the end of the file at {}, found 1 more bytes", whole.len());
    assert_eq!(parsed(&longer), Err(message));
}

/// Replaces a field of the header and makes its checksum right again.
fn forged<const N: usize>(bytes: &[u8], at: usize, field: [u8; N]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[at..at + N].copy_from_slice(&field);
    let functions = u32::from_le_bytes(bytes[20..24].try_into().expect("four"));
    let end = 84 + 2 * (functions as usize).min(2);
    let crc = crc32fast::hash(&bytes[..end]);
    bytes[end..end + 4].copy_from_slice(&crc.to_le_bytes());
    bytes
}

#[test]
fn forged_headers_are_refused_by_name() {
    let whole = bytes(&small());
    assert_eq!(forged(&whole, 12, [1, 0, 0, 0]), whole, "the header's checksum is where it is thought to be");
    let error = |at: usize, field: u32| parsed(&forged(&whole, at, field.to_le_bytes())).expect_err("refused");
    assert_eq!(error(8, 2), "a.prt: expected a .prt file of version 1 to 1, found version 2");
    assert_eq!(error(12, 7), "a.prt: conventions: expected 1 to 3, found 7");
    assert_eq!(error(28, 2), "a.prt: albedo: expected 0 to 1, found 2");
    assert_eq!(error(36, 0), "a.prt: number of sections: expected 1 to 4, found 0");
    assert!(error(36, 1).contains("expected the end of the file"), "{}", error(36, 1));
    assert_eq!(error(40, 11), "a.prt: vertices of the mesh: expected 12, found 11");
    assert_eq!(error(56, 4), "a.prt: tangents: expected 0 to 3, found 4");
    assert_eq!(error(56, 2), "a.prt: axis of tangents: expected zeros, found 0,-0.5,2");
    assert!(error(56, 0).starts_with("a.prt: mesh's digest: expected 0 to 0, found"), "{}", error(56, 0));
    let axis = |axis: [f64; 3]| {
        let field: [u8; 24] = std::array::from_fn(|i| axis[i / 8].to_le_bytes()[i % 8]);
        parsed(&forged(&whole, 60, field)).expect_err("refused")
    };
    assert_eq!(axis([0.0; 3]), "a.prt: axis of tangents: expected a finite length above 0, found 0,0,0");
    assert!(axis([1.0, f64::NAN, 0.0]).ends_with("found 1,NaN,0") && axis([1e300; 3]).contains("a finite length"));
    // Counts far beyond the bytes that are there: refused before anything of that size is allocated.
    for at in [16, 20, 24, 32] {
        for field in [3, 1000, u32::MAX] {
            assert!(error(at, field).starts_with("a.prt: "), "{at}: {field}");
        }
    }
    assert_eq!(parsed(b"\x93NUMPY"), Err("a.prt: expected a .prt file, found another beginning".to_owned()));
    assert!(parsed(MAGIC).expect_err("cut").contains("expected 4 bytes of header at 8, found 0"));
}

#[test]
fn another_mesh_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.prt");
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
    let refused = |file: &PrtFile| {
        let mut out = Vec::new();
        let error = write_prt(file, &mut out).expect_err("refused");
        assert!(out.is_empty(), "nothing is written");
        error.to_string()
    };
    let file = small();
    let meaning = |channels, exit_functions: &[u16], light_order| PrtMeaning::Transfer {
        channels,
        exit_functions: exit_functions.to_vec(),
        light_order,
        includes_albedo: false,
    };
    let with = |meaning| PrtFile { meaning, ..file.clone() };
    assert_eq!(refused(&with(meaning(2, &[0], 2))), "channels: expected 1 or 3, found 2");
    assert_eq!(refused(&with(meaning(1, &[0], 11))), "light order: expected 1 to 10, found 11");
    let functions = "exit functions: expected at least one of 0 to 99, in increasing order, found";
    for list in [&[][..], &[0, 0], &[1, 0], &[100]] {
        assert!(refused(&with(meaning(1, list, 2))).starts_with(functions), "{list:?}");
    }
    assert_eq!(refused(&with(meaning(1, &[0], 2))), "numbers per point: expected 4, found 8");
    let empty = PrtFile { transfer: None, clustering: None, superclusters: None, ..file.clone() };
    assert_eq!(refused(&empty), "contents: expected transfer or clusters, found neither");
    let mesh = file.mesh.map(|mesh| MeshDigest { vertices: 13, ..mesh });
    assert_eq!(refused(&PrtFile { mesh, ..file.clone() }), "vertices of the mesh: expected 12, found 13");
    let other = PrtFile { transfer: Some(torus_signal(11, 8, 1)), ..file.clone() };
    let shapes = "clusters: expected 11 points of 8 numbers, found 12 points of 8 numbers";
    assert_eq!(refused(&other), shapes);
    let groups =
        |superclusters: &[u32]| refused(&PrtFile { superclusters: Some(superclusters.to_vec()), ..file.clone() });
    assert_eq!(groups(&[0, 1]), "superclusters: expected a number for 3 clusters, found 2");
    assert_eq!(groups(&[0, 2, 1]), "superclusters: expected 0 to 1, in the order of clusters, found 2");
    assert_eq!(groups(&[1, 0, 0]), "superclusters: expected 0 to 0, in the order of clusters, found 1");
    let made = |line: &str| refused(&PrtFile { provenance: Some(line.to_owned()), ..file.clone() });
    let expected = "provenance: expected a line of 1 to 4096 bytes without control characters, found";
    for line in ["", "two\nlines", "\u{9b}31m", &"x".repeat(4097)] {
        assert!(made(line).starts_with(expected), "{line:?}");
    }
}

/// Sections out of order, twice, or with text that is none.
#[test]
fn forged_sections_are_refused_by_name() {
    let whole = PrtFile { transfer: None, ..small() };
    let without = |whole: &PrtFile| bytes(&PrtFile { superclusters: None, provenance: None, ..whole.clone() });
    let forged = |sections: &[(&[u8; 4], &[u8])]| {
        let section = |&(tag, body): &(&[u8; 4], &[u8])| {
            let all = [&tag[..], &(body.len() as u64).to_le_bytes(), body].concat();
            let crc = crc32fast::hash(&all).to_le_bytes();
            [all, crc.to_vec()].concat()
        };
        let mut all = forged(&without(&whole), 36, (1 + sections.len() as u32).to_le_bytes());
        all.extend(sections.iter().flat_map(section));
        parsed(&all)
    };
    let (groups, line) = ((b"SUPR", &[0; 12][..]), (b"MADE", &b"a"[..]));
    assert!(forged(&[groups, line]).is_ok() && forged(&[line]).is_ok());
    for wrong in [&[line, groups][..], &[line, line], &[groups, groups], &[(b"CLUS", &[][..])], &[(b"ELSE", &[][..])]] {
        let error = forged(wrong).expect_err("refused");
        assert!(error.contains("in this order, each at most once, found"), "{error}");
    }
    assert!(forged(&[(b"MADE", &[255][..])]).expect_err("refused").contains("provenance: expected UTF-8"));
    assert!(forged(&[(b"MADE", &[][..])]).expect_err("refused").contains("provenance: expected a line"));
    assert!(forged(&[(b"SUPR", &[0; 11][..])]).is_err() && forged(&[(b"SUPR", &[0; 16][..])]).is_err());
    assert!(forged(&[(b"SUPR", &[1; 12][..])]).expect_err("refused").contains("superclusters: expected 0 to 0"));
}

/// The same bytes for any number of threads.
#[test]
fn bytes_do_not_depend_on_threads() {
    let of_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| bytes(&small()))
    };
    assert_eq!(of_threads(1), of_threads(3));
}

proptest! {
    #[test]
    fn any_signal_and_its_clusters_come_back(
        values in prop::collection::vec(-1e30_f32..1e30, 1..60), dimension in 1..=4_usize, keep in 1..=3_u8,
    ) {
        let whole = values.len() / dimension * dimension;
        prop_assume!(whole > 0);
        let signal = Signal::new(dimension, values[..whole].to_vec()).expect("a signal");
        let clusters = signal.points().min(3);
        let options = CpcaOptions {
            clusters, vectors: 1, vq_iterations: 2, iterations: 2, method: CpcaMethod::Iterative, form: CpcaForm::Affine, start: StartPoints::Seed(7),
        };
        let clustering = compress(&signal, &options, |_| ()).expect("compressed").clustering;
        let file = PrtFile {
            meaning: PrtMeaning::Numbers { dimension: dimension as u32 },
            mesh: None,
            transfer: (keep & 1 != 0).then_some(signal),
            clustering: (keep & 2 != 0).then_some(clustering),
            superclusters: None,
            provenance: None,
        };
        prop_assert_eq!(parsed(&bytes(&file)), Ok(file));
    }

    /// Anything behind the magic, with right checksums or wrong ones: an error or a file, no panic.
    #[test]
    fn noise_is_no_file(noise in prop::collection::vec(any::<u8>(), 0..200), at in 8..300_usize, with in any::<[u8; 4]>()) {
        let _ = parsed(&[&MAGIC[..], &noise].concat());
        let mut changed = bytes(&small());
        changed[at..at + 4].copy_from_slice(&with);
        let end = 88;
        let crc = crc32fast::hash(&changed[..end]);
        changed[end..end + 4].copy_from_slice(&crc.to_le_bytes());
        let _ = parsed(&changed);
    }

    #[test]
    fn arrays_of_numpy_come_back(columns in 1..6_usize, rows in 1..9_usize, seed in any::<u32>()) {
        let values = (0..(rows * columns) as u32).map(|i| f32::from_bits(seed.wrapping_mul(i + 1) & 0xbfff_ffff));
        let table = NumberTable { columns, values: values.collect() };
        let mut bytes = Vec::new();
        write_npy(&table, &mut bytes).expect("written");
        let back = parse_single_npy(&bytes, name()).expect("a table");
        prop_assert_eq!(back, table);
    }

    #[test]
    fn damaged_arrays_and_tables_do_not_panic(
        at in 0..152_usize, with in any::<u8>(), noise in prop::collection::vec(any::<u8>(), 0..60),
    ) {
        let mut bytes = Vec::new();
        write_npy(&NumberTable { columns: 2, values: vec![1.0; 6] }, &mut bytes).expect("written");
        bytes[at] = with;
        let _ = parse_single_npy(&bytes, name());
        let _ = parse_single_npy(&[crossbar::io::npy::MAGIC, &noise].concat(), name());
        let _ = parse_number_table(&noise, name());
    }
}

#[test]
fn signals_are_read_from_tables_and_arrays() {
    let folder = tempfile::tempdir().expect("a folder");
    let read = |bytes: &[u8]| {
        let path = folder.path().join("signal");
        std::fs::write(&path, bytes).expect("written");
        load_signal(&path).map_err(|error| error.to_string().replace(&path.display().to_string(), "signal"))
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
