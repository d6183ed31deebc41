//! Biclusters: the fast search against a literal Algorithm 1, and properties for any matrix.

use crossbar::bi_scale::bicluster::{SEED, bicluster};
use crossbar::bi_scale::matrix::MatrixEntry;
use crossbar::bi_scale::paper;
use crossbar::bi_scale::product::{Gather, by_rows};
use proptest::prelude::*;

use super::{blocks, matrix, quietly};

/// Values of any size and sign, with few zeros.
fn anything() -> impl Strategy<Value = Vec<Vec<i32>>> {
    let value = prop_oneof![2 => Just(0), 4 => -3..4_i32, 1 => -1_000_000..1_000_000_i32];
    (1..10_usize, 1..10_usize).prop_flat_map(move |(rows, columns)| {
        prop::collection::vec(prop::collection::vec(value.clone(), columns), rows)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn the_fast_search_decides_as_algorithm_1(
        rows in prop_oneof![3 => blocks(), 1 => anything()],
        seed: u64,
    ) {
        let matrix = matrix(&rows, 2);
        let expected = paper::biclusters(&matrix, seed);
        let found = quietly(&matrix, seed);
        for index in 0..expected.len().min(found.len()) {
            prop_assert_eq!(expected.get(index), found.get(index), "bicluster {}", index);
        }
        prop_assert_eq!(expected, found);
    }

    #[test]
    fn biclusters_sum_to_the_matrix(rows in prop_oneof![blocks(), anything()], seed: u64) {
        let matrix = matrix(&rows, 2);
        let mut left = vec![matrix.nonzeros() as u64];
        let found = bicluster(&matrix, seed, &mut |now| left.push(now)).unwrap();
        prop_assert_eq!(found.sum(), Ok(matrix.clone()));
        // Each bicluster removes at least half its cost in nonzeros, so the total cost is at most twice the non-zeros.
        for (index, step) in left.windows(2).enumerate() {
            prop_assert!(2 * step[1] + found.get(index).cost() <= 2 * step[0], "bicluster {}", index);
        }
        prop_assert_eq!(left.last(), Some(&0));
        prop_assert!(found.cost() <= 2 * matrix.nonzeros() as u64);
    }

    #[test]
    fn light_is_transferred_exactly(rows in blocks(), seed: u64, light in prop::collection::vec(0..1000_u16, 12)) {
        let matrix = matrix(&rows, 2);
        let found = quietly(&matrix, seed);
        let light: Vec<f64> = light[..matrix.columns()].iter().map(|&texel| f64::from(texel)).collect();
        let expected = by_rows(&matrix, &light);
        prop_assert_eq!(&paper::multiply(&found, &light), &expected);
        // Sums of multiples of a quarter below 2^22 are also exact in f32.
        let fast = Gather::new(&found).multiply(&light.iter().map(|&texel| [texel as f32]).collect::<Vec<_>>());
        prop_assert_eq!(fast.into_iter().map(|[sum]| f64::from(sum)).collect::<Vec<f64>>(), expected);
    }
}

/// The example of section IV-C, whose second row differs by 2 in one column.
#[test]
fn a_residual_is_left_for_later() {
    let rows = vec![vec![4, 3, 2, 1]; 6].into_iter().enumerate().map(|(row, mut values)| {
        if row == 1 {
            values[1] += 2;
        }
        values
    });
    let matrix = matrix(&rows.collect::<Vec<_>>(), 2);
    let found = quietly(&matrix, SEED);
    assert_eq!(found.len(), 2);
    assert_eq!((found.rows_of(0).len(), found.columns_of(0).len()), (6, 4));
    assert_eq!((found.rows_of(1), found.columns_of(1)), (&[1][..], &[MatrixEntry { index: 1, value: 2 }][..]));
    assert_eq!(found.cost(), (6 + 8 - 1) + 2);
}

#[test]
fn a_matrix_of_nothing_has_no_biclusters() {
    let matrix = matrix(&[vec![0, 0], vec![0, 0]], 0);
    let found = quietly(&matrix, SEED);
    assert!(found.is_empty());
    assert_eq!(paper::multiply(&found, &[1.0, 2.0]), [0.0, 0.0]);
    assert_eq!(found.sum(), Ok(matrix));
}

#[test]
fn residuals_beyond_32_bits_are_refused() {
    let mut rows = vec![vec![i32::MIN, 1, 1, 1, 1, 1]; 7];
    rows[0][0] = 0;
    let error = bicluster(&matrix(&rows, 2), SEED, &mut |_| ()).expect_err("2^31 units").to_string();
    assert_eq!(error, "expected residuals that fit into 32 bits, found larger residuals");
}
