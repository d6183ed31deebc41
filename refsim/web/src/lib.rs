//! The emulator for a web page: [`answer`] takes a request as JSON and returns the answer as JSON. `exports` makes
//! it callable from WebAssembly without generated code; docs/page.md describes the page.

mod examples;
pub mod exports;
mod request;
mod scene;
#[cfg(feature = "wgsl")]
mod shader;
mod shown;

pub use request::{Device, Request, answer};
pub use scene::SIDE;
#[cfg(feature = "wgsl")]
pub use shader::{ShaderRequest, shader_answer};
