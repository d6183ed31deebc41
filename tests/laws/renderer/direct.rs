//! Compares direct light from a square with Lambert's closed form of 1760.

use std::f64::consts::PI;

use approx::abs_diff_eq;
use crossbar::geom::vector::wide;
use crossbar::renderer::path::Direct;
use crossbar::renderer::{RenderedPicture, Settings};
use crossbar::scene::Scene;
use glam::DVec3;

use super::{Builder, by_distributed_rays, by_paths, lamp, needle, settings, white, within_chance};

/// Form factor from a small area at the origin, facing along z, to a polygon above it: each side adds the angle that it
/// subtends times the cosine between z and the normal of the plane through the side and the origin.
fn lambert(corners: &[DVec3]) -> f64 {
    let side = |i: usize| {
        let (a, b) = (corners[i].normalize(), corners[(i + 1) % corners.len()].normalize());
        libm::acos(a.dot(b)) * a.cross(b).normalize().z
    };
    ((0..corners.len()).map(side).sum::<f64>() / (2.0 * PI)).abs()
}

/// Form factor to a rectangle parallel to the area, with a corner directly above it; a and b are its sides divided by
/// its height.
fn parallel_corner(a: f64, b: f64) -> f64 {
    let (x, y) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
    (a / x * libm::atan(b / x) + b / y * libm::atan(a / y)) / (2.0 * PI)
}

/// A floor, and a parallelogram as a lamp, given by a corner and two sides.
fn lit(corner: [f32; 3], u: [f32; 3], v: [f32; 3]) -> (Scene, f64) {
    let mut builder = Builder::default();
    builder.quad([-3.0, -3.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], white(0.75));
    builder.quad(corner, u, v, lamp([2.0, 1.0, 0.5]));
    let [corner, u, v] = [corner, u, v].map(wide);
    let at = |a: f64, b: f64| corner + a * u + b * v;
    let factor = lambert(&[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]);
    (builder.scene(), factor)
}

fn pictures(scene: &Scene, samples: u32) -> Vec<RenderedPicture> {
    let camera = needle([-2.0, 0.1, 0.3], [0.0; 3]);
    let settings = Settings { samples, depth: 1, ..settings() };
    let ways = [Direct::Emitters, Direct::Both, Direct::Walk];
    let paths = ways.map(|direct| by_paths(scene, &camera, &settings, direct));
    paths.into_iter().chain([by_distributed_rays(scene, &camera, &settings)]).collect()
}

fn check(scene: &Scene, factor: f64) {
    for picture in pictures(scene, 6000) {
        within_chance(&picture, 0, [2.0, 1.0, 0.5].map(|radiance| 0.75 * radiance * factor));
    }
}

#[test]
fn a_square_straight_above() {
    let (scene, factor) = lit([-1.0, -1.0, 1.5], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0]);
    assert!(
        abs_diff_eq!(factor, 4.0 * parallel_corner(1.0 / 1.5, 1.0 / 1.5), epsilon = 1e-12),
        "two closed forms agree: {factor}"
    );
    check(&scene, factor);
}

#[test]
fn a_square_that_stands_beside() {
    let (scene, factor) = lit([0.8, -0.5, 0.25], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]);
    assert!(factor > 0.05, "{factor}");
    check(&scene, factor);
}

#[test]
fn the_back_of_an_emitter_is_dark() {
    let (scene, _) = lit([-1.0, -1.0, 1.5], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
    for picture in pictures(&scene, 16) {
        assert_eq!(picture.color[0], [0.0; 3]);
    }
}
