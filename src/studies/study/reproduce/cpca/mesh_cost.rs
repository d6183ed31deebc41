//! Cost of a model's triangles on a card, independent of their clusters.

use refsim::device::Profile;
use refsim::event::vertex_cache_misses;

use super::StudyError;
use crate::geom::Mesh;

/// The paper's card: "a Radeon 9700".
pub(super) const CARD: &str = "r300";
/// Its constant registers: "~256".
pub(super) const REGISTERS: usize = 256;

/// Mesh as the card's cost model describes it.
#[derive(Clone, Copy)]
pub(super) struct MeshCost {
    pub(super) triangles: u64,
    /// Vertices processed per triangle.
    pub(super) run_per_triangle: f64,
}

impl MeshCost {
    /// Measures a mesh, drawing its triangles in their order.
    pub(super) fn new(mesh: &Mesh) -> Result<Self, StudyError> {
        let profile = Profile::named(CARD)?;
        let entries = profile.rates.vertex_cache_entries.unwrap_or(0);
        let run = vertex_cache_misses(mesh.triangles().as_flattened(), mesh.positions().len(), entries);
        Ok(Self { triangles: mesh.len() as u64, run_per_triangle: run as f64 / mesh.len().max(1) as f64 })
    }
}
