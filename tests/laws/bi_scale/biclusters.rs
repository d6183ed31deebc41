//! Biclusters: the fast search against a literal Algorithm 1, and properties for any matrix.

use crossbar::bi_scale::bicluster::{Biclustering, SEED, bicluster};
use crossbar::bi_scale::matrix::MatrixEntry;
use crossbar::bi_scale::paper;
use crossbar::bi_scale::product::{Gather, by_rows};
use proptest::prelude::*;
use refsim::num::power_of_two;

use super::{bits, blocks, matrix, numbers_of, quietly, real_blocks, real_matrix};

/// Values of any size and sign, with few zeros.
fn anything() -> impl Strategy<Value = Vec<Vec<i32>>> {
    let value = prop_oneof![2 => Just(0), 4 => -3..4_i32, 1 => -1_000_000..1_000_000_i32];
    (1..10_usize, 1..10_usize).prop_flat_map(move |(rows, columns)| {
        prop::collection::vec(prop::collection::vec(value.clone(), columns), rows)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// The search decides as Algorithm 1, and its biclusters sum to the matrix.
    #[test]
    fn the_fast_search_decides_as_algorithm_1(rows in prop_oneof![3 => blocks(), 1 => anything()], seed: u64) {
        let matrix = matrix(&rows, 2);
        let expected = paper::biclusters(&matrix, seed);
        let mut left = vec![matrix.nonzeros() as u64];
        let found = bicluster(&matrix, seed, &mut |now| left.push(now)).unwrap();
        for index in 0..expected.len().min(found.len()) {
            prop_assert_eq!(expected.get(index), found.get(index), "bicluster {}", index);
        }
        prop_assert_eq!(&expected, &found);
        prop_assert_eq!(found.sum(), Ok(matrix.clone()));
        // Each bicluster removes at least half its cost in nonzeros, so the total cost is at most twice the non-zeros.
        for (index, step) in left.windows(2).enumerate() {
            prop_assert!(2 * step[1] + found.get(index).cost() <= 2 * step[0], "bicluster {}", index);
        }
        prop_assert_eq!(left.last(), Some(&0));
        prop_assert!(found.cost() <= 2 * matrix.nonzeros() as u64);
    }

    /// Light of whole numbers is transferred exactly, any light within the rounding.
    #[test]
    fn light_is_transferred(
        rows in blocks(), seed: u64, whole in prop::collection::vec(0..1000_u16, 12),
        light in prop::collection::vec(0.0..1e4_f32, 12),
    ) {
        let matrix = matrix(&rows, 2);
        let found = quietly(&matrix, seed);
        let gather = Gather::new(&found);
        let fast = |light: &[f32]| -> Vec<f64> {
            let sums = gather.multiply(&light.iter().map(|&texel| [texel]).collect::<Vec<_>>());
            sums.into_iter().map(|[sum]| f64::from(sum)).collect()
        };
        let wide = |light: &[f32]| light.iter().map(|&texel| f64::from(texel)).collect::<Vec<f64>>();
        let whole: Vec<f32> = whole[..matrix.columns()].iter().map(|&texel| f32::from(texel)).collect();
        let expected = by_rows(&matrix, &wide(&whole));
        prop_assert_eq!(&paper::multiply(&found, &wide(&whole)), &expected);
        // Sums of multiples of a quarter below 2^22 are also exact in f32.
        prop_assert_eq!(fast(&whole), expected);
        let light = &light[..matrix.columns()];
        let expected = paper::multiply(&found, &wide(light));
        // For each row, the sum of magnitudes and the largest number of operations on a term.
        let [rows, _] = found.matrix_size();
        let (mut magnitude, mut operations) = (vec![0.0; rows], vec![0; rows]);
        for index in 0..found.len() {
            let columns = found.columns_of(index);
            let sum: f64 = columns
                .iter()
                .map(|entry| found.value(entry.value).abs() * f64::from(light[entry.index as usize]))
                .sum();
            for &row in found.rows_of(index) {
                magnitude[row as usize] += sum;
                operations[row as usize] += 1 + columns.len() + 1;
            }
        }
        for (row, (fast, expected)) in fast(light).iter().zip(&expected).enumerate() {
            // (1 + u)^n - 1 <= 2 n u for n u below a half, with u = 2^-24. Doubled, because f64 also has a (smaller)
            // error.
            let bound = 4.0 * operations[row] as f64 * f64::from(f32::EPSILON) / 2.0 * magnitude[row];
            prop_assert!((fast - expected).abs() <= bound, "row {row}: {fast} for {expected}");
        }
    }
}

/// Bound on the rounding error of the sum of biclusters, per entry. An entry v that is split into n terms t_k has
/// residuals r_0 = v, r_k = r_(k-1) - t_k and r_n = 0, each rounded by at most u |r_k| with u = EPSILON / 2, so the
/// exact sum of the t_k differs from v by at most the sum of these roundings. Adding the t_k rounds n more times. To
/// first order no partial sum exceeds S = |v| + sum |t_k|, so the bound is 2 n u S; n + 2 instead of n covers the terms
/// of second order.
fn rounding(found: &Biclustering, rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut sizes: Vec<Vec<f64>> = rows.iter().map(|row| row.iter().map(|value| value.abs()).collect()).collect();
    let mut counts: Vec<Vec<f64>> = rows.iter().map(|row| vec![2.0; row.len()]).collect();
    for index in 0..found.len() {
        for (row, entry) in
            found.rows_of(index).iter().flat_map(|row| found.columns_of(index).iter().map(move |e| (row, e)))
        {
            sizes[*row as usize][entry.index as usize] += found.value(entry.value).abs();
            counts[*row as usize][entry.index as usize] += 1.0;
        }
    }
    let bound = |(size, count): (&f64, &f64)| if *count > 3.0 { size * count * f64::EPSILON } else { 0.0 };
    sizes.iter().zip(&counts).map(|(sizes, counts)| sizes.iter().zip(counts).map(bound).collect()).collect()
}

#[test]
fn residuals_beyond_doubles_are_refused() {
    let mut rows = vec![vec![f64::MAX, 0.1, 0.1, 0.1, 0.1]; 6];
    rows[0][0] = f64::MIN;
    assert!(bicluster(&real_matrix(&rows), SEED, &mut |_| ()).is_err());
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

/// A residual of 2^31 units does not fit into 32 bits: the search continues with a table, and the matrix is recovered
/// in its own unit.
#[test]
fn residuals_leave_32_bits() {
    let mut rows = vec![vec![i32::MIN, 1, 1, 1, 1, 1]; 7];
    rows[0][0] = 0;
    let matrix = matrix(&rows, 2);
    let found = quietly(&matrix, SEED);
    assert_eq!((found.values().fraction_bits(), found.values().table_len()), (Some(2), Some(3)));
    assert_eq!(paper::biclusters(&matrix, SEED), found);
    assert_eq!(found.sum(), Ok(matrix));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Subnormal numbers, 1e-300 together with 1e300, and 53-bit numbers are decided as by Algorithm 1 and recovered up
    /// to rounding.
    #[test]
    fn any_numbers_come_back(rows in real_blocks(), seed: u64) {
        let matrix = real_matrix(&rows);
        prop_assert_eq!(bits(&numbers_of(&matrix)), bits(&rows));
        let found = quietly(&matrix, seed);
        prop_assert_eq!(&paper::biclusters(&matrix, seed), &found);
        let sum = numbers_of(&found.sum().expect("sums of a matrix"));
        let bounds = rounding(&found, &rows);
        for (row, column) in (0..rows.len()).flat_map(|row| (0..rows[0].len()).map(move |column| (row, column))) {
            let off = (sum[row][column] - rows[row][column]).abs();
            prop_assert!(off <= bounds[row][column], "{off} in row {row}, column {column}");
        }
        prop_assert!(found.cost() <= 2 * matrix.nonzeros() as u64);
    }

    /// Multiples of a power of two, below 2^40 times that power, are subtracted without rounding.
    #[test]
    fn numbers_of_few_bits_come_back_exactly(
        rows in anything(), factor in 1..1_000_000_i32, power in -1000..900_i32, seed: u64,
    ) {
        let number = |&value: &i32| f64::from(value) * f64::from(factor) * power_of_two(power);
        let rows: Vec<Vec<f64>> = rows.iter().map(|row| row.iter().map(number).collect()).collect();
        let found = quietly(&real_matrix(&rows), seed);
        prop_assert_eq!(bits(&numbers_of(&found.sum().expect("a matrix"))), bits(&rows));
    }

    /// Rows that are multiples of one row yield one bicluster per factor; the only row of a factor is split into
    /// columns at the same cost.
    #[test]
    fn matrices_of_rank_1_are_few_biclusters(
        row in prop::collection::vec(0.5..1.0_f64, 6..12),
        powers in prop::collection::vec(-500..500_i32, 12),
        factors in prop::sample::subsequence(vec![0.1, -1.3, 1e-150, 3.0, 7e150], 1..5),
        choice in prop::collection::vec(any::<prop::sample::Index>(), 10..30),
        seed: u64,
    ) {
        let column = |(at, value): (usize, &f64)| value * power_of_two(powers[at]);
        let row: Vec<f64> = row.iter().enumerate().map(column).collect();
        let of_row: Vec<usize> = choice.iter().map(|choice| choice.index(factors.len())).collect();
        let rows: Vec<Vec<f64>> =
            of_row.iter().map(|&factor| row.iter().map(|value| factors[factor] * value).collect()).collect();
        let found = quietly(&real_matrix(&rows), seed);
        let rows_of = |factor: usize| of_row.iter().filter(|&&other| other == factor).count();
        let biclusters = (0..factors.len()).map(|factor| match rows_of(factor) {
            0 => 0,
            1 => row.len(),
            _ => 1,
        });
        prop_assert_eq!(found.len(), biclusters.sum::<usize>());
        prop_assert_eq!(bits(&numbers_of(&found.sum().expect("a matrix"))), bits(&rows));
    }

    /// The search finds the same biclusters for numbers in a table and in units; multiples of 2^-42 have no unit.
    #[test]
    fn the_scale_of_numbers_decides_nothing(rows in blocks(), seed: u64) {
        let small = |value: &i32| f64::from(*value) * power_of_two(-42);
        let tabled: Vec<Vec<f64>> = rows.iter().map(|row| row.iter().map(small).collect()).collect();
        let (in_units, in_table) = (quietly(&matrix(&rows, 2), seed), quietly(&real_matrix(&tabled), seed));
        prop_assert_eq!(in_units.len(), in_table.len());
        for number in 0..in_units.len() {
            prop_assert_eq!(in_units.rows_of(number), in_table.rows_of(number));
            let columns = in_units.columns_of(number).iter().map(|at| (at.index, in_units.value(at.value)));
            let tabled = in_table.columns_of(number).iter().map(|at| (at.index, in_table.value(at.value)));
            prop_assert!(columns.eq(tabled.map(|(index, value)| (index, value * power_of_two(40)))));
        }
    }
}
