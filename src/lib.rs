//! Crossbar.
