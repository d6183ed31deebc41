//! The log of a machine, and the observer of its texel reads.

use super::TextureId;
use super::state::DrawState;
use crate::event::{Event, TexelObserver};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// The log, and the state of the last draw to compare the next one with.
#[derive(Debug, Default)]
pub(super) struct Recorder {
    pub(super) on: bool,
    /// Read-backs log through a shared machine.
    pub(super) log: Mutex<Log>,
    /// Told of every texel that is read, if set.
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

    /// Writes an event down, if the machine records.
    pub(super) fn push(&self, event: impl FnOnce() -> Event) {
        self.with(|log| log.events.push(event()));
    }

    /// Whether the machine records.
    pub(super) fn is_on(&self) -> bool {
        self.on
    }
}

/// What textures in memory start at multiples of.
const ALIGNMENT: u64 = 4096;

/// Where the card keeps its textures, as far as that is known: in the order in which draws first read them.
#[derive(Debug, Default)]
pub(super) struct Addresses {
    first: BTreeMap<TextureId, u64>,
    free: u64,
}

impl Addresses {
    /// The first byte of a texture of `size` bytes.
    pub(super) fn of(&mut self, texture: TextureId, size: u64) -> u64 {
        *self.first.entry(texture).or_insert_with(|| {
            let at = self.free;
            self.free = (at + size).next_multiple_of(ALIGNMENT);
            at
        })
    }
}
