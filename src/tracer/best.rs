//! The nearest hit of a ray while it is traced.

use crate::geom::Hit;

/// A ray goes on a little beyond its best hit, in shares of t: an fp32 t is no better than that, and the next cell may
/// hold a triangle whose rounded t is smaller.
pub(super) const BEYOND: f64 = 1e-5;

/// The nearest hit so far: of equal t the lowest triangle, as a card keeps that draws triangles in order and tests
/// `less`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Best(Option<(f32, u32)>);

impl Best {
    /// An infinite t is none: it fails the depth test of a card.
    pub(crate) fn offer(&mut self, t: f32, triangle: u32) {
        if t < f32::INFINITY && self.0.is_none_or(|(best, first)| t < best || (t == best && triangle < first)) {
            self.0 = Some((t, triangle));
        }
    }

    /// Whether cells that the ray enters at `t` of its own direction can't hold anything nearer.
    pub(crate) fn settles(&self, t: f64, power: f64) -> bool {
        self.0.is_some_and(|(best, _)| f64::from(best) * power * (1.0 + BEYOND) < t)
    }

    pub(crate) fn hit(&self, power: f64) -> Option<Hit> {
        // A depth buffer knows one zero.
        self.0.map(|(t, triangle)| Hit { triangle, t: (f64::from(t) * power) as f32 + 0.0 })
    }
}
