//! Rays and hits.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Half-line `origin + t * direction`, t >= 0, with the f32 values as given: the direction is never renormalised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    origin: [f32; 3],
    direction: [f32; 3],
}

/// Error of a ray's origin or direction.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum RayError {
    /// One of the six numbers is NaN or infinite.
    #[error("expected six finite numbers, found {what} {axis} not finite")]
    NotFinite {
        /// `origin` or `direction`.
        what: &'static str,
        /// `x`, `y` or `z`.
        axis: char,
    },
    /// All three components of the direction are zero.
    #[error("expected a direction, found (0, 0, 0)")]
    ZeroDirection,
}

impl Ray {
    /// Creates a ray from an origin along a direction of any length but zero.
    ///
    /// # Errors
    /// [`RayError`] when a number is not finite or the direction is zero.
    pub fn new(origin: [f32; 3], direction: [f32; 3]) -> Result<Self, RayError> {
        for (what, vector) in [("origin", origin), ("direction", direction)] {
            for (axis, value) in ['x', 'y', 'z'].into_iter().zip(vector) {
                if !value.is_finite() {
                    return Err(RayError::NotFinite { what, axis });
                }
            }
        }
        if direction == [0.0; 3] {
            return Err(RayError::ZeroDirection);
        }
        Ok(Self { origin, direction })
    }

    /// Origin of the ray (t = 0).
    pub fn origin(&self) -> [f32; 3] {
        self.origin
    }

    /// Direction of the ray: t counts in multiples of this vector.
    pub fn direction(&self) -> [f32; 3] {
        self.direction
    }
}

impl AsRef<Self> for Ray {
    fn as_ref(&self) -> &Self {
        self
    }
}

/// First hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hit {
    /// Id of the triangle: its index in the mesh.
    pub triangle: u32,
    /// The ray parameter, in multiples of the ray's direction.
    pub t: f32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_is_no_ray() {
        assert_eq!(Ray::new([0.0; 3], [0.0, -0.0, 0.0]), Err(RayError::ZeroDirection));
        let found = Ray::new([0.0, f32::NAN, 0.0], [1.0; 3]);
        assert_eq!(found, Err(RayError::NotFinite { what: "origin", axis: 'y' }));
        assert!(Ray::new([0.0; 3], [0.0, 0.0, f32::from_bits(1)]).is_ok());
    }
}
