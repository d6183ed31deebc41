//! Drawing cost of a mesh in clusters: with neither optimisation of section 5, with each alone, and with both.

use refsim::device::Profile;
use refsim::event::vertex_cache_misses;

use super::signals::{ComputedSignal, iterative};
use super::{HOST, RunResult, Shared, SharedResult, StudyError};
use crate::clustering::Clustering;
use crate::cpca::coherence::{ConstantRegisters, Superclusters, overdraw, reclassify};
use crate::scene::built::transfer_models::TransferModel;

/// The paper's card: "a Radeon 9700".
pub(super) const CARD: &str = "r300";
/// Its constant registers: "~256".
pub(super) const REGISTERS: usize = 256;
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

/// Cost of the iterative clustering of a signal.
impl SharedResult for DrawnClusters {
    type Key = usize;

    fn compute(&at: &usize, shared: &Shared) -> Result<Self, StudyError> {
        let (signal, clustering) = iterative(shared, at)?;
        Self::new(&signal, &clustering)
    }
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

/// Cost of our model's triangles at the printed size, independent of their clusters.
#[derive(Clone, Copy)]
pub(super) struct MeshCost {
    pub(super) triangles: u64,
    /// Number of vertices processed per triangle if triangles are drawn in their order.
    pub(super) run_per_triangle: f64,
}

impl SharedResult for MeshCost {
    type Key = TransferModel;

    fn compute(model: &TransferModel, _: &Shared) -> Result<Self, StudyError> {
        let mesh = model.mesh(1);
        let entries = Profile::named(CARD)?.rates.vertex_cache_entries.unwrap_or(0);
        let run = vertex_cache_misses(mesh.triangles().as_flattened(), mesh.positions().len(), entries);
        Ok(Self { triangles: mesh.len() as u64, run_per_triangle: run as f64 / mesh.len().max(1) as f64 })
    }
}
