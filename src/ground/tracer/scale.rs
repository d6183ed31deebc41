//! Scaling by powers of two, which brings lengths of any unit into the range of single precision without rounding.

use glam::DVec3;
use refsim::num::power_of_two;

use crate::geom::Mesh;
use crate::geom::vector::wide;

/// Largest magnitude of scaled corners, which puts squared lengths in the middle of single precision's exponent range.
const MAX_CORNER: f64 = 4.0;

/// Scale of a mesh's corners for the single-precision triangle test.
pub fn mesh_scale(mesh: &Mesh) -> f64 {
    let [low, high] = mesh.bounds().unwrap_or_default().map(|corner| wide(corner).abs().max_element());
    in_single_precision(scale_into(low.max(high), MAX_CORNER))
}

/// Clamps a scale to the normal and denormal numbers of single precision. Scenes smaller than 2^-123, where numbers
/// have few bits left, get a smaller scale than they need.
pub fn in_single_precision(scale: f64) -> f64 {
    scale.clamp(power_of_two(-149), power_of_two(127))
}

/// Exponent of the largest power of two that is at most `x`; `x` must be finite and above zero.
fn floor_log2(x: f64) -> i32 {
    // Denormal f64 can't come from f32 inputs, so the biased exponent suffices.
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// Scales a direction by a power of two so that its largest component lies in [1/2, 1); returns it and the power.
///
/// `scaled = direction * power`, hence `t = t_scaled * power`.
pub fn normalize_range(direction: [f32; 3]) -> (DVec3, f64) {
    let direction = wide(direction);
    let power = power_of_two(-1 - floor_log2(direction.abs().max_element()));
    (direction * power, power)
}

/// Smallest power of two that is at least `x`; 1 for 0.
pub fn ceil_power_of_two(x: f64) -> f64 {
    if x == 0.0 {
        return 1.0;
    }
    let floor = power_of_two(floor_log2(x));
    if floor == x { floor } else { floor * 2.0 }
}

/// Largest power of two `s` with `s * extent <= range`; 1 for an extent of 0.
pub fn scale_into(extent: f64, range: f64) -> f64 {
    if extent == 0.0 { 1.0 } else { 1.0 / ceil_power_of_two(extent / range) }
}
