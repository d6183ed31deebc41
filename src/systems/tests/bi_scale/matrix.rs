//! Local directions; the numbers that entries of matrices and biclusters represent; start elements of biclusters.

use approx::assert_abs_diff_eq;
use crossbar_systems::bi_scale::bicluster::bicluster;
use crossbar_systems::bi_scale::directions::{LocalDirections, hemisphere, square};
use crossbar_systems::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use glam::DVec3;

use crate::error::InputError;
use crate::geom::random::CounterRng;
use crate::io::CoordinateMatrix;

#[test]
fn the_square_and_the_hemisphere_are_one_to_one() {
    for (i, j) in (0..=40).flat_map(|i| (0..=40).map(move |j| (i, j))) {
        let point = [i, j].map(|at| f64::from(at) / 20.0 - 1.0);
        let direction = hemisphere(point);
        assert_abs_diff_eq!(direction.length(), 1.0, epsilon = 1e-15);
        assert!(direction.z >= 0.0);
        let back = square(direction);
        assert_abs_diff_eq!(back[0], point[0], epsilon = 1e-7);
        assert_abs_diff_eq!(back[1], point[1], epsilon = 1e-7);
    }
}

/// Solid angles of cells, summed over triangles of a fine grid, are equal.
#[test]
fn areas_are_kept() {
    let (cells, fine) = (6, 40);
    let at = |i: usize, j: usize| hemisphere([i, j].map(|at| 2.0 * at as f64 / (cells * fine) as f64 - 1.0));
    let area = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a).length() / 2.0;
    let expected = std::f64::consts::TAU / (cells * cells) as f64;
    for (u, v) in (0..cells).flat_map(|u| (0..cells).map(move |v| (u, v))) {
        let corners = (0..fine * fine).map(|k| (u * fine + k % fine, v * fine + k / fine));
        let sum: f64 = corners
            .map(|(i, j)| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
                area(a, b, c) + area(b, c, d)
            })
            .sum();
        assert_abs_diff_eq!(sum / expected, 1.0, epsilon = 2e-3);
    }
}

#[test]
fn the_nearest_is_that_of_all() {
    let random = CounterRng::new(3);
    for side in [1, 2, 3, 5, 8, 12, 16, 32] {
        let directions = LocalDirections::new(side).unwrap();
        for number in 0..20_000 {
            let [x, y, z] = [0, 1, 2].map(|k| 2.0 * random.unit(number, side as u64, k) - 1.0);
            let direction = DVec3::new(x, y, z).normalize();
            assert_eq!(directions.nearest(direction), directions.nearest_of_all(direction), "{side}: {direction}");
        }
    }
}

#[test]
fn squares_of_too_many_cells_are_refused() {
    let found = LocalDirections::new(65).unwrap_err().to_string();
    assert_eq!(found, "expected 1 to 64 directions along an edge of the square, found 65");
}

#[test]
fn a_wrong_row_changes_nothing() {
    let entry = |index, value| MatrixEntry { index, value };
    let mut matrix = SparseMatrix::new(4, 2).unwrap();
    matrix.push_row(&[entry(0, 4), entry(3, 1)]).unwrap();
    let before = matrix.clone();
    let wrong = [
        (vec![entry(4, 1)], "expected a column below 4 in row 1, found 4"),
        (
            vec![entry(2, 1), entry(2, 3)],
            "expected increasing columns in row 1, found 2 after 2: is an entry given twice?",
        ),
        (vec![entry(1, 0)], "expected values other than 0, found 0 in row 1, column 1"),
    ];
    for (row, error) in wrong {
        assert_eq!(matrix.push_row(&row).expect_err("refused").to_string(), error);
        assert_eq!(matrix, before);
    }
    assert_eq!(
        SparseMatrix::new(0, 2).expect_err("refused").to_string(),
        "expected 1 to 4294967295 rows and columns, found 0 x 0"
    );
    assert_eq!((matrix.value(1), matrix.nonzeros()), (0.25, 2));
}

fn of(entries: &[(u32, u32, f64)]) -> Result<SparseMatrix, InputError> {
    SparseMatrix::from_coordinates(&CoordinateMatrix { rows: 3, columns: 4, entries: entries.to_vec() })
}

#[test]
fn real_numbers_get_the_largest_units() {
    let matrix = of(&[(0, 1, 0.5), (2, 0, -3.0), (2, 1, 0.0), (2, 3, 0.25)]).unwrap();
    assert_eq!((matrix.fraction_bits(), matrix.nonzeros(), matrix.rows()), (2, 3, 3));
    assert_eq!(matrix.row(2), [MatrixEntry { index: 0, value: -12 }, MatrixEntry { index: 3, value: 1 }]);
    assert_eq!(of(&[(0, 1, 6e8)]).unwrap().fraction_bits(), 0);
    assert_eq!(of(&[]).unwrap().fraction_bits(), 0);
}

#[test]
fn numbers_without_a_unit_are_refused() {
    for numbers in [[0.1, 0.25], [6e8, 0.25], [1e200, 1.0], [f64::from_bits(1), -1e300], [f64::MAX, -0.1]] {
        let said = of(&[(0, 1, numbers[0]), (2, 0, numbers[1])]).expect_err("refused").to_string();
        assert!(said.starts_with("expected multiples of a single power of two"), "{said}");
    }
    let infinite = of(&[(0, 0, 0.1), (1, 1, f64::INFINITY)]).expect_err("refused").to_string();
    assert_eq!(infinite, "expected finite values, found inf in row 1, column 1");
}

#[test]
fn every_element_is_drawn_alike() {
    let diagonal: Vec<(u32, u32, f64)> = (0..10).map(|at| (at, at, f64::from(at + 1))).collect();
    let matrix = SparseMatrix::from_coordinates(&CoordinateMatrix { rows: 10, columns: 10, entries: diagonal });
    let (matrix, mut drawn) = (matrix.unwrap(), [0; 10]);
    for seed in 0..10_000 {
        let found = bicluster(&matrix, seed, &mut |_| ()).expect("biclusters");
        drawn[found.rows_of(0)[0] as usize] += 1;
    }
    assert!(drawn.iter().all(|count| (900..1100).contains(count)), "{drawn:?}");
}
