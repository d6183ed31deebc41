//! Rays on the host.

mod octree;
