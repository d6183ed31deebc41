//! Point lights and glossy surfaces: every renderer that supports both agrees with the closed form of Phong's lobe.

use std::f64::consts::PI;

use crossbar::renderer::Settings;
use crossbar::renderer::path::Direct;
use crossbar::renderer::photon::{self, Photons};
use crossbar::scene::{PointLight, Scene, Surface};
use glam::DVec3;

use super::{
    Builder, by_distributed_rays, by_paths, by_photons, by_whitted_rays, host, lamp, near, needle, of, settings, white,
};

const EXPONENT: f32 = 20.0;
const SPECULAR: [f64; 3] = [0.75, 0.5, 0.25];
const LIGHT: DVec3 = DVec3::new(0.5, 0.25, 2.0);
const EYE: [f32; 3] = [-1.0, 0.0, 1.5];

fn glossy(albedo: f32) -> crossbar::scene::Material {
    of(Surface::Glossy { albedo: [albedo; 3], specular: SPECULAR.map(|value| value as f32), exponent: EXPONENT })
}

/// A floor under a point light, with further objects.
fn floor(albedo: f32, beside: impl FnOnce(&mut Builder)) -> Scene {
    let mut builder = Builder::default();
    builder.quad([-3.0, -3.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], glossy(albedo));
    beside(&mut builder);
    let mut scene = builder.scene();
    scene.point_lights.push(PointLight { position: LIGHT.as_vec3().to_array(), intensity: [8.0, 4.0, 2.0] });
    scene
}

/// Radiance of the floor at the origin towards the eye: `f cos I / d^2` with the f of Lafortune and Willems.
fn radiance(albedo: f64, light: DVec3, share: f64) -> [f64; 3] {
    let eye = DVec3::from(EYE.map(f64::from)).normalize();
    let mirrored = DVec3::new(-eye.x, -eye.y, eye.z);
    let towards = light.normalize();
    let exponent = f64::from(EXPONENT);
    let lobe = (exponent + 2.0) / (2.0 * PI) * libm::pow(mirrored.dot(towards), exponent);
    let irradiance = [8.0, 4.0, 2.0].map(|intensity| share * intensity * towards.z / light.length_squared());
    std::array::from_fn(|channel| (albedo / PI + SPECULAR[channel] * lobe) * irradiance[channel])
}

fn photons(gather: u32) -> Photons {
    Photons { global: 100, caustic: 100, nearest: 10, radius: 0.3, gather }
}

#[test]
fn every_renderer_shows_the_highlight_of_a_point_light() {
    let camera = needle(EYE, [0.0; 3]);
    for albedo in [0.0, 0.001, 0.5] {
        let scene = floor(albedo, |_| {});
        let expected = radiance(f64::from(albedo), LIGHT, 1.0);
        let pictures = [
            by_whitted_rays(&scene, &camera, &settings()),
            by_distributed_rays(&scene, &camera, &settings()),
            by_paths(&scene, &camera, &settings(), Direct::Both),
            by_photons(&scene, &camera, &settings(), &photons(4)),
        ];
        for picture in pictures {
            near(picture.color[0], expected, 1e-5);
        }
        // The map shows the diffuse part approximately; the highlight is still exact.
        let photons = Photons { global: 200_000, nearest: 500, ..photons(0) };
        let picture = by_photons(&scene, &camera, &settings(), &photons);
        near(picture.color[0], expected, 1e-5 + 0.2 * f64::from(albedo) * expected[0]);
    }
}

/// A mirror acts as a second light for the floor, at the light's mirror image. No ray of a lobe can hit a point light,
/// but photons carry its light.
#[test]
fn a_mirror_casts_a_point_light_on_gloss() {
    let image = DVec3::new(2.5, 0.25, 2.0);
    let scene = floor(0.0, |builder| {
        let mirror = of(Surface::Mirror { reflectance: [0.5; 3] });
        builder.quad([1.5, -2.0, 0.0], [0.0, 0.0, 4.0], [0.0, 4.0, 0.0], mirror);
    });
    let (direct, mirrored) = (radiance(0.0, LIGHT, 1.0), radiance(0.0, image, 0.5));
    let photons = Photons { caustic: 1_000_000, nearest: 2000, radius: 0.2, ..photons(4) };
    let found = by_photons(&scene, &needle(EYE, [0.0; 3]), &settings(), &photons).color[0];
    for channel in 0..3 {
        // About 600 photons have a standard deviation of 4 %; the lobe varies a little over the disk of the estimate.
        let share = (found[channel] - direct[channel]) / mirrored[channel];
        assert!((share - 1.0).abs() < 0.2, "{found:?}, expected {mirrored:?} beside {direct:?}");
    }
}

/// Behind the first glass, each of the two rays samples one of two lamps, and only one of the lamps is visible to it.
/// With separate random numbers the variance of the rays' sum is the sum of their variances. With the same numbers one
/// ray would be lit exactly where the other is not.
#[test]
fn the_two_rays_of_glass_are_independent() {
    let variance = |below: f32, above: f32| {
        let mut builder = Builder::default();
        let glass = of(Surface::Glass { index: 1.5, transmittance: [1.0; 3] });
        builder.quad([-9.0, -9.0, 0.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], glass);
        // Below the glass, a floor with a lamp over it; above the glass, a wall with a lamp in front of it.
        builder.quad([-9.0, -9.0, -2.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0], white(below));
        builder.quad([2.0, -1.0, -0.5], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0], lamp([4.0; 3]));
        builder.quad([4.0, -9.0, 0.0], [0.0, 0.0, 9.0], [0.0, 18.0, 0.0], white(above));
        builder.quad([2.0, -1.0, 2.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], lamp([4.0; 3]));
        let scene = builder.scene();
        let settings = Settings { samples: 20_000, depth: 2, ..settings() };
        let camera = needle([-3.0, 0.0, 0.36], [0.0; 3]);
        by_distributed_rays(&scene, &camera, &settings).variance[0][0]
    };
    let (refracted, reflected, both) = (variance(0.5, 0.0), variance(0.0, 0.5), variance(0.5, 0.5));
    assert!(refracted > 0.05 * reflected && reflected > 0.05 * refracted, "{refracted} and {reflected}");
    let ratio = both / (refracted + reflected);
    assert!((ratio - 1.0).abs() < 0.05, "{refracted} and {reflected} make {both}, {ratio} of their sum");
}

#[test]
fn an_estimate_of_fewer_than_two_photons_is_refused() {
    let scene = floor(0.5, |_| {});
    for nearest in [0, 1] {
        let photons = Photons { nearest, ..photons(1) };
        let camera = needle(EYE, [0.0; 3]);
        let refused = photon::render(&scene, &camera, &settings(), &photons, &mut host(&scene), &mut |_| {});
        assert!(refused.is_err(), "{nearest}");
    }
}
