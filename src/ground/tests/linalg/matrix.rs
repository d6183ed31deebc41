use crossbar_base::error::InputError;
use crossbar_ground::linalg::{MAX_SQUARE, Matrix};

#[test]
fn rows_columns_and_products() {
    let m = Matrix::new([2, 3], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]).expect("a matrix");
    assert_eq!((m.times(&[1.0, 10.0, 100.0]), m.diagonal()), (vec![321.0, 654.0], vec![1.0, 5.0]));
    let squares = Matrix::new([2, 2], vec![14.0, 32.0, 32.0, 77.0]).expect("a matrix");
    assert_eq!(m.product(&m.transposed()), Ok(squares));
    assert_eq!(Matrix::zeros([0, 0]).expect("a matrix").times(&[]), Vec::<f64>::new());
}

#[test]
fn what_makes_no_matrix_is_refused() {
    let error = |matrix: Result<Matrix, InputError>| matrix.expect_err("refused").to_string();
    assert_eq!(error(Matrix::new([2, 2], vec![0.0; 3])), "expected 2 x 2 values, found 3");
    for [rows, columns] in [[MAX_SQUARE + 1, MAX_SQUARE], [usize::MAX, 2]] {
        let most = "expected a matrix of at most 268435456 elements (16384 x 16384)";
        assert_eq!(error(Matrix::zeros([rows, columns])), format!("{most}, found {rows} x {columns}"));
    }
}
