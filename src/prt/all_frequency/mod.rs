//! System 5: all-frequency transfer for glossy objects (Liu, Sloan, Shum, Snyder 2004).
//!
//! - [`factor`]: reflectance as a sum of products of a function of view and a function of light.

pub mod factor;
