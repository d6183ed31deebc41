//! The only definition of equality: of numbers, pictures, and traces of a program.
//!
//! - [`f32_ulps`]: how far apart two f32 are; it needs no emulator, the others do.
//! - [`Number`]: two patterns are equal if their bits are, where both have the same layout; across layouts if they are
//!   the same number. [`ulps`] is how far apart they are.
//! - [`images`], [`depths`]: two surfaces are equal if every stored bit is; the difference as statistics.
//! - [`first_difference`]: where two traces of one pixel part: the pass, the stage, the instruction, the component.

mod single;

#[cfg(feature = "systems")]
mod number;
#[cfg(feature = "systems")]
mod operands;
#[cfg(feature = "systems")]
mod side;
#[cfg(feature = "systems")]
mod surface;
#[cfg(feature = "systems")]
mod trace;

#[cfg(feature = "systems")]
pub use number::{Compared, Number, ulps};
#[cfg(feature = "systems")]
pub use operands::Operand;
#[cfg(feature = "systems")]
pub use side::{TraceSide, component};
pub use single::f32_ulps;
#[cfg(feature = "systems")]
pub use surface::{Largest, SurfaceDifference, depths, images};
#[cfg(feature = "systems")]
pub use trace::{FragmentPass, TargetFormats, TraceDifference, TraceStage, differing_corner, first_difference};
