//! The time of a frame (Table 1): the host's steps at one calibrated rate, uploads over the bus, vertices and pixels.

use refsim::event::{Event, ResourceId};
use refsim::isa::Version;
use refsim::timing::host::{HostCounts, HostError, HostModel, HostOperation};

use super::attributes::TransferredMesh;
use super::options::{ProductPlace, VertexColors};
use crate::all_frequency::kernels::TransferredVertexKernel;
use crate::all_frequency::shade::Multiplies;
use crate::card::frame_time::{UnseenFrame, host_work};

const CHANNELS: u64 = 3;
/// Representatives per cluster in all of Table 1.
const REPRESENTATIVES: u64 = 16;
/// Number of lighting segments, and of coefficients per segment.
const SEGMENTS: u64 = 24;
const COEFFICIENTS: u64 = 256;

/// A column of Table 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrintedModel {
    /// The name, with (d) for diffuse and (g) for glossy.
    pub name: &'static str,
    /// Vertices, in hundreds.
    pub vertex_hundreds: u64,
    /// The number m of terms.
    pub terms: u64,
    /// Number of clusters over all segments.
    pub clusters: u64,
    /// omega, the mean fraction of segments in which a vertex has transfer, in thousandths.
    pub omega_thousandths: u64,
    /// Frames in ten seconds, with and without drawing.
    pub frames_in_ten_seconds: [u64; 2],
}

const fn printed(
    name: &'static str,
    terms: u64,
    vertex_hundreds: u64,
    clusters: u64,
    omega_thousandths: u64,
    frames_in_ten_seconds: [u64; 2],
) -> PrintedModel {
    PrintedModel { name, vertex_hundreds, terms, clusters, omega_thousandths, frames_in_ten_seconds }
}

/// The models of the paper's Table 1, as printed.
pub const TABLE_1: [PrintedModel; 6] = [
    printed("bunny", 10, 115, 763, 560, [50, 62]),
    printed("teapot", 10, 513, 3801, 618, [12, 13]),
    printed("tweety (d)", 1, 328, 2260, 576, [84, 140]),
    printed("tweety (g)", 10, 328, 2263, 576, [17, 18]),
    printed("buddha (d)", 1, 541, 2739, 424, [66, 94]),
    printed("buddha (g)", 10, 541, 2740, 424, [11, 12]),
];

impl PrintedModel {
    /// Multiplications of a frame, including those by zero: 3 n m 256 per cluster, and 24 omega 3 n m per vertex.
    pub fn multiplies(&self) -> Multiplies {
        let per_row = CHANNELS * REPRESENTATIVES * self.terms;
        Multiplies {
            per_cluster: self.clusters * per_row * COEFFICIENTS,
            per_vertex: self.vertex_hundreds * SEGMENTS * self.omega_thousandths * per_row / 10,
        }
    }
}

/// The host of section 7 (two processors of 3 GHz), calibrated by one number: the sum of the times of one frame of each
/// model of Table 1 without drawing.
pub fn host_of_table_1() -> Result<HostModel, HostError> {
    let work = |model: &PrintedModel| {
        let Multiplies { per_cluster, per_vertex } = model.multiplies();
        per_cluster + per_vertex
    };
    let seconds: f64 = TABLE_1.iter().map(|model| 10.0 / model.frames_in_ten_seconds[1] as f64).sum();
    let work = TABLE_1.iter().map(work).sum::<u64>();
    // The model accepts only whole seconds, so the work and its time are multiplied by a thousand.
    let counts = HostCounts::default().with(HostOperation::MultiplyAdd, 1000 * work);
    HostModel::calibrate(&counts, (1000.0 * seconds).round() as u64, 1)
}

/// Vertex streams are not a resource of the emulated card; this number represents a frame's stream in logs.
const VERTEX_STREAM: ResourceId = ResourceId::Texture(1 << 20);

/// Bytes per vertex that a frame sends.
pub fn streamed_bytes(place: &ProductPlace, terms: usize) -> usize {
    match place {
        ProductPlace::Vertices(VertexColors::Bytes) => 4,
        ProductPlace::Vertices(VertexColors::Floats) => 12,
        ProductPlace::Pixels(_) if terms == 1 => 12,
        ProductPlace::Pixels(options) => CHANNELS as usize * terms * options.radiance.bytes(),
    }
}

/// The host's work in a frame: the multiplications of steps 2 and 3, then for each mesh 3 m multiplications per vertex
/// (by G, or by the scales of G's texels), and the submission and upload of vertices.
pub(super) fn host_log<'a>(
    meshes: impl Iterator<Item = &'a TransferredMesh<'a>>,
    place: &ProductPlace,
    host: Multiplies,
) -> Vec<Event> {
    let mut rest = Some(host);
    let share = |mesh: &TransferredMesh<'_>| {
        share_of_host(mesh.vertices.len() as u64, mesh.terms(), place, rest.take().unwrap_or_default())
    };
    meshes.flat_map(share).collect()
}

fn share_of_host(vertices: u64, terms: usize, place: &ProductPlace, host: Multiplies) -> Vec<Event> {
    let step_4 = CHANNELS * terms as u64 * vertices;
    vec![
        host_work(HostOperation::MultiplyAdd, host.per_cluster + host.per_vertex + step_4),
        host_work(HostOperation::VertexSent, vertices),
        Event::Upload { resource: VERTEX_STREAM, bytes: vertices * streamed_bytes(place, terms) as u64 },
    ]
}

/// The parameters of a frame's time, without its pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactoredFrame {
    /// Vertices of the mesh.
    pub vertices: u64,
    /// Number of triangles of the mesh.
    pub triangles: u64,
    /// Number of terms m.
    pub terms: usize,
    /// Multiplications of steps 2 and 3.
    pub host: Multiplies,
    /// Mean number of vertex program runs per triangle, which depends on the order of the mesh and the card's vertex
    /// cache.
    pub run_per_triangle: f64,
}

/// Number of constants of a frame: rows of the projection, and the eye.
const VERTEX_CONSTANTS: u32 = 5;
/// Numbers of instructions and of attributes of the programs for vertex colors.
const COLOR_SLOTS: u64 = 5;
const COLOR_ATTRIBUTES: u64 = 2;

impl FactoredFrame {
    /// The log of the frame, in which pixels take no time.
    pub fn log(&self, place: &ProductPlace) -> Vec<Event> {
        let (passes, (slots, attributes)) = match place {
            ProductPlace::Pixels(options) if self.terms > 1 => {
                let kernel = TransferredVertexKernel { layout: options.layout(self.terms), version: Version::Vs2_0 };
                let passes = if options.is_pass_per_channel { 3 } else { 1 };
                (passes, (kernel.slots() as u64, kernel.attributes() as u64))
            }
            _ => (1, (COLOR_SLOTS, COLOR_ATTRIBUTES)),
        };
        let host = share_of_host(self.vertices, self.terms, place, self.host);
        let mut frame = UnseenFrame::new(host, self.run_per_triangle);
        for _ in 0..passes {
            frame.pass(VERTEX_CONSTANTS, self.triangles, slots, attributes);
        }
        frame.log
    }
}
