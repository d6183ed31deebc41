//! Clustered principal components of the rows of a sparse matrix (section VI-B, Figure 6).

use super::refine::{PlacedRow, RowSubspace, placed, refitted};
use super::stored::{StoredSize, StoredTransfer};
use crate::bi_scale::baselines::stored::dark_error;
use crate::bi_scale::matrix::SparseMatrix;
use crate::clustering::{CpcaForm, CpcaMethod, CpcaOptions, Signal, StartPoints, compress};
use crate::error::{InputError, ensure};
use crate::geom::random::CounterRng;
use crate::linalg::dot;

/// Options of the compression of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowClusterOptions {
    /// Number of clusters; 32 in the paper.
    pub clusters: usize,
    /// Number of vectors per cluster; 8 in the paper.
    pub vectors: usize,
    /// Affine subspaces (with a mean) or linear ones.
    pub form: CpcaForm,
    /// Number of sample rows for the initial clusters, drawn without replacement from the non-zero rows. A row takes 4
    /// bytes per column: 4,096 rows of 6,144 columns take 100 MB.
    pub sample: usize,
    /// Maximum number of iterations on the sample for each number of vectors.
    pub iterations: usize,
    /// Number of rounds over all rows after the sample.
    pub rounds: usize,
    /// Random seed of the sample and of the first representatives.
    pub seed: u64,
}

impl Default for RowClusterOptions {
    fn default() -> Self {
        Self { clusters: 32, vectors: 8, form: CpcaForm::Affine, sample: 4096, iterations: 10, rounds: 5, seed: 1 }
    }
}

impl RowClusterOptions {
    /// These options with the largest number of vectors that fits into `bytes`, at least one.
    #[must_use]
    pub fn within(self, bytes: u64, [rows, columns]: [usize; 2]) -> Self {
        let means = if self.form == CpcaForm::Affine { self.clusters * columns } else { 0 };
        let fixed = (NUMBER * means + rows * name_bytes(self.clusters)) as u64;
        let each = (NUMBER * (rows + self.clusters * columns)).max(1) as u64;
        let vectors = (bytes.saturating_sub(fixed) / each).max(1);
        Self { vectors: (vectors as usize).min(columns), ..self }
    }
}

/// Bytes per number.
const NUMBER: usize = 4;

fn name_bytes(clusters: usize) -> usize {
    if clusters > 256 { 2 } else { 1 }
}

/// Rows as a mean and a few vectors per cluster, all in f32.
#[derive(Clone, Debug, PartialEq)]
pub struct RowClusters {
    columns: usize,
    form: CpcaForm,
    means: Vec<f32>,
    /// The vectors of each cluster, concatenated.
    vectors: Vec<Vec<f32>>,
    of_row: Vec<u32>,
    /// Weights row by row: one for each vector of the row's cluster.
    weights: Vec<f32>,
    /// The squared error over all rows before each round and after the last; except for rounding it never grows.
    pub history: Vec<f64>,
}

impl RowClusters {
    /// Clusters the rows of a matrix: first a sample by [`compress`], then rounds over all rows. `observe` is called
    /// with the number of finished rounds.
    pub fn new(
        matrix: &SparseMatrix,
        options: &RowClusterOptions,
        observe: &mut dyn FnMut(usize),
    ) -> Result<Self, InputError> {
        let mut subspaces = first(matrix, options)?;
        let mut rows = placed(matrix, &subspaces);
        let mut history = vec![total(&rows)];
        for round in 0..options.rounds {
            observe(round);
            subspaces = refitted(matrix, (subspaces, options.form), &rows);
            rows = placed(matrix, &subspaces);
            history.push(total(&rows));
        }
        observe(options.rounds);
        let single = |values: &[f64]| values.iter().map(|&value| value as f32).collect::<Vec<f32>>();
        let mut weights = Vec::new();
        rows.iter().for_each(|row| weights.extend(single(&row.weights)));
        Ok(Self {
            columns: matrix.columns(),
            form: options.form,
            means: subspaces.iter().flat_map(|subspace| single(&subspace.mean)).collect(),
            vectors: subspaces.iter().map(|subspace| single(&subspace.vectors)).collect(),
            of_row: rows.iter().map(|row| row.cluster).collect(),
            weights,
            history,
        })
    }

    /// The approximation of a row, one number per column. Panics if there is no such row.
    pub fn row(&self, row: usize) -> Vec<f64> {
        let before = self.of_row[..row].iter().map(|&cluster| self.vectors_of(cluster)).sum::<usize>();
        let cluster = self.of_row[row] as usize;
        let mean = &self.means[cluster * self.columns..][..self.columns];
        let mut sum: Vec<f64> = mean.iter().map(|&value| value.into()).collect();
        for (vector, &weight) in self.vectors[cluster].chunks_exact(self.columns).zip(&self.weights[before..]) {
            sum.iter_mut().zip(vector).for_each(|(sum, &value)| *sum += f64::from(weight) * f64::from(value));
        }
        sum
    }

    /// The cluster of each row.
    pub fn of_row(&self) -> &[u32] {
        &self.of_row
    }

    fn vectors_of(&self, cluster: u32) -> usize {
        self.vectors[cluster as usize].len() / self.columns
    }
}

impl StoredTransfer for RowClusters {
    fn sizes(&self) -> Vec<StoredSize> {
        let means = if self.form == CpcaForm::Affine { self.means.len() } else { 0 };
        let vectors: usize = self.vectors.iter().map(Vec::len).sum();
        let numbers = self.weights.len() + vectors + means;
        let names = name_bytes(self.vectors.len()) * self.of_row.len();
        vec![
            StoredSize {
                layout: "4 bytes per number, a cluster index per row",
                bytes: (NUMBER * numbers + names) as u64,
            },
            StoredSize { layout: "numbers alone", bytes: (NUMBER * numbers) as u64 },
        ]
    }

    fn multiply(&self, light: &[f64]) -> Vec<f64> {
        assert_eq!(light.len(), self.columns, "as many numbers as columns");
        let with_light = |line: &[f32]| {
            let line: Vec<f64> = line.iter().map(|&value| value.into()).collect();
            dot(&line, light)
        };
        let means: Vec<f64> = self.means.chunks_exact(self.columns).map(with_light).collect();
        let vectors: Vec<Vec<f64>> =
            self.vectors.iter().map(|of| of.chunks_exact(self.columns).map(with_light).collect()).collect();
        let mut weights = &self.weights[..];
        let row = |&cluster: &u32| {
            let along = &vectors[cluster as usize];
            let (own, others) = weights.split_at(along.len());
            weights = others;
            own.iter().zip(along).fold(means[cluster as usize], |sum, (&weight, along)| sum + f64::from(weight) * along)
        };
        self.of_row.iter().map(row).collect()
    }
}

/// The initial clusters, from a sample of rows.
fn first(matrix: &SparseMatrix, options: &RowClusterOptions) -> Result<Vec<RowSubspace>, InputError> {
    let rows = sample(matrix, options.sample, options.seed);
    if rows.is_empty() {
        return Err(dark_error());
    }
    ensure!(
        rows.len() >= options.clusters,
        "expected at least {} rows to find {} clusters from, found {}",
        options.clusters,
        options.clusters,
        rows.len()
    );
    let columns = matrix.columns();
    let mut values = vec![0.0; rows.len() * columns];
    for (into, &row) in values.chunks_exact_mut(columns).zip(&rows) {
        for entry in matrix.row(row) {
            into[entry.index as usize] = matrix.value(entry.value) as f32;
        }
    }
    let signal = Signal::new(columns, values).map_err(|_| dark_error())?;
    let of_sample = CpcaOptions {
        clusters: options.clusters,
        vectors: options.vectors,
        vq_iterations: options.iterations,
        iterations: options.iterations,
        method: CpcaMethod::Doubling,
        form: options.form,
        start: StartPoints::Seed(options.seed),
    };
    let clustering = compress(&signal, &of_sample, |_| ())?.clustering;
    let subspaces = clustering.subspaces().iter();
    Ok(subspaces.map(|s| RowSubspace { mean: s.mean.clone(), vectors: s.vectors.clone() }).collect())
}

/// At most `most` of the non-zero rows, those with the lowest random numbers, in increasing order.
fn sample(matrix: &SparseMatrix, most: usize, seed: u64) -> Vec<usize> {
    let random = CounterRng::new(seed);
    let lit = (0..matrix.rows()).filter(|&row| !matrix.row(row).is_empty());
    let mut drawn: Vec<(u64, usize)> = lit.map(|row| (random.bits(row as u64, 0, 0), row)).collect();
    drawn.sort_unstable();
    drawn.truncate(most);
    let mut rows: Vec<usize> = drawn.into_iter().map(|(_, row)| row).collect();
    rows.sort_unstable();
    rows
}

fn total(rows: &[PlacedRow]) -> f64 {
    rows.iter().fold(0.0, |sum, row| sum + row.squared_error)
}
