//! The number library in WGSL: validity of the text, and equality with the reference on an adapter.

#[path = "../common/adapter.rs"]
mod adapter;
#[cfg(feature = "wgpu")]
mod device;
#[cfg(feature = "wgpu")]
#[path = "../common/environment.rs"]
mod environment;
#[cfg(feature = "wgpu")]
mod functions;
#[cfg(feature = "wgpu")]
mod operands;
#[cfg(feature = "wgpu")]
#[path = "../common/random.rs"]
mod random;
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

fn the_library_is_valid_wgsl() {
    validate(&(parts::constants() + &library()));
}

fn main() -> std::process::ExitCode {
    let mut trials = adapter::trials![on_host: the_library_is_valid_wgsl];
    #[cfg(feature = "wgpu")]
    {
        trials.extend(adapter::trials![
            on_adapter: device::every_operation_in_many_formats,
            device::every_pair_of_short_formats,
            device::operands_that_cards_were_given,
            functions::functions_beside_the_switch,
        ]);
    }
    adapter::run(trials)
}
