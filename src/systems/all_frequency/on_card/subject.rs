//! The drawn object: a mesh whose vertices have transferred radiance.

use crate::all_frequency::Reflectance;
use crate::all_frequency::shade::TransferredRadiance;
use crate::card::CardError;
use crate::transfer::Vertices;

/// A mesh with transferred radiance at its vertices.
#[derive(Clone, Copy, Debug)]
pub struct TransferredMesh<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// The reflectance for which its transfer was computed.
    pub reflectance: &'a Reflectance,
    /// The surface color of each material.
    pub colors: &'a [[f64; 3]],
    /// T_p of each vertex.
    pub transferred: &'a TransferredRadiance,
}

impl TransferredMesh<'_> {
    /// The number of terms m.
    pub fn terms(&self) -> usize {
        self.reflectance.terms()
    }

    /// The surface's color at a vertex.
    pub(super) fn color(&self, vertex: usize) -> [f64; 3] {
        self.colors[self.vertices.materials()[vertex] as usize]
    }

    /// Checks that the parts have matching sizes.
    pub(super) fn check(&self) -> Result<(), CardError> {
        let materials = self.vertices.materials().iter().max().map_or(0, |&most| most as usize + 1);
        let transferred = self.transferred;
        CardError::check_size("vertices with transferred radiance", self.vertices.len(), transferred.vertices())?;
        CardError::check_size("rows, one per term", self.terms(), transferred.rows())?;
        CardError::check_size("colors, one per material", materials, self.colors.len().min(materials))
    }
}
