//! The only definition of equality: of numbers, pictures, and traces of a program.
//!
//! - [`f32_ulps`]: distance between two f32 in ULPs; the only function here that needs no emulator.
//! - [`Number`]: two numbers with the same layout are equal if their bits are equal; two numbers with different
//!   layouts, if their values are equal. [`ulps`] is the distance between two numbers.
//! - [`images`], [`depths`]: comparison of every stored bit of two surfaces, with statistics of the difference.
//! - [`first_difference`]: the pass, stage, instruction and component at which two traces of one pixel first differ.

mod single;

#[cfg(feature = "refsim")]
mod number;
#[cfg(feature = "refsim")]
mod operands;
#[cfg(feature = "refsim")]
mod side;
#[cfg(feature = "refsim")]
mod surface;
#[cfg(feature = "refsim")]
mod trace;

#[cfg(feature = "refsim")]
pub use number::{Compared, Number, ulps};
#[cfg(feature = "refsim")]
pub use operands::Operand;
#[cfg(feature = "refsim")]
pub use side::{TraceSide, component};
pub use single::f32_ulps;
pub(crate) use single::shortest;
#[cfg(feature = "refsim")]
pub use surface::{Largest, SurfaceDifference, depths, images};
#[cfg(feature = "refsim")]
pub use trace::{FragmentPass, TargetFormats, TraceDifference, TraceStage, differing_corner, first_difference};
