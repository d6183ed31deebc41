//! Three numbers in f64: places, directions and colours. Sums run from the left.

/// A place, a direction or a linear colour.
pub type Vec3 = [f64; 3];

/// All three the same.
pub(super) const fn splat(value: f64) -> Vec3 {
    [value; 3]
}

/// f32 figures, exactly.
pub(super) fn wide(vector: [f32; 3]) -> Vec3 {
    vector.map(f64::from)
}

/// Rounded to f32.
pub(super) fn narrow(vector: Vec3) -> [f32; 3] {
    vector.map(|value| value as f32)
}

pub(super) fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Component by component.
pub(super) fn mul(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

pub(super) fn scale(a: Vec3, by: f64) -> Vec3 {
    [a[0] * by, a[1] * by, a[2] * by]
}

/// `a + b * by`.
pub(super) fn along(a: Vec3, b: Vec3, by: f64) -> Vec3 {
    add(a, scale(b, by))
}

pub(super) fn neg(a: Vec3) -> Vec3 {
    a.map(|value| -value)
}

pub(super) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn length(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// At length 1, if it has a length.
pub(super) fn unit(a: Vec3) -> Option<Vec3> {
    let length = length(a);
    (length > 0.0 && length.is_finite()).then(|| a.map(|value| value / length))
}

/// The largest component.
pub(super) fn largest(a: Vec3) -> f64 {
    a[0].max(a[1]).max(a[2])
}

/// The mean of a colour's channels: what the choice between lobes, lamps and an end goes by. Any positive weight is right; this one is plain.
pub(super) fn mean(a: Vec3) -> f64 {
    (a[0] + a[1] + a[2]) / 3.0
}

/// Two directions that make a right-handed frame with a unit vector.
pub(super) fn frame(normal: Vec3) -> [Vec3; 2] {
    // The axis that the normal follows least keeps the product far from zero.
    let least = (0..3).fold(0, |least, axis| if normal[axis].abs() < normal[least].abs() { axis } else { least });
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let tangent = cross(axis, normal);
    let tangent = scale(tangent, 1.0 / length(tangent));
    [tangent, cross(normal, tangent)]
}

/// A direction given in the frame of a unit vector.
pub(super) fn turned(local: Vec3, normal: Vec3) -> Vec3 {
    let [tangent, other] = frame(normal);
    add(add(scale(tangent, local[0]), scale(other, local[1])), scale(normal, local[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_square() {
        for normal in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.6, -0.8, 0.0], [-2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0]] {
            let [x, y] = frame(normal);
            assert!(dot(x, y).abs() < 1e-15 && dot(x, normal).abs() < 1e-15 && dot(y, normal).abs() < 1e-15);
            assert!((length(x) - 1.0).abs() < 1e-15 && (length(y) - 1.0).abs() < 1e-15);
            assert!(length(sub(cross(x, y), normal)) < 1e-15, "right-handed");
        }
        assert_eq!(unit([0.0; 3]), None);
    }
}
