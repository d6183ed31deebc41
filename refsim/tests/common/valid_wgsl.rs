//! Validates WGSL with naga.

use naga::Module;
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// Parses and validates a module; panics with naga's errors.
pub(crate) fn valid(text: &str) -> Module {
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator.validate(&module).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    module
}
