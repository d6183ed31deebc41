//! Baselines of compressed transfer on the host: matrices without compression, and the method that they replaced.
//!
//! - [`UncompressedTransfer`]: M_p l per vertex and frame, for 25 x 25, 24 x 25 and 16 x 25 matrices, and t_p . l for
//!   diffuse transfer;
//! - [`ViewMap`]: radiance towards an eye from maps over the view direction, of y(v) for exit radiance, or of y(v) B
//!   for transferred incident radiance (Kautz, Sloan and Snyder 2002).
//!
//! Vector quantisation and principal components alone are options of
//! [`compress`](crate::transfer::clustering::compress): no vectors, or one cluster.

mod uncompressed;
mod view_map;

pub use uncompressed::{ExitCoefficients, UncompressedTransfer};
pub use view_map::ViewMap;
