//! The only definition of equality: of numbers, pictures, and traces of a program.
//!
//! - [`f32_ulps`]: how far apart two f32 are; it needs no emulator, the others do.
//! - [`Number`]: two patterns are equal if their bits are, where both have the same layout; across layouts if they are
//!   the same number. [`ulps`] is how far apart they are.
//! - [`images`], [`depths`]: two surfaces are equal if every stored bit is; the difference as statistics.
//! - [`first_difference`]: where two traces of one pixel part: the pass, the stage, the instruction, the component.

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
