//! Point lights and glossy surfaces: every renderer that shows one has the closed form of Phong's lobe.

use std::f64::consts::PI;

use crossbar::renderer::{Settings, distributed, path, whitted};
use crossbar::scene::{PointLight, Scene, Surface};
use glam::DVec3;

use super::{Builder, host, lamp, near, needle, of, settings, white};

const EXPONENT: f32 = 20.0;
const SPECULAR: [f64; 3] = [0.75, 0.5, 0.25];
const LIGHT: DVec3 = DVec3::new(0.5, 0.25, 2.0);
const EYE: [f32; 3] = [-1.0, 0.0, 1.5];

fn glossy(albedo: f32) -> crossbar::scene::Material {
    of(Surface::Glossy { albedo: [albedo; 3], specular: SPECULAR.map(|value| value as f32), exponent: EXPONENT })
}

/// A floor under a point light.
fn floor(albedo: f32) -> Scene {
    let mut builder = Builder::default();
    builder.quad([-3.0, -3.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], glossy(albedo));
    let mut scene = builder.scene();
    scene.point_lights.push(PointLight { position: LIGHT.as_vec3().to_array(), intensity: [8.0, 4.0, 2.0] });
    scene
}

/// Radiance of the floor at the origin towards the eye: `f cos I / d^2` with f of Lafortune and Willems.
fn radiance(albedo: f64) -> [f64; 3] {
    let eye = DVec3::from(EYE.map(f64::from)).normalize();
    let mirrored = DVec3::new(-eye.x, -eye.y, eye.z);
    let towards = LIGHT.normalize();
    let exponent = f64::from(EXPONENT);
    let lobe = (exponent + 2.0) / (2.0 * PI) * libm::pow(mirrored.dot(towards), exponent);
    let irradiance = [8.0, 4.0, 2.0].map(|intensity| intensity * towards.z / LIGHT.length_squared());
    std::array::from_fn(|channel| (albedo / PI + SPECULAR[channel] * lobe) * irradiance[channel])
}

#[test]
fn every_renderer_shows_the_highlight_of_a_point_light() {
    let camera = needle(EYE, [0.0; 3]);
    for albedo in [0.0, 0.001, 0.5] {
        let scene = floor(albedo);
        let expected = radiance(f64::from(albedo));
        let pictures = [
            whitted::render(&scene, &camera, &settings(), &mut host(&scene), &mut |_| {}).expect("a picture"),
            distributed::render(&scene, &camera, &settings(), &mut host(&scene), &mut |_| {}).expect("a picture"),
            path::render(&scene, &camera, &settings(), path::Direct::Both, &mut host(&scene), &mut |_| {})
                .expect("a picture"),
        ];
        for picture in pictures {
            near(picture.color[0], expected, 1e-5);
        }
    }
}

/// Behind the first glass each of the two rays asks one of two lamps, of which it sees one: with random numbers of
/// their own the variance of their sum is the sum of their variances. With the same numbers one of them would be lit
/// exactly where the other is not.
#[test]
fn the_two_rays_of_glass_are_independent() {
    let variance = |below: f32, above: f32| {
        let mut builder = Builder::default();
        let glass = of(Surface::Glass { index: 1.5, transmittance: [1.0; 3] });
        builder.quad([-9.0, -9.0, 0.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], glass);
        // Under the glass a floor with a lamp over it, above it a wall with a lamp before it.
        builder.quad([-9.0, -9.0, -2.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], white(below));
        builder.quad([2.0, -1.0, -0.5], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0], lamp([4.0; 3]));
        builder.quad([4.0, -9.0, 0.0], [0.0, 0.0, 9.0], [0.0, 18.0, 0.0], white(above));
        builder.quad([2.0, -1.0, 2.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], lamp([4.0; 3]));
        let scene = builder.scene();
        let settings = Settings { samples: 20_000, depth: 2, ..settings() };
        let camera = needle([-3.0, 0.0, 0.36], [0.0; 3]);
        let picture = distributed::render(&scene, &camera, &settings, &mut host(&scene), &mut |_| {});
        picture.expect("a picture").variance[0][0]
    };
    let (refracted, reflected, both) = (variance(0.5, 0.0), variance(0.0, 0.5), variance(0.5, 0.5));
    assert!(refracted > 0.05 * reflected && reflected > 0.05 * refracted, "{refracted} and {reflected}");
    let ratio = both / (refracted + reflected);
    assert!((ratio - 1.0).abs() < 0.05, "{refracted} and {reflected} make {both}, {ratio} of their sum");
}
