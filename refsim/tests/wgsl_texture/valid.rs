//! Tests that the text is valid WGSL, without a GPU.

use super::module;

pub(crate) fn modules_are_valid() {
    for text in [module::reading(), module::decoding()] {
        let parsed = naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
        let mut validator =
            naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
        validator.validate(&parsed).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&text)));
    }
}
