//! The Utah teapot: 32 bicubic Bezier patches, tessellated at any rate into one mesh with shared vertices.
//!
//! **Arithmetic.** The control points are multiples of 1/100000 and the parameters are i/N, so every point of the grid
//! is a fraction of two integers. It is computed exactly and rounded to f32 once. Two patches therefore give
//! bit-identical points on their common border, and welding by bit identity closes the seams without an epsilon.
//!
//! **Watertightness.** For N >= 2 every edge belongs to exactly two triangles that traverse it in opposite directions,
//! except 16 N boundary edges: the rims that the published surface itself leaves open.
//!
//! | rim | patches | boundary edges |
//! |---|---|---|
//! | the pot's mouth (inner lip, radius 1.4, z = 2.4) | 4 | 4 N |
//! | the lid's edge (radius 1.3, z = 2.4; it does not touch the mouth) | 4 | 4 N |
//! | the handle's two ends (they pass through the body unjoined) | 2 each | 2 N + 2 N |
//! | the spout's base (inside the body) and its tip (open) | 2 each | 2 N + 2 N |
//!
//! At the poles of lid and bottom each column has one triangle instead of two: there are `64 N^2 - 8 N` triangles, and
//! none is degenerate. At N = 1 handle and spout collapse to double sheets: only the 8 edges of mouth and lid are open,
//! the middle edge of the handle has four triangles, the last segment of the spout is omitted, and 52 triangles remain.
//!
//! The lower end of the handle shares a vertex with the body (control point 69), but no edge. Front faces
//! (counter-clockwise) face outwards; z is up and the spout points along +x.

use num_bigint::BigUint;

use super::exact::{is_degenerate, ratio};
use super::mesh::{Mesh, Welder};
use super::teapot_table::{PATCHES, POINTS, UNITS};
use crate::error::{InputError, ensure};

/// Maximum rate of tessellation: 4 million triangles. Beyond it, slivers at the poles approach f32 resolution.
pub const MAX_RATE: u32 = 256;

/// Tessellated teapot.
#[derive(Debug, Clone, PartialEq)]
pub struct Teapot {
    /// Mesh of the surface.
    pub mesh: Mesh,
    /// Patch (0 to 31) of each triangle.
    pub patch_of: Vec<u8>,
}

/// Builds the teapot's mesh with `rate` x `rate` quads per patch, two triangles each.
///
/// ```
/// # extern crate crossbar_base as crossbar;
/// let mesh = crossbar::geom::teapot::teapot(6).expect("a rate in range");
/// assert_eq!((mesh.len(), mesh.degenerate_count()), (2256, 0));
/// ```
///
/// # Errors
/// [`InputError`] for a rate outside 1 to [`MAX_RATE`].
pub fn teapot(rate: u32) -> Result<Mesh, InputError> {
    tessellate(rate).map(|teapot| teapot.mesh)
}

/// Like [`teapot`], with the patch of every triangle.
pub fn tessellate(rate: u32) -> Result<Teapot, InputError> {
    ensure!(
        (1..=MAX_RATE).contains(&rate),
        "expected a tessellation of 1 to {MAX_RATE} quads along a patch side, found {rate}"
    );
    let weights: Vec<[i128; 4]> = (0..=rate).map(|step| bernstein(step, rate)).collect();
    let scale = BigUint::from(rate).pow(6) * UNITS.unsigned_abs();
    let side = rate as usize + 1;
    let mut welder = Welder::default();
    let mut triangles = Vec::new();
    let mut patch_of = Vec::new();
    for (patch, control) in (0_u8..).zip(&PATCHES) {
        let mut grid = Vec::with_capacity(side * side);
        for row in &weights {
            for column in &weights {
                grid.push(welder.vertex(point(control, row, column, &scale)));
            }
        }
        for row in 0..side - 1 {
            for column in 0..side - 1 {
                let at = row * side + column;
                let [a, b, c, d] = [grid[at], grid[at + 1], grid[at + side + 1], grid[at + side]];
                // The published patches face inwards, so the winding is reversed. At a pole a = b, and one triangle
                // remains.
                for [p, q, r] in [[a, b, c], [a, c, d]] {
                    let corners = [p, q, r].map(|index| welder.position(index));
                    if !is_degenerate(&corners) {
                        triangles.push([p, q, r]);
                        patch_of.push(patch);
                    }
                }
            }
        }
    }
    let mesh = Mesh::new(welder.into_positions(), triangles).expect("grid indices are in range and points finite");
    Ok(Teapot { mesh, patch_of })
}

/// The four cubic Bernstein polynomials at step/rate, times rate^3.
fn bernstein(step: u32, rate: u32) -> [i128; 4] {
    let (near, far) = (i128::from(step), i128::from(rate - step));
    [far * far * far, 3 * near * far * far, 3 * near * near * far, near * near * near]
}

/// Evaluates a point of a patch: the exact fraction `sum(weights * control points) / scale`, each coordinate rounded to
/// nearest once.
fn point(control: &[u16; 16], row: &[i128; 4], column: &[i128; 4], scale: &BigUint) -> [f32; 3] {
    let mut sum = [0_i128; 3];
    for (index, &number) in control.iter().enumerate() {
        let weight = row[index / 4] * column[index % 4];
        for (axis, total) in sum.iter_mut().enumerate() {
            *total += weight * i128::from(POINTS[usize::from(number) - 1][axis]);
        }
    }
    sum.map(|total| {
        let magnitude = ratio::to_f32(&BigUint::from(total.unsigned_abs()), scale);
        if total < 0 { -magnitude } else { magnitude }
    })
}
