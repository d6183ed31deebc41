//! Modules around programs.

use refsim::exec::wgsl::{INTERFACE, program};

/// Arithmetic that is none: for texts that are only looked at.
const HOLLOW: &str = include_str!("hollow.wgsl");
/// A texture that is none.
const BLANK: &str = include_str!("blank.wgsl");

/// A pixel module of a program text.
pub(crate) fn pixel(shade: &str) -> String {
    [HOLLOW, INTERFACE, BLANK, program::NO_OUTPUT, program::NO_TRACE, shade].concat()
}

/// The module of all vertex programs.
pub(crate) fn vertex(shade: &str) -> String {
    [HOLLOW, program::vertex_kernel(), shade].concat()
}

/// Parses and validates.
pub(crate) fn validate(text: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    validator.validate(&module).map(|_| ()).map_err(|e| e.emit_to_string(text))
}
