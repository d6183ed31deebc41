//! Layouts of pictures of the whole sphere, tested against independent formulas for their directions, integrated by a
//! product rule.

use std::f64::consts::{PI, TAU};

use crossbar_base::elementary::{hypot, sin_cos};
use crossbar_ground::picture::Picture;
use crossbar_ground::quadrature::gauss_legendre;
use crossbar_ground::sphere::{EnvironmentLayout, EnvironmentPicture, HarmonicLight, function_count, harmonics};
use glam::DVec3;
use strum::IntoEnumIterator as _;

fn shapes(layout: EnvironmentLayout) -> Vec<[usize; 2]> {
    match layout {
        EnvironmentLayout::LatLong => vec![[2, 1], [64, 32], [200, 100]],
        EnvironmentLayout::AngularProbe => vec![[1, 1], [2, 2], [3, 3], [7, 7], [32, 32], [101, 101]],
        EnvironmentLayout::CubeCross => vec![[4, 3], [3, 4], [64, 48], [75, 100]],
        EnvironmentLayout::CubeStrip => vec![[1, 6], [5, 30], [16, 96]],
    }
}

/// The direction at a position of a picture, in pixels from its upper left corner, and the solid angle per squared
/// pixel there; `None` where nothing is shown.
fn shown(layout: EnvironmentLayout, [width, height]: [usize; 2], [x, y]: [f64; 2]) -> Option<(DVec3, f64)> {
    let [across, down] = [width, height].map(|side| side as f64);
    match layout {
        EnvironmentLayout::LatLong => {
            let (sin, cos) = sin_cos(TAU * (x / across - 0.5));
            let (sin_polar, cos_polar) = sin_cos(PI * y / down);
            let density = TAU / across * PI / down * sin_polar;
            Some((DVec3::new(sin * sin_polar, cos * sin_polar, cos_polar), density))
        }
        EnvironmentLayout::AngularProbe => {
            let [right, up] = [2.0 * x / across - 1.0, 1.0 - 2.0 * y / down];
            let r = hypot(right, up);
            let (sin, cos) = sin_cos(PI * r);
            let scale = if r > 0.0 { sin / r } else { PI };
            let density = PI * scale * (2.0 / across) * (2.0 / across);
            (r < 1.0).then(|| (DVec3::new(scale * right, cos, scale * up), density))
        }
        EnvironmentLayout::CubeCross => {
            let side = across.max(down) / 4.0;
            let tile = [x, y].map(|at| (at / side) as usize);
            let [u, v] = [x, y].map(|at| 2.0 * (at / side).fract() - 1.0);
            // Right and up axes of the face, for a viewer who looks along +y.
            let point = match (tile, width > height) {
                ([1, 0], _) => DVec3::new(u, v, 1.0),
                ([0, 1], _) => DVec3::new(-1.0, u, -v),
                ([1, 1], _) => DVec3::new(u, 1.0, -v),
                ([2, 1], _) => DVec3::new(1.0, -u, -v),
                ([1, 2], _) => DVec3::new(u, -v, -1.0),
                ([3, 1], true) => DVec3::new(-u, -1.0, -v),
                ([1, 3], false) => DVec3::new(u, -1.0, v),
                _ => return None,
            };
            on_cube(point, side)
        }
        EnvironmentLayout::CubeStrip => {
            let [u, v] = [x, y].map(|at| 2.0 * (at / across).fract() - 1.0);
            // Direct3D's faces.
            let point = match (y / across) as usize {
                0 => DVec3::new(1.0, -v, -u),
                1 => DVec3::new(-1.0, -v, u),
                2 => DVec3::new(u, 1.0, v),
                3 => DVec3::new(u, -1.0, -v),
                4 => DVec3::new(u, -v, 1.0),
                _ => DVec3::new(-u, -v, -1.0),
            };
            on_cube(point, across)
        }
    }
}

/// The direction of a point of a cube, and the solid angle per squared pixel there.
fn on_cube(point: DVec3, side: f64) -> Option<(DVec3, f64)> {
    let length = point.length();
    Some((point / length, 4.0 / (side * side) / (length * length * length)))
}

/// The coefficients of the light of one white pixel.
fn pixel_light(order: usize, [width, height]: [usize; 2], at: usize) -> Vec<f64> {
    let mut pixels = vec![[0.0; 3]; width * height];
    pixels[at] = [1.0; 3];
    let picture = Picture::rgb(width as u32, height as u32, &pixels);
    HarmonicLight::from_picture(order, &picture).expect("a light").channels()[0].clone()
}

#[test]
fn solid_angles_add_up_to_the_sphere() {
    for layout in EnvironmentLayout::iter() {
        for [width, height] in shapes(layout) {
            assert_eq!(EnvironmentLayout::of(width as u32, height as u32), Some(layout));
            let white = Picture::rgb(width as u32, height as u32, &vec![[1.0; 3]; width * height]);
            let light = HarmonicLight::from_picture(1, &white).expect("a light");
            // The first harmonic is 1 over the root of 4 pi.
            let sum = light.channels()[0][0] * (4.0 * PI).sqrt();
            assert!((sum - 4.0 * PI).abs() < 4e-14, "{layout} {width}x{height}: {sum}");
        }
    }
}

#[test]
fn a_pixel_is_found_in_its_directions() {
    for layout in EnvironmentLayout::iter() {
        for size @ [width, height] in shapes(layout) {
            let pixels: Vec<[f32; 3]> = (0..width * height).map(|at| [at as f32; 3]).collect();
            let picture = EnvironmentPicture::new(&Picture::rgb(width as u32, height as u32, &pixels)).expect("a map");
            for at in 0..width * height {
                for [u, v] in [[0.5, 0.5], [0.02, 0.9], [0.97, 0.03]] {
                    let place = [(at % width) as f64 + u, (at / width) as f64 + v];
                    if let Some((direction, _)) = shown(layout, size, place) {
                        assert_eq!(picture.radiance(direction)[0], at as f64, "{layout} {size:?}: {direction}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_pixel_has_the_integrals_of_harmonics_over_its_part_of_the_sphere() {
    let rule = gauss_legendre(12);
    let order = 4;
    for (layout, size) in [
        (EnvironmentLayout::LatLong, [16, 8]),
        (EnvironmentLayout::AngularProbe, [16, 16]),
        (EnvironmentLayout::CubeCross, [16, 12]),
    ] {
        for [column, row] in [[7, 5], [5, 6]] {
            let mut expected = vec![0.0; function_count(order)];
            let mut y = expected.clone();
            for (v, u) in rule.iter().flat_map(|v| rule.iter().map(move |u| (v, u))) {
                let place = [column as f64 + u.0, row as f64 + v.0];
                let (direction, density) = shown(layout, size, place).expect("a pixel that shows something");
                harmonics(order, direction, &mut y);
                expected.iter_mut().zip(&y).for_each(|(sum, y)| *sum += u.1 * v.1 * density * y);
            }
            let found = pixel_light(order, size, row * size[0] + column);
            let off = |(found, expected): (&f64, &f64)| (found - expected).abs();
            let most = found.iter().zip(&expected).map(off).fold(0.0, f64::max);
            assert!(off((&found[0], &expected[0])) < 1e-14 && most < 1e-12, "{layout}: {most:e}");
        }
    }
}

#[test]
fn shapes_that_fit_nothing_have_no_layout() {
    for [width, height] in [[0, 0], [3, 2], [5, 4], [8, 7], [1, 2]] {
        assert_eq!(EnvironmentLayout::of(width, height), None, "{width}x{height}");
    }
}
