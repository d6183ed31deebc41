//! Passes on one card: rays of any origin against subsets of a mesh's triangles.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use refsim::event::{DrawEvents, Event, FenceId};
use refsim::machine::Machine;

use super::card::{CardHit, PassInputs, RayTextures, ReadBack, Streams};
use super::cull;
use super::outputs::{Outputs, TargetEncoding};
use super::range::Range;
use super::units::Units;
use super::{EngineError, Kernel, RayBatch};
use crate::geom::Mesh;
use crate::geom::exact::Sides;

/// Requirements on passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PassRequirements {
    pub(super) outputs: Outputs,
    pub(super) small_ids: bool,
    pub(super) cull: bool,
    /// Maximum number of triangles of a pass.
    pub(super) triangles: usize,
}

/// Card with several sets of textures and targets, so that one pass can be prepared while others are in flight.
#[derive(Debug)]
pub(super) struct PassCard {
    machine: Machine,
    kernel: Kernel,
    sides: Sides,
    requirements: PassRequirements,
    /// Lowest and highest coordinates of the mesh that all passes test against.
    bounds: [[f32; 3]; 2],
    sheets: BTreeMap<(usize, u32, u32, Format), RayTextures>,
}

/// Name of a target's format, the key of its set of resources.
type Format = &'static str;

/// Draw whose results can be read back.
#[derive(Clone, Copy, Debug)]
pub(super) struct DrawnPass {
    units: Units,
    code: TargetEncoding,
    sheet: usize,
    /// Events of the draw.
    pub(super) events: DrawEvents,
}

impl PassCard {
    /// Creates a card for passes over triangles of one mesh.
    pub(super) fn new(
        machine: Machine,
        kernel: Kernel,
        mesh: &Mesh,
        sides: Sides,
        requirements: PassRequirements,
    ) -> Self {
        let bounds = mesh.bounds().unwrap_or_default();
        Self { machine, kernel, sides, requirements, bounds, sheets: BTreeMap::new() }
    }

    /// Returns the file name of the pixel program.
    pub(super) fn kernel_name(&self) -> &'static str {
        self.kernel.name
    }

    /// Starts or stops recording the log.
    pub(super) fn record(&mut self, on: bool) {
        self.machine.record(on);
    }

    /// Takes the log recorded since the last call.
    pub(super) fn take_log(&mut self) -> Vec<Event> {
        self.machine.take_log()
    }

    /// Draws some triangles, given in ascending order, over rays, using the textures and targets of set `sheet`.
    pub(super) fn draw(
        &mut self,
        sheet: usize,
        mesh: &Mesh,
        triangles: &[u32],
        rays: &RayBatch,
    ) -> Result<DrawnPass, EngineError> {
        let (machine, kernel) = (&mut self.machine, &self.kernel);
        let units = Units::within(kernel.form, Range::of_pixels(&machine.profile().rules), self.bounds, rays);
        let bucket = match (kernel.takes_bucket(), kernel.culls) {
            (true, true) => cull::bucket(&machine.profile().rules, &units, mesh, triangles, rays, self.sides),
            (true, false) => cull::nothing(),
            (false, _) => Vec::new(),
        };
        let code =
            TargetEncoding::choose(machine.profile(), kernel.weights, self.requirements.small_ids, triangles.len());
        let loaded = match self.sheets.entry((sheet, rays.width(), rays.height(), code.format().name())) {
            Entry::Occupied(held) => {
                let loaded = held.into_mut();
                loaded.load(machine, kernel, rays, &units)?;
                loaded
            }
            Entry::Vacant(slot) => slot.insert(RayTextures::new(machine, kernel, rays, &units, code)?),
        };
        loaded.clear(machine)?;
        let pass = PassInputs { kernel, units: &units, bucket: &bucket };
        let events = loaded.draw(machine, pass, &Streams::new(mesh, &units, triangles, code))?;
        Ok(DrawnPass { units, code, sheet, events })
    }

    /// Reads back the hit of each ray of a draw. If the host does not wait, the returned fence is passed when all data
    /// has arrived.
    pub(super) fn read_back(
        &self,
        drawn: &DrawnPass,
        triangles: &[u32],
        rays: &RayBatch,
        wait: bool,
    ) -> Result<(Vec<Option<CardHit>>, Option<FenceId>), EngineError> {
        let place = (drawn.sheet, rays.width(), rays.height(), drawn.code.format().name());
        let Some(sheet) = self.sheets.get(&place) else {
            return Ok((vec![None; rays.rays().len()], None));
        };
        let t = self.requirements.outputs == Outputs::IdAndT;
        sheet.read_back(&self.machine, &ReadBack { rays, units: &drawn.units, triangles, t, wait })
    }

    /// Makes the host wait for a fence.
    pub(super) fn finish(&self, fence: FenceId) {
        self.machine.finish_fence(fence);
    }
}
