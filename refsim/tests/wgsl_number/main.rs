//! The number library in WGSL: validity of the text, and equality with the reference on an adapter.

#[path = "../common/adapter.rs"]
mod adapter;
mod device;
#[path = "../common/environment.rs"]
mod environment;
mod functions;
mod operands;
#[path = "../common/random.rs"]
mod random;
mod reference;
#[path = "../common/valid_wgsl.rs"]
mod valid_wgsl;

use refsim::exec::wgsl::{number::library, parts};

fn the_library_is_valid_wgsl() {
    valid_wgsl::valid(&(parts::constants() + &library()));
}

fn main() -> std::process::ExitCode {
    let mut trials = adapter::trials![on_host: the_library_is_valid_wgsl];
    trials.extend(adapter::trials![
        on_adapter: device::every_operation_in_many_formats,
        device::every_pair_of_short_formats,
        device::operands_that_cards_were_given,
        functions::functions_beside_the_switch,
    ]);
    adapter::run(trials)
}
