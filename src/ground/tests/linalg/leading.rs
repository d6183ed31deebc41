use approx::assert_abs_diff_eq;
use crossbar_ground::linalg::{LeadingEigen, Matrix, SymmetricEigen, dot};

/// Symmetric matrix of integers from a rule.
fn matrix(size: usize, rule: impl Fn(usize, usize) -> f64) -> Matrix {
    let values = (0..size * size).map(|at| rule((at / size).max(at % size), (at / size).min(at % size)));
    Matrix::new([size; 2], values.collect()).expect("a matrix")
}

#[test]
fn pairs_are_those_of_the_full_factorisation() {
    for size in [1, 2, 3, 7, 40, 90] {
        let m = matrix(size, |i, j| ((i * 31 + j * 17 + i * j) % 23) as f64 - 11.0);
        let (all, leading) = (SymmetricEigen::new(&m).expect("all"), LeadingEigen::new(&m, 5).expect("five"));
        for (a, b) in all.values.iter().zip(&leading.values) {
            assert_abs_diff_eq!(a, b, epsilon = 1e-11 * size as f64);
        }
        assert_eq!(leading.vectors.row_count(), size.min(5));
        for (i, vector) in leading.vectors.rows().enumerate() {
            assert_abs_diff_eq!(dot(vector, all.vectors.row(i)), 1.0, epsilon = 1e-10);
        }
    }
}

#[test]
fn repeated_and_vanishing_eigenvalues_have_orthonormal_vectors() {
    let same = |size| matrix(size, |i, j| if i == j { 3.0 } else { 0.0 });
    let ones = |size| matrix(size, |_, _| 1.0);
    // Eigenvalues of a ring of neighbours come in pairs.
    let ring = |size| matrix(size, move |i, j| if i - j == 1 || i - j == size - 1 { 1.0 } else { 0.0 });
    for m in [same(6), ones(33), ring(33), matrix(20, |i, j| if i == j && i < 3 { 1e-300 } else { 0.0 })] {
        let eigen = LeadingEigen::new(&m, 12).expect("pairs");
        for (i, a) in eigen.vectors.rows().enumerate() {
            for (j, b) in eigen.vectors.rows().enumerate() {
                assert_abs_diff_eq!(dot(a, b), f64::from(u8::from(i == j)), epsilon = 1e-13);
            }
        }
    }
    assert_eq!(LeadingEigen::new(&same(6), 1).expect("pairs").values, [3.0; 6]);
    assert_abs_diff_eq!(LeadingEigen::new(&ones(33), 1).expect("pairs").values[0], 33.0, epsilon = 1e-12);
    let zero = LeadingEigen::new(&matrix(4, |_, _| 0.0), 2).expect("pairs");
    assert_eq!((zero.values, zero.vectors.row(1)), (vec![0.0; 4], &[0.0, 1.0, 0.0, 0.0][..]));
    assert_eq!(LeadingEigen::new(&matrix(0, |_, _| 0.0), 2).expect("none").values, [0.0; 0]);
}

#[test]
fn graded_matrices_are_solved_in_any_order_of_their_grades() {
    for seed in 0..200_usize {
        let size = 2 + seed % 30;
        // Rows from 1 down to a power of 1/2, in an order that changes with the seed.
        let graded = |power: usize| {
            let at = |i: usize| (i * (seed + 3)) % size;
            let grade = |i: usize| (0..at(i) * power / size).fold(1.0, |grade, _| grade * 0.5);
            matrix(size, |i, j| grade(i) * grade(j) * (((i * 31 + j * 17 + seed) % 23) as f64 - 11.0))
        };
        // Fourth powers of these elements underflow; `new` itself checks the eigenpairs.
        assert!(LeadingEigen::new(&graded(600), size).is_ok());
        let m = graded(60);
        let (all, leading) = (SymmetricEigen::new(&m).expect("all"), LeadingEigen::new(&m, size).expect("pairs"));
        for (a, b) in all.values.iter().zip(&leading.values) {
            assert_abs_diff_eq!(a, b, epsilon = 1e-13 * all.values[0].abs().max(all.values[size - 1].abs()));
        }
    }
}

#[test]
fn any_magnitude_is_taken_and_no_number_refused() {
    for scale in [1e-290, 1.0, 1e290] {
        let m = matrix(9, |i, j| scale * ((i * 5 + j) % 7) as f64);
        let (all, leading) = (SymmetricEigen::new(&m).expect("all"), LeadingEigen::new(&m, 2).expect("two"));
        assert_abs_diff_eq!(all.values[0] / scale, leading.values[0] / scale, epsilon = 1e-12);
    }
    let nan = matrix(3, |i, j| if i == 2 && j == 1 { f64::NAN } else { 1.0 });
    assert_eq!(
        LeadingEigen::new(&nan, 1).unwrap_err().to_string(),
        "expected finite elements, found 1 that are not finite"
    );
}
