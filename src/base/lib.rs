//! The lowest modules of Crossbar: meshes and rays, exact hits, elementary functions with the same bits everywhere, the
//! definition of equality, the error of every module, and the oracle for other people's hits. `crossbar` re-exports
//! them.

pub mod compare;
pub mod elementary;
pub mod error;
pub mod geom;
pub mod oracle;
