//! Passes in flight on the card.

use std::collections::VecDeque;

use refsim::event::{Event, FenceId};

use super::Readback;
use super::flight::Waiting;
use crate::geom::{Mesh, Ray};
use crate::ray_engine::card::CardHit;
use crate::ray_engine::pass::PassCard;
use crate::ray_engine::{EngineError, RayBatch};

/// Rows of a pass's textures (section 5.3: 64 x 4).
const ROWS: usize = 4;

#[derive(Debug)]
pub(super) struct PassInFlight {
    /// Rays of the pass.
    pub(super) waiting: Vec<Waiting>,
    /// Hits of the rays. The emulator knows them at once; the host must not use them before it takes them.
    pub(super) hits: Vec<Option<CardHit>>,
    /// Fence after the read-back; `None` if the host has already waited for it.
    fence: Option<FenceId>,
    sheet: usize,
}

/// Card with its passes in flight.
#[derive(Debug)]
pub(super) struct Passes {
    card: PassCard,
    readback: Readback,
    flying: VecDeque<PassInFlight>,
    /// Sets of textures and targets that no pass in flight uses, least recently used first.
    free: VecDeque<usize>,
    sheets: usize,
}

impl Passes {
    /// Creates the queue of passes of a card. A pass that finds no free set of textures and targets creates one.
    pub(super) fn new(mut card: PassCard, readback: Readback, record: bool) -> Self {
        card.machine.record(record && readback != Readback::InfinitelyFast);
        Self { card, readback, flying: VecDeque::new(), free: VecDeque::new(), sheets: 0 }
    }

    /// Maximum number of passes in flight while the host continues.
    fn ahead(&self) -> usize {
        match self.readback {
            Readback::Asynchronous { passes } => passes.max(1),
            Readback::Synchronous | Readback::InfinitelyFast => 0,
        }
    }

    /// Returns `true` if more passes are in flight than the read-back mode allows.
    pub(super) fn too_many(&self) -> bool {
        self.flying.len() > self.ahead()
    }

    /// Gives a pass to the card; `waiting` are the cache's rays. Returns the number of triangles that were not culled.
    pub(super) fn issue(
        &mut self,
        mesh: &Mesh,
        triangles: &[u32],
        mut rays: Vec<Ray>,
        waiting: Vec<Waiting>,
    ) -> Result<u64, EngineError> {
        let width = rays.len().div_ceil(ROWS);
        // Pads the rectangle with the last ray.
        if let Some(last) = rays.last().copied() {
            rays.resize(width * ROWS, last);
        }
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let batch = RayBatch::new(side(width), side(ROWS), rays)?;
        let sheet = self.free.pop_front().unwrap_or(self.sheets);
        self.sheets = self.sheets.max(sheet + 1);
        let wait = !matches!(self.readback, Readback::Asynchronous { .. });
        let ((hits, fence), events) = self.card.test(sheet, mesh, triangles, &batch, wait)?;
        self.flying.push_back(PassInFlight { waiting, hits, fence, sheet });
        // A quad covers the whole screen or no pixel.
        Ok((events.fragments.generated / batch.rays().len().max(1) as u64).min(triangles.len() as u64))
    }

    /// Waits for the oldest pass in flight and removes it.
    pub(super) fn take(&mut self) -> Option<PassInFlight> {
        let pass = self.flying.pop_front()?;
        if let Some(fence) = pass.fence {
            self.card.machine.finish_fence(fence);
        }
        self.free.push_back(pass.sheet);
        Some(pass)
    }

    pub(super) fn take_log(&mut self) -> Vec<Event> {
        self.card.machine.take_log()
    }
}
