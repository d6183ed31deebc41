//! Rows of columns and values.

use crossbar::bi_scale::baselines::{CompressedRows, LocalLightError, StoredTransfer};
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::bi_scale::product::by_rows;

use super::{any_rows, light};

#[test]
fn sizes_are_of_entries_and_rows() {
    let matrix = any_rows(3, 25);
    let (entries, rows) = (matrix.nonzeros() as u64, 26);
    assert_eq!(CompressedRows::narrow(&matrix).expect("small values").sizes()[0].bytes, 3 * entries + 4 * rows);
    assert_eq!(CompressedRows::wide(&matrix).sizes()[0].bytes, 8 * entries + 4 * rows);
}

/// Columns and values that do not fit have no narrow layout.
#[test]
fn what_has_no_room_is_not_stored() {
    let fits = |columns, index, value| {
        let mut matrix = SparseMatrix::new(columns, 0).unwrap();
        matrix.push_row(&[MatrixEntry { index, value }]).unwrap();
        CompressedRows::narrow(&matrix).is_some()
    };
    assert!(fits(65_536, 65_535, 127) && fits(4, 0, -128));
    assert!(!fits(65_537, 0, 1) && !fits(4, 0, 128));
}

#[test]
fn what_differs_is_found() {
    let light = light(1);
    let expected = by_rows(&any_rows(1, 20), &light);
    let other = any_rows(2, 20);
    let error = LocalLightError::new(&CompressedRows::wide(&other).multiply(&light), &expected);
    assert!(error.relative > 0.1 && error.largest >= error.root_mean_square, "{error:?}");
}
