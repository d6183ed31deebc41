//! Numeric range of a card's pixel format, and the part of it that the intersection programs may use.
//!
//! The scene scale S and a triangle's edge scale k are powers of two that keep every intermediate of every program
//! inside the format. With A an offset (origin minus corner) and e an edge, in card units, and D <= 1 a component of a
//! direction, the intermediates are
//!
//! | intermediate | at most | kept in range by |
//! |---|---|---|
//! | o, a, ao, bo | A | S |
//! | aod = ao x d, bod | 2 A D | S |
//! | k ab, k ac, k bc | k e | k |
//! | k n | 2 k e^2 | k |
//! | k n.d, k n.ao and their partial sums | 3 \|k n\| D, 3 \|k n\| A | k |
//! | k u, k v, k w and their partial sums | 3 k e (2 A D) | k |
//!
//! The code uses finer bounds than this table: intervals per component over all rays of a batch, for each triangle
//! separately. They include the card's rounding errors, so that no number saturates, wraps or becomes infinite,
//! whatever the card's order of additions.

use refsim::device::{Rules, TexdepthDenominator};
use refsim::num::{Format, FormatKind, power_of_two};

use crate::tracer::scale::ceil_power_of_two;

/// Steps of a signed byte between 0 and 1.
pub(super) const BYTE_CODES: f64 = 127.0;

/// Properties of a number format on which the intersection programs depend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    /// Exclusive bound on magnitudes. Fixed point: the end of the range, 2^I. Float: a power of two below the largest
    /// number.
    pub(super) end: f64,
    /// Step of fixed point; 0 for floats, whose errors are relative.
    pub(super) step: f64,
    /// Exclusive bound on n.d, the divisor.
    divisor: f64,
    /// Bound on the difference between a ray's component and its code in a texture, expanded by `_bx2`.
    code: f64,
    kind: RangeKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RangeKind {
    /// Fixed point, whose precision is absolute.
    Fixed,
    /// Float with fewer exponents than single precision: products of small edges underflow.
    Narrow,
    /// Float with the exponents of single precision. The host's test, in single precision, has no edge scale either.
    Wide,
}

impl Range {
    /// Range of a pixel program: the range of its format, limited by the divisor of `texdepth`.
    pub(super) fn of_pixels(rules: &Rules) -> Self {
        let range = Self::of(&rules.format);
        match rules.texdepth_denominator {
            TexdepthDenominator::Min1 if rules.format.is_fixed() => Self { divisor: range.end.min(1.0), ..range },
            _ => range,
        }
    }

    pub(super) fn of(format: &Format) -> Self {
        let (end, step, kind) = match format.kind {
            FormatKind::Fixed { int_bits, frac_bits } => {
                (power_of_two(int_bits.into()), power_of_two(-i32::from(frac_bits)), RangeKind::Fixed)
            }
            FormatKind::Normalized { int_bits, .. } => {
                (power_of_two(int_bits.into()), 1.0 / f64::from(format.denominator()), RangeKind::Fixed)
            }
            FormatKind::Float { exp_bits, .. } => {
                // The largest number is nearly 2^(bias + 1).
                let bias = (1 << (i32::from(exp_bits) - 1)) - 1;
                match exp_bits {
                    0..8 => (power_of_two(bias - 1), 0.0, RangeKind::Narrow),
                    // Without an edge scale |n.ao| is up to 384 A and |u| up to 48 A, for corners in [-4, 4].
                    _ => (power_of_two(bias - 10), 0.0, RangeKind::Wide),
                }
            }
        };
        // Half a 16-bit code, doubled by `_bx2`.
        Self { end, step, divisor: end, code: power_of_two(-15), kind }
    }

    /// This range for rays in textures of signed bytes.
    pub(super) fn with_byte_texels(self) -> Self {
        // Components between the largest used code and 1 have an error of up to one step.
        Self { code: 1.0 / BYTE_CODES, ..self }
    }

    /// Bound on numbers that the card rounds once or twice: coordinates, offsets, edges, normals.
    pub(super) fn of_vectors(&self) -> f64 {
        match self.kind {
            // An edge scale cannot help, because the vertex program computes the normal in single precision too.
            RangeKind::Wide => 4.0,
            _ => self.room(4.0 * self.step),
        }
    }

    /// Bound on ao x d before rounding.
    pub(super) fn of_cross_products(&self) -> f64 {
        self.room(self.cross_product_error())
    }

    /// Bound on sums of three products with an edge or a normal, each factor with its error.
    pub(super) fn of_sums(&self) -> f64 {
        self.room(self.step * (3.0 * self.end + 24.0))
    }

    /// Bound on numbers in ray textures: 1, or slightly less if the register range ends at 1.
    pub(super) fn of_texels(&self) -> f64 {
        (self.end - 2.0 * self.step).min(1.0)
    }

    /// Bounds on corners and offsets of a scene on a float card that keep squared lengths in the middle of the exponent
    /// range.
    pub(super) fn of_float_scenes(&self) -> [f64; 2] {
        let offsets = self.end / 4.0;
        [offsets.min(4.0), offsets]
    }

    /// Error of a component read from a ray texture: the error of its code plus the register's rounding, doubled by
    /// `_bx2`.
    pub(super) fn texel_error(&self) -> f64 {
        if self.step == 0.0 { 0.0 } else { self.code + 2.0 * self.step }
    }

    /// Error of a component of ao x d: twice the error of d times ao, plus the error of ao and the roundings.
    pub(super) fn cross_product_error(&self) -> f64 {
        2.0 * self.end * self.texel_error() + 8.0 * self.step
    }

    /// Weight of a sum that becomes the divisor of `texdepth`, relative to the other sums.
    pub(super) fn of_divisors(&self) -> f64 {
        self.end / self.divisor
    }

    /// Chooses the edge scale of a triangle whose largest sum is `sum` at k = 1, and whose normal's largest component
    /// is `normal`.
    ///
    /// Fixed point: 1, as in the paper, or less if 1 does not fit. Floats with few exponents: the scale that brings the
    /// normal near 1, so that neither its products nor the quotient by n.d leave the range. A power of two has no other
    /// effect.
    pub(super) fn edge_scale(&self, sum: f64, normal: f64) -> f64 {
        let fits = self.fitting_scale(sum);
        match self.kind {
            RangeKind::Wide => 1.0,
            RangeKind::Fixed => fits.min(1.0),
            RangeKind::Narrow => fits.min((1.0 / ceil_power_of_two(normal)).max(1.0)),
        }
    }

    /// Chooses the scale of a vector whose scale no other number shares: like [`Self::edge_scale`], but in fixed point
    /// the largest scale that fits, for the most bits.
    pub(super) fn own_scale(&self, sum: f64, largest: f64) -> f64 {
        match self.kind {
            RangeKind::Fixed => self.fitting_scale(sum),
            RangeKind::Narrow | RangeKind::Wide => self.edge_scale(sum, largest),
        }
    }

    /// Largest scale with which a sum stays in range. Vertex constants are in single precision.
    fn fitting_scale(&self, sum: f64) -> f64 {
        (1.0 / ceil_power_of_two(sum / self.of_sums())).min(power_of_two(64))
    }

    /// Returns `true` if each triangle needs its own edge scale.
    pub(super) fn has_edge_scale(&self) -> bool {
        self.kind != RangeKind::Wide
    }

    /// Range minus the errors; at least half the range, for formats with very few bits.
    fn room(&self, errors: f64) -> f64 {
        (self.end - errors).max(self.end / 2.0)
    }
}
