//! Symmetric tridiagonal matrices: all eigenvalues by implicit QL, and selected eigenvectors.

use crate::error::InputError;
use crate::linalg::factor::no_convergence_error;

/// Number of QL sweeps after which an eigenvalue counts as not converged.
const MAX_SWEEPS: usize = 100;

/// Rotation of columns `first` and `first + 1`.
pub(super) struct Rotation {
    first: usize,
    cosine: f64,
    sine: f64,
}

/// Diagonalises a tridiagonal matrix; returns the rotations in the order of their application.
pub(super) fn diagonalise(diagonal: &mut [f64], beside: &mut [f64]) -> Result<Vec<Rotation>, InputError> {
    let size = diagonal.len();
    let norm = diagonal.iter().chain(beside.iter()).fold(0.0_f64, |norm, value| norm.max(value.abs()));
    let negligible = norm * f64::EPSILON;
    let mut rotations = Vec::new();
    for first in 0..size {
        for sweep in 0.. {
            let last = (first..size - 1).find(|&i| beside[i].abs() <= negligible).unwrap_or(size - 1);
            if last == first {
                break;
            }
            if sweep == MAX_SWEEPS {
                return Err(no_convergence_error(size, size));
            }
            sweep_once(diagonal, beside, first..last, &mut rotations);
        }
    }
    Ok(rotations)
}

/// Performs one implicit QL sweep over an unreduced block, from its last pair to its first.
fn sweep_once(diagonal: &mut [f64], beside: &mut [f64], block: std::ops::Range<usize>, rotations: &mut Vec<Rotation>) {
    let first = block.start;
    // The shift is the eigenvalue of the first 2 x 2 block that is nearer to the block's first element.
    let half = (diagonal[first + 1] - diagonal[first]) / (2.0 * beside[first]);
    let shift = diagonal[first] - beside[first] / (half + (half * half + 1.0).sqrt().copysign(half));
    let mut along = diagonal[block.end] - shift;
    let (mut cosine, mut sine, mut moved) = (1.0, 1.0, 0.0);
    for i in block.clone().rev() {
        let (bulge, kept) = (sine * beside[i], cosine * beside[i]);
        let length = (bulge * bulge + along * along).sqrt();
        if i + 1 < block.end {
            beside[i + 1] = length;
        }
        if length == 0.0 {
            // The block splits here.
            diagonal[i + 1] -= moved;
            return;
        }
        (sine, cosine) = (bulge / length, along / length);
        let lower = diagonal[i + 1] - moved;
        let change = (diagonal[i] - lower) * sine + 2.0 * cosine * kept;
        moved = sine * change;
        diagonal[i + 1] = lower + moved;
        along = cosine * change - kept;
        rotations.push(Rotation { first: i, cosine, sine });
    }
    diagonal[first] -= moved;
    beside[first] = along;
}

/// The requested columns of the product of all rotations, one after the other.
pub(super) fn rotated(size: usize, columns: &[usize], rotations: &[Rotation]) -> Vec<f64> {
    let count = columns.len();
    // Stored by rows during the rotations, so that one rotation turns all vectors together.
    let mut rows = vec![0.0; size * count];
    columns.iter().enumerate().for_each(|(vector, &column)| rows[column * count + vector] = 1.0);
    for &Rotation { first, cosine, sine } in rotations.iter().rev() {
        let (upper, lower) = rows[first * count..][..2 * count].split_at_mut(count);
        for (a, b) in upper.iter_mut().zip(lower) {
            (*a, *b) = (cosine * *a + sine * *b, cosine * *b - sine * *a);
        }
    }
    (0..count).flat_map(|vector| rows[vector..].iter().step_by(count).copied()).collect()
}
