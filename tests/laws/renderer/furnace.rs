//! White furnaces: under uniform radiance nothing is visible, and the sum of all paths is known.

use crossbar::renderer::path::Direct;
use crossbar::renderer::{RenderedPicture, Settings};
use crossbar::scene::{Camera, Material, Scene, Surface};

use super::{
    Builder, FAR, by_distributed_rays, by_paths, by_whitted_rays, near, needle, of, settings, white, within_chance,
};

fn trace(scene: &Scene, camera: &Camera, settings: &Settings, direct: Direct) -> RenderedPicture {
    let picture = by_paths(scene, camera, settings, direct);
    assert_eq!(picture.not_finite, 0);
    picture
}

/// A closed box whose walls emit radiance 1 and reflect half of the light.
fn furnace() -> Scene {
    let mut builder = Builder::default();
    builder.boxed([-1.0; 3], [1.0, 2.0, 1.5], true, &Material { emission: [1.0; 3], ..white(0.5) });
    builder.scene()
}

fn inside() -> Camera {
    Camera::new([0.1, 0.2, 0.3], [0.9, 1.5, 0.2], [0.0, 0.0, 1.0], 0.7, 4, 4).expect("a camera")
}

#[test]
fn short_walks_sum_the_series_exactly() {
    let scene = furnace();
    for depth in 0..=3 {
        let picture = trace(&scene, &inside(), &Settings { depth, ..settings() }, Direct::Walk);
        let expected: f64 = (0..=depth).map(|bounces| 1.0 / f64::from(1_u32 << bounces)).sum();
        for color in picture.color {
            near(color, [expected; 3], 1e-12);
        }
    }
}

#[test]
fn all_walks_sum_to_emission_over_one_minus_albedo() {
    // Only Russian roulette is random, and it must not change the mean, 1 / (1 - 1/2).
    let scene = furnace();
    let all = Settings { depth: 1000, samples: 8000, ..settings() };
    for direct in [Direct::Walk, Direct::Both] {
        let picture = trace(&scene, &needle([0.1, 0.2, 0.3], [0.9, 1.5, 0.2]), &all, direct);
        within_chance(&picture, 0, [2.0; 3]);
    }
}

/// A convex body in uniform light.
fn floating(surface: Surface) -> Scene {
    let mut builder = Builder::default();
    builder.boxed([-0.5, -0.4, -0.3], [0.5, 0.4, 0.3], false, &of(surface));
    builder.scene()
}

fn around(samples: u32) -> (Camera, Settings) {
    let camera = Camera::new([1.5, -2.5, 1.25], [0.0; 3], [0.0, 0.0, 1.0], 0.25, 12, 12).expect("a camera");
    (camera, Settings { background: [1.0; 3], depth: 200, samples, ..settings() })
}

#[test]
fn what_loses_nothing_vanishes() {
    let (camera, settings) = around(4);
    let surfaces = [
        Surface::Diffuse { albedo: [1.0; 3] },
        Surface::Mirror { reflectance: [1.0; 3] },
        Surface::Glass { index: 1.5, transmittance: [1.0; 3] },
        Surface::Glass { index: 0.75, transmittance: [1.0; 3] },
    ];
    for surface in surfaces {
        let scene = floating(surface);
        let picture = trace(&scene, &camera, &settings, Direct::Both);
        assert!(picture.first.iter().flatten().count() > 30, "the thing is in the picture");
        for color in picture.color {
            near(color, [1.0; 3], 1e-9);
        }
        if matches!(surface, Surface::Diffuse { .. }) {
            continue;
        }
        for color in by_distributed_rays(&scene, &camera, &settings).color {
            near(color, [1.0; 3], 1e-9);
        }
    }
}

#[test]
fn whitted_loses_only_the_branches_that_it_drops() {
    let (camera, settings) = around(1);
    let scene = floating(Surface::Glass { index: 1.5, transmittance: [1.0; 3] });
    for color in by_whitted_rays(&scene, &camera, &settings).color {
        assert!(color[0] <= 1.0 + 1e-9 && color[0] > 0.99, "{color:?}");
    }
}

#[test]
fn gloss_makes_no_energy_and_keeps_it_head_on() {
    let surface = |exponent| Surface::Glossy { albedo: [0.4, 0.3, 0.2], specular: [0.6, 0.6, 0.6], exponent };
    for exponent in [1.0, 10.0, 300.0] {
        let scene = floating(surface(exponent));
        let settings = Settings { background: [1.0; 3], samples: 4000, ..settings() };
        let picture = trace(&scene, &needle([0.01, 0.02, 5.0], [0.01, 0.02, 0.0]), &settings, Direct::Both);
        within_chance(&picture, 0, [1.0, 0.9, 0.8]);
        let (camera, settings) = around(64);
        let picture = trace(&scene, &camera, &settings, Direct::Both);
        for (color, variance) in picture.color.iter().zip(&picture.variance) {
            assert!(color[0] <= 1.0 + FAR * variance[0].sqrt() + 1e-9, "{color:?}");
        }
    }
}
