use crossbar_ground::linalg::{Lu, Matrix};
use nalgebra::{DMatrix, DVector};

#[test]
fn rows_are_exchanged_where_they_must_be() {
    let m = Matrix::new([3, 3], vec![0.0, 2.0, 1.0, 4.0, 4.0, 0.0, 2.0, 0.0, 8.0]).expect("a matrix");
    let x = [1.0, -2.0, 3.0];
    assert_eq!(Lu::new(&m).expect("invertible").solve(&m.times(&x)), x);
}

#[test]
fn a_matrix_without_inverse_is_refused() {
    let m = Matrix::new([2, 2], vec![1.0, 2.0, 2.0, 4.0]).expect("a matrix");
    let error = |matrix: &Matrix| Lu::new(matrix).err().map(|error| error.to_string());
    let told =
        |column| Some(format!("expected an invertible matrix, found no pivot in column {column} (counted from 0)"));
    assert_eq!(error(&m), told(1));
    let nan = Matrix::new([1, 1], vec![f64::NAN]).expect("a matrix");
    assert_eq!(error(&nan), told(0));
}

/// Sizes just below and above the size of a panel, a tile and a parallel task.
#[test]
fn panels_change_no_bit_of_elimination_column_by_column() {
    for size in [1_usize, 2, 5, 63, 64, 65, 100, 129, 333] {
        let number = |i: usize| (i * 7919 % 10_007) as f64 / 4096.0 - 1.0;
        let values: Vec<f64> = (0..size * size).map(number).collect();
        let theirs = DMatrix::from_row_slice(size, size, &values).lu();
        let matrix = Matrix::new([size, size], values).expect("a matrix");
        let right: Vec<f64> = (0..size).map(|i| number(3 * i + 1)).collect();
        let ours = Lu::new(&matrix).map(|lu| lu.solve(&right));
        let theirs = theirs.solve(&DVector::from_column_slice(&right));
        let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        match (ours, theirs) {
            (Ok(ours), Some(theirs)) => assert_eq!(bits(&ours), bits(theirs.as_slice()), "{size}"),
            (ours, theirs) => assert!(ours.is_err() && theirs.is_none(), "{size}: {ours:?} {theirs:?}"),
        }
    }
}
