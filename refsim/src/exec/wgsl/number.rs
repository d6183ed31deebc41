//! Arithmetic in WGSL: the text of the library and the words by which a shader is told a format.
//!
//! The definition is [`crate::num`]: the exact result, rounded once. The text computes with integers of 32 bits alone,
//! for every format, so its results are the same on every device that conforms to WGSL, whatever the device's own
//! floating point does. [`NumberMode::Native`] replaces single precision operations by the device's own where a probe
//! has found them exact.

use bitflags::bitflags;
use serde::{Deserialize, Serialize};

/// How a shader computes in single precision.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NumberMode {
    /// Integers alone: the same bits on every conforming device.
    #[default]
    Integer,
    /// The device's `f32` where [`NativeOperations`] says so; every other format as in integer mode.
    Native,
}

bitflags! {
    /// Single precision operations that a device's own `f32` carries out.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub struct NativeOperations: u32 {
        /// Addition and subtraction.
        const ADD = 1;
        /// Multiplication.
        const MUL = 2;
        /// Product and sum, each rounded (`a * b + c` that the compiler doesn't contract).
        const MUL_ADD = 4;
        /// Division and reciprocal.
        const DIV = 8;
        /// Square root.
        const SQRT = 16;
        /// From 32-bit integers.
        const CONVERT = 32;
        /// Minimum, maximum and comparisons.
        const MIN_MAX = 64;
        /// Floor.
        const FLOOR = 128;
    }
}
