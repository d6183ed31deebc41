//! Files of bi-scale transfer, and matrices as text: written files can be read back, damaged ones are refused.

use std::path::Path;

use crossbar::bi_scale::bicluster::SEED;
use crossbar::bi_scale::directions::LocalDirections;
use crossbar::bi_scale::file::{
    BiScaleFile, BiScaleMeaning, load_bi_scale, parse_bi_scale, save_bi_scale, write_bi_scale,
};
use crossbar::bi_scale::transfer::transfer_matrix;
use crossbar::transfer::file::{MeshDigest, parse_prt};
use crossbar::transfer::visibility::Horizon;
use proptest::prelude::*;

use super::{matrix, quietly, sight};
use crate::archive::{members, with_metadata};
use crate::support::forgery_does_no_harm;

fn bytes(file: &BiScaleFile) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_bi_scale(file, &mut bytes).expect("written");
    bytes
}

fn parsed(bytes: &[u8]) -> Result<BiScaleFile, String> {
    parse_bi_scale(bytes, Path::new("b.npz")).map_err(|error| error.to_string())
}

/// Any matrix with its biclusters.
fn small(values: &[Vec<i32>]) -> BiScaleFile {
    let matrix = matrix(values, 2);
    let biclusters = Some(quietly(&matrix, SEED));
    BiScaleFile { meaning: None, matrix: Some(matrix), biclusters }
}

/// Values of one, two and four bytes.
fn all_widths() -> [BiScaleFile; 3] {
    let rows = |large: i32| small(&[vec![4, 4, 0, 1], vec![4, 4, large, 0], vec![0, 0, 0, 0]]);
    [rows(-3), rows(300), rows(-70_000)]
}

/// The transfer of hills.
fn transfer() -> BiScaleFile {
    let (vertices, maps) = sight(1, Horizon::Geometry);
    let matrix = transfer_matrix(&vertices, &maps, &LocalDirections::new(2).expect("a side")).expect("a matrix");
    let meaning = BiScaleMeaning { mesh: MeshDigest::new(&vertices), side: 2, horizon: Horizon::Geometry };
    let biclusters = Some(quietly(&matrix, SEED));
    BiScaleFile { meaning: Some(meaning), matrix: Some(matrix), biclusters }
}

#[test]
fn what_is_written_is_read() {
    let whole = transfer();
    let matrix = BiScaleFile { biclusters: None, ..whole.clone() };
    let biclusters = BiScaleFile { matrix: None, ..whole.clone() };
    for file in all_widths().into_iter().chain([whole, matrix, biclusters]) {
        let bytes = bytes(&file);
        assert_eq!(parsed(&bytes), Ok(file.clone()));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("b.npz");
        save_bi_scale(&file, &path).expect("saved");
        assert_eq!(load_bi_scale(&path).expect("read"), file);
        let error = parse_prt(&bytes, Path::new("b.npz")).expect_err("another kind").to_string();
        assert_eq!(error, "b.npz: expected a file of low-frequency transfer, found one of bi-scale transfer");
    }
}

/// Integers have the smallest type that holds all of them.
#[test]
fn values_have_types() {
    let type_of = |file: &BiScaleFile| {
        let data = members(&bytes(file)).into_iter().find(|(name, _)| name == "data.npy").expect("values").1;
        String::from_utf8_lossy(&data[21..24]).into_owned()
    };
    assert_eq!(all_widths().each_ref().map(type_of), ["|i1", "<u2", "<i4"]);
    let example = std::fs::read("docs/examples/court_biclusters.npz").expect("an example");
    assert_eq!(bytes(&parsed(&example).expect("a file")), example);
    let newer = with_metadata(&example, |text| text.replace("\"version\":1", "\"version\":3"));
    assert_eq!(parsed(&newer).expect_err("a newer version"), "b.npz: version: expected 1, found 3");
    for (from, to) in
        [("\"rows\":560", "\"rows\":0"), ("\"fraction_bits\":2", "\"fraction_bits\":31"), ("\"side\":4", "\"side\":3")]
    {
        assert!(parsed(&with_metadata(&example, |text| text.replace(from, to))).is_err(), "{to}");
    }
}

#[test]
fn parts_that_do_not_go_together_are_refused() {
    let [one, other, _] = all_widths();
    let nothing = BiScaleFile { meaning: None, matrix: None, biclusters: None };
    let larger = small(&[vec![4, 4, 0, 1, 2], vec![4, 4, 0, 0, 1], vec![0, 0, 0, 0, 0]]);
    let mixed = BiScaleFile { biclusters: larger.biclusters, ..one.clone() };
    let meaning = transfer().meaning;
    let of_no_mesh = BiScaleFile { meaning, ..other };
    for file in [nothing, mixed, of_no_mesh] {
        assert!(write_bi_scale(&file, &mut Vec::new()).is_err(), "{file:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Damaged files with corrected checksums are read or refused without a panic.
    #[test]
    fn damaged_contents_never_panic(which in 0..3_usize, member: prop::sample::Index, at: prop::sample::Index, byte: u8) {
        forgery_does_no_harm(&bytes(&all_widths()[which]), (member, at, byte), parsed, bytes);
    }
}
