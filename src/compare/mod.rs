//! The one place that says "equal": numbers, pictures, and what two runs of one program did.
//!
//! - [`f32_ulps`]: how far apart two f32 are.
//! - [`Number`]: two patterns are equal if their bits are, where both have the same layout; across layouts if they are
//!   the same number. [`ulps`] is how far apart they are.
//! - [`images`], [`depths`]: two surfaces are equal if every stored bit is; the difference as statistics.
//! - [`first_difference`]: where two traces of one pixel part: the pass, the stage, the instruction, the component.

mod single;

mod number;
mod operands;
mod side;
mod surface;
mod trace;

pub use number::{Compared, Number, ulps};
pub use operands::Operand;
pub use side::{TraceSide, component};
pub use single::f32_ulps;
pub use surface::{Largest, SurfaceDifference, depths, images};
pub use trace::{FragmentPass, TargetFormats, TraceDifference, TraceStage, differing_corner, first_difference};
