//! Passes on their way through the card.

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

/// A pass that was given to the card.
#[derive(Debug)]
pub(super) struct PassInFlight {
    /// Its rays.
    pub(super) waiting: Vec<Waiting>,
    /// What they hit. The emulator knows at once; the host must not look before it has taken the pass.
    pub(super) hits: Vec<Option<CardHit>>,
    /// The fence behind its read-back, if no one has waited for it.
    fence: Option<FenceId>,
    /// Its textures and targets.
    sheet: usize,
}

/// The card, and what it has been given.
#[derive(Debug)]
pub(super) struct Passes {
    card: PassCard,
    readback: Readback,
    flying: VecDeque<PassInFlight>,
    /// Textures and targets that no pass in flight uses, the one not used longest first.
    free: VecDeque<usize>,
    /// How many there are.
    sheets: usize,
}

impl Passes {
    /// A card; textures and targets are made when a pass finds none free.
    pub(super) fn new(mut card: PassCard, readback: Readback, record: bool) -> Self {
        card.record(record && readback != Readback::InfinitelyFast);
        Self { card, readback, flying: VecDeque::new(), free: VecDeque::new(), sheets: 0 }
    }

    /// Passes that stay in flight while the host goes on.
    fn ahead(&self) -> usize {
        match self.readback {
            Readback::Asynchronous { passes } => passes.max(1),
            Readback::Synchronous | Readback::InfinitelyFast => 0,
        }
    }

    /// Whether more are in flight than are to be.
    pub(super) fn too_many(&self) -> bool {
        self.flying.len() > self.ahead()
    }

    /// Gives a pass to the card; `rays` are those that wait. How many of the triangles were on the screen.
    pub(super) fn issue(
        &mut self,
        mesh: &Mesh,
        triangles: &[u32],
        mut rays: Vec<Ray>,
        waiting: Vec<Waiting>,
    ) -> Result<u64, EngineError> {
        let width = rays.len().div_ceil(ROWS);
        // The last ray fills what is left of the rectangle.
        if let Some(last) = rays.last().copied() {
            rays.resize(width * ROWS, last);
        }
        let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        let batch = RayBatch::new(side(width), side(ROWS), rays)?;
        let sheet = self.free.pop_front().unwrap_or(self.sheets);
        self.sheets = self.sheets.max(sheet + 1);
        let drawn = self.card.draw(sheet, mesh, triangles, &batch)?;
        let wait = !matches!(self.readback, Readback::Asynchronous { .. });
        let (hits, fence) = self.card.read_back(&drawn, triangles, &batch, wait)?;
        self.flying.push_back(PassInFlight { waiting, hits, fence, sheet });
        // A quad covers the screen or nothing.
        Ok((drawn.events.fragments.generated / batch.rays().len().max(1) as u64).min(triangles.len() as u64))
    }

    /// The oldest pass in flight, waited for.
    pub(super) fn take(&mut self) -> Option<PassInFlight> {
        let pass = self.flying.pop_front()?;
        if let Some(fence) = pass.fence {
            self.card.finish(fence);
        }
        self.free.push_back(pass.sheet);
        Some(pass)
    }

    /// What was asked of the card since the last time.
    pub(super) fn take_log(&mut self) -> Vec<Event> {
        self.card.take_log()
    }
}
