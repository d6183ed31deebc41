//! Refinement of clusters of sparse rows by rounds over all rows.
//!
//! A million dense rows of a transfer matrix would take 25 GB; inner products with the clusters' vectors need only the
//! entries. A round assigns each row to the cluster that approximates it best (on ties, the first). Then each cluster
//! takes the mean of its rows, and its vectors are multiplied by the covariance of its rows and orthonormalised
//! (orthogonal iteration). No step increases the error. Means and nearest clusters are optimal. For positive
//! semidefinite C and orthonormal V, let U be an orthonormal basis of C V: then tr(U^T C U) >= tr(V^T C V), because U
//! maximises the tangent of this convex function at V.

use rayon::prelude::*;

use crate::bi_scale::matrix::SparseMatrix;
use crate::clustering::CpcaForm;
use crate::linalg::dot;

/// Relative length below which the part of a vector orthogonal to the others counts as rounding error.
const NOTHING: f64 = 1e-12;

/// The subspace of a cluster of rows: a mean, and orthonormal vectors concatenated, all with one number per column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RowSubspace {
    pub(super) mean: Vec<f64>,
    pub(super) vectors: Vec<f64>,
}

/// A row's cluster, weights and error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PlacedRow {
    pub(super) cluster: u32,
    pub(super) weights: Vec<f64>,
    pub(super) squared_error: f64,
}

/// All means and vectors interleaved by column, so that each entry of a row reads contiguous numbers.
struct ByColumn {
    /// The index of each cluster's mean, which its vectors follow.
    begins: Vec<usize>,
    stride: usize,
    values: Vec<f64>,
    /// The inner product of each mean and vector with its cluster's mean.
    with_mean: Vec<f64>,
}

impl ByColumn {
    fn new(subspaces: &[RowSubspace]) -> Self {
        let length = subspaces.first().map_or(0, |first| first.mean.len());
        let lines = || subspaces.iter().flat_map(|s| std::iter::once(&s.mean[..]).chain(s.vectors.chunks(length)));
        let mut begins = vec![0];
        for subspace in subspaces {
            begins.push(begins.last().unwrap_or(&0) + 1 + subspace.vectors.len() / length);
        }
        let stride = lines().count();
        let mut values = vec![0.0; stride * length];
        for (at, line) in lines().enumerate() {
            line.iter().enumerate().for_each(|(column, &value)| values[column * stride + at] = value);
        }
        let with_mean = subspaces.iter().flat_map(|s| {
            std::iter::once(dot(&s.mean, &s.mean)).chain(s.vectors.chunks(length).map(|vector| dot(vector, &s.mean)))
        });
        let with_mean = with_mean.collect();
        Self { begins, stride, values, with_mean }
    }

    /// Writes inner products of a row with all means and vectors to `sums`; returns the row's squared length.
    fn products(&self, matrix: &SparseMatrix, row: usize, sums: &mut [f64]) -> f64 {
        sums.fill(0.0);
        let mut square = 0.0;
        for entry in matrix.row(row) {
            let value = matrix.value(entry.value);
            let lines = &self.values[entry.index as usize * self.stride..][..self.stride];
            sums.iter_mut().zip(lines).for_each(|(sum, line)| *sum += value * line);
            square += value * value;
        }
        square
    }

    /// Assigns a row to its best cluster.
    fn place(&self, matrix: &SparseMatrix, row: usize, sums: &mut [f64]) -> PlacedRow {
        let square = self.products(matrix, row, sums);
        let along = |at: usize| sums[at] - self.with_mean[at];
        let mut best = (0, f64::INFINITY);
        for (cluster, ends) in self.begins.windows(2).enumerate() {
            let mut error = square - 2.0 * sums[ends[0]] + self.with_mean[ends[0]];
            (ends[0] + 1..ends[1]).for_each(|at| error -= along(at) * along(at));
            if error < best.1 {
                best = (cluster, error);
            }
        }
        let (cluster, squared_error) = best;
        let weights = (self.begins[cluster] + 1..self.begins[cluster + 1]).map(along).collect();
        // The expanded square may round below 0.
        PlacedRow { cluster: cluster as u32, weights, squared_error: squared_error.max(0.0) }
    }
}

/// Assigns each row to its best cluster; on ties, to the first.
pub(super) fn placed(matrix: &SparseMatrix, subspaces: &[RowSubspace]) -> Vec<PlacedRow> {
    let lines = ByColumn::new(subspaces);
    let rows = (0..matrix.rows()).into_par_iter();
    rows.map_init(|| vec![0.0; lines.stride], |sums, row| lines.place(matrix, row, sums)).collect()
}

/// Fits the subspaces to the rows of each cluster. A cluster without rows keeps its subspace.
pub(super) fn refitted(
    matrix: &SparseMatrix,
    (before, form): (Vec<RowSubspace>, CpcaForm),
    placed: &[PlacedRow],
) -> Vec<RowSubspace> {
    let mut members = vec![Vec::new(); before.len()];
    (0..).zip(placed).for_each(|(row, placed)| members[placed.cluster as usize].push(row));
    let refit = |(subspace, rows): (RowSubspace, Vec<usize>)| match rows[..] {
        [] => subspace,
        _ => refit(matrix, &subspace, form, &rows),
    };
    before.into_par_iter().zip(members).map(refit).collect()
}

fn refit(matrix: &SparseMatrix, before: &RowSubspace, form: CpcaForm, rows: &[usize]) -> RowSubspace {
    let length = matrix.columns();
    let mut mean = vec![0.0; length];
    if form == CpcaForm::Affine {
        rows.iter().for_each(|&row| add(matrix, row, 1.0, &mut mean));
        mean.iter_mut().for_each(|sum| *sum /= rows.len() as f64);
    }
    let alone = RowSubspace { mean: vec![0.0; length], vectors: before.vectors.clone() };
    let lines = ByColumn::new(std::slice::from_ref(&alone));
    let (mut products, mut sums) = (vec![0.0; lines.stride], vec![0.0; lines.stride]);
    let mut images = vec![0.0; before.vectors.len()];
    let with_mean: Vec<f64> = before.vectors.chunks(length).map(|vector| dot(vector, &mean)).collect();
    for &row in rows {
        lines.products(matrix, row, &mut products);
        for (at, image) in images.chunks_exact_mut(length).enumerate() {
            let along = products[at + 1] - with_mean[at];
            sums[at + 1] += along;
            add(matrix, row, along, image);
        }
    }
    for (image, sum) in images.chunks_exact_mut(length).zip(&sums[1..]) {
        image.iter_mut().zip(&mean).for_each(|(image, mean)| *image -= sum * mean);
    }
    let mut vectors = Vec::with_capacity(images.len());
    for (image, vector) in images.chunks_exact(length).zip(before.vectors.chunks_exact(length)) {
        // A vector to which all rows are orthogonal does not change.
        if !add_orthonormal(&mut vectors, image) {
            add_orthonormal(&mut vectors, vector);
        }
    }
    RowSubspace { mean, vectors }
}

/// Adds `scale` times a row to `into`.
fn add(matrix: &SparseMatrix, row: usize, scale: f64, into: &mut [f64]) {
    matrix.row(row).iter().for_each(|entry| into[entry.index as usize] += scale * matrix.value(entry.value));
}

/// Orthonormalises a vector against orthonormal vectors and appends it; false if it is linearly dependent on them.
fn add_orthonormal(vectors: &mut Vec<f64>, vector: &[f64]) -> bool {
    let mut vector = vector.to_vec();
    let mut before = dot(&vector, &vector).sqrt();
    // Two passes of orthogonalisation against rounding.
    for _ in 0..2 {
        for earlier in vectors.chunks_exact(vector.len()) {
            let along = dot(earlier, &vector);
            vector.iter_mut().zip(earlier).for_each(|(value, earlier)| *value -= along * earlier);
        }
        let length = dot(&vector, &vector).sqrt();
        if length <= NOTHING * before || length == 0.0 {
            return false;
        }
        vector.iter_mut().for_each(|value| *value /= length);
        before = 1.0;
    }
    vectors.extend(vector);
    true
}
