//! Drawing cost of clusters: with neither optimisation of section 5, with each alone, and with both; frame rates from
//! sizes and overdraw: the overdraw printed in the table of section 7, or that of our clusters.

use refsim::device::Profile;
use refsim::event::vertex_cache_misses;
use refsim::timing::host::HostOperation;

use super::signals::{BIRD, ComputedSignal, PaperSignal, SIGNALS, iterative};
use super::{
    Contradiction, Dependence, HOST, Method, PaperRow, RunResult, Shared, SharedResult, StudyError, TimedWork,
    paper_row, printed, printed_value,
};
use crate::card::frame_time::{FrameTime, frame_time};
use crate::clustering::Clustering;
use crate::cpca::coherence::{ConstantRegisters, Superclusters, overdraw, reclassify};
use crate::cpca::on_card::model::TransferSize;
use crate::cpca::on_card::time::{FrameCounts, host_of_section_7};
use crate::report::{Cell, Table};
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

/// Index in [`COLUMNS`] of the column with both optimisations.
const BOTH: usize = 3;
/// Inputs of the modelled rates: calibration of the host's rate, and overdraw.
pub(super) const INPUTS: &str =
    "2.9 Hz of the uncompressed head, which determined the host's rate; the printed overdraw";
/// Inputs of the modelled rates that use our clusters' overdraw.
pub(super) const OWN_INPUTS: &str = "2.9 Hz of the uncompressed head, which determined the host's rate";

/// Time of a frame with a printed size and `groups` groups, which are drawn one after the other.
fn modelled(
    card: &Profile,
    mesh: MeshCost,
    size: TransferSize,
    (overdraw, groups): (f64, usize),
) -> Result<FrameTime, StudyError> {
    let counts = FrameCounts {
        size,
        triangles: mesh.triangles,
        drawn: (mesh.triangles as f64 * overdraw).round() as u64,
        groups: groups as u64,
        run_per_triangle: mesh.run_per_triangle,
    };
    let host = host_of_section_7().on(HOST)?;
    frame_time(card, &counts.log(), &host).on(CARD)
}

/// Time of a frame with both optimisations, with our own clusters' overdraw.
pub(super) fn modelled_from_clusters(
    card: &Profile,
    shared: &Shared,
    (model, size): (TransferModel, TransferSize),
    drawn: &DrawnClusters,
) -> Result<FrameTime, StudyError> {
    let groups = size.clusters.div_ceil(size.clusters_per_batch(REGISTERS).max(1));
    modelled(card, *shared.get::<MeshCost>(model)?, size, (drawn.overdraw[BOTH], groups))
}

/// Frames per second without compression, by equation and from printed sizes: the host multiplies every matrix by the
/// light.
pub(super) fn uncompressed(size: TransferSize) -> Result<f64, StudyError> {
    let host = host_of_section_7().on(HOST)?;
    Ok(1.0 / host.time_of(HostOperation::MultiplyAdd, size.multiply_adds(size.vertices) as u64).seconds())
}

/// Names of the two printed rates of the Buddha with anisotropic gloss: in Table 1, and in section 7 with both
/// optimisations. They contradict each other: signal, clusters, vectors, card and host are the same.
const CONTRADICTORY: [&str; 2] = ["rate-buddha-gloss-anis", "rate-buddha-both"];

pub(super) fn rate_row(id: &str, time: &FrameTime, from: &'static str) -> Result<PaperRow, StudyError> {
    let row = ratio_row(id, (time.into(), time.per_second()), from)?;
    let Some(at) = CONTRADICTORY.iter().position(|known| *known == id) else { return Ok(row) };
    let other = printed(&format!("cpca/{}", CONTRADICTORY[1 - at]))?;
    let how = format!("the same signal, clusters and card in {}", other.place);
    let contradiction = Contradiction::between(&row.target, other.value, &how);
    Ok(row.contradicted(contradiction))
}

/// Row for a rate, or for a ratio of two rates, with its method.
pub(super) fn ratio_row(id: &str, (method, ours): (Method, f64), from: &'static str) -> Result<PaperRow, StudyError> {
    paper_row(&format!("cpca/{id}"), (CARD, method), (ours, Dependence::Predicted { from }))
}

/// Rows for printed rates, and a table of the times of each unit. A signal is an index, a name, and its name in figure
/// names.
pub(super) fn rates(
    models: &[(usize, &'static str, &'static str)],
    shared: &Shared,
) -> Result<(Vec<PaperRow>, Table), StudyError> {
    let mut table = Table::of(
        "Frames per second, modelled from the printed overdraw",
        "model how overdraw_printed printed ours host_ms constants_ms draws_ms vertices_run run_per_triangle",
    );
    let (mut rows, card) = (Vec::new(), Profile::named(CARD)?);
    for &(at, name, id) in models {
        let paper = &SIGNALS[at];
        let mesh = *shared.get::<MeshCost>(paper.model)?;
        for (column, how) in COLUMNS.into_iter().enumerate() {
            let (overdraw, time) = of_print(&card, mesh, paper.size, (id, column))?;
            let id = format!("rate-{id}-{}", COLUMN_IDS[column]);
            let row = rate_row(&id, &time, INPUTS)?;
            let head = [name.into(), how.into(), Cell::decimals(overdraw, 3), Cell::decimals(row.target.value, 1)];
            let run = [time.vertices_run.into(), Cell::ratio(mesh.run_per_triangle)];
            table.push(head.into_iter().chain(time_cells(&time)).chain(run));
            rows.push(row);
        }
    }
    Ok((rows, table))
}

/// Printed overdraw of a column, and the time of a frame with it.
fn of_print(
    card: &Profile,
    mesh: MeshCost,
    size: TransferSize,
    (id, column): (&str, usize),
) -> Result<(f64, FrameTime), StudyError> {
    let fit = if column < 2 { 1 } else { size.clusters_per_batch(REGISTERS) };
    let overdraw = printed_value(&format!("cpca/overdraw-{id}-{}", COLUMN_IDS[column]))?;
    Ok((overdraw, modelled(card, mesh, size, (overdraw, size.clusters.div_ceil(fit)))?))
}

pub(in crate::study::reproduce) fn timed() -> Result<TimedWork, StudyError> {
    let PaperSignal { model, size, .. } = SIGNALS[BIRD];
    let (_, time) =
        of_print(&Profile::named(CARD)?, MeshCost::compute(&model, &Shared::default())?, size, ("bird", BOTH))?;
    TimedWork::new("cpca/rate-bird-both", CARD, time.frame)
}

/// Frames per second, and milliseconds of the host, of constants and of draws.
pub(super) fn time_cells(time: &FrameTime) -> [Cell; 4] {
    let ms = [time.host, time.state, time.draws].map(|part| Cell::measured(1e3 * part.seconds()));
    let [host, constants, draws] = ms;
    [Cell::measured(time.per_second()), host, constants, draws]
}
