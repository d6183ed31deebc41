//! Singular values by the one-sided Jacobi method (Hestenes 1958), which rotates pairs of columns.
//!
//! For the small matrices of the hemisphere, the method finds the smallest singular value as accurately as the
//! condition number allows, and singular vectors that are orthogonal up to rounding. Bidiagonalisation leaves residuals
//! of 1e-11 for them.

use crate::linalg::dot;

/// Maximum number of sweeps over all pairs of columns; 10 columns need 4 to 7.
const MAX_SWEEPS: usize = 40;

/// Cosine up to which columns count as orthogonal.
const ORTHOGONAL: f64 = 4.0 * f64::EPSILON;

/// Singular values of a matrix given by columns, each with its right singular vector, unsorted.
pub(super) fn singular_values(mut columns: Vec<Vec<f64>>) -> Vec<(f64, Vec<f64>)> {
    let size = columns.len();
    let unit = |i: usize| (0..size).map(|k| if k == i { 1.0 } else { 0.0 }).collect();
    let mut vectors: Vec<Vec<f64>> = (0..size).map(unit).collect();
    for _ in 0..MAX_SWEEPS {
        let mut turned = false;
        for q in 1..size {
            for p in 0..q {
                let [pp, qq, pq] = [[p, p], [q, q], [p, q]].map(|[a, b]| dot(&columns[a], &columns[b]));
                if pq.abs() > ORTHOGONAL * (pp * qq).sqrt() {
                    let zeta = (qq - pp) / (2.0 * pq);
                    let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                    rotate(&mut columns, [p, q], tangent);
                    rotate(&mut vectors, [p, q], tangent);
                    turned = true;
                }
            }
        }
        if !turned {
            break;
        }
    }
    columns.iter().map(|column| dot(column, column).sqrt()).zip(vectors).collect()
}

fn rotate(columns: &mut [Vec<f64>], [p, q]: [usize; 2], tangent: f64) {
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let sine = cosine * tangent;
    let (before, after) = columns.split_at_mut(q);
    for (a, b) in before[p].iter_mut().zip(&mut after[0]) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
}
