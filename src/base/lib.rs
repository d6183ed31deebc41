//! The lowest modules of Crossbar: meshes and rays, exact hits, elementary functions with the same bits everywhere, the
//! definition of equality, the common error type, and the oracle for other intersectors' hits. `crossbar` re-exports
//! them.

pub mod compare;
pub mod elementary;
pub mod error;
pub mod geom;
pub mod oracle;
