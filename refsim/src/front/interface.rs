//! Result of translating a fragment shader in WGSL: its program, operations and inputs.

use super::half::WgslOperation;
use crate::isa::Program;

/// A shader's program, the operations in its text, and its inputs and uniforms.
pub(super) struct Translation {
    pub(super) program: Program,
    pub(super) operations: Vec<WgslOperation>,
    pub(super) interface: WgslInterface,
}

/// Inputs and uniforms of a fragment entry point, for a host that runs the WGSL text on a GPU.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WgslInterface {
    /// Name of the entry point.
    pub entry: String,
    /// Inputs with a location.
    pub inputs: Vec<WgslInput>,
    /// Uniforms of floats, one for each parameter of the program and in its order.
    pub uniforms: Vec<WgslUniform>,
}

/// An input of an entry point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WgslInput {
    /// Number of its `@location`.
    pub location: u32,
    /// Number of its components, 1 to 4.
    pub width: usize,
    /// `true` for f16.
    pub half: bool,
}

/// A scalar, a vector, or a column of a matrix in uniform memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WgslUniform {
    /// Numbers of `@group` and `@binding`.
    pub binding: [u32; 2],
    /// Size of the variable of this binding, in bytes.
    pub size: u32,
    /// Place in that variable, in bytes.
    pub offset: u32,
    /// `true` for f16.
    pub half: bool,
}
