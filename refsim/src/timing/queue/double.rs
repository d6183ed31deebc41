//! Double buffers: write into one copy while the card still reads the other.

use super::ResourceId;

/// A texture or target with two copies. What overwrites all of it goes into the copy that was not used last, so that it
/// need not wait for draws that read the other one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DoubleBuffer {
    copies: [ResourceId; 2],
    current: usize,
}

impl DoubleBuffer {
    /// Of two resources; the first is current.
    pub const fn new(first: ResourceId, second: ResourceId) -> Self {
        Self { copies: [first, second], current: 0 }
    }

    /// The copy that draws read and write.
    pub const fn current(&self) -> ResourceId {
        self.copies[self.current]
    }

    /// Makes the other copy current, and returns it: the one to overwrite.
    pub const fn flip(&mut self) -> ResourceId {
        self.current = 1 - self.current;
        self.copies[self.current]
    }
}
