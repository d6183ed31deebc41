//! Targets with mip levels, and generated levels.

use refsim::device::Profile;
use refsim::event::{Event, MipmapLevel, MipmapRecord, ResourceId};
use refsim::exec::Constants;
use refsim::machine::{ExecutorKind, Machine, MachineError};
use refsim::texture::{Image, TexelFormat, TextureKind};

use super::{COLOR, quads, screen};
use crate::running::{bits, checked, ideal};

fn nv35() -> Machine {
    Machine::new(Profile::named("nv35").unwrap(), ExecutorKind::Scalar)
}

fn image(format: TexelFormat, kind: TextureKind, extents: [u32; 3], levels: u32) -> Image {
    Image::new(format, kind, extents, levels).unwrap()
}

#[test]
fn what_is_drawn_into_level_0_reaches_the_others() {
    let mut machine = nv35();
    let program = checked(COLOR, machine.profile());
    let map = machine.create_target_with_levels(TexelFormat::Bgra8, 5, 2, 3).unwrap();
    let (vertices, host) = (screen(8), Constants::default());
    machine.draw(&quads(&vertices, &program, &host, map)).unwrap();
    let before = machine.read_back(map).unwrap().clone();
    assert!(before.level_bytes(0).iter().all(|&b| b != 0), "drawn into");
    assert!(before.level_bytes(1).iter().all(|&b| b == 0), "not yet generated");
    machine.record(true);
    let record = machine.generate_mipmaps(map).unwrap();
    let one = |extents, texels_read| MipmapLevel { extents, texels_read };
    let levels = vec![one([2, 1, 1], 8), one([1, 1, 1], 2)];
    assert_eq!(record, MipmapRecord { texture: ResourceId::Texture(0), texel_bytes: 4, levels });
    assert_eq!((record.texels_read(), record.texels_written()), (10, 3));
    assert_eq!(machine.take_log(), [Event::GenerateMipmaps(record)]);
    let after = machine.read_back(map).unwrap();
    assert_eq!(after.raw(2, 0, 0, 0), before.raw(0, 0, 0, 0), "one colour all over");
}

#[test]
fn a_clear_is_of_level_0() {
    let mut machine = nv35();
    let map = machine.create_target_with_levels(TexelFormat::Bgra8, 4, 4, 3).unwrap();
    machine.clear_target(map, bits([1.0; 4])).unwrap();
    machine.generate_mipmaps(map).unwrap();
    machine.record(true);
    machine.clear_target(map, [0; 4]).unwrap();
    assert_eq!(machine.take_log(), [Event::Clear { resource: ResourceId::Texture(0), bytes: 64 }]);
    let image = machine.read_back(map).unwrap();
    assert!(image.level_bytes(0).iter().all(|&b| b == 0));
    assert!(image.level_bytes(1).iter().chain(image.level_bytes(2)).all(|&b| b == 0xff));
}

#[test]
fn means_are_rounded_as_the_device_says() {
    for (value, expected) in [("nearest", [2, 1]), ("truncate", [1, 0])] {
        let mut profile = Profile::named("nv35").unwrap();
        profile.set_switch("mipmap-rounding", value).unwrap();
        let mut machine = Machine::new(profile, ExecutorKind::Batch);
        // Means of 1.5 and of 2/4.
        let texels = vec![1, 2, 0, 1, 2, 1, 1, 0, 0, 0];
        let image = Image::from_bytes(TexelFormat::L8, TextureKind::D2, [4, 2, 1], 2, texels).unwrap();
        let texture = machine.create_texture(image).unwrap();
        machine.generate_mipmaps(texture).unwrap();
        assert_eq!(machine.read_back(texture).unwrap().level_bytes(1), expected, "{value}");
    }
}

#[test]
fn what_has_no_levels_is_refused() {
    let message = |machine: &mut Machine, image: Image| {
        let texture = machine.create_texture(image).unwrap();
        machine.generate_mipmaps(texture).map_err(|e| e.to_string()).unwrap_err()
    };
    let mut card = nv35();
    let one_level = image(TexelFormat::Rgba8, TextureKind::D2, [4, 9, 1], 1);
    insta::assert_snapshot!(message(&mut card, one_level), @"texture 0 was made with level 0 alone; make it with up to 4 levels to have them generated");
    let rectangle = image(TexelFormat::Rgba8, TextureKind::Rectangle, [4, 4, 1], 1);
    insta::assert_snapshot!(message(&mut card, rectangle), @"texture 1 is a rectangle, which has no mip levels; make it a 2-D texture");
    let float = image(TexelFormat::Rgba16f, TextureKind::D2, [4, 4, 1], 1);
    insta::assert_snapshot!(message(&mut card, float), @"texture 2 is rgba16f, whose mip levels `nv35` cannot generate (limits.float_mipmaps); draw each level by a program that reads four texels of the previous level, into a separate texture");
    // R300 has float textures with levels, but cannot filter them.
    let mut r300 = Machine::new(Profile::named("r300").unwrap(), ExecutorKind::Scalar);
    let float = image(TexelFormat::Rgba16f, TextureKind::D2, [4, 4, 1], 3);
    assert!(message(&mut r300, float).contains("(limits.float_filtering)"));
    let float = card.create_target_with_levels(TexelFormat::Rgba32f, 4, 4, 3).unwrap_err();
    insta::assert_snapshot!(float, @"texture has 3 levels of rgba32f, `nv35` allows 1 (limits.float_mipmaps); keep each level in a separate texture");
    assert!(matches!(card.create_target_with_levels(TexelFormat::Bgra8, 4, 4, 4), Err(MachineError::Texture(_))));
    let released = card.create_target(TexelFormat::Bgra8, 4, 4).unwrap();
    card.release_texture(released).unwrap();
    assert!(matches!(card.generate_mipmaps(released), Err(MachineError::NoSuchResource { .. })));
}

#[test]
fn one_texel_is_a_whole_chain_and_floats_are_filtered_where_they_can_be() {
    let mut card = nv35();
    let dot = card.create_texture(image(TexelFormat::Rgba8, TextureKind::D2, [1, 1, 1], 1)).unwrap();
    assert_eq!(card.generate_mipmaps(dot).unwrap().levels, []);
    let mut ideal = Machine::new(ideal("e8m23"), ExecutorKind::Scalar);
    let map = ideal.create_target_with_levels(TexelFormat::R32f, 2, 2, 2).unwrap();
    ideal.clear_target(map, bits([0.1, 0.0, 0.0, 0.0])).unwrap();
    ideal.generate_mipmaps(map).unwrap();
    assert_eq!(ideal.read_back(map).unwrap().raw(1, 0, 0, 0), 0.1_f32.to_bits().into());
}
