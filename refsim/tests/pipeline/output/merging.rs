//! Merging of fragments.

use proptest::prelude::*;
use refsim::num::Format;
use refsim::output::{
    AlphaTest, BlendFactor, BlendOp, BlendState, CompareFunction, DepthFormat, DepthState, DepthSurface, FragmentFate,
    FragmentOutput, OutputError, OutputRules, OutputState, TargetTile, WriteMask, merge,
};
use refsim::texture::{Image, Region, TargetRounding, TexelFormat, TextureKind};

const RULES: OutputRules = OutputRules {
    format: Format::S3_12,
    target_rounding: TargetRounding::Nearest,
    depth_rounding: TargetRounding::Nearest,
};

const ONE: u32 = 0x1000; // in s3.12

fn targets() -> (Image, DepthSurface) {
    let image = Image::new_2d(TexelFormat::Rgba8, 4, 4).unwrap();
    (image, DepthSurface::new(DepthFormat::Unorm16, 4, 4).unwrap())
}

fn fragment(alpha: u32) -> FragmentOutput {
    FragmentOutput { colors: [[ONE, 0, ONE, alpha]; 4], written: 15, ..FragmentOutput::default() }
}

#[test]
fn steps_come_in_order() {
    let (image, depth) = targets();
    let mut tile = TargetTile::load(&[Some(&image)], Some(&depth), image.region()).unwrap();
    let state = OutputState {
        alpha: Some(AlphaTest { function: CompareFunction::GreaterEqual, reference: (128.0f32 / 255.0).to_bits() }),
        depth: DepthState { test: Some(CompareFunction::Less), write: true },
        ..OutputState::default()
    };
    let before = tile.clone();
    let near = 0.25f32.to_bits();
    let killed = FragmentOutput { killed: true, ..fragment(0) };
    assert_eq!(merge(&mut tile, (1, 2), &killed, near, &state, &RULES), FragmentFate::KilledByShader);
    // Just below 128/255: fails, and its depth is not stored.
    assert_eq!(merge(&mut tile, (1, 2), &fragment(0x0800), near, &state, &RULES), FragmentFate::AlphaFailed);
    assert_eq!(merge(&mut tile, (4, 0), &fragment(ONE), near, &state, &RULES), FragmentFate::OutsideTile);
    assert_eq!(tile, before);
    assert_eq!(merge(&mut tile, (1, 2), &fragment(0x0809), near, &state, &RULES), FragmentFate::Passed);
    assert_eq!(tile.depth.as_ref().unwrap().data[9], 0x4000);
    assert_eq!(tile.colors[0].as_ref().unwrap().raw(9), 0x80ff_00ff);
    // An equal depth is not less; a depth written by the program replaces the interpolated one.
    assert_eq!(merge(&mut tile, (1, 2), &fragment(ONE), near, &state, &RULES), FragmentFate::DepthFailed);
    let own = FragmentOutput { depth: Some(ONE / 8), ..fragment(ONE) };
    assert_eq!(merge(&mut tile, (1, 2), &own, near, &state, &RULES), FragmentFate::Passed);
    assert_eq!(tile.depth.as_ref().unwrap().data[9], 0x2000);
}

#[test]
fn depth_is_written_only_if_asked() {
    let (image, depth) = targets();
    for (state, want) in [
        (DepthState { test: Some(CompareFunction::Always), write: false }, 0xffff),
        (DepthState { test: None, write: true }, 0xffff),
        (DepthState { test: Some(CompareFunction::Always), write: true }, 0),
    ] {
        let mut tile = TargetTile::load(&[Some(&image)], Some(&depth), image.region()).unwrap();
        let state = OutputState { depth: state, ..OutputState::default() };
        assert_eq!(merge(&mut tile, (0, 0), &fragment(ONE), 0, &state, &RULES), FragmentFate::Passed);
        assert_eq!(tile.depth.unwrap().data[0], want);
    }
}

#[test]
fn targets_have_their_own_masks_and_formats() {
    let formats = [TexelFormat::Rgba8, TexelFormat::L8, TexelFormat::Rgba16f, TexelFormat::Rg16];
    let images = formats.map(|f| Image::new_2d(f, 2, 1).unwrap());
    let list: Vec<_> = images.iter().map(Some).collect();
    let mut tile = TargetTile::load(&list, None, images[0].region()).unwrap();
    let state = OutputState {
        masks: [WriteMask(0b0101), WriteMask(0b1110), WriteMask::ALL, WriteMask::ALL],
        ..OutputState::default()
    };
    let output = FragmentOutput { colors: [[ONE; 4]; 4], written: 0b0111, ..FragmentOutput::default() };
    assert_eq!(merge(&mut tile, (1, 0), &output, 0, &state, &RULES), FragmentFate::Passed);
    let raw = tile.colors.map(|c| c.unwrap().raw(1));
    assert_eq!(raw, [0x00ff_00ff, 0, 0x3c00_3c00_3c00_3c00, 0]);
}

#[test]
fn impossible_targets_are_refused() {
    let plane = Image::new_2d(TexelFormat::Rgba8, 4, 4).unwrap();
    let cube = Image::new(TexelFormat::Rgba8, TextureKind::Cube, [4, 4, 1], 1).unwrap();
    let small = DepthSurface::new(DepthFormat::Unorm16, 4, 3).unwrap();
    let check = |colors: &[Option<&Image>], depth| TargetTile::check(colors, depth);
    assert!(matches!(check(&[Some(&plane); 5], None), Err(OutputError::TooManyTargets { .. })));
    assert!(matches!(check(&[None, Some(&cube)], None), Err(OutputError::TargetKind { index: 1, .. })));
    assert!(matches!(check(&[Some(&plane)], Some(&small)), Err(OutputError::TargetSize { width: 4, height: 3, .. })));
    assert_eq!(check(&[Some(&plane)], None), Ok(plane.region()));
}

proptest! {
    /// Fragments produce the same targets whether merged in a single tile or in tiles of any size.
    #[test]
    fn tiles_change_nothing(
        fragments in prop::collection::vec((0u32..9, 0u32..7, [0u32..0x1400, 0u32..0x1400, 0u32..0x1400, 0u32..0x1400], 0.0f32..1.0), 1..60),
        tile_width in 1u32..9, tile_height in 1u32..7, blend in any::<bool>(),
    ) {
        let mut images = [Image::new_2d(TexelFormat::Bgr565, 9, 7).unwrap(), Image::new_2d(TexelFormat::Rgba16f, 9, 7).unwrap()];
        let mut depth = DepthSurface::new(DepthFormat::Unorm24, 9, 7).unwrap();
        let state = OutputState {
            depth: DepthState { test: Some(CompareFunction::LessEqual), write: true },
            blend: blend.then(|| BlendState::both(BlendFactor::SrcAlpha, BlendFactor::InvSrcColor, BlendOp::Add)),
            ..OutputState::default()
        };
        let (first, zs) = (images.clone(), depth.clone());
        let through = |region: Region| {
            let mut tile = TargetTile::load(&[Some(&first[0]), Some(&first[1])], Some(&zs), region).unwrap();
            for &(x, y, color, z) in &fragments {
                let output = FragmentOutput { colors: [color; 4], written: 3, ..FragmentOutput::default() };
                merge(&mut tile, (x, y), &output, z.to_bits(), &state, &RULES);
            }
            tile
        };
        let whole = through(Region { x: 0, y: 0, width: 9, height: 7 });
        for y in (0..7).step_by(tile_height as usize) {
            for x in (0..9).step_by(tile_width as usize) {
                let tile = through(Region { x, y, width: tile_width, height: tile_height });
                images.iter_mut().enumerate().for_each(|(i, image)| tile.store_color(i, image).unwrap());
                tile.store_depth(&mut depth);
            }
        }
        prop_assert_eq!(images[0].bytes(), &whole.colors[0].as_ref().unwrap().bytes[..]);
        prop_assert_eq!(images[1].bytes(), &whole.colors[1].as_ref().unwrap().bytes[..]);
        prop_assert_eq!(depth.data(), &whole.depth.as_ref().unwrap().data[..]);
    }
}
