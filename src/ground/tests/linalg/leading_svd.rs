use approx::assert_abs_diff_eq;
use crossbar_ground::linalg::{LeadingSvd, Matrix, dot};
use nalgebra::DMatrix;

fn matrix([rows, columns]: [usize; 2], rule: impl Fn(usize, usize) -> f64) -> Matrix {
    Matrix::new([rows, columns], (0..rows * columns).map(|at| rule(at / columns, at % columns)).collect())
        .expect("a small matrix")
}

/// All singular values by nalgebra, largest first.
fn all_values(matrix: &Matrix) -> Vec<f64> {
    let values: Vec<f64> = matrix.rows().flatten().copied().collect();
    let matrix = DMatrix::from_row_slice(matrix.row_count(), matrix.column_count(), &values);
    matrix.singular_values().as_slice().to_vec()
}

/// Product of left vectors, values and right vectors.
fn product(svd: &LeadingSvd) -> Matrix {
    let mut right = svd.right.clone();
    for (k, value) in svd.values.iter().enumerate().take(right.row_count()) {
        right.row_mut(k).iter_mut().for_each(|element| *element *= value);
    }
    svd.left.transposed().product(&right).expect("a small matrix")
}

fn largest_difference(a: &Matrix, b: &Matrix) -> f64 {
    a.rows().flatten().zip(b.rows().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn assert_orthonormal(rows: &Matrix, tolerance: f64) {
    for (i, a) in rows.rows().enumerate() {
        for (j, b) in rows.rows().enumerate() {
            assert_abs_diff_eq!(dot(a, b), f64::from(u8::from(i == j)), epsilon = tolerance);
        }
    }
}

#[test]
fn values_and_vectors_are_those_of_the_full_factorisation() {
    for size in [[1, 1], [2, 2], [3, 7], [40, 40], [90, 33], [33, 90], [200, 190], [1, 5], [5, 1]] {
        let m = matrix(size, |i, j| ((i * 31 + j * 17 + i * j * j) % 23) as f64 - 11.0);
        let (all, leading) = (all_values(&m), LeadingSvd::new(&m, usize::MAX).expect("leading"));
        assert_eq!(all.len(), leading.values.len());
        for (a, b) in all.iter().zip(&leading.values) {
            assert_abs_diff_eq!(a, b, epsilon = 1e-13 * all[0]);
        }
        assert!(largest_difference(&product(&leading), &m) < 1e-12 * all[0], "{size:?}");
        assert_orthonormal(&leading.left, 1e-10);
        assert_orthonormal(&leading.right, 1e-10);
        let one = LeadingSvd::new(&m, 1).expect("one");
        let same = |a: &Matrix, b: &Matrix| a.row(0).iter().zip(b.row(0)).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same(&one.right, &leading.right) && same(&one.left, &leading.left), "{size:?}");
    }
}

/// Squares of the small values would underflow relative to the square of the largest.
#[test]
fn small_values_keep_their_digits() {
    let m = matrix([20, 20], |i, j| if i == j { (0..i).fold(1.0, |value, _| value * 0.25) } else { 0.0 });
    let leading = LeadingSvd::new(&m, 20).expect("all");
    assert_eq!(leading.rank, 20);
    for (k, value) in leading.values.iter().enumerate() {
        assert_abs_diff_eq!(*value, m.row(k)[k], epsilon = 4.0 * f64::EPSILON * m.row(k)[k]);
    }
    // A rotated matrix with the same singular values.
    let turned = matrix([20, 20], |i, j| {
        let h = |a: usize, b: usize| f64::from(u8::from(a == b)) - 2.0 * (a + 1) as f64 * (b + 1) as f64 / 2870.0;
        (0..20).map(|k| h(i, k) * m.row(k)[k] * h(k, j)).sum()
    });
    for (a, b) in LeadingSvd::new(&turned, 0).expect("values").values.iter().zip(&leading.values) {
        assert_abs_diff_eq!(a, b, epsilon = 1e-15);
    }
}

#[test]
fn ranks_below_the_size_and_equal_values_are_found() {
    let ones = LeadingSvd::new(&matrix([30, 20], |_, _| 1.0), 9).expect("one");
    assert_eq!((ones.rank, ones.left.row_count(), ones.right.row_count()), (1, 1, 1));
    assert_abs_diff_eq!(ones.values[0], 600.0_f64.sqrt(), epsilon = 1e-12);
    let same = LeadingSvd::new(&matrix([9, 9], |i, j| if i == j { 3.0 } else { 0.0 }), 9).expect("all");
    assert_eq!(same.rank, 9);
    same.values.iter().for_each(|value| assert_abs_diff_eq!(*value, 3.0, epsilon = 1e-15));
    assert_orthonormal(&same.left, 1e-15);
    let ring = matrix([33, 33], |i, j| f64::from(u8::from((i + 1) % 33 == j || (j + 1) % 33 == i)));
    let pairs = LeadingSvd::new(&ring, 33).expect("all");
    assert!(largest_difference(&product(&pairs), &ring) < 1e-13);
    let zero = LeadingSvd::new(&matrix([4, 3], |_, _| 0.0), 2).expect("none");
    assert_eq!((zero.rank, zero.values, zero.right.row_count()), (0, vec![0.0; 3], 0));
    assert_eq!(LeadingSvd::new(&matrix([0, 0], |_, _| 0.0), 2).expect("none").values, [0.0; 0]);
}

/// Zero rows and columns between others, as in maps with texels beyond the rim.
#[test]
fn zeros_in_between_change_nothing() {
    let inner = |i: usize, j: usize| 1.0 / (1.0 + i as f64 + 2.0 * j as f64);
    let whole = matrix([12, 12], inner);
    let at = |i: usize| (i % 3 != 1).then_some(i / 3 * 2 + i % 3 / 2);
    let holed = matrix([18, 18], |i, j| at(i).zip(at(j)).map_or(0.0, |(i, j)| inner(i, j)));
    let [whole, holed] = [whole, holed].map(|m| LeadingSvd::new(&m, 6).expect("values"));
    assert_eq!(whole.rank, holed.rank);
    for (a, b) in whole.values.iter().zip(&holed.values) {
        assert_abs_diff_eq!(a, b, epsilon = 18.0 * f64::EPSILON * whole.values[0]);
    }
}

#[test]
fn any_magnitude_is_taken_and_no_number_refused() {
    for scale in [1e-290, 1.0, 1e290] {
        let m = matrix([9, 7], |i, j| scale * ((i * 5 + j * j) % 7) as f64);
        let (all, leading) = (all_values(&m), LeadingSvd::new(&m, 2).expect("two"));
        assert_abs_diff_eq!(all[0] / scale, leading.values[0] / scale, epsilon = 1e-12);
    }
    let nan = matrix([3, 3], |i, j| if i == 2 && j == 1 { f64::NAN } else { 1.0 });
    assert_eq!(
        LeadingSvd::new(&nan, 1).unwrap_err().to_string(),
        "expected finite elements, found 1 that are not finite"
    );
}
