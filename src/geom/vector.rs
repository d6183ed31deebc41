//! Vectors of three f64. Sums run from the left.

/// A point or a direction.
pub type Vec3 = [f64; 3];

/// `a + b`.
#[must_use]
pub fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a - b`.
#[must_use]
pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `s a`.
#[must_use]
pub fn scale(s: f64, a: Vec3) -> Vec3 {
    a.map(|x| s * x)
}

/// The inner product.
#[must_use]
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product.
#[must_use]
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The length. IEEE square root is correctly rounded, hence the same everywhere.
#[must_use]
pub fn length(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// The vector at length 1, if it has one.
#[must_use]
pub fn unit(a: Vec3) -> Option<Vec3> {
    let length = length(a);
    (length > 0.0).then(|| a.map(|x| x / length))
}
