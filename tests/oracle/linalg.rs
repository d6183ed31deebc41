//! Pins the bits of the factorizations. CI runs this test with and without nalgebra's `std` feature, which other crates
//! enable in builds of the whole workspace: its kernels, chosen by the processor, must not affect results.

use crossbar::geom::random::CounterRng;
use crossbar::linalg::{Lu, Matrix, SymmetricEigen, dot};

fn random([rows, columns]: [usize; 2], seed: u64) -> Matrix {
    let random = CounterRng::new(seed);
    let value = |k: usize| random.unit(k as u64, 0, 0) - 0.5;
    Matrix::new([rows, columns], (0..rows * columns).map(value).collect()).expect("a small matrix")
}

fn symmetric(size: usize) -> Matrix {
    let matrix = random([size + 3, size], 5);
    matrix.transposed().product(&matrix).expect("a small matrix")
}

/// FNV-1a over the bytes.
fn digest<'a>(values: impl IntoIterator<Item = &'a f64>) -> u64 {
    let bytes = values.into_iter().flat_map(|value| value.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

fn largest_difference(a: &Matrix, b: &Matrix) -> f64 {
    a.rows().flatten().zip(b.rows().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Multiplies each row by its factor.
fn scaled(mut matrix: Matrix, factors: &[f64]) -> Matrix {
    for (i, factor) in factors.iter().enumerate() {
        matrix.row_mut(i).iter_mut().for_each(|value| *value *= factor);
    }
    matrix
}

#[test]
fn products_are_plain_inner_products() {
    let (a, b) = (random([23, 31], 1), random([31, 19], 2));
    let (product, columns) = (a.product(&b).expect("a small matrix"), b.transposed());
    for i in 0..23 {
        for j in 0..19 {
            assert_eq!(product.row(i)[j].to_bits(), dot(a.row(i), columns.row(j)).to_bits(), "{i}, {j}");
        }
    }
    assert_eq!(digest(product.rows().flatten()), 0xe445_2639_d105_05a3);
}

#[test]
fn systems_have_these_bits() {
    let (square, x) = (random([37, 37], 3), random([1, 37], 6));
    let solved = Lu::new(&square).expect("invertible").solve(&square.times(x.row(0)));
    assert!(solved.iter().zip(x.row(0)).all(|(a, b)| (a - b).abs() < 1e-12), "{solved:?}");
    assert_eq!(digest(&solved), 0x429b_3105_4c21_3564);
}

#[test]
fn eigenvectors_have_these_bits() {
    let matrix = symmetric(29);
    let SymmetricEigen { values, vectors } = SymmetricEigen::new(&matrix).expect("eigenvalues");
    assert!(values.is_sorted_by(|a, b| a >= b));
    let again = vectors.transposed().product(&scaled(vectors.clone(), &values)).expect("a small matrix");
    assert!(largest_difference(&again, &matrix) < 1e-13);
    assert_eq!([digest(&values), digest(vectors.rows().flatten())], [0xbf63_58ed_a153_3e97, 0x045f_9185_604f_a7c4]);
}
