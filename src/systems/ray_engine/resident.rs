//! A crossbar whose rays and triangles are resident on the card, for repeated draws without uploads.

use std::sync::Arc;

use refsim::machine::Machine;

use super::card::{RayTextures, Streams, rounded};
use super::units::Units;
use super::{Answer, EngineError, Kernel, RayBatch};

/// A card with rays in its textures and triangles in its vertex memory. [`super::Crossbar::make_resident`] creates it.
#[derive(Debug)]
pub struct ResidentCrossbar {
    /// `None` if there are no rays or no triangles.
    pub(super) work: Option<(Machine, RayTextures, Units, Streams)>,
    pub(super) rays: RayBatch,
    pub(super) kernel: Arc<Kernel>,
}

impl ResidentCrossbar {
    /// Clears the targets, draws every triangle over every ray, and reads back: the result of
    /// [`super::Crossbar::intersect`] with all pairs. Fails with [`EngineError::Machine`] if the card rejects the work.
    pub fn intersect(&mut self) -> Result<Answer, EngineError> {
        let answer = Answer::without_hits(self.rays.rays().len(), self.kernel.name);
        let Some((machine, sheet, units, streams)) = &mut self.work else { return Ok(answer) };
        sheet.clear(machine)?;
        let events = sheet.draw(machine, &self.kernel, units, &[], streams)?;
        let (hits, _) = sheet.read_back(machine, &self.rays, units, true)?;
        Ok(Answer { hits: rounded(hits), events, log: machine.take_log(), ..answer })
    }
}
