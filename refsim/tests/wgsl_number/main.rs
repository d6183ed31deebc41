//! The arithmetic library in WGSL: valid text, and on an adapter the reference's bits.

#![cfg_attr(
    feature = "wgpu",
    expect(clippy::print_stdout, reason = "says what was tried, and that there is no adapter")
)]

#[cfg(feature = "wgpu")]
mod device;
#[cfg(feature = "wgpu")]
mod functions;
#[cfg(feature = "wgpu")]
mod operands;
#[cfg(feature = "wgpu")]
mod probe;
#[cfg(feature = "wgpu")]
mod reference;

use refsim::exec::wgsl::{number::library, parts};

/// Parses and validates a module; the message names what naga found.
fn validate(text: &str) {
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
}

#[test]
fn the_library_is_valid_wgsl() {
    validate(&(parts::constants() + &library()));
}
