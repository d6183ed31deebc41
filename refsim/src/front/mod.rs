//! Front ends: programs in languages of today, translated for ideal devices. docs/wgsl.md says what each construct of
//! WGSL becomes.

mod refusal;
#[cfg(feature = "wgsl")]
mod wgsl;

pub use refusal::Refusal;

use crate::isa::Program;

/// Translates the fragment entry point of a WGSL module into an `!!FP1.0` program whose places are those of the text.
/// Uniforms become its parameters, `u.color` for example; texture `n` of the text, from 0, becomes image unit `n`.
///
/// # Errors
/// If the text is not WGSL or uses a construct without translation, with the place; always without the feature `wgsl`.
#[cfg(feature = "wgsl")]
pub fn translate_wgsl(text: &str) -> Result<Program, Refusal> {
    wgsl::translate(text)
}

/// Refuses: this build lacks the feature `wgsl`.
///
/// # Errors
/// Always.
#[cfg(not(feature = "wgsl"))]
pub fn translate_wgsl(_text: &str) -> Result<Program, Refusal> {
    Err(Refusal::new("the feature `wgsl` is off, which reads shaders", Default::default())
        .help("build with it: cargo build --release --features wgsl"))
}
