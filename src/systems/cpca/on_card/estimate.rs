//! The log of a frame from sizes and counts alone, without mesh, clusters or pixels; pixels take no time.

use std::sync::Arc;

use refsim::event::{Event, FlowConstants, ProgramWork};
use refsim::isa::Version;
use refsim::timing::host::HostOperation;

use super::model::TransferSize;
use crate::card::frame_time::{host_work, unseen_draw};
use crate::card::kernels::SHADE;
use crate::cpca::kernels::{VertexKernel, VertexShading};

/// The parameters of a frame's time, without its pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameCounts {
    /// The sizes of the transfer.
    pub size: TransferSize,
    /// Triangles of the mesh.
    pub triangles: u64,
    /// Triangles drawn per pass: [`Self::triangles`] times the overdraw.
    pub drawn: u64,
    /// Number of superclusters, or of clusters if each is drawn alone.
    pub groups: u64,
    /// Vertices run per triangle, which follow from the order of the mesh and the card's vertex cache.
    pub run_per_triangle: f64,
}

/// Numbers of attributes without weights, for glossy and diffuse transfer: position, cluster, and if glossy the frame.
const GLOSSY_ATTRIBUTES: usize = 4;
const DIFFUSE_ATTRIBUTES: usize = 2;
/// Number of instructions of the program that draws positions only.
const POSITION_SLOTS: u64 = 4;

impl FrameCounts {
    /// The log of such a frame, for [`frame_time`](crate::card::frame_time::frame_time): products on the host, the mesh
    /// into the depth buffer, then group by group its constants and passes. Groups have equal sizes.
    pub fn log(&self) -> Vec<Event> {
        let registers = self.size.rows.div_ceil(4);
        let shading = if self.size.rows == 1 { VertexShading::Diffuse } else { VertexShading::Glossy { registers } };
        let kernel = VertexKernel { shading, vectors: self.size.vectors, version: Version::Vs2_0 };
        let beside = if self.size.rows == 1 { DIFFUSE_ATTRIBUTES } else { GLOSSY_ATTRIBUTES };
        let attributes = (beside + kernel.weight_registers()) as u64;
        let work = self.size.host_multiply_adds() as u64;
        let program = refsim::asm::assemble(SHADE.text).expect("a program of the project");
        let pixel = Arc::new(ProgramWork::new(&program, FlowConstants::default()));
        let mut log = vec![host_work(HostOperation::MultiplyAdd, work)];
        log.push(self.draw(self.triangles, (POSITION_SLOTS, 1), &pixel));
        let groups = self.groups.max(1);
        let (passes, slots) = (self.size.passes() as u64, kernel.slots() as u64);
        let constants = (self.size.uploaded_registers() as u64 / (groups * passes)) as u32;
        for group in 0..groups {
            // Differences of rounded shares, which sum to all drawn triangles.
            let triangles = self.drawn * (group + 1) / groups - self.drawn * group / groups;
            for _ in 0..passes {
                log.push(Event::StateChange { changes: 2, constants });
                log.push(self.draw(triangles, (slots, attributes), &pixel));
            }
        }
        log
    }

    fn draw(&self, triangles: u64, vertex: (u64, u64), pixel: &Arc<ProgramWork>) -> Event {
        let run = (triangles as f64 * self.run_per_triangle).round() as u64;
        unseen_draw([triangles, run], vertex, pixel)
    }
}
