//! Exact texture addressing, from coordinates to texel indices. A floating-point `floor(u * n)` would be wrong near
//! texel edges.

use super::{WeightRounding, value};

/// Addressing of coordinates outside 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::EnumString)]
#[strum(serialize_all = "lowercase")]
pub enum AddressMode {
    /// Repeats the image.
    #[default]
    Wrap,
    /// Repeats the image; every second copy is mirrored.
    Mirror,
    /// Repeats the texel at the edge.
    Clamp,
    /// Returns the sampler's border colour.
    Border,
}

/// The faces of a cube map in the order of their slices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum CubeFace {
    /// +x, slice 0.
    PositiveX,
    /// -x, slice 1.
    NegativeX,
    /// +y, slice 2.
    PositiveY,
    /// -y, slice 3.
    NegativeY,
    /// +z, slice 4.
    PositiveZ,
    /// -z, slice 5.
    NegativeZ,
}

/// Applies an address mode to a texel position in an extent of `size` texels; `None` is the border.
pub(crate) fn resolve(mode: AddressMode, position: i64, size: u32) -> Option<u32> {
    let n = i64::from(size);
    let index = match mode {
        AddressMode::Wrap => position.rem_euclid(n),
        AddressMode::Mirror => {
            let folded = position.rem_euclid(2 * n);
            if folded < n { folded } else { 2 * n - 1 - folded }
        }
        AddressMode::Clamp => position.clamp(0, n - 1),
        AddressMode::Border if (0..n).contains(&position) => position,
        AddressMode::Border => return None,
    };
    Some(index as u32)
}

/// Replaces a coordinate by one with the same address that is small enough for exact arithmetic.
///
/// NaN and infinities become 0. From 2^24 on every FP32 number is an even integer. All such numbers of equal sign have
/// the same address in every mode, so 2^24 with their sign replaces them.
fn bounded(bits: u32) -> u32 {
    const LARGEST: u32 = 0x4b80_0000; // 2^24
    let finite = value::finite_or_zero(bits);
    if finite & 0x7fff_ffff > LARGEST { finite & 0x8000_0000 | LARGEST } else { finite }
}

/// Texel index of an FP32 coordinate under nearest filtering: `floor(coordinate * scale)`, then the address mode.
///
/// `scale` is `size` for normalised coordinates and 1 for rectangle textures. `None` is the border. The floor is
/// exact: no product is rounded.
pub fn nearest_index(mode: AddressMode, coordinate: u32, size: u32, scale: u32) -> Option<u32> {
    resolve(mode, value::scaled_floor(bounded(coordinate), scale, 0, false), size)
}

/// The two texels of linear filtering, and the weight of the second texel in units of `2^-fraction_bits`.
///
/// The position `coordinate * scale - 1/2` is rounded to `fraction_bits` (at most 12; nearest with halves up, or down);
/// `None` is the border. With a weight of 0 the second texel does not contribute. Without fraction bits the first texel
/// is the nearest texel, under any rounding.
pub fn linear_taps(
    mode: AddressMode,
    coordinate: u32,
    size: u32,
    scale: u32,
    fraction_bits: u8,
    rounding: WeightRounding,
) -> ([Option<u32>; 2], u32) {
    let bits = u32::from(fraction_bits.min(12));
    let bounded = bounded(coordinate);
    // Without fraction bits, `position - 1/2` rounded with halves up is the floor of the position.
    let position = match bits {
        0 => value::scaled_floor(bounded, scale, 0, false),
        _ => value::scaled_floor(bounded, scale, bits, rounding == WeightRounding::Nearest) - (1 << (bits - 1)),
    };
    let whole = position >> bits;
    let weight = (position - (whole << bits)) as u32;
    ([resolve(mode, whole, size), resolve(mode, whole + 1, size)], weight)
}

/// Divides the first three coordinates by the fourth, each in one FP32 division, for projective reads.
pub fn project(coordinates: [u32; 4]) -> [u32; 4] {
    let [x, y, z, w] = coordinates;
    [value::div(x, w), value::div(y, w), value::div(z, w), w]
}

/// The cube face that a direction (FP32 bits) selects and the coordinates on it, 0 to 1.
///
/// The component of largest magnitude selects the face; ties go to z, then y, then x. On the face
/// `u = (s / |m| + 1) * 1/2`, with s and m from Direct3D's cube map table, each step one FP32 operation. NaN and
/// infinite components count as 0.
pub fn cube_coordinates(direction: [u32; 3]) -> (CubeFace, u32, u32) {
    let (face, s, t, major) = cube_axes(direction);
    let place = |c: u32| value::mul(value::add(value::div(c, major), value::ONE), value::HALF);
    (face, place(s), place(t))
}

/// The face, the two coordinates on it, and the magnitude of the major axis.
pub(crate) fn cube_axes(direction: [u32; 3]) -> (CubeFace, u32, u32, u32) {
    let [x, y, z] = direction.map(value::finite_or_zero);
    let size = |c: u32| c & 0x7fff_ffff;
    let flip = |c: u32| c ^ 0x8000_0000;
    let below = |c: u32| c >> 31 == 1;
    if size(z) >= size(y) && size(z) >= size(x) {
        let (face, s) = if below(z) { (CubeFace::NegativeZ, flip(x)) } else { (CubeFace::PositiveZ, x) };
        (face, s, flip(y), size(z))
    } else if size(y) >= size(x) {
        let (face, t) = if below(y) { (CubeFace::NegativeY, flip(z)) } else { (CubeFace::PositiveY, z) };
        (face, x, t, size(y))
    } else {
        let (face, s) = if below(x) { (CubeFace::NegativeX, z) } else { (CubeFace::PositiveX, flip(z)) };
        (face, s, flip(y), size(x))
    }
}
