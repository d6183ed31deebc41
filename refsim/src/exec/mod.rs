//! Executors of checked programs. They compute the same bits by different means.
//!
//! - [`scalar`] is the reference: it processes one value at a time in integer arithmetic, and follows the Direct3D
//!   shader reference.
//! - [`batch`] processes tiles with the host's SIMD instructions.
//! - [`wgsl`] generates shaders, which `gpu` runs on a GPU of the host.
//!
//! `batch` and `wgsl` start from `lower`, which translates a program to a graph of values.
//!
//! `tests/agree` compares the executors. They share no arithmetic, only the jump targets ([`FlowMap`]), register
//! contents of constants ([`ResolvedConstants`]), bindings, parameters of a draw ([`TileDraw`]), and result types
//! ([`FragmentResult`], [`Shading`]).

pub mod batch;
mod bindings;
pub(crate) mod budget;
mod constants;
mod flow;
mod fragment;
#[cfg(feature = "wgpu")]
pub mod gpu;
mod lower;
mod observer;
mod result;
pub mod scalar;
mod state;
mod tile;
mod trace;
mod usage;
pub mod wgsl;

pub use bindings::{BUMP_STAGES, BumpStage, PixelBindings, Projection, SamplerBinding};
pub use budget::Overrun;
pub use constants::{Constants, ResolvedConstants, delivered_color, unorm_steps};
pub use flow::FlowMap;
pub use fragment::FragmentFormats;
pub use observer::{NoObserver, Observer, Step, TextureRead, Trace};
pub use result::{DepthValue, FragmentResult};
pub use state::{FixedFunctionState, FogState, LightState, MaterialState, MatrixRows};
pub use tile::{TILE, TileDraw};
pub use trace::Shading;
pub use usage::{colors_written, inputs_read};

use crate::check::Checked;
use crate::isa::Program;

/// A program that passed the checker. Executors accept only checked programs.
///
/// It may run on a device for which it was not checked: only the checker enforces limits, and executors support every
/// register that a version can name.
pub type CheckedProgram = Checked<Program>;

pub(crate) fn program(checked: &CheckedProgram) -> &Program {
    checked
}
