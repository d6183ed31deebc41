//! Conversion of mesh coordinates to f64 and back, and normalisation with one rounding per component, which glam lacks.

use glam::DVec3;

/// Converts f32 coordinates to f64, exactly.
pub fn wide(vector: [f32; 3]) -> DVec3 {
    vector.map(f64::from).into()
}

/// Rounds each component to f32.
pub fn narrow(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().into()
}

/// Returns the vector divided by its length, if that is positive and finite. glam's `normalize` multiplies by the
/// reciprocal instead, which rounds twice and gives other bits.
pub fn unit(vector: DVec3) -> Option<DVec3> {
    let length = vector.length();
    (length > 0.0 && length.is_finite()).then(|| vector / length)
}

/// Normal of a triangle by the right-hand rule, with twice its area as length.
pub fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// Returns the coordinate axis along which a direction has its smallest component (on ties, the first). The axis is far
/// from parallel to the direction.
pub fn least_axis(direction: DVec3) -> DVec3 {
    let size = direction.abs();
    if size.x <= size.y && size.x <= size.z {
        DVec3::X
    } else if size.y <= size.z {
        DVec3::Y
    } else {
        DVec3::Z
    }
}

/// Bits of a position as a key for equal positions: -0 becomes +0.
pub fn place_bits(place: [f32; 3]) -> [u32; 3] {
    place.map(|value| (value + 0.0).to_bits())
}
