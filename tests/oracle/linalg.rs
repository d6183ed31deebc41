//! Bits of the factorisations. CI runs this with and without nalgebra's `std` feature, which other people's crates turn
//! on in builds of the whole workspace: its kernels, chosen by the processor, must not show.

use crossbar::error::InputError;
use crossbar::geom::random::CounterRng;
use crossbar::linalg::{Lu, Matrix, Qr, Svd, SymmetricEigen, dot};

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

fn identity(size: usize) -> Matrix {
    let mut matrix = Matrix::zeros([size; 2]).expect("a small matrix");
    (0..size).for_each(|i| matrix.row_mut(i)[i] = 1.0);
    matrix
}

/// Each row times its factor.
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
fn systems_and_least_squares_have_these_bits() {
    let (square, tall, x) = (random([37, 37], 3), random([53, 17], 4), random([1, 37], 6));
    let solved = Lu::new(&square).expect("invertible").solve(&square.times(x.row(0)));
    assert!(solved.iter().zip(x.row(0)).all(|(a, b)| (a - b).abs() < 1e-12), "{solved:?}");
    let right = random([1, 53], 7);
    let fitted = Qr::new(&tall).expect("independent columns").least_squares(right.row(0));
    let residual: Vec<f64> = tall.times(&fitted).iter().zip(right.row(0)).map(|(a, b)| a - b).collect();
    assert!(tall.transposed().times(&residual).iter().all(|x| x.abs() < 1e-13), "orthogonal to the columns");
    assert_eq!([digest(&solved), digest(&fitted)], [0x429b_3105_4c21_3564, 0xee58_6e16_cafd_1113]);
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

#[test]
fn singular_vectors_have_these_bits() {
    for (size, bits) in [
        ([41, 13], [0xb70d_f73b_a979_6739, 0xdd5e_dd58_6bd8_1120, 0x6eee_de95_8562_5ea8]),
        ([11, 30], [0x99a8_9b2e_22f2_442d, 0x94d3_2dff_4733_8414, 0x61aa_5d32_f45a_e616]),
    ] {
        let matrix = random(size, 8);
        let Svd { left, values, right } = Svd::new(&matrix).expect("singular values");
        let k = size[0].min(size[1]);
        assert_eq!([left.column_count(), values.len(), right.row_count()], [k; 3], "thin");
        let again = left.product(&scaled(right.clone(), &values)).expect("a small matrix");
        assert!(values.is_sorted_by(|a, b| a >= b) && largest_difference(&again, &matrix) < 1e-13);
        let one = right.product(&right.transposed()).expect("a small matrix");
        assert!(largest_difference(&one, &identity(k)) < 1e-13, "orthonormal");
        assert_eq!([digest(left.rows().flatten()), digest(&values), digest(right.rows().flatten())], bits);
    }
}

#[test]
fn matrices_without_such_a_factorisation_are_refused() {
    let told = |error: Option<InputError>| error.expect("refused").to_string();
    let not_finite = "expected finite elements, found 2 that are not";
    let dependent = |column, columns| {
        let found = format!("found column {column} (counted from 0) to depend on those before it");
        format!("expected {columns} independent columns, {found}")
    };
    let nan = Matrix::new([2, 2], vec![1.0, f64::NAN, f64::INFINITY, 1.0]).expect("a matrix");
    assert_eq!(told(SymmetricEigen::new(&nan).err()), not_finite);
    assert_eq!(told(Svd::new(&nan).err()), not_finite);
    let twice = Matrix::new([3, 2], vec![1.0, 2.0, 3.0, 6.0, -1.0, -2.0]).expect("a matrix");
    assert_eq!(told(Qr::new(&twice).err()), dependent(1, 2));
    assert_eq!(told(Qr::new(&twice.transposed()).err()), dependent(2, 3));
    assert!(Svd::new(&twice).expect("of rank one").values[1].abs() < 1e-15);
    let none = Matrix::zeros([0, 3]).expect("a matrix");
    assert!(Svd::new(&none).expect("no values").values.is_empty());
}
