//! Intersection of rays with a repeating height field: exact up to rounding, since along a ray the surface of a cell is
//! a parabola.
//!
//! [`follow`] visits the cells along the ray and stops at the first hit.

use std::ops::ControlFlow;

use super::field::{HeightField, within};

/// Maximum horizontal length of a ray, in edges of the patch: rays nearly parallel to the surface end there.
const REACH: f64 = 64.0;
/// Depth below the surface at which a ray counts as blocked, in edges of the patch: far more than the rounding error of
/// rays that start on the surface.
const DEPTH: f64 = 1e-12;

/// A ray with horizontal coordinates in texels, and heights in units of the patch's edge length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TexelRay {
    at: [f64; 2],
    height: f64,
    step: [f64; 2],
    rise: f64,
    /// The parameter at which the ray ends.
    pub(super) end: f64,
}

/// The interval of a ray over a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CellSpan {
    cell: [isize; 2],
    from: f64,
    to: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SurfaceHit {
    pub(super) cell: [isize; 2],
    pub(super) at: [f64; 2],
}

impl TexelRay {
    /// A ray from a position in texels and a height, along a direction of the local frame; it ends where it leaves the
    /// heights between `lowest` and 0, or after [`REACH`].
    pub(super) fn new(side: usize, at: [f64; 2], height: f64, direction: [f64; 3], lowest: f64) -> Self {
        let [x, y, rise] = direction;
        let step = [x, y].map(|along| along * side as f64);
        let across = (x * x + y * y).sqrt();
        let out = if rise > 0.0 { (0.0 - height) / rise } else { (lowest - height) / rise };
        // Only heights limit a vertical ray, and only the reach limits a horizontal ray.
        let reach = if across > 0.0 { REACH / across } else { f64::INFINITY };
        Self { at, height, step, rise, end: if rise == 0.0 { reach } else { out.min(reach) } }
    }

    /// The interval in which the ray is over columns, or rows, from `cell` to `cell` + 1, along one axis.
    fn span_along(&self, axis: usize, cell: isize) -> (f64, f64) {
        let (at, step) = (self.at[axis], self.step[axis]);
        let line = |index: isize| (index as f64 - at) / step;
        if step > 0.0 {
            (line(cell), line(cell + 1))
        } else if step < 0.0 {
            (line(cell + 1), line(cell))
        } else if at.floor() as isize == cell {
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            (f64::INFINITY, f64::NEG_INFINITY)
        }
    }

    pub(super) fn place(&self, t: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.at[axis] + t * self.step[axis])
    }

    /// Height of the ray above a cell's surface: the coefficients of c0 + c1 t + c2 t^2, with t = 0 at the beginning of
    /// the span. `None` if the ray stays above the whole cell.
    fn above(&self, field: &HeightField, span: &CellSpan) -> Option<[f64; 3]> {
        let [from, to] = [span.from, span.to].map(|t| self.height + t * self.rise);
        if from.min(to) > field.top(span.cell) {
            return None;
        }
        let (patch, [dx, dy]) = (field.cell(span.cell), self.step);
        let inside = within(span.cell, self.place(span.from));
        let [along, across] = patch.slope(inside);
        Some([from - patch.height(inside), self.rise - dx * along - dy * across, -(dx * dy * patch.twist)])
    }

    /// The first point at which the ray reaches a cell's surface from above.
    pub(super) fn hit(&self, field: &HeightField, span: &CellSpan) -> Option<SurfaceHit> {
        let coefficients = self.above(field, span)?;
        let t = (span.from + first_root(coefficients, span.to - span.from)?).min(span.to);
        Some(SurfaceHit { cell: span.cell, at: self.place(t) })
    }

    /// True if the ray dips below a cell's surface by more than [`DEPTH`].
    pub(super) fn dips(&self, field: &HeightField, span: &CellSpan) -> bool {
        self.above(field, span).is_some_and(|coefficients| least(coefficients, span.to - span.from) < -DEPTH)
    }
}

/// The first t in [0, `most`] at which c0 + c1 t + c2 t^2 is 0 or less.
fn first_root([c0, c1, c2]: [f64; 3], most: f64) -> Option<f64> {
    if c0 <= 0.0 {
        return Some(0.0);
    }
    let discriminant = c1 * c1 - 4.0 * c2 * c0;
    if discriminant < 0.0 {
        return None;
    }
    // The root of larger magnitude follows from a sum without cancellation, the other root from their product.
    let sum = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let roots = [sum / c2, c0 / sum].into_iter().filter(|root| (0.0..=most).contains(root));
    roots.fold(None, |least: Option<f64>, root| Some(least.map_or(root, |least| least.min(root))))
}

/// The minimum of c0 + c1 t + c2 t^2 over [0, `most`].
fn least([c0, c1, c2]: [f64; 3], most: f64) -> f64 {
    let ends = c0.min(c0 + most * (c1 + most * c2));
    let lowest = -c1 / (2.0 * c2);
    if c2 > 0.0 && lowest > 0.0 && lowest < most { ends.min(c0 + 0.5 * c1 * lowest) } else { ends }
}

/// Visits the cells along a ray in order, until `ask` breaks with a result.
pub(super) fn follow<T>(ray: &TexelRay, mut ask: impl FnMut(&CellSpan) -> ControlFlow<T>) -> Option<T> {
    let mut cell = ray.at.map(|at| at.floor() as isize);
    let mut from = 0.0;
    loop {
        let [x, y] = [0, 1].map(|axis| ray.span_along(axis, cell[axis]).1);
        let to = x.min(y).min(ray.end);
        if from < to {
            if let ControlFlow::Break(found) = ask(&CellSpan { cell, from, to }) {
                return Some(found);
            }
            from = to;
        }
        if to >= ray.end {
            return None;
        }
        let axis = usize::from(y < x);
        cell[axis] += if ray.step[axis] > 0.0 { 1 } else { -1 };
    }
}
