//! Drawing cost of a mesh in clusters: with neither optimisation of section 5, with each alone, and with both.

use super::mesh_cost::REGISTERS;
use super::signals::ComputedSignal;
use super::{HOST, RunResult, StudyError};
use crate::clustering::Clustering;
use crate::cpca::coherence::{ConstantRegisters, Superclusters, overdraw, reclassify};

/// "Using a 5% error threshold".
pub(super) const BUDGET: f64 = 0.05;
/// Columns of the paper's table.
pub(super) const COLUMNS: [&str; 4] = ["original", "rec", "sc", "sc+rec"];
/// Columns of the paper's table, as in figure names.
pub(super) const COLUMN_IDS: [&str; 4] = ["original", "rec", "sc", "both"];

/// Drawing cost of a mesh's clusters, in the order of [`COLUMNS`].
pub(super) struct DrawnClusters {
    /// Triangles drawn per triangle of the mesh.
    pub(super) overdraw: [f64; 4],
    /// Error added by reclassification, relative to the squared error.
    pub(super) added_error: f64,
    /// Number of superclusters after reclassification.
    pub(super) superclusters: usize,
}

impl DrawnClusters {
    /// Applies both optimisations, alone and together.
    pub(super) fn new(computed: &ComputedSignal, clustering: &Clustering) -> Result<Self, StudyError> {
        let triangles = computed.vertices.triangles();
        let rows = computed.paper.size.rows;
        let registers =
            if rows == 1 { ConstantRegisters::diffuse(REGISTERS) } else { ConstantRegisters::glossy(REGISTERS, rows) };
        let moved = reclassify(&computed.signal, clustering, triangles, BUDGET).on(HOST)?;
        let superclusters = |clustering: &Clustering| -> Result<(Vec<u32>, usize), StudyError> {
            let made = Superclusters::new(clustering, triangles, registers).on(HOST)?;
            let of_vertex = clustering.of_point().iter().map(|&cluster| made.of_cluster()[cluster as usize]);
            Ok((of_vertex.collect(), made.count()))
        };
        let (alone, _) = superclusters(clustering)?;
        let (both, count) = superclusters(&moved.clustering)?;
        let groups = [clustering.of_point(), moved.clustering.of_point(), &alone, &both];
        let drawn = groups.map(|of_vertex| overdraw(triangles, of_vertex));
        let whole = computed.error(clustering);
        Ok(Self {
            overdraw: drawn.map(|drawn| drawn as f64 / triangles.len() as f64),
            added_error: if whole > 0.0 { moved.added_error / whole } else { 0.0 },
            superclusters: count,
        })
    }
}
