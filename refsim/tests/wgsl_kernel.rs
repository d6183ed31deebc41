//! The texts of the pixel kernel and of the one that follows pixels are valid modules, with a program in both number
//! modes.

use refsim::exec::wgsl::number::{NativeOperations, NumberMode, library};
use refsim::exec::wgsl::{follow, kernel, program, texture};

fn is_valid(text: &str, entry: &str, size: usize) {
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(text)));
    let found = module.entry_points.iter().find(|e| e.name == entry);
    assert_eq!(found.map(|e| e.workgroup_size), Some([size as u32, 1, 1]), "{entry}");
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    if let Err(e) = validator.validate(&module) {
        panic!("{entry}: {}", e.emit_to_string(text));
    }
}

#[test]
fn the_modules_of_all_programs_are_valid() {
    for mode in [NumberMode::Integer, NumberMode::Native] {
        let library = library(mode, NativeOperations::all());
        let rest = [program::machine(), program::NO_OUTPUT, &texture::library()].concat();
        let drawn = kernel::text(&library) + program::NO_TRACE + &rest;
        is_valid(&drawn, kernel::ENTRY, kernel::INVOCATIONS);
        is_valid(&(follow::text(&library) + &rest), follow::ENTRY, 1);
    }
}
