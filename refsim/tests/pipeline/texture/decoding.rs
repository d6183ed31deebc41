//! Decoding of texels.

use refsim::num::Format;
use refsim::texture::{SignedTexelMinimum, TargetRounding, TexelFormat, decode, encode};

#[test]
fn float_texels_come_back_as_they_were_stored() {
    for (texel, format) in [(TexelFormat::R16f, Format::FP16), (TexelFormat::R24f, Format::FP24)] {
        for bits in (0..=format.mask()).step_by(if format.width() > 16 { 101 } else { 1 }) {
            let raw = encode(texel, format, [bits, 0, 0, 0], TargetRounding::Nearest);
            let back = decode(texel, raw, SignedTexelMinimum::Clamp).to_format(format);
            let want = if format.is_nan(bits) { format.canonical_nan().unwrap() } else { bits };
            assert_eq!(back, [want, format.one(), format.one(), format.one()], "{texel} {bits:#x}");
        }
    }
}

#[test]
fn formats_have_names_of_direct3d_too() {
    assert_eq!(TexelFormat::named("D3DFMT_A8R8G8B8"), Some(TexelFormat::Bgra8));
    assert_eq!(TexelFormat::named(""), None);
}
