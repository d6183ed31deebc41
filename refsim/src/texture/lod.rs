//! Level of detail: selection of the mip levels that a sample reads.

use super::address::cube_axes;
use super::value::{self, Exact};
use super::{Image, TextureKind};

/// Level of detail requested by a sample instruction, before the sampler's bias.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lod {
    /// Level 0, for reads without derivatives.
    #[default]
    Base,
    /// Log2 of texels per pixel, in FP32 bits: [`lod_from_derivatives`] plus the instruction's bias, or an explicit
    /// level. NaN counts as 0.
    Level(u32),
}

/// Computes the level of detail from the coordinates' derivatives `ddx` and `ddy` per pixel (all FP32 bits).
///
/// rho^2 is the larger of the two squared lengths in texels of level 0, `((x*x) + (y*y)) + (z*z)`, where each step is
/// one FP32 operation. The result is `floor(log2(rho^2) / 2)` on a grid of `2^-fraction_bits` (at most 8), by repeated
/// squaring of the significand with 62 fraction bits kept. rho = 0 gives -127, an infinite rho 127, NaN 0. For cube
/// maps the derivatives are converted to face coordinates by the quotient rule.
pub fn lod_from_derivatives(
    image: &Image,
    coordinates: [u32; 4],
    ddx: [u32; 4],
    ddy: [u32; 4],
    fraction_bits: u8,
) -> u32 {
    let along_x = squared_length(texels(image, coordinates, ddx));
    let along_y = squared_length(texels(image, coordinates, ddy));
    let largest = if value::is_nan(along_x) || value::is_nan(along_y) {
        value::NAN
    } else {
        along_x.max(along_y) // patterns of numbers >= 0 have the order of the numbers
    };
    half_log2(largest, fraction_bits.min(8))
}

/// Converts a derivative to texels of level 0.
fn texels(image: &Image, coordinates: [u32; 4], d: [u32; 4]) -> [u32; 3] {
    let scaled = |c: u32, size: u32| value::mul(c, value::from_integer(i64::from(size)));
    match image.kind() {
        TextureKind::Rectangle => [d[0], d[1], value::ZERO],
        TextureKind::D1 => [scaled(d[0], image.width()), value::ZERO, value::ZERO],
        TextureKind::D2 => [scaled(d[0], image.width()), scaled(d[1], image.height()), value::ZERO],
        TextureKind::Volume => {
            [scaled(d[0], image.width()), scaled(d[1], image.height()), scaled(d[2], image.slices())]
        }
        TextureKind::Cube => cube_texels(image, coordinates, d),
    }
}

/// Uses d(s/m) = (ds - (s/m) dm) / m; the face coordinate changes by half of this.
fn cube_texels(image: &Image, coordinates: [u32; 4], d: [u32; 4]) -> [u32; 3] {
    let [x, y, z, _] = coordinates;
    let (_, s, t, major) = cube_axes([x, y, z]);
    let moved = [0, 1, 2].map(|i| value::add(value::finite_or_zero(coordinates[i]), d[i]));
    let (s1, t1, major1) = on_same_face([x, y, z], moved);
    let change = |c: u32, c1: u32| {
        let quotient = value::div(c, major);
        let slope = value::sub(value::sub(c1, c), value::mul(quotient, value::sub(major1, major)));
        let half = value::mul(value::div(slope, major), value::HALF);
        value::mul(half, value::from_integer(i64::from(image.width())))
    };
    [change(s, s1), change(t, t1), value::ZERO]
}

/// Axes of `moved` on the face that `direction` selects, with the face's signs.
fn on_same_face(direction: [u32; 3], moved: [u32; 3]) -> (u32, u32, u32) {
    use super::CubeFace::{NegativeX, NegativeY, NegativeZ, PositiveX, PositiveY, PositiveZ};
    let flip = |c: u32| c ^ 0x8000_0000;
    let [x, y, z] = moved;
    match cube_axes(direction).0 {
        PositiveX => (flip(z), flip(y), x),
        NegativeX => (z, flip(y), flip(x)),
        PositiveY => (x, z, y),
        NegativeY => (x, flip(z), flip(y)),
        PositiveZ => (x, flip(y), z),
        NegativeZ => (flip(x), flip(y), flip(z)),
    }
}

fn squared_length([x, y, z]: [u32; 3]) -> u32 {
    value::add(value::add(value::mul(x, x), value::mul(y, y)), value::mul(z, z))
}

/// Computes log2(x) / 2 of an FP32 number >= 0, floored to `fraction_bits`, as FP32 bits.
fn half_log2(bits: u32, fraction_bits: u8) -> u32 {
    let Exact::Finite { significand, exponent, .. } = value::exact32(bits) else {
        return if value::is_nan(bits) { value::ZERO } else { value::from_integer(127) };
    };
    if significand == 0 {
        return value::from_integer(-127);
    }
    let top = 63 - significand.leading_zeros();
    let mut result = i64::from(exponent) + i64::from(top);
    let mut mantissa = u128::from(significand) << (62 - top); // in [1, 2), 62 fraction bits
    for _ in 0..fraction_bits {
        // Squaring doubles the logarithm; if the square reaches 2, the next binary digit is 1.
        mantissa = (mantissa * mantissa) >> 62;
        let carry = mantissa >> 63;
        mantissa >>= carry;
        result = result * 2 + carry as i64;
    }
    value::from_fixed(result >> 1, fraction_bits)
}
