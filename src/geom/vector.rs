//! What glam's vectors lack: mesh coordinates to f64 and back, and a normalisation of one rounding per component.

use glam::DVec3;

/// f32 coordinates as f64, exactly.
pub fn wide(vector: [f32; 3]) -> DVec3 {
    vector.map(f64::from).into()
}

/// Each component rounded to f32.
pub fn narrow(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().into()
}

/// The vector divided by its length, if that is positive and finite. glam's `normalize` multiplies by the reciprocal
/// instead, which rounds twice and gives other bits.
pub fn unit(vector: DVec3) -> Option<DVec3> {
    let length = vector.length();
    (length > 0.0 && length.is_finite()).then(|| vector / length)
}

/// The coordinate axis that a direction follows least, the first of equals: far from parallel to it.
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
