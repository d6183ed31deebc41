//! Light times the transfer: L~ = T L as the sum of B_i L (section V, Rendering; Algorithm 2).
//!
//! - [`by_rows`]: T L itself, row by row;
//! - [`Gather`]: Algorithm 2 in f32, from lists in the order of reads, with sums in the order of
//!   [`paper::multiply`](super::paper::multiply).
//!
//! Values of biclusters are rounded to the format of the product. So large residuals that cancel may leave an error,
//! although the biclusters are exact.
//!
//! Sums begin with 0 and have a fixed order. The sum of a bicluster runs over its columns, increasing; the sum of a row
//! over its biclusters, in the order in which they were found.

use super::bicluster::Biclustering;
use super::matrix::SparseMatrix;

/// L~ = T L from the matrix itself, in f64, summed in the order of columns. Panics if the light does not have one
/// number per column.
pub fn by_rows(matrix: &SparseMatrix, light: &[f64]) -> Vec<f64> {
    assert_eq!(light.len(), matrix.columns(), "as many numbers as columns");
    let row = |row| {
        let terms = matrix.row(row).iter().map(|entry| matrix.value(entry.value) * light[entry.index as usize]);
        terms.fold(0.0, |sum, term| sum + term)
    };
    (0..matrix.rows()).map(row).collect()
}

/// Rows that are summed together.
const LANES: usize = 8;

/// Biclusters in the layout of Algorithm 2: rows with equal numbers of biclusters are adjacent, so that loops have
/// equal lengths, and the lists of eight rows are interleaved, so that eight sums are computed in parallel.
#[derive(Clone, Debug)]
pub struct Gather {
    columns: usize,
    /// For each place of the buffer, the start of its bicluster's columns; then the end of the last columns.
    column_begins: Vec<u32>,
    /// Columns and their values t.
    columns_of: Vec<(u32, f32)>,
    /// Rows sorted by their number of biclusters, then by index.
    rows: Vec<u32>,
    /// The distinct numbers of biclusters per row, increasing, each with its number of rows.
    lengths: Vec<[usize; 2]>,
    /// I_j: buffer places of each row's biclusters, in the order in which these were found. Eight rows of one length
    /// are interleaved, remaining rows are stored one by one.
    biclusters_of: Vec<u32>,
}

impl Gather {
    /// Creates the lists of biclusters.
    pub fn new(biclusters: &Biclustering) -> Self {
        let [rows, columns] = biclusters.matrix_size();
        // Sums with equal numbers of terms are adjacent, so that loops have equal lengths.
        let mut stored: Vec<usize> = (0..biclusters.len()).collect();
        stored.sort_by_key(|&bicluster| biclusters.columns_of(bicluster).len());
        let mut places = vec![0; biclusters.len()];
        (0..).zip(&stored).for_each(|(place, &bicluster)| places[bicluster] = place);
        let mut column_begins = vec![0];
        let mut columns_of = Vec::with_capacity(biclusters.column_entries());
        for bicluster in stored {
            let value = |value: i32| biclusters.value(value) as f32;
            columns_of.extend(biclusters.columns_of(bicluster).iter().map(|entry| (entry.index, value(entry.value))));
            column_begins.push(columns_of.len() as u32);
        }
        let (begins, mut of_row) = biclusters.by_row();
        of_row.iter_mut().for_each(|bicluster| *bicluster = places[*bicluster as usize]);
        let list = |row: u32| &of_row[begins[row as usize]..begins[row as usize + 1]];
        let mut rows: Vec<u32> = (0..rows as u32).collect();
        rows.sort_by_key(|&row| list(row).len());
        let mut lengths = Vec::new();
        let mut biclusters_of = Vec::with_capacity(of_row.len());
        for class in rows.chunk_by(|&a, &b| list(a).len() == list(b).len()) {
            let length = list(class[0]).len();
            lengths.push([length, class.len()]);
            let groups = class.chunks_exact(LANES);
            let left_over = groups.remainder();
            for group in groups {
                (0..length).for_each(|at| biclusters_of.extend(group.iter().map(|&row| list(row)[at])));
            }
            left_over.iter().for_each(|&row| biclusters_of.extend(list(row)));
        }
        Self { columns, column_begins, columns_of, rows, lengths, biclusters_of }
    }

    /// Algorithm 2 in f32, for C lights or color channels in parallel. Panics if the light does not have one number per
    /// column.
    pub fn multiply<const C: usize>(&self, light: &[[f32; C]]) -> Vec<[f32; C]> {
        assert_eq!(light.len(), self.columns, "as many numbers as columns");
        let buffer = self.buffer(light);
        let mut local = vec![[0.0; C]; self.rows.len()];
        let (mut rows, mut lists) = (&self.rows[..], &self.biclusters_of[..]);
        for &[length, count] in &self.lengths {
            let (class, other_rows) = rows.split_at(count);
            let (class_lists, other_lists) = lists.split_at(length * count);
            (rows, lists) = (other_rows, other_lists);
            if length == 0 {
                continue;
            }
            let groups = class.chunks_exact(LANES);
            let left_over = groups.remainder();
            let (of_groups, of_left_over) = class_lists.split_at(length * (count - left_over.len()));
            for (group, lists) in groups.zip(of_groups.chunks_exact(LANES * length)) {
                let mut sums = [[0.0; C]; LANES];
                for of_lanes in lists.as_chunks::<LANES>().0 {
                    sums.iter_mut().zip(of_lanes).for_each(|(sum, &place)| *sum = plus(*sum, buffer[place as usize]));
                }
                group.iter().zip(sums).for_each(|(&row, sum)| local[row as usize] = sum);
            }
            for (&row, list) in left_over.iter().zip(of_left_over.chunks_exact(length)) {
                let sum = list.iter().fold([0.0; C], |sum, &place| plus(sum, buffer[place as usize]));
                local[row as usize] = sum;
            }
        }
        local
    }

    /// P: for each bicluster, light times its columns.
    fn buffer<const C: usize>(&self, light: &[[f32; C]]) -> Vec<[f32; C]> {
        let sum = |ends: &[u32]| {
            let columns = &self.columns_of[ends[0] as usize..ends[1] as usize];
            let term = |&(column, t): &(u32, f32)| light[column as usize].map(|light| t * light);
            columns.iter().map(term).fold([0.0; C], plus)
        };
        self.column_begins.windows(2).map(sum).collect()
    }
}

fn plus<const C: usize>(a: [f32; C], b: [f32; C]) -> [f32; C] {
    std::array::from_fn(|channel| a[channel] + b[channel])
}
