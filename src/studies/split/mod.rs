//! Runs of a command divided into parts, which may be computed on different machines.
//!
//! A command reaches its independent items (vertices, segments, rows) in one place, [`SplitRun::compute`]. An ordinary
//! run computes all of them there. A part computes a range and writes it to a file, with a [`PartHeader`] that
//! identifies the run. A merge reads the parts of a [`PartSet`] instead of computing, and then continues like an
//! ordinary run. So a merge writes the same bytes as one run. docs/decisions/0031-parts-of-a-run.md explains this.
//!
//! [`KeptResults`] stores the results of work that may be interrupted and continued, in files of the same layout.

mod file;
mod kept;
mod number;
mod run;
mod set;

pub use file::{PartHeader, SplitCommand, not_utf8, unreadable};
pub use kept::{KeptResults, SpentTime};
pub use number::PartNumber;
pub use run::{Computed, Concatenate, SplitRun, WrittenPart};
pub use set::PartSet;
