//! Rays and hits.

use serde::{Deserialize, Serialize};

use crate::error::{InputError, ensure};

/// Half-line `origin + t * direction`, t >= 0, with the f32 values as given: the direction is never renormalised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    origin: [f32; 3],
    direction: [f32; 3],
}

impl Ray {
    /// Creates a ray from an origin along a direction of any length but zero.
    pub fn new(origin: [f32; 3], direction: [f32; 3]) -> Result<Self, InputError> {
        for (what, vector) in [("origin", origin), ("direction", direction)] {
            for (axis, value) in ['x', 'y', 'z'].into_iter().zip(vector) {
                ensure!(value.is_finite(), "expected six finite numbers, found {what} {axis} not finite");
            }
        }
        ensure!(direction != [0.0; 3], "expected a direction, found (0, 0, 0)");
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
