//! Texels as patches of the sphere: solid angles, and the integrals of harmonics over them.

use glam::DVec3;
use rayon::prelude::*;

use super::harmonics::{MAX_ORDER, function_count, harmonics};
use crate::elementary::atan2;
use crate::quadrature::{GaussPoint, gauss_legendre};

/// Map of the sphere, or of a part of it, to a grid of texels.
pub(super) trait TexelGrid: Sync {
    /// Number of columns and rows.
    fn size(&self) -> [usize; 2];
    /// Solid angle of a texel, 0 if it covers none.
    fn solid_angle(&self, column: usize, row: usize) -> f64;
    /// Returns the direction at u, v in [0, 1] of a texel that covers a solid angle, and a density proportional to
    /// solid angle per du dv.
    fn at(&self, texel: [usize; 2], u: f64, v: f64) -> (DVec3, f64);
}

/// Projects the function that is constant over each texel; texels row by row, of any number of channels.
///
/// The solid angle is exact; the mean of a harmonic over a texel is computed by a Gauss rule, with more points where
/// texels are large. Rows are summed one by one, then added in order: the bits do not depend on the number of threads.
pub(super) fn project<const N: usize>(
    grid: &impl TexelGrid,
    order: usize,
    radiance: impl Fn(usize) -> [f32; N] + Sync,
) -> [Vec<f64>; N] {
    let (count, [columns, rows]) = (function_count(order), grid.size());
    let rule = rule_for((columns * rows).isqrt());
    let of_row = |row: usize| {
        let mut sums = [const { [0.0; MAX_ORDER * MAX_ORDER] }; N];
        let [mut y, mut of_texel] = [[0.0; MAX_ORDER * MAX_ORDER]; 2];
        for column in 0..columns {
            let solid_angle = grid.solid_angle(column, row);
            let color = radiance(row * columns + column);
            if solid_angle > 0.0 && color != [0.0; N] {
                texel(grid, [column, row], &rule, order, &mut y, &mut of_texel);
                for (sums, radiance) in sums.iter_mut().zip(color) {
                    let scale = solid_angle * f64::from(radiance);
                    sums[..count].iter_mut().zip(&of_texel).for_each(|(sum, mean)| *sum += scale * mean);
                }
            }
        }
        sums
    };
    let by_row: Vec<[[f64; MAX_ORDER * MAX_ORDER]; N]> = (0..rows).into_par_iter().map(of_row).collect();
    std::array::from_fn(|channel| (0..count).map(|i| by_row.iter().map(|row| row[channel][i]).sum()).collect())
}

/// Computes the means of all harmonics over a texel.
fn texel(
    grid: &impl TexelGrid,
    texel: [usize; 2],
    rule: &[GaussPoint],
    order: usize,
    y: &mut [f64; MAX_ORDER * MAX_ORDER],
    means: &mut [f64; MAX_ORDER * MAX_ORDER],
) {
    let count = function_count(order);
    means.fill(0.0);
    let mut whole = 0.0;
    for &(v, row_weight) in rule {
        for &(u, weight) in rule {
            let (direction, density) = grid.at(texel, u, v);
            let weight = row_weight * weight * density;
            harmonics(order, direction, &mut y[..count]);
            means[..count].iter_mut().zip(y.iter()).for_each(|(mean, y)| *mean += weight * y);
            whole += weight;
        }
    }
    if whole > 0.0 {
        means[..count].iter_mut().for_each(|mean| *mean /= whole);
    } else {
        // A sliver at the rim of a probe, between the rule's points.
        harmonics(order, grid.at(texel, 0.5, 0.5).0, &mut means[..count]);
    }
}

/// Gauss rule for a texel of a picture with the square of this number of texels.
fn rule_for(side: usize) -> Vec<GaussPoint> {
    gauss_legendre(match side {
        0..24 => 8,
        24..96 => 5,
        96..384 => 3,
        _ => 2,
    })
}

/// Solid angle of the rectangle from x0, y0 to x1, y1 in the plane at distance 1 from the eye, relative to (0, 0): two
/// triangles (van Oosterom and Strackee, 1983), whose triple product is the rectangle's area, without cancellation.
pub(super) fn rectangle_solid_angle([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
    let corner = |x, y| DVec3::new(x, y, 1.0);
    let [a, b, c, d] = [corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1)];
    let area = (x1 - x0) * (y1 - y0);
    let triangle = |p: DVec3, q: DVec3, r: DVec3| {
        let [lp, lq, lr] = [p.length(), q.length(), r.length()];
        2.0 * atan2(area, lp * lq * lr + p.dot(q) * lr + q.dot(r) * lp + r.dot(p) * lq)
    };
    triangle(a, b, c) + triangle(a, c, d)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_face_of_a_cube_covers_a_sixth_and_its_parts_add_up() {
        let whole = 2.0 / 3.0 * PI;
        assert!((rectangle_solid_angle([-1.0; 2], [1.0; 2]) - whole).abs() < 1e-15);
        let at = |i: i32| f64::from(i) / 8.0 - 1.0;
        let parts = (0..256).map(|i| rectangle_solid_angle([at(i % 16), at(i / 16)], [at(i % 16 + 1), at(i / 16 + 1)]));
        assert!((parts.sum::<f64>() - whole).abs() < 1e-14);
        let tiny = rectangle_solid_angle([0.0; 2], [1e-9; 2]);
        assert!((tiny / 1e-18 - 1.0).abs() < 1e-15, "no digit is lost: {tiny:e}");
    }
}
