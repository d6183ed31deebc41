//! Executors of checked programs, which compute the same bits by different means.
//!
//! - [`scalar`] is the reference: one value at a time, integers alone, readable beside the Direct3D shader reference.
//! - [`batch`] runs whole tiles in vector code of the host; [`wgsl`] writes shaders, which `gpu` runs on a GPU of the
//!   host. Both start from `lower`: a program as a graph of values.
//!
//! `tests/agree` holds them together. What they all share is no arithmetic: the jump structure ([`FlowMap`]), constants
//! as registers hold them ([`ResolvedConstants`]), bindings, what the machine says of a draw ([`TileDraw`]), and what
//! is reported of a fragment ([`FragmentResult`], [`Shading`]).

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
pub use tile::{TILE, TileDraw, output_rules};
pub use trace::{PixelTracer, Shading};
pub use usage::{colors_written, inputs_read};

use crate::check::Checked;
use crate::device::Rules;
use crate::isa::Program;
use crate::texture::SampleRules;

/// A program that the checker has passed. Executors take no other.
///
/// It may run on another device than the one it was checked for: limits are the checker's business, and executors hold
/// whatever any version can name.
pub type CheckedProgram = Checked<Program>;

/// The program within.
pub(crate) fn program(checked: &CheckedProgram) -> &Program {
    checked
}

/// What a device says about sampling, out of its rules.
pub fn sample_rules(rules: &Rules) -> SampleRules {
    SampleRules {
        format: rules.format,
        filter_fraction_bits: rules.filter_fraction_bits,
        lod_fraction_bits: rules.lod_fraction_bits,
        signed_texel_minimum: rules.signed_texel_minimum,
    }
}
