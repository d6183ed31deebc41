//! The time of a frame: the host on which section 7 measures, and the log of a frame, computed from sizes and counts
//! alone, without mesh, clusters or pixels.

use refsim::event::Event;
use refsim::isa::Version;
use refsim::timing::host::{HostCounts, HostError, HostModel, HostOperation};

use super::model::TransferSize;
use crate::card::frame_time::{UnseenFrame, host_work};
use crate::cpca::kernels::{VertexKernel, VertexShading};

/// The uncompressed head of section 7; the 2.2 GHz host multiplies the matrix of every vertex by the light.
const HEAD: TransferSize = TransferSize { vertices: 50_060, rows: 25, columns: 25, clusters: 0, vectors: 0 };
/// Frames of the head in 10 seconds: 2.9 frames per second is the only number that calibrates the host.
const HEAD_FRAMES: u64 = 29;
const HEAD_SECONDS: u64 = 10;

/// The host of section 7, at the speed that gives the uncompressed head 2.9 frames per second.
pub fn host_of_section_7() -> Result<HostModel, HostError> {
    let work = HEAD_FRAMES * HEAD.multiply_adds(HEAD.vertices) as u64;
    HostModel::calibrate(&HostCounts::default().with(HostOperation::MultiplyAdd, work), HEAD_SECONDS, 1)
}

/// The parameters of a frame's time, without its pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameCounts {
    /// The sizes of the transfer.
    pub size: TransferSize,
    /// Number of triangles of the mesh.
    pub triangles: u64,
    /// Triangles drawn per pass: [`Self::triangles`] times the overdraw.
    pub drawn: u64,
    /// Number of superclusters, or of clusters if each is drawn alone.
    pub groups: u64,
    /// Mean number of vertex program runs per triangle, which depends on the order of the mesh and the card's vertex
    /// cache.
    pub run_per_triangle: f64,
}

/// Number of instructions of the program that draws only positions.
const POSITION_SLOTS: u64 = 4;

impl FrameCounts {
    /// The log of a frame, for [`frame_time`](crate::card::frame_time::frame_time), without time for pixels: products
    /// on the host, the mesh into the depth buffer, then constants and passes of each group. Groups have equal sizes.
    pub fn log(&self) -> Vec<Event> {
        let registers = self.size.rows.div_ceil(4);
        let shading = if self.size.rows == 1 { VertexShading::Diffuse } else { VertexShading::Glossy { registers } };
        let kernel = VertexKernel { shading, vectors: self.size.vectors, version: Version::Vs2_0 };
        let representatives = self.size.representatives();
        let work = host_work(HostOperation::MultiplyAdd, self.size.multiply_adds(representatives) as u64);
        let mut frame = UnseenFrame::new(vec![work], self.run_per_triangle);
        frame.draw(self.triangles, POSITION_SLOTS, 1);
        let (groups, passes) = (self.groups.max(1), self.size.passes() as u64);
        let constants = (self.size.uploaded_registers(representatives) as u64 / (groups * passes)) as u32;
        for group in 0..groups {
            // Differences of rounded multiples sum exactly to all drawn triangles.
            let triangles = self.drawn * (group + 1) / groups - self.drawn * group / groups;
            for _ in 0..passes {
                frame.pass(constants, triangles, kernel.slots() as u64, kernel.attributes() as u64);
            }
        }
        frame.log
    }
}
