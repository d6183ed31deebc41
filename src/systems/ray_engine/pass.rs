//! Passes on one card: rays of any origin against subsets of a mesh's triangles.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use refsim::event::DrawEvents;
use refsim::machine::Machine;

use super::card::{RayTextures, ReadHits, Streams};
use super::cull;
use super::units::Units;
use super::{EngineError, Kernel, RayBatch};
use crate::geom::Mesh;
use crate::geom::exact::Sides;

/// Card with several sets of textures and targets, so that one pass can be prepared while others are in flight.
#[derive(Debug)]
pub(super) struct PassCard {
    pub(super) machine: Machine,
    pub(super) kernel: Kernel,
    sides: Sides,
    /// Lowest and highest coordinates of the mesh of all passes.
    bounds: [[f32; 3]; 2],
    sheets: BTreeMap<(usize, u32, u32), RayTextures>,
}

impl PassCard {
    pub(super) fn new(machine: Machine, kernel: Kernel, mesh: &Mesh, sides: Sides) -> Self {
        let bounds = mesh.bounds().unwrap_or_default();
        Self { machine, kernel, sides, bounds, sheets: BTreeMap::new() }
    }

    /// Tests rays against some triangles, given in ascending order, with the textures and targets of set `sheet`, and
    /// reads back the hit of each ray. If the host does not wait, the returned fence is passed when all data has arrived.
    pub(super) fn test(
        &mut self,
        sheet: usize,
        mesh: &Mesh,
        triangles: &[u32],
        rays: &RayBatch,
        wait: bool,
    ) -> Result<(ReadHits, DrawEvents), EngineError> {
        let (machine, kernel) = (&mut self.machine, &self.kernel);
        let units = Units::within(kernel.numbers(&machine.profile().rules), self.bounds, rays);
        let bucket = match kernel.culls {
            true => cull::bucket(&machine.profile().rules, &units, mesh, triangles, rays, self.sides),
            false => Vec::new(),
        };
        let loaded = match self.sheets.entry((sheet, rays.width(), rays.height())) {
            Entry::Occupied(held) => {
                let loaded = held.into_mut();
                loaded.load(machine, kernel, rays, &units)?;
                loaded
            }
            Entry::Vacant(slot) => slot.insert(RayTextures::new(machine, kernel, rays, &units)?),
        };
        loaded.clear(machine)?;
        let events = loaded.draw(machine, kernel, &units, &bucket, &Streams::new(mesh, kernel, &units, triangles))?;
        Ok((loaded.read_back(machine, rays, &units, wait)?, events))
    }
}
