//! Local frames of surface points: tangent, bitangent, normal.

use glam::{DMat3, DVec3};

use crate::card::attribute;
use crate::geom::vector::{least_axis, unit};

/// Minimum length of a tangent's part perpendicular to the normal, relative to the tangent's length.
const LEAST_ACROSS: f64 = 1e-6;

/// The local frame of a surface point: right-handed, z along the normal, x along the tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalFrame {
    axes: [DVec3; 3],
}

impl LocalFrame {
    /// The frame of a unit normal and a tangent, which is orthogonalised (Gram-Schmidt); `None` if the tangent is
    /// parallel to the normal or zero.
    pub fn new(normal: DVec3, tangent: DVec3) -> Option<Self> {
        let tangent = unit(tangent)?;
        let across = tangent - tangent.dot(normal) * normal;
        if across.length() < LEAST_ACROSS {
            return None;
        }
        // Two subtractions suffice: the first leaves a component along the normal of the order of rounding.
        let x = unit(across - across.dot(normal) * normal)?;
        Some(Self { axes: [x, normal.cross(x), normal] })
    }

    /// A frame of a unit normal with an arbitrary tangent: the direction is derived from the coordinate axis that is
    /// least parallel to the normal.
    pub fn of_normal(normal: DVec3) -> Self {
        Self::new(normal, least_axis(normal)).unwrap_or(Self { axes: DVec3::AXES })
    }

    /// The normal.
    pub fn normal(&self) -> DVec3 {
        self.axes[2]
    }

    /// The tangent.
    pub fn tangent(&self) -> DVec3 {
        self.axes[0]
    }

    /// Tangent and normal as attributes of a card's vertex.
    pub fn attributes(&self) -> [[u32; 4]; 2] {
        [self.tangent(), self.normal()].map(|axis| attribute(axis.to_array(), 0.0))
    }

    /// A global direction in local coordinates.
    pub fn to_local(&self, direction: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        DVec3::new(x.dot(direction), y.dot(direction), z.dot(direction))
    }

    /// A local direction in global coordinates.
    pub fn to_global(&self, direction: DVec3) -> DVec3 {
        let [x, y, z] = self.axes;
        direction.x * x + direction.y * y + direction.z * z
    }

    /// The rotation from local to global coordinates.
    pub fn matrix(&self) -> DMat3 {
        let [x, y, z] = self.axes;
        DMat3::from_cols(x, y, z)
    }
}
