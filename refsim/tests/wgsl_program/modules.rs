//! Modules that run programs.

use refsim::exec::wgsl::number::library;
use refsim::exec::wgsl::parts::Parts;
use refsim::exec::wgsl::{INTERFACE, program, texture};

/// The entry point of [`RUNS`].
pub(crate) const ENTRY: &str = "run";
const RUNS: &str = include_str!("runs.wgsl");
/// A texture library that reads nothing.
const BLANK: &str = "fn texture_read(number: u32, detail: u32, run: vec4<bool>) {\n}\n";
/// Records the words of a traced lane in [`followed`].
const TRACE: &str = "fn trace_put(at: u32, word: u32) {\n    atomicStore(&counts[at + 1u], word);\n}\n";

fn module(texture: &str, trace: &str) -> String {
    let text = [&library(), INTERFACE, &program::machine(), texture, trace, RUNS].concat();
    Parts::all().of(&text, ENTRY)
}

/// A module that runs pixel programs.
pub(crate) fn pixel() -> String {
    module(BLANK, program::NO_TRACE)
}

/// A module that records the trace of a lane, from word 1 of `counts` on.
pub(crate) fn followed() -> String {
    module(BLANK, TRACE)
}

/// A module that reads textures.
pub(crate) fn textured() -> String {
    module(&texture::library(), program::NO_TRACE)
}

/// Parses and validates.
pub(crate) fn validate(text: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    validator.validate(&module).map(|_| ()).map_err(|e| e.emit_to_string(text))
}
