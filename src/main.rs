//! The `crossbar` program.
fn main() {}
