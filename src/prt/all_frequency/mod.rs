//! System 5: all-frequency transfer for glossy objects (Liu, Sloan, Shum, Snyder 2004).

pub mod grid;
pub mod haar;
pub mod hats;
pub mod light;
pub mod reference;
pub mod transfer;
pub mod visibility;
