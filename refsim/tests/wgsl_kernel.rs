//! The text of the pixel kernel is a valid module, with a program in both number modes.

use refsim::exec::wgsl::number::{NativeOperations, NumberMode, library};
use refsim::exec::wgsl::{kernel, program, texture};

#[test]
fn the_module_of_all_programs_is_valid() {
    for mode in [NumberMode::Integer, NumberMode::Native] {
        let parts = [
            &kernel::text(&library(mode, NativeOperations::all())),
            program::machine(),
            program::NO_OUTPUT,
            program::NO_TRACE,
            &texture::library(),
        ];
        let text = parts.concat();
        let module = naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        let entry = module.entry_points.iter().find(|e| e.name == kernel::ENTRY);
        assert_eq!(entry.map(|e| e.workgroup_size), Some([kernel::INVOCATIONS as u32, 1, 1]));
        let flags = naga::valid::ValidationFlags::all();
        let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
        if let Err(e) = validator.validate(&module) {
            panic!("{mode:?}: {}", e.emit_to_string(&text));
        }
    }
}
