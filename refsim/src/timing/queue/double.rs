//! Double buffering: the host or card writes one copy while the card still reads the other.

use super::ResourceId;

/// A texture or target with two copies. An operation that overwrites the whole resource writes the copy not used last,
/// so that it need not wait for draws that read the other one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DoubleBuffer {
    copies: [ResourceId; 2],
    current: usize,
}

impl DoubleBuffer {
    /// Creates a double buffer of two resources; the first is current.
    pub const fn new(first: ResourceId, second: ResourceId) -> Self {
        Self { copies: [first, second], current: 0 }
    }

    /// The copy that draws read and write.
    pub const fn current(&self) -> ResourceId {
        self.copies[self.current]
    }

    /// Makes the other copy current and returns it, for overwriting.
    pub const fn flip(&mut self) -> ResourceId {
        self.current = 1 - self.current;
        self.copies[self.current]
    }
}
