//! Modules around programs.

use refsim::exec::wgsl::number::{NativeOperations, NumberMode, library};
use refsim::exec::wgsl::{INTERFACE, program};

/// A texture that is none.
const BLANK: &str = include_str!("blank.wgsl");

/// A pixel module of a program text.
pub(crate) fn pixel(mode: NumberMode, shade: &str) -> String {
    let numbers = library(mode, NativeOperations::all());
    [&numbers, INTERFACE, BLANK, program::NO_OUTPUT, program::NO_TRACE, shade].concat()
}

/// Where a followed lane's words go in [`followed`].
const TRACE: &str = "fn trace_put(at: u32, word: u32) {\n    atomicStore(&counts[at + 1u], word);\n}\n";

/// A pixel module that puts down what the followed lane does, from word 1 of `counts` on.
pub(crate) fn followed(mode: NumberMode, shade: &str) -> String {
    pixel(mode, shade).replace(program::NO_TRACE, TRACE)
}

/// The module of all vertex programs.
pub(crate) fn vertex(mode: NumberMode, shade: &str) -> String {
    [&library(mode, NativeOperations::all()), program::vertex_kernel(), shade].concat()
}

/// Parses and validates.
pub(crate) fn validate(text: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    validator.validate(&module).map(|_| ()).map_err(|e| e.emit_to_string(text))
}

/// A pixel module that reads textures.
pub(crate) fn textured(mode: NumberMode, shade: &str) -> String {
    pixel(mode, shade).replace(BLANK, &refsim::exec::wgsl::texture::library())
}
