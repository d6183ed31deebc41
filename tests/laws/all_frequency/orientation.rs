//! Orientation of the cube: one bright texel, and the normals that see it. The table of docs/papers/all_frequency.md.

use crossbar::all_frequency::transfer::FactoredTransfer;
use crossbar::io::{parse_cube_table, write_cube_table};
use crossbar::picture::Picture;
use crossbar::sphere::EnvironmentPicture;
use crossbar::transfer::grid::{LIGHT_MAP, LIGHT_SIDE, Segmentation};
use crossbar::transfer::light::{CubeLight, HaarLight};
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use glam::DVec3;
use std::path::Path;

use super::{all, flat, observer, trace, vertices};

/// Face name, segment number of its upper left quarter, and the signs of x, y and z at its upper left corner.
const UPPER_LEFT: [(&str, usize, [f64; 3]); 6] = [
    ("+x", 0, [1.0, 1.0, 1.0]),
    ("-x", 4, [-1.0, 1.0, -1.0]),
    ("+y", 8, [-1.0, 1.0, -1.0]),
    ("-y", 12, [-1.0, -1.0, 1.0]),
    ("+z", 16, [-1.0, 1.0, 1.0]),
    ("-z", 20, [1.0, 1.0, -1.0]),
];

/// A table with one texel that is not black.
fn one_texel(face: &str, row: usize, column: usize) -> CubeLight {
    let mut text = write_cube_table(&[[0.0; 3]; 6144], LIGHT_SIDE);
    let number = UPPER_LEFT.iter().position(|(name, ..)| *name == face).expect("a face");
    let black = format!("{number},{row},{column},0,0,0\n");
    assert!(text.contains(&black));
    text = text.replacen(&black, &format!("{number},{row},{column},1,2,4\n"), 1);
    CubeLight::new(parse_cube_table(text.as_bytes(), Path::new("light.csv"), LIGHT_SIDE).expect("a map"))
        .expect("a light")
}

/// The radiance of a white Lambert surface, M L, that looks along a normal.
fn seen(light: &HaarLight, normal: DVec3) -> f64 {
    let mesh = flat(observer(normal).to_vec());
    let vertices = vertices(&mesh);
    let (maps, hats) = (trace(&mesh, &vertices, &[0]), LinearBasis::new(BasisWidth::TwoTexels));
    let response = |s: DVec3, into: &mut [f64]| into[0] = s.z;
    let transfer = FactoredTransfer { vertices: &vertices, maps: &maps, hats: &hats, rows: 1, response: &response };
    assert_eq!(all(&vertices).len(), 3);
    let products = transfer.segments().map(|segment| {
        let segment = segment.expect("transfer");
        let pairs = segment.signal.point(0).iter().zip(light.segment(0, segment.segment));
        pairs.map(|(&m, l)| f64::from(m) * l).sum::<f64>()
    });
    products.sum()
}

/// A bright texel at the middle of a face lights a surface that looks along the face's axis most; no other axis gets
/// half as much. (Four texels meet in the middle.)
#[test]
fn a_texel_shines_from_its_face() {
    let axes = [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z];
    for (face, (name, ..)) in UPPER_LEFT.into_iter().enumerate() {
        let light = HaarLight::new(&one_texel(name, 16, 16), Segmentation::Quarters);
        let found = axes.map(|axis| seen(&light, axis));
        for (at, value) in found.into_iter().enumerate() {
            assert!(at == face || value < 0.05 * found[face], "{name}: {found:?}");
        }
    }
}

#[test]
fn upper_left_texels_lie_where_the_table_says() {
    for (face, (name, segment, signs)) in UPPER_LEFT.into_iter().enumerate() {
        let texel = one_texel(name, 0, 0).texels().iter().position(|texel| texel[1] == 2.0).expect("a texel");
        assert_eq!(texel, face * 1024);
        assert_eq!(Segmentation::Quarters.place(texel), [segment, 0]);
        let direction = LIGHT_MAP.direction(face, 0, 0);
        assert_eq!(direction.to_array().map(f64::signum), signs, "{name}: {direction}");
        // The face extends to the right and down from the corner, whose largest component is the face's axis.
        let towards = DVec3::from(signs).normalize();
        let light = HaarLight::new(&one_texel(name, 0, 0), Segmentation::Quarters);
        let [with, against] = [towards, -towards].map(|normal| seen(&light, normal));
        assert!(with > 0.0 && against == 0.0, "{name}: {with} {against}");
    }
}

/// A picture's middle looks along +y, right is +x and up is +z; its bright pixel lights the texel in that direction.
#[test]
fn a_picture_lights_the_texel_that_its_pixel_shows() {
    for (width, height, pixel, face) in [
        (64, 32, [48, 16], 0),
        (64, 32, [15, 16], 1),
        (64, 32, [32, 15], 2),
        (64, 32, [0, 16], 3),
        (64, 64, [32, 16], 4),
        (64, 48, [24, 40], 5),
    ] {
        let mut pixels = vec![[0.0; 3]; width * height];
        pixels[pixel[1] * width + pixel[0]] = [1.0; 3];
        let picture = EnvironmentPicture::new(&Picture::rgb(width as u32, height as u32, &pixels)).expect("a picture");
        let light = CubeLight::from_picture(&picture).expect("a light");
        let lit: Vec<usize> = (0..6144).filter(|&texel| light.texels()[texel][0] > 0.0).collect();
        let near = |&texel: &usize| {
            let (row, column) = (texel / 32 % 32, texel % 32);
            texel / 1024 == face && (13..19).contains(&row) && (13..19).contains(&column)
        };
        assert!(!lit.is_empty() && lit.iter().all(near), "{width}x{height} {pixel:?}: {lit:?}");
    }
}
