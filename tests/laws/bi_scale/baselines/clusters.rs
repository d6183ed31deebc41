//! Clusters of rows: no round increases the error, each row is in its best cluster, and sizes and products match the
//! stored form.

use approx::assert_relative_eq;
use crossbar::bi_scale::baselines::{RowClusterOptions, RowClusters, StoredTransfer};
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::clustering::{CpcaError, CpcaForm, CpcaMethod, CpcaOptions, Signal, compress};
use crossbar::linalg::dot;

use super::{dense_row, light, transfer};
use crate::support::cluster_options;

const FORMS: [CpcaForm; 2] = [CpcaForm::Affine, CpcaForm::Linear];

fn options(form: CpcaForm) -> RowClusterOptions {
    RowClusterOptions { clusters: 5, vectors: 3, form, iterations: 4, rounds: 6, ..RowClusterOptions::default() }
}

fn clusters(matrix: &SparseMatrix, options: &RowClusterOptions) -> RowClusters {
    RowClusters::new(matrix, options, &mut |_| ()).expect("clusters")
}

/// The squared error of all rows, computed from dense rows.
fn squared_error(matrix: &SparseMatrix, found: &RowClusters) -> f64 {
    let of_row = |row| {
        let difference: Vec<f64> = dense_row(matrix, row).iter().zip(found.row(row)).map(|(a, b)| a - b).collect();
        dot(&difference, &difference)
    };
    (0..matrix.rows()).map(of_row).sum()
}

#[test]
fn no_round_adds_error() {
    let matrix = transfer().1;
    let whole: f64 = (0..matrix.rows()).map(|row| dot(&dense_row(&matrix, row), &dense_row(&matrix, row))).sum();
    for form in FORMS {
        // From all rows, and from a sample, which needs more rounds.
        for sample in [4096, 40] {
            let mut told = Vec::new();
            let options = RowClusterOptions { sample, ..options(form) };
            let found = RowClusters::new(&matrix, &options, &mut |round| told.push(round)).expect("clusters");
            assert_eq!((told.len(), found.history.len()), (7, 7));
            let falls = found.history.windows(2).all(|pair| pair[1] <= pair[0] * (1.0 + 1e-12));
            assert!(falls && found.history[6] < whole, "{form:?}: {:?} of {whole}", found.history);
            let gained = found.history[6] / found.history[0];
            assert!(sample > 40 || gained < 0.99, "{form:?}: {:?}", found.history);
            // Stored numbers are f32.
            assert_relative_eq!(squared_error(&matrix, &found), found.history[6], max_relative = 1e-5);
        }
    }
}

/// Rounds over all rows start where clustering of the dense signal ends; each row is in its best cluster.
#[test]
fn rounds_begin_with_the_clusters_of_the_dense_signal() {
    let matrix = transfer().1;
    let lit: Vec<usize> = (0..matrix.rows()).filter(|&row| !matrix.row(row).is_empty()).collect();
    let values = lit.iter().flat_map(|&row| dense_row(&matrix, row)).map(|value| value as f32);
    let signal = Signal::new(6144, values.collect()).expect("a signal");
    for form in FORMS {
        let dense = CpcaOptions { method: CpcaMethod::Doubling, form, ..cluster_options(5, 3, 4, 1) };
        let dense = compress(&signal, &dense, |_| ()).expect("compressed").clustering;
        let found = clusters(&matrix, &RowClusterOptions { rounds: 0, ..options(form) });
        let mut residual = 0.0;
        for (point, &row) in lit.iter().enumerate() {
            let of = |cluster: u32| {
                let subspace = &dense.subspaces()[cluster as usize];
                let left: Vec<f64> = dense_row(&matrix, row).iter().zip(&subspace.mean).map(|(a, b)| a - b).collect();
                let along = subspace.vectors().map(|vector| dot(vector, &left));
                dot(&left, &left) - along.map(|along| along * along).sum::<f64>()
            };
            let best = of(found.of_row()[row]);
            assert!((0..5).all(|cluster| best <= of(cluster) + 1e-9), "row {row}");
            residual += best;
            assert!(best <= dense.squared_error_of(point, &signal) + 1e-9, "row {row}");
        }
        let dark = matrix.rows() - lit.len();
        assert!(dark == 0 || form == CpcaForm::Linear || found.history[0] >= residual - 1e-6);
        assert!(form == CpcaForm::Affine || (found.history[0] - residual).abs() < 1e-6, "dark rows are met exactly");
    }
}

#[test]
fn products_are_those_of_the_approximated_rows() {
    let (matrix, light) = (transfer().1, light(3));
    for form in FORMS {
        let found = clusters(&matrix, &options(form));
        for (row, found_light) in found.multiply(&light).into_iter().enumerate() {
            assert_relative_eq!(found_light, dot(&found.row(row), &light), max_relative = 1e-9, epsilon = 1e-12);
        }
        let means = if form == CpcaForm::Affine { 5 * 6144 } else { 0 };
        let numbers = (matrix.rows() * 3 + 5 * 3 * 6144 + means) as u64;
        let rows = matrix.rows() as u64;
        assert_eq!([found.sizes()[0].bytes, found.sizes()[1].bytes], [4 * numbers + rows, 4 * numbers]);
        let within = |bytes| options(form).within(bytes, [matrix.rows(), 6144]).vectors;
        assert_eq!([4 * numbers + rows, 4 * numbers + rows - 1].map(within), [3, 2]);
    }
}

/// Rows that are combinations of two patterns are represented exactly by two vectors.
#[test]
fn rows_of_low_rank_are_met() {
    let mut matrix = SparseMatrix::new(6144, 2).unwrap();
    for row in 0..60_i32 {
        let pattern = |texel: u32| (row % 7 + 1) * i32::from(texel < 9) + (row % 4) * i32::from(texel % 11 == 3);
        let entries = (0..100).map(|texel| MatrixEntry { index: 50 * texel, value: pattern(texel) });
        matrix.push_row(&entries.filter(|entry| entry.value != 0).collect::<Vec<_>>()).unwrap();
    }
    for form in FORMS {
        let found = clusters(&matrix, &RowClusterOptions { clusters: 1, vectors: 2, ..options(form) });
        assert!(squared_error(&matrix, &found) < 1e-8, "{form:?}: {:?}", found.history);
    }
}

#[test]
fn what_cannot_be_clustered_is_refused() {
    let refused = |matrix: &SparseMatrix, options: &RowClusterOptions| {
        RowClusters::new(matrix, options, &mut |_| ()).expect_err("refused")
    };
    let mut dark = SparseMatrix::new(6144, 0).unwrap();
    dark.push_row(&[]).unwrap();
    assert_eq!(
        refused(&dark, &RowClusterOptions::default()).to_string(),
        "expected a row with a value other than 0, found none"
    );
    let matrix = transfer().1;
    let few = RowClusterOptions { sample: 3, ..options(CpcaForm::Affine) };
    assert_eq!(refused(&matrix, &few).to_string(), "expected at least 5 rows to find 5 clusters from, found 3");
    let none = RowClusterOptions { vectors: 0, ..options(CpcaForm::Linear) };
    assert_eq!(refused(&matrix, &none).to_string(), CpcaError::NothingLinear.to_string());
}
