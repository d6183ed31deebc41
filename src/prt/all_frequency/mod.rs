//! System 5: all-frequency transfer for glossy objects (Liu, Sloan, Shum and Snyder 2004).
//!
//! - [`compressed`]: each lighting segment's transfer by clusters of linear combinations (section 5);
//! - [`code`]: that as integers of a few bits, representatives without their zeros (section 4);
//! - [`shade`]: transferred radiance from coded transfer and light (section 6).

pub mod code;
pub mod compressed;
pub mod shade;
