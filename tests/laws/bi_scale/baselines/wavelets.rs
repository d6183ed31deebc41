//! Compares rows stored as wavelet coefficients with plain loops.

use approx::assert_relative_eq;
use crossbar::bi_scale::baselines::{
    CoefficientPriority, CoefficientStorage, HaarRowOptions, HaarRows, StoredTransfer,
};
use crossbar::bi_scale::matrix::SparseMatrix;
use crossbar::bi_scale::product::by_rows;
use crossbar::transfer::haar::Haar;

use super::{any_rows, dense_row, light, transfer};

const PRIORITIES: [CoefficientPriority; 2] = [CoefficientPriority::Area, CoefficientPriority::Magnitude];

/// The row that stored coefficients represent.
fn approximation(rows: &HaarRows, row: usize) -> Vec<f64> {
    let mut values = vec![0.0; 6144];
    rows.row(row).for_each(|(at, value)| values[at] = value);
    values.chunks_exact_mut(1024).for_each(|face| Haar::new(32).inverse(face));
    values
}

fn singles(matrix: &SparseMatrix, keep: usize, priority: CoefficientPriority) -> HaarRows {
    let storage = CoefficientStorage::Single;
    HaarRows::new(matrix, HaarRowOptions { keep, priority, storage }).expect("rows")
}

/// A row from its `keep` largest wavelet coefficients: all six faces transformed, all coefficients sorted, the others
/// set to 0, and transformed back.
fn by_largest_coefficients(row: &[f64], keep: usize, priority: CoefficientPriority) -> Vec<f64> {
    let face = 1024;
    let mut haar = Haar::new(32);
    let mut coefficients = row.to_vec();
    for of_face in coefficients.chunks_exact_mut(face) {
        haar.forward(of_face);
    }
    let mut order: Vec<(f64, usize)> = Vec::new();
    for (at, value) in coefficients.iter().enumerate() {
        let side = haar.support(at % face).side as f64;
        let weight = match priority {
            CoefficientPriority::Area => side * side,
            CoefficientPriority::Magnitude => 1.0,
        };
        order.push((weight * value.abs(), at));
    }
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    for &(_, at) in &order[keep.min(order.len())..] {
        coefficients[at] = 0.0;
    }
    for of_face in coefficients.chunks_exact_mut(face) {
        haar.inverse(of_face);
    }
    coefficients
}

/// Coefficients of quarters are multiples of powers of two, so nothing is rounded.
#[test]
fn the_largest_coefficients_are_those_of_plain_loops() {
    for seed in 0..12 {
        let matrix = any_rows(seed, 12);
        for (keep, priority) in [1, 2, 12, 100, 6144].into_iter().flat_map(|keep| PRIORITIES.map(|p| (keep, p))) {
            let found = singles(&matrix, keep, priority);
            for row in 0..matrix.rows() {
                let expected = by_largest_coefficients(&dense_row(&matrix, row), keep, priority);
                assert!(found.row(row).len() <= keep);
                assert!(approximation(&found, row) == expected, "seed {seed}, row {row}, {keep} by {priority}");
            }
        }
    }
}

/// Orthonormal wavelets: with all coefficients the product equals the matrix's; with fewer, it equals the product of
/// the represented rows, and selection by magnitude has the smallest squared error.
#[test]
fn products_are_those_of_the_approximated_rows() {
    let (matrix, light) = (transfer().1, light(7));
    let all = singles(&matrix, 6144, CoefficientPriority::Area).multiply(&light);
    for (found, expected) in all.iter().zip(by_rows(&matrix, &light)) {
        assert_relative_eq!(*found, expected, max_relative = 1e-12, epsilon = 1e-14);
    }
    let mut squares = [0.0; 2];
    for (priority, squares) in PRIORITIES.into_iter().zip(&mut squares) {
        let rows = singles(&matrix, 12, priority);
        for (row, found) in rows.multiply(&light).into_iter().enumerate() {
            let values = approximation(&rows, row);
            let expected: f64 = values.iter().zip(&light).map(|(value, light)| value * light).sum();
            assert_relative_eq!(found, expected, max_relative = 1e-11, epsilon = 1e-14);
            let exact = dense_row(&matrix, row);
            *squares += values.iter().zip(&exact).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        }
    }
    assert!(squares[1] > 0.0 && 1.2 * squares[1] < squares[0], "{squares:?}");
}

/// Coefficients in bytes have an error of at most half a step; sizes count the stored data.
#[test]
fn bytes_are_steps_of_the_largest() {
    let matrix = any_rows(5, 40);
    let exact = singles(&matrix, 12, CoefficientPriority::Area);
    let coarse = HaarRows::new(&matrix, HaarRowOptions::default()).expect("rows");
    let values = |rows: &HaarRows| (0..40).flat_map(|row| rows.row(row).collect::<Vec<_>>()).collect::<Vec<_>>();
    let (exact_values, coarse_values) = (values(&exact), values(&coarse));
    let step = exact_values.iter().fold(0.0_f64, |most, (_, value)| most.max(value.abs())) / 127.0;
    let mut moved = 0;
    for ((at, exact), (place, coarse)) in exact_values.iter().zip(&coarse_values) {
        assert_eq!(at, place);
        assert!((exact - coarse).abs() <= 0.5001 * step, "{exact} to {coarse} in steps of {step}");
        moved += usize::from(exact != coarse);
    }
    assert!(moved > 100, "{moved} of {}", exact_values.len());
    assert_eq!([coarse.sizes()[0].bytes, exact.sizes()[0].bytes], [3 * 12 * 40, 6 * 12 * 40]);
    let stored = exact_values.len() as u64;
    assert_eq!([coarse.sizes()[1].bytes, exact.sizes()[1].bytes], [3 * stored + 4 * 41, 6 * stored + 4 * 41]);
    let options = HaarRowOptions::default();
    assert_eq!([35_u64, 36, 10_000].map(|bytes| options.within(40 * bytes, 40).keep), [11, 12, 3333]);
}

#[test]
fn what_is_no_transfer_is_refused() {
    let narrow = SparseMatrix::new(32, 0).unwrap();
    let refused = HaarRows::new(&narrow, HaarRowOptions::default()).unwrap_err().to_string();
    assert_eq!(refused, "expected a matrix of 6144 columns, a light texel each, found 32");
    let none = HaarRowOptions { keep: 0, ..HaarRowOptions::default() };
    let refused = HaarRows::new(&any_rows(1, 2), none).unwrap_err().to_string();
    assert_eq!(refused, "expected 1 to 6144 coefficients per row, found 0");
}
