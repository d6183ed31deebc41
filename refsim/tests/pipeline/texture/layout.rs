//! Addresses of texels in memory.

use std::collections::BTreeSet;

use refsim::texture::{Image, Layout, TexelFormat, TexelMap, TextureKind};

#[test]
fn every_texel_has_a_place_of_its_own() {
    for layout in [Layout::Rows, Layout::Tiles] {
        for format in
            [TexelFormat::L8, TexelFormat::Bgr565, TexelFormat::Rgba8, TexelFormat::Rgba16, TexelFormat::Rgba32f]
        {
            let image = Image::new(format, TextureKind::D2, [70, 37, 1], 7).unwrap();
            let map = TexelMap::new(layout, &image);
            let mut seen = BTreeSet::new();
            for (n, level) in (0..).zip(image.levels()) {
                for (y, x) in (0..level.height).flat_map(|y| (0..level.width).map(move |x| (y, x))) {
                    let at = map.offset(n, 0, y, x);
                    assert!(at.is_multiple_of(map.texel_bytes().into()) && at < map.bytes());
                    assert!(seen.insert(at), "{layout:?} {format}: two texels at {at}");
                }
            }
        }
    }
}

#[test]
fn a_micro_tile_is_32_bytes_and_a_macro_tile_2_kib() {
    let image = Image::new_2d(TexelFormat::Rgba8, 64, 64).unwrap();
    let map = TexelMap::new(Layout::Tiles, &image);
    assert_eq!([(0, 0), (0, 3), (1, 0), (1, 3)].map(|(y, x)| map.offset(0, 0, y, x)), [0, 12, 16, 28]);
    assert_eq!(
        (map.offset(0, 0, 0, 4), map.offset(0, 0, 2, 0)),
        (32, 256),
        "the next micro tile, and the next row of them"
    );
    assert_eq!(
        (map.offset(0, 0, 0, 32), map.offset(0, 0, 16, 0)),
        (2048, 4096),
        "the next macro tile, and row of them"
    );
}
