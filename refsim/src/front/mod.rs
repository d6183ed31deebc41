//! Front ends: translate programs in today's languages for ideal devices. docs/wgsl.md describes the translation of
//! each WGSL construct.

#[cfg_attr(not(feature = "wgsl"), expect(dead_code, reason = "operations are found by the translation"))]
mod half;
mod interface;
mod refusal;
#[cfg(feature = "wgsl")]
mod wgsl;

pub use half::WgslOperation;
pub use interface::{WgslInput, WgslInterface, WgslUniform};
pub use refusal::Refusal;

use crate::isa::Program;
use interface::Translation;

/// Translates the fragment entry point of a WGSL module into an `!!FP1.0` program whose spans refer to the WGSL text.
/// Uniforms become the program's parameters, `u.color` for example; texture `n` of the text, from 0, becomes image unit
/// `n`.
///
/// # Errors
/// If the text is not WGSL, or uses a construct without translation; the error has the position. Always, if the feature
/// `wgsl` is off.
pub fn translate_wgsl(text: &str) -> Result<Program, Refusal> {
    Ok(translated(text)?.program)
}

/// The operations on f32 that the fragment entry point executes, in the order of their spans.
///
/// # Errors
/// As [`translate_wgsl`].
pub fn wgsl_operations(text: &str) -> Result<Vec<WgslOperation>, Refusal> {
    Ok(translated(text)?.operations)
}

/// As [`translate_wgsl`]; also returns the inputs and uniforms that a GPU needs to draw the same text.
///
/// # Errors
/// As [`translate_wgsl`].
pub fn wgsl_with_interface(text: &str) -> Result<(Program, WgslInterface), Refusal> {
    translated(text).map(|found| (found.program, found.interface))
}

#[cfg(feature = "wgsl")]
fn translated(text: &str) -> Result<Translation, Refusal> {
    wgsl::translate(text)
}

#[cfg(not(feature = "wgsl"))]
fn translated(_text: &str) -> Result<Translation, Refusal> {
    Err(Refusal::new("reading WGSL shaders needs the feature `wgsl`, which is off", Default::default())
        .with_help("build with it: cargo build --release --features wgsl"))
}
