//! One pass after another on one card: some rays of any origin against some triangles.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

use refsim::event::{Event, FenceId};
use refsim::machine::Machine;

use super::card::{Sheet, Streams};
use super::units::Units;
use super::{EngineError, Hit, Kernel, RayBatch};
use crate::geom::Mesh;

/// A card with several sets of textures and targets, so that one pass can be prepared while others are on their way.
#[derive(Debug)]
pub(super) struct PassCard {
    machine: Machine,
    kernel: Arc<Kernel>,
    sheets: BTreeMap<(usize, u32, u32), Loaded>,
}

/// Textures and targets, and the units of the rays in them.
#[derive(Debug)]
struct Loaded {
    sheet: Sheet,
    units: Units,
}

impl PassCard {
    pub(super) fn new(machine: Machine, kernel: Arc<Kernel>) -> Self {
        Self { machine, kernel, sheets: BTreeMap::new() }
    }

    /// Starts or stops writing down what is asked of the card.
    pub(super) fn record(&mut self, on: bool) {
        self.machine.record(on);
    }

    /// What was asked of it since the last time.
    pub(super) fn take_log(&mut self) -> Vec<Event> {
        self.machine.take_log()
    }

    /// Draws some triangles, given in rising order, over rays, in the textures and targets of number `sheet`.
    pub(super) fn draw(
        &mut self,
        sheet: usize,
        mesh: &Mesh,
        triangles: &[u32],
        rays: &RayBatch,
    ) -> Result<(), EngineError> {
        let (machine, kernel) = (&mut self.machine, &self.kernel);
        let units = Units::choose(kernel.form, mesh, rays);
        let loaded = match self.sheets.entry((sheet, rays.width(), rays.height())) {
            Entry::Occupied(held) => {
                let loaded = held.into_mut();
                loaded.sheet.load(machine, kernel, rays, &units)?;
                loaded.units = units;
                loaded
            }
            Entry::Vacant(slot) => slot.insert(Loaded { sheet: Sheet::new(machine, kernel, rays, &units)?, units }),
        };
        loaded.sheet.clear(machine)?;
        loaded.sheet.draw(machine, kernel, &units, &Streams::new(mesh, triangles))?;
        Ok(())
    }

    /// What each ray of the last draw of a sheet hits. If the host does not wait, a fence tells when it may look.
    pub(super) fn read_back(
        &self,
        sheet: usize,
        rays: &RayBatch,
        wait: bool,
    ) -> Result<(Vec<Option<Hit>>, Option<FenceId>), EngineError> {
        let Some(loaded) = self.sheets.get(&(sheet, rays.width(), rays.height())) else {
            return Ok((vec![None; rays.rays().len()], None));
        };
        loaded.sheet.read_back(&self.machine, rays, &loaded.units, wait)
    }

    /// The host waits for a fence.
    pub(super) fn finish(&self, fence: FenceId) {
        self.machine.finish_fence(fence);
    }
}
