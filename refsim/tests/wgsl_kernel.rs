//! The texts of the pixel kernel and of the trace kernel are valid modules.

use refsim::exec::wgsl::parts::{self, Parts};
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
fn the_modules_are_valid_with_all_their_parts_and_with_few() {
    let rest = program::machine() + &texture::library();
    let drawn = kernel::text() + program::NO_TRACE + &rest;
    let followed = follow::text() + &rest;
    for (text, entry, size) in [(&drawn, kernel::ENTRY, kernel::INVOCATIONS), (&followed, follow::ENTRY, 1)] {
        is_valid(&(parts::constants() + text), entry, size);
        let all = Parts::all().of(text, entry);
        is_valid(&all, entry, size);
        for feature in
            ["HAS_FLOAT_TARGETS", "HAS_INTEGER_BLENDING", "HAS_CUBES", "HAS_SUSPENSION", "HAS_FIXED", "VM_DOT"]
        {
            let mut few = Parts::default();
            few.add(feature);
            let few = few.of(text, entry);
            is_valid(&few, entry, size);
            assert!(few.len() < all.len() * 2 / 3, "{entry} with {feature}");
        }
    }
}
