//! The log of a machine, and the observer of its texel reads.

use super::TextureId;
use super::state::DrawState;
use crate::event::{Event, TexelObserver};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The log, and the state of the last draw, which is kept to detect changes.
#[derive(Debug, Default)]
pub(super) struct Recorder {
    pub(super) on: bool,
    /// In a mutex, because read-backs write to the log through a shared reference.
    pub(super) log: Mutex<Log>,
    /// Observer of texel reads, if set.
    pub(super) observer: Option<Box<dyn TexelObserver>>,
    pub(super) addresses: Addresses,
}

#[derive(Debug, Default)]
pub(super) struct Log {
    pub(super) events: Vec<Event>,
    pub(super) state: Option<DrawState>,
    pub(super) fences: u32,
}

impl Recorder {
    pub(super) fn with<T>(&self, work: impl FnOnce(&mut Log) -> T) -> Option<T> {
        self.on.then(|| work(&mut self.log.lock().unwrap_or_else(PoisonError::into_inner)))
    }

    /// Appends an event if recording is on.
    pub(super) fn push(&self, event: impl FnOnce() -> Event) {
        self.with(|log| log.events.push(event()));
    }

    pub(super) fn is_on(&self) -> bool {
        self.on
    }
}

/// Alignment of textures in the card's memory, in bytes.
const ALIGNMENT: u64 = 4096;

/// Assumed addresses of textures in the card's memory, in the order in which draws first read them.
#[derive(Debug, Default)]
pub(super) struct Addresses {
    first: BTreeMap<TextureId, u64>,
    free: u64,
}

impl Addresses {
    /// Address of a texture of `size` bytes.
    pub(super) fn of(&mut self, texture: TextureId, size: u64) -> u64 {
        *self.first.entry(texture).or_insert_with(|| {
            let at = self.free;
            self.free = (at + size).next_multiple_of(ALIGNMENT);
            at
        })
    }
}
