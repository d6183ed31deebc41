//! Tests that the pixel kernel and the trace kernel are valid WGSL modules, and how images are packed into words.

#[path = "common/valid_wgsl.rs"]
mod valid_wgsl;

use refsim::exec::wgsl::parts::{self, Parts};
use refsim::exec::wgsl::texture::{image_size, image_words, texel_words, words_to_image};
use refsim::exec::wgsl::{follow, kernel, program, texture};
use refsim::num::Format;
use refsim::texture::{ChannelClass, Image, TexelFormat, TextureError, TextureKind};

fn is_valid(text: &str, entry: &str, size: usize) {
    let module = valid_wgsl::valid(text);
    let found = module.entry_points.iter().find(|e| e.name == entry);
    assert_eq!(found.map(|e| e.workgroup_size), Some([size as u32, 1, 1]), "{entry}");
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

#[test]
fn arms_blocks_and_functions_go_with_their_parts() {
    let text = "const A: u32 = 1u;\nfn low() {\n}\nfn high() { low(); }\nfn cube() {\n    if (HAS_CUBES) {\n        high();\n    }\n}\n\
                @compute @workgroup_size(1)\nfn main() {\n    switch op {\n        case N_EXP2, N_SUB: { cube(); } // both\n        \
                case N_FLOOR: { // one {\n            high();\n        }\n        default: {}\n    }\n}\n";
    let parts = Parts::default();
    let found = parts.of(text, "main");
    assert!(
        found.ends_with(
            "const A: u32 = 1u;\nfn cube() {\n}\n@compute @workgroup_size(1)\nfn main() {\n    switch op {\n\
         case N_SUB: { cube(); } // both\n        default: {}\n    }\n}\n"
        ),
        "{found}"
    );
    assert!(Parts::all().covers(&parts) && !parts.covers(&Parts::all()));
    assert!(Parts::all().of(text, "main").contains("high();"));
}

#[test]
fn channels_are_what_the_text_takes_them_for() {
    for &format in TexelFormat::ALL {
        assert!([1, 2, 4].contains(&texel_words(format)), "{format}");
        for channel in format.record().stored() {
            let (low, high) = (channel.shift / 32, (channel.shift + channel.bits - 1) / 32);
            assert_eq!(low, high, "{format}: a channel crosses a word");
            match channel.class {
                ChannelClass::Float(f) => {
                    assert!([Format::FP16, Format::FP24, Format::FP32].contains(&f), "{format}");
                    assert!(format.record().is_float(), "{format}: floats and ratios in one texel");
                }
                _ => assert!(channel.bits <= 16, "{format}: a ratio of {} bits", channel.bits),
            }
        }
    }
}

#[test]
fn words_are_undone_exactly() -> Result<(), TextureError> {
    for &format in TexelFormat::ALL {
        let mut image = Image::new(format, TextureKind::Volume, [5, 3, 2], 3)?;
        for (i, byte) in image.bytes_mut().iter_mut().enumerate() {
            *byte = (i * 37 + 11) as u8;
        }
        let words = image_words(&image);
        assert_eq!(words.len(), image_size(&image), "{format}");
        assert_eq!(words[0].to_le_bytes()[0], 11, "{format}");
        let mut back = Image::new(format, TextureKind::Volume, [5, 3, 2], 3)?;
        words_to_image(&words, &mut back)?;
        assert_eq!(back, image, "{format}");
        assert!(words_to_image(&words[1..], &mut back).is_err());
    }
    Ok(())
}
