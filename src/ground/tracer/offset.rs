//! Offsets of ray ends from surfaces, so that no ray hits the triangle at its start or at its end.
//!
//! One policy for all ray casters: points are lifted along the triangle's normal, to the side on which the ray lies, at
//! both ends of a segment. The distance depends on the position of the point:
//!
//! - it lies *on* a triangle: [`SurfacePoint::clearance`], a bound of rounding errors in the ray's origin and in the
//!   test of that triangle;
//! - it lies *near* triangles, such as a point of a patch whose four corners are coplanar only up to f32:
//!   [`scene_clearance`], a fixed fraction of the scene.

use glam::DVec3;
use refsim::num::{Format, FormatKind, Rounding};

use crate::geom::vector::{area_vector, narrow, unit, wide};
use crate::geom::{Mesh, Ray};

/// Unit roundoff of single precision.
pub const SINGLE: f64 = 1.0 / 16_777_216.0;

/// Unit roundoff of a format: half a step of its numbers near 1, a whole step if it does not round to nearest. At least
/// that of single precision, since rays are single precision.
pub fn unit_roundoff(format: Format) -> f64 {
    let step = match format.kind {
        FormatKind::Fixed { frac_bits: bits, .. } | FormatKind::Float { man_bits: bits, .. } => {
            1.0 / f64::from(1_u32 << bits.min(31))
        }
        FormatKind::Normalized { .. } => 1.0 / f64::from(format.denominator()),
    };
    let nearest = matches!(format.rounding, Rounding::NearestEven | Rounding::NearestAway);
    (if nearest { step / 2.0 } else { step }).max(SINGLE)
}

/// Sine of the thinnest triangle in the bound on the plane test; thinner triangles count as this thin.
const MIN_SINE: f64 = 1.0 / 256.0;
/// Clearance as a fraction of a scene's diagonal.
const SCENE: f64 = 1.0 / 65_536.0;

/// Clearance of points near the surfaces of a scene with this diagonal: above the error of f32 corners and of the
/// test's rounding, below the size of modelled detail.
pub fn scene_clearance(diagonal: f64) -> f64 {
    SCENE * diagonal
}

/// Point on a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Position.
    pub at: DVec3,
    /// Unit normal of the triangle, on the side from which the corners run counter-clockwise.
    pub normal: DVec3,
    /// Length of the longer of the sides ab and ac.
    size: f64,
    /// `|ab| |ac| / |ab x ac|`: 1 over the sine of the angle at a.
    thinness: f64,
    /// Unit roundoff of the caster.
    rounding: f64,
}

impl SurfacePoint {
    /// Returns the point of a triangle with these barycentric coordinates; `None` if the triangle has no area or does
    /// not exist. `rounding` is the unit roundoff of the caster's arithmetic, for example [`SINGLE`].
    pub fn new(mesh: &Mesh, triangle: u32, weights: DVec3, rounding: f64) -> Option<Self> {
        Self::of(mesh.corners(triangle)?.map(wide), weights, rounding)
    }

    /// Like [`Self::new`], for a triangle given by its corners.
    pub fn of([a, b, c]: [DVec3; 3], weights: DVec3, rounding: f64) -> Option<Self> {
        let across = area_vector([a, b, c]);
        let normal = unit(across)?;
        let (ab, ac) = ((b - a).length(), (c - a).length());
        let at = weights.x * a + weights.y * b + weights.z * c;
        let sine = (across.length() / (ab * ac)).max(MIN_SINE);
        Some(Self { at, normal, size: ab.max(ac), thinness: 1.0 / sine, rounding })
    }

    /// Returns the offset from the triangle at which a ray must start for its test to miss the triangle, for points up
    /// to `reach` from the origin.
    ///
    /// With u the unit roundoff, 2^-24 for fp32: rounding the origin moves it along the normal by at most u times the
    /// sum of its magnitudes; twice that is used. The test finds the side from n . ao. One rounding per component of
    /// ao, ab and ac, three of the cross product and four of the dot product make at most (1 + 2 + 2 + 4) u of the sum
    /// of magnitudes |n|.|ao| <= sqrt(3) |ab| |ac| |ao|: as a length, 16 u |ao| |ab| |ac| / |ab x ac|. Here |ao| is at
    /// most the triangle's size plus `reach`.
    pub fn clearance(&self, reach: f64) -> f64 {
        self.rounding * (2.0 * self.at.abs().element_sum() + 16.0 * self.thinness * (self.size + reach))
    }

    /// Returns the point offset from the triangle to the side of `towards`, clear of the test of rays that start there
    /// or, with a `reach`, that end there.
    pub fn lifted(&self, towards: DVec3, reach: f64) -> [f32; 3] {
        let side = if self.normal.dot(towards) < 0.0 { -1.0 } else { 1.0 };
        narrow(self.at + side * self.clearance(reach) * self.normal)
    }

    /// Returns the ray to a point of another triangle, clear of both triangles: it hits something before t = 1 if and
    /// only if something lies between the points. `None` if f32 cannot represent its direction.
    pub fn ray_to(&self, other: &Self) -> Option<Ray> {
        let way = other.at - self.at;
        let start = self.lifted(way, 0.0);
        let end = other.lifted(-way, way.length());
        Ray::new(start, narrow(wide(end) - wide(start))).ok()
    }
}
