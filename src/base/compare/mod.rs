//! The only definition of equality: of numbers, pictures, and traces of a program. Only [`f32_ulps`] needs no emulator.

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
