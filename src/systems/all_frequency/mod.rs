//! System 5: all-frequency transfer for glossy objects (Liu, Sloan, Shum and Snyder 2004).
//!
//! - [`paper`]: equation 1 by plain loops, without compression; read it first;
//! - [`factor`]: reflectance as a sum of products of a function of view and a function of light (section 3);
//! - [`Reflectance`]: such factors, or the exact term of a diffuse surface;
//! - [`transfer`]: matrices of vertices (section 4), over the light texels of [`grid`](crate::transfer::grid);
//! - [`compressed`]: each lighting segment's transfer as clusters of linear combinations (section 5);
//! - [`mod@file`]: compressed transfer in `.npz` files;
//! - [`code`]: compressed transfer as integers of a few bits, without the zeros of representatives (section 4);
//! - [`shade`]: transferred radiance from coded transfer and light (section 6);
//! - [`kernels`], [`on_card`]: transferred radiance drawn by vertex and pixel programs (section 6);
//! - [`baselines`]: the methods to which Figure 1 compares.

pub mod baselines;
pub mod code;
pub mod compressed;
pub mod factor;
pub mod file;
pub mod kernels;
pub mod on_card;
pub mod paper;
mod reflectance;
pub mod shade;
pub mod transfer;

pub use reflectance::Reflectance;
