//! Other ways to store transfer: their contents and errors, compared with plain loops.

mod clusters;
mod rotated;
mod rows;
mod wavelets;

use crossbar::bi_scale::directions::LocalDirections;
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::bi_scale::transfer::{light_vector, transfer_matrix};
use crossbar::geom::random::CounterRng;
use crossbar::transfer::Vertices;
use crossbar::transfer::visibility::Horizon;

use super::sight;

/// The transfer of hills to 4 x 4 directions.
fn transfer() -> (Vertices, SparseMatrix, LocalDirections) {
    let (vertices, maps) = sight(1, Horizon::Normal);
    let directions = LocalDirections::new(4).expect("a side");
    let matrix = transfer_matrix(&vertices, &maps, &directions).expect("a matrix");
    (vertices, matrix, directions)
}

/// Random light of cube texels, times solid angles.
fn light(seed: u64) -> Vec<f64> {
    let random = CounterRng::new(seed);
    light_vector(&(0..6144).map(|texel| 3.0 * random.unit(texel, 0, 0)).collect::<Vec<f64>>())
}

/// A row of a matrix, including all zeros.
fn dense_row(matrix: &SparseMatrix, row: usize) -> Vec<f64> {
    let mut dense = vec![0.0; matrix.columns()];
    for entry in matrix.row(row) {
        dense[entry.index as usize] = matrix.value(entry.value);
    }
    dense
}

/// Rows of light texels with random blocks of values; some blocks are empty, some full.
fn any_rows(seed: u64, count: usize) -> SparseMatrix {
    let random = CounterRng::new(seed);
    let mut matrix = SparseMatrix::new(6144, 2).expect("columns");
    for row in 0..count as u64 {
        let draw = |what: u64, range: u64| random.bits(row, 1, what) % range;
        let (face, side) = (draw(0, 6), [0, 1, 2, 5, 17, 32][draw(1, 6) as usize]);
        let (first, others) = ([draw(2, 33 - side.max(1)), draw(3, 33 - side.max(1))], draw(4, 3));
        let value = |texel: u64| match [texel / 1024, texel / 32 % 32, texel % 32] {
            [at, v, u] if at == face && u.wrapping_sub(first[0]) < side && v.wrapping_sub(first[1]) < side => {
                (random.bits(row, 2, texel) % 5) as i32 - i32::from(others == 1)
            }
            // Some entries elsewhere.
            _ if others == 2 && random.bits(row, 3, texel).is_multiple_of(97) => 1,
            _ => 0,
        };
        let entries = (0..6144).map(|texel| MatrixEntry { index: texel as u32, value: value(texel) });
        matrix.push_row(&entries.filter(|entry| entry.value != 0).collect::<Vec<_>>()).expect("a row");
    }
    matrix
}
