//! Integration tests of the studies, and of the rooms below them, through what the library offers.

mod case;
mod kept;
mod options;
mod report;
mod study;
