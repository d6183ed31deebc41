//! Files of all-frequency transfer: written files can be read back, damaged ones are refused.

use std::path::Path;

use crossbar::all_frequency::Reflectance;
use crossbar::all_frequency::code::{CodeOptions, ScaleOf};
use crossbar::all_frequency::file::{
    AllFrequencyFile, load_all_frequency, parse_all_frequency, save_all_frequency, write_all_frequency,
};
use crossbar::transfer::file::{MeshDigest, parse_prt};
use crossbar::transfer::linear_basis::BasisWidth;
use proptest::prelude::*;

use super::coding::coded;
use super::{all, clutter, factors, trace, vertices};
use crate::support::forgery_does_no_harm;

fn bytes(file: &AllFrequencyFile) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_all_frequency(file, &mut bytes).expect("written");
    bytes
}

fn parsed(bytes: &[u8]) -> Result<AllFrequencyFile, String> {
    parse_all_frequency(bytes, Path::new("a.npz")).map_err(|error| error.to_string())
}

/// A complete file of two triangles: factors of 3 terms, visibility, coded transfer.
fn whole() -> AllFrequencyFile {
    let mesh = clutter(3, 2, 1.0);
    let vertices = vertices(&mesh);
    let maps = trace(&mesh, &vertices, &all(&vertices));
    let reflectance = Reflectance::Factored(factors(3));
    let options = CodeOptions { representative_bits: 9, weight_bits: 11, scale: ScaleOf::Segment };
    let coded = coded(&vertices, &maps, &reflectance, 2, options);
    let mesh = MeshDigest::new(&vertices);
    let (visibility, coded, model) = (Some(maps), Some(coded), Some("ground.obj".to_owned()));
    AllFrequencyFile { mesh, hats: BasisWidth::OneTexel, reflectance, visibility, coded, model }
}

/// A small file with only coded transfer.
fn small() -> AllFrequencyFile {
    let mesh = clutter(3, 1, 1.0);
    let vertices = vertices(&mesh);
    let maps = trace(&mesh, &vertices, &all(&vertices));
    let mut coded = coded(&vertices, &maps, &Reflectance::Diffuse, 1, CodeOptions::default());
    coded.segments.truncate(2);
    let mesh = MeshDigest::new(&vertices);
    let (hats, reflectance) = (BasisWidth::TwoTexels, Reflectance::Diffuse);
    AllFrequencyFile { mesh, hats, reflectance, visibility: None, coded: Some(coded), model: None }
}

#[test]
fn what_is_written_is_read_in_all_its_parts() {
    let all = whole();
    let sight = AllFrequencyFile { coded: None, ..all.clone() };
    let coded = AllFrequencyFile { visibility: None, ..all.clone() };
    for file in [all, sight, coded, small()] {
        let mut read = parsed(&bytes(&file)).expect("read");
        // The file does not store how maps were computed.
        if let (Some(read), Some(maps)) = (&mut read.visibility, &file.visibility) {
            assert_eq!(read.counts.visible, maps.counts.visible);
            read.counts = maps.counts.clone();
        }
        assert_eq!(read, file);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.npz");
        save_all_frequency(&file, &path).expect("saved");
        assert!(load_all_frequency(&path, Some(&file.mesh)).is_ok());
        let other = MeshDigest { triangle_crc: !file.mesh.triangle_crc, ..file.mesh };
        assert!(load_all_frequency(&path, Some(&other)).is_err());
    }
}

#[test]
fn files_of_the_other_kind_are_told_apart() {
    let ours = bytes(&small());
    let error = parse_prt(&ours, Path::new("a.npz")).expect_err("refused").to_string();
    assert_eq!(error, "a.npz: expected a file of low-frequency transfer, found one of transfer of all frequencies");
    let other = std::fs::read("docs/examples/step.npz").expect("an example");
    assert!(parsed(&other).is_err());
}

#[test]
fn parts_of_unlike_shapes_are_not_written() {
    let changes: [fn(&mut AllFrequencyFile); 7] = [
        |f| f.coded = None,
        |f| f.mesh.vertices = 9,
        |f| f.coded.as_mut().expect("coded").rows = 2,
        |f| f.coded.as_mut().expect("coded").segments[0].weights.truncate(1),
        |f| f.coded.as_mut().expect("coded").segments[0].cluster_of[0] = 7,
        |f| f.coded.as_mut().expect("coded").segments[0].weight_steps[0] = f32::NAN,
        |f| f.coded.as_mut().expect("coded").segments.swap(0, 1),
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut file = small();
        change(&mut file);
        assert!(write_all_frequency(&file, &mut Vec::new()).is_err(), "change {number}");
    }
}

proptest! {
    #[test]
    fn forged_contents_never_panic(which: prop::sample::Index, at: prop::sample::Index, value: u8) {
        forgery_does_no_harm(&bytes(&small()), (which, at, value), parsed, bytes);
    }
}
