//! System 5: all-frequency transfer for glossy objects (Liu, Sloan, Shum and Snyder 2004).
//!
//! - [`factor`]: reflectance as a sum of products of a function of view and a function of light (section 3);
//! - [`Reflectance`]: these factors, or the exact term of a diffuse surface;
//! - [`grid`], [`haar`], [`hats`]: the cube of light texels, its segments and their bases (sections 4 and 5);
//! - [`light`]: light as coefficients (section 6); [`visibility`], [`transfer`]: matrices of vertices (section 4);
//! - [`compressed`]: each lighting segment's transfer by clusters of linear combinations (section 5);
//! - [`code`]: that as integers of a few bits, representatives without their zeros (section 4);
//! - [`shade`]: transferred radiance from coded transfer and light (section 6);
//! - [`kernels`], [`on_card`]: transferred radiance drawn by vertex and pixel programs (section 6);
//! - [`rivals`]: the methods that Figure 1 compares with;
//! - [`mod@reference`]: all of it by plain loops, without compression.

pub mod code;
pub mod compressed;
pub mod factor;
pub mod grid;
pub mod haar;
pub mod hats;
pub mod kernels;
pub mod light;
pub mod on_card;
pub mod reference;
mod reflectance;
pub mod rivals;
pub mod shade;
pub mod transfer;
pub mod visibility;

pub use reflectance::Reflectance;
