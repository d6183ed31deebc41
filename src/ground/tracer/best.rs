//! Nearest hit of a ray during traversal.

use crate::geom::Hit;

/// Relative margin in t by which traversal continues beyond the best hit: an fp32 t may be that inexact, so the next
/// cell may contain a triangle whose rounded t is smaller.
pub(super) const T_MARGIN: f64 = 1e-5;

/// Nearest hit so far; at equal t the triangle with the lowest index, as on a card that draws triangles in order with a
/// `less` depth test.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Best(Option<(f32, u32)>);

impl Best {
    /// Records a hit if it is nearer. An infinite t is not a hit: it fails the depth test of a card.
    pub fn offer(&mut self, t: f32, triangle: u32) {
        if t < f32::INFINITY && self.0.is_none_or(|(best, first)| t < best || (t == best && triangle < first)) {
            self.0 = Some((t, triangle));
        }
    }

    /// Returns `true` if a cell cannot contain a nearer hit. The ray enters the cell at `t`, in multiples of its own
    /// direction.
    pub fn settles(&self, t: f64, power: f64) -> bool {
        self.0.is_some_and(|(best, _)| f64::from(best) * power * (1.0 + T_MARGIN) < t)
    }

    /// The recorded hit, with t in multiples of the ray's own direction.
    pub fn hit(&self, power: f64) -> Option<Hit> {
        // A depth buffer has no -0.
        self.0.map(|(t, triangle)| Hit { triangle, t: (f64::from(t) * power) as f32 + 0.0 })
    }
}
