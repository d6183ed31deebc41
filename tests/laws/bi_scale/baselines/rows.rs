//! Compressed rows are lossless.

use crossbar::bi_scale::baselines::{CompressedRows, LocalLightError, StoredTransfer};
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::bi_scale::product::by_rows;
use proptest::prelude::*;

use super::{any_rows, light};
use crate::bi_scale::real_matrix;
use crossbar::error::input_error;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn layouts_agree_to_the_bit(seed: u64) {
        let (matrix, light) = (any_rows(seed, 30), light(seed));
        let (narrow, wide) = (CompressedRows::narrow(&matrix).unwrap(), CompressedRows::wide(&matrix).unwrap());
        let expected = by_rows(&matrix, &light);
        prop_assert_eq!(&narrow.multiply(&light), &expected);
        prop_assert_eq!(&wide.multiply(&light), &expected);
        let singles: Vec<[f32; 2]> = light.iter().map(|&light| [light as f32, 2.0 * light as f32]).collect();
        let found = narrow.multiply_singles(&singles);
        prop_assert_eq!(&found, &wide.multiply_singles(&singles));
        for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
            prop_assert_eq!(found[1], 2.0 * found[0]);
            let magnitude: f64 = matrix.row(row).iter()
                .map(|entry| 0.25 * f64::from(entry.value.abs()) * light[entry.index as usize]).sum();
            // Per entry one rounding of the light, a product and a sum, each with error 2^-24; doubled, since f64 has a
            // smaller error.
            let bound = 2.0 * (matrix.row(row).len() + 2) as f64 * f64::from(f32::EPSILON) * magnitude;
            prop_assert!((f64::from(found[0]) - expected).abs() <= bound, "row {}", row);
        }
    }

    #[test]
    fn whole_lights_are_exact_in_singles(seed: u64) {
        let matrix = any_rows(seed, 20);
        let light: Vec<f64> = (0..6144).map(|texel| f64::from(texel * 7 % 64)).collect();
        let singles: Vec<[f32; 1]> = light.iter().map(|&light| [light as f32]).collect();
        let found = CompressedRows::narrow(&matrix).unwrap().multiply_singles(&singles);
        prop_assert_eq!(found.into_iter().map(|[sum]| f64::from(sum)).collect::<Vec<_>>(), by_rows(&matrix, &light));
    }
}

#[test]
fn sizes_are_of_entries_and_rows() {
    let matrix = any_rows(3, 25);
    let (entries, rows) = (matrix.nonzeros() as u64, 26);
    assert_eq!(CompressedRows::narrow(&matrix).unwrap().sizes()[0].bytes, 3 * entries + 4 * rows);
    assert_eq!(CompressedRows::wide(&matrix).unwrap().sizes()[0].bytes, 8 * entries + 4 * rows);
}

/// Columns and values that are out of a type's range are refused, but fit wider types.
#[test]
fn what_has_no_room_is_refused() {
    let of = |columns, index, value| {
        let mut matrix = SparseMatrix::new(columns, 0).unwrap();
        matrix.push_row(&[MatrixEntry { index, value }]).unwrap();
        (CompressedRows::narrow(&matrix).map(|_| ()), CompressedRows::wide(&matrix).is_ok())
    };
    assert_eq!(of(70_000, 65_535, 127), (Ok(()), true));
    assert_eq!(
        of(70_000, 65_536, 1),
        (
            Err(input_error!(
                "expected columns of at most 65535 in this layout, found 65536: take one of wider numbers"
            )),
            true
        )
    );
    assert_eq!(of(4, 0, -128), (Ok(()), true));
    let holds = "values of -128 to 127 units";
    assert_eq!(
        of(4, 0, 128),
        (
            Err(input_error!("expected {holds} in this layout, found {:e} in row 0: take one of wider numbers", 128.0)),
            true
        )
    );
    let tenth = real_matrix(&[vec![0.1, 0.0]]);
    assert_eq!(
        CompressedRows::narrow(&tenth).err(),
        Some(input_error!("expected {holds} in this layout, found {:e} in row 0: take one of wider numbers", 0.1))
    );
    assert_eq!(CompressedRows::wide(&tenth).unwrap().multiply(&[1.0, 1.0]), [f64::from(0.1_f32)]);
    let (large, holds) = (real_matrix(&[vec![0.0], vec![1e300]]), "values within single precision");
    assert_eq!(
        CompressedRows::wide(&large).err(),
        Some(input_error!("expected {holds} in this layout, found {:e} in row 1: take one of wider numbers", 1e300))
    );
}

#[test]
fn what_differs_is_found() {
    let light = light(1);
    let expected = by_rows(&any_rows(1, 20), &light);
    let error = LocalLightError::new(&CompressedRows::wide(&any_rows(2, 20)).unwrap().multiply(&light), &expected);
    assert!(error.relative > 0.1 && error.largest >= error.root_mean_square, "{error:?}");
}
