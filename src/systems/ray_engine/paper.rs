//! Equations (1) to (8) in plain f64, which the kernels approximate. [`crate::geom::exact`] decides in exact arithmetic
//! whether a ray hits.

use glam::DVec3;

/// Result of equations (3) and (6) to (8) for one ray and one triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Equation (3): the ray parameter; infinite or NaN for a ray in the plane.
    pub t: f64,
    /// Equation (6), unnormalised.
    pub u: f64,
    /// Equation (7), unnormalised.
    pub v: f64,
    /// Equation (8) with its sign chosen to be positive inside a front face, unnormalised.
    pub w: f64,
    /// `n . d`: negative for a front face; `u + v + w = -n.d`.
    pub n_dot_d: f64,
}

impl Crossing {
    /// Section 4.3: a hit has all three barycentric coordinates non-negative, and t >= 0.
    pub fn hits_front(&self) -> bool {
        self.n_dot_d < 0.0 && self.t >= 0.0 && self.u >= 0.0 && self.v >= 0.0 && self.w >= 0.0
    }

    /// A hit from either side: all three coordinates have the sign of `-n.d`.
    pub fn hits_either(&self) -> bool {
        let sign = if self.n_dot_d < 0.0 { 1.0 } else { -1.0 };
        self.n_dot_d != 0.0 && self.t >= 0.0 && self.u * sign >= 0.0 && self.v * sign >= 0.0 && self.w * sign >= 0.0
    }
}

/// Evaluates the equations for the ray `o + t d` and the triangle `a b c`.
pub fn intersect(o: DVec3, d: DVec3, [a, b, c]: [DVec3; 3]) -> Crossing {
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let n = ab.cross(ac);
    let ao = o - a; // (1)
    let bo = o - b; // (2)
    let n_dot_d = n.dot(d);
    let t = -n.dot(ao) / n_dot_d; // (3)
    let aod = ao.cross(d); // (4)
    let bod = bo.cross(d); // (5)
    let u = ac.dot(aod); // (6)
    let v = -ab.dot(aod); // (7)
    let w = -bc.dot(bod); // (8), DIFFERENCE: printed without the minus
    Crossing { t, u, v, w, n_dot_d }
}
