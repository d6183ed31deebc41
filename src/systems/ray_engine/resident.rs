//! A crossbar whose rays and triangles are resident on the card, for repeated draws without uploads.

use refsim::event::DrawEvents;

use super::card::{Card, Streams};
use super::{Answer, EngineError, RayBatch};

/// A card with rays in its textures and triangles in its vertex memory. [`super::Crossbar::make_resident`] makes one.
#[derive(Debug)]
pub struct ResidentCrossbar {
    /// `None` if there are no rays or no triangles.
    work: Option<(Card, Streams)>,
    rays: RayBatch,
    kernel: &'static str,
}

impl ResidentCrossbar {
    pub(super) fn new(card: Card, streams: Streams, rays: RayBatch, kernel: &'static str) -> Self {
        Self { work: Some((card, streams)), rays, kernel }
    }

    /// Creates a resident crossbar without work.
    pub(super) fn idle(rays: RayBatch, kernel: &'static str) -> Self {
        Self { work: None, rays, kernel }
    }

    /// Clears the targets, draws every triangle over every ray, and reads back: the result of
    /// [`super::Crossbar::intersect`] with all pairs.
    ///
    /// # Errors
    /// [`EngineError::Machine`] if the card refuses the work.
    pub fn intersect(&mut self) -> Result<Answer, EngineError> {
        let kernel = self.kernel;
        let Some((card, streams)) = &mut self.work else {
            let hits = vec![None; self.rays.rays().len()];
            return Ok(Answer { hits, events: DrawEvents::default(), kernel, log: Vec::new() });
        };
        card.clear()?;
        let events = card.draw(streams)?;
        Ok(Answer { hits: card.read_back(&self.rays)?, events, kernel, log: card.take_log() })
    }
}
