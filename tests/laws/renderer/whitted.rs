//! Compares Whitted's rays with closed forms: the image in a mirror, Snell, Fresnel, total internal reflection,
//! shadows.

use std::f64::consts::PI;

use crossbar::renderer::{RayKind, Settings, whitted};
use crossbar::scene::{Camera, PointLight, Scene, Surface};

use crate::support::profile;

use super::{Builder, by_whitted_rays, lamp, near, needle, of, settings, white};

fn glass() -> Surface {
    Surface::Glass { index: 1.5, transmittance: [1.0; 3] }
}

fn render(scene: &Scene, camera: &Camera, settings: &Settings) -> crossbar::renderer::RenderedPicture {
    let picture = by_whitted_rays(scene, camera, settings);
    assert_eq!(picture.not_finite, 0);
    picture
}

fn one(scene: &Scene, eye: [f32; 3], target: [f32; 3]) -> [f64; 3] {
    render(scene, &needle(eye, target), &settings()).color[0]
}

#[test]
fn a_mirror_shows_the_image_of_a_point() {
    let mut builder = Builder::default();
    builder.quad(
        [-10.0, -10.0, 0.0],
        [20.0, 0.0, 0.0],
        [0.0, 20.0, 0.0],
        of(Surface::Mirror { reflectance: [0.9, 0.8, 0.7] }),
    );
    // A lamp of side 0.02 centered at (2, 1, 3) that faces down; its image is at (2, 1, -3).
    builder.quad([1.99, 0.99, 3.0], [0.0, 0.02, 0.0], [0.02, 0.0, 0.0], lamp([2.0, 2.0, 2.0]));
    let scene = builder.scene();
    let eye = [-1.0, -2.0, 4.0];
    near(one(&scene, eye, [2.0, 1.0, -3.0]), [1.8, 1.6, 1.4], 1e-6);
    // Rays that hit the image, and rays just outside it.
    for (at, seen) in [([1.992, 1.008, -3.0], true), ([1.98, 1.0, -3.0], false), ([2.0, 1.02, -3.0], false)] {
        let found = one(&scene, eye, at);
        assert_eq!(found[0] > 0.0, seen, "{at:?}: {found:?}");
    }
}

#[test]
fn a_slab_of_glass_moves_the_ray_and_keeps_its_direction() {
    // The fronts of the slab face outward: air above z = 0, glass down to z = -1.
    let mut builder = Builder::default();
    builder.boxed([-50.0, -50.0, -1.0], [50.0, 50.0, 0.0], false, &of(glass()));
    // The ray enters at 45 degrees: sin' = sin / 1.5. It moves across by tan' within the slab, and leaves in its
    // original direction.
    let sine = (0.5_f64).sqrt() / 1.5;
    let across = sine / (1.0 - sine * sine).sqrt();
    let at = (across + 1.0) as f32;
    builder.quad([at - 0.01, -0.01, -2.0], [0.02, 0.0, 0.0], [0.0, 0.02, 0.0], lamp([1.0; 3]));
    let scene = builder.scene();
    let (s, p) = fresnel(0.5_f64.sqrt(), 1.5);
    let passes = 1.0 - (s + p) / 2.0;
    near(one(&scene, [-1.0, 0.0, 1.0], [0.0; 3]), [passes * passes; 3], 1e-9);
    // Rays that would hit the lamp without glass, and rays beyond the other side of the image.
    near(one(&scene, [-1.1, 0.0, 1.0], [-0.1, 0.0, 0.0]), [0.0; 3], 0.0);
    near(one(&scene, [-0.9, 0.0, 1.0], [0.1, 0.0, 0.0]), [0.0; 3], 0.0);
}

/// Reflectances for both polarizations, computed from cosines instead of sines and tangents of the angles' sum and
/// difference.
fn fresnel(cosine: f64, index: f64) -> (f64, f64) {
    let other = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let s = (cosine - index * other) / (cosine + index * other);
    let p = (index * cosine - other) / (index * cosine + other);
    (s * s, p * p)
}

#[test]
fn a_prism_turns_light_by_total_internal_reflection() {
    // Right angle at the origin, legs along x and z, hypotenuse from (2, 0) to (0, 2): 45 degrees exceed the critical
    // angle of 41.8.
    let mut builder = Builder::default();
    let (low, high) = (-5.0, 10.0);
    builder.quad([0.0, low, 0.0], [0.0, high, 0.0], [2.0, 0.0, 0.0], of(glass()));
    builder.quad([0.0, low, 0.0], [0.0, 0.0, 2.0], [0.0, high, 0.0], of(glass()));
    builder.quad([2.0, low, 0.0], [0.0, high, 0.0], [-2.0, 0.0, 2.0], of(glass()));
    // The ray enters upward through the leg on x, is reflected at the hypotenuse, and leaves through the leg on z
    // toward negative x.
    builder.quad([-3.0, -1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0], lamp([1.0; 3]));
    let found = one(&builder.scene(), [0.75, 0.0, -3.0], [0.75, 0.0, 0.0]);
    near(found, [0.96 * 0.96; 3], 1e-9);
}

/// A floor, a square of side 1 one unit above it, and a light one unit above the square.
fn shadowed() -> Scene {
    let mut builder = Builder::default();
    builder.quad([-20.0, -20.0, 0.0], [40.0, 0.0, 0.0], [0.0, 40.0, 0.0], white(0.5));
    builder.quad([-0.5, -0.5, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], white(0.5));
    let mut scene = builder.scene();
    scene.point_lights.push(PointLight { position: [0.0, 0.0, 2.0], intensity: [3.0, 2.0, 1.0] });
    scene
}

#[test]
fn shadows_end_where_the_light_says() {
    let scene = shadowed();
    // The shadow on the floor is twice as large as the square: from -1 to 1.
    for (x, lit) in [(0.0, false), (0.98, false), (1.02, true), (4.0, true)] {
        let found = one(&scene, [x, -6.0, 0.5], [x, 0.0, 0.0]);
        let square = f64::from(x * x) + 4.0;
        let expected = if lit { 0.5 / PI * (2.0 / square.sqrt()) / square } else { 0.0 };
        near(found, [3.0 * expected, 2.0 * expected, expected], 1e-6);
    }
}

#[test]
fn lit_surfaces_have_no_spots() {
    // Rays that start on a surface must not meet it again, however far it is from the origin of coordinates and however
    // small their angle to it.
    for shift in [0.0, 100.0, 3000.0] {
        let mut builder = Builder::default();
        builder.quad([shift, shift, 0.1 * shift], [8.0, 0.0, 1.7], [0.0, 7.0, 0.9], white(1.0));
        let mut scene = builder.scene();
        scene
            .point_lights
            .push(PointLight { position: [shift + 9.0, shift + 3.0, 0.1 * shift + 2.6], intensity: [1.0; 3] });
        let middle = [shift + 4.0, shift + 3.5, 0.1 * shift + 1.3];
        let camera = Camera::new([shift + 4.0, shift + 3.5, 0.1 * shift + 30.0], middle, [0.0, 1.0, 0.0], 0.1, 64, 64);
        let picture = render(&scene, &camera.expect("a camera"), &settings());
        let dark = picture.color.iter().filter(|color| color[0] <= 0.0).count();
        assert_eq!(dark, 0, "{dark} dark pixels at {shift}");
    }
}

#[test]
fn cards_of_short_formats_see_no_shadow_of_their_own() {
    use crossbar::geom::exact::Sides;
    use crossbar::ray_engine::engine::{EngineParameters, RayEngine};
    let mut builder = Builder::default();
    builder.quad([-1.0, -1.0, 0.1], [2.0, 0.0, 0.3], [0.0, 2.0, 0.2], white(1.0));
    let mut scene = builder.scene();
    scene.point_lights.push(PointLight { position: [1.5, 0.25, 1.75], intensity: [1.0; 3] });
    let camera = Camera::new([0.1, 0.2, 9.0], [0.0, 0.0, 0.25], [0.0, 1.0, 0.0], 0.1, 24, 24).expect("a camera");
    let dark = |rounding| {
        let parameters =
            EngineParameters { sides: Sides::Both, triangles: 1..=15, rays: 8, ..EngineParameters::default() };
        let executor = refsim::machine::ExecutorKind::Batch;
        let mut engine = RayEngine::new(scene.mesh(), profile("ideal-fp24"), executor, parameters).expect("an engine");
        let told = Settings { rounding, ..settings() };
        let picture = whitted::render(&scene, &camera, &told, &mut engine, &mut |_| {}).expect("a picture");
        picture.color.iter().filter(|color| color[0] <= 0.0).count()
    };
    assert_eq!(dark(1.0 / 131_072.0), 0);
    assert!(dark(Settings::default().rounding) > 0, "told that it were single precision, it sees some");
}

#[test]
fn depth_ends_the_hall_of_mirrors() {
    let mut builder = Builder::default();
    let mirror = of(Surface::Mirror { reflectance: [1.0; 3] });
    builder.quad([-1.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], mirror.clone());
    builder.quad([-1.0, -1.0, 1.0], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0], mirror);
    let scene = builder.scene();
    for depth in [0, 1, 7] {
        let picture = render(&scene, &needle([0.1, 0.1, 0.5], [0.1, 0.1, 0.0]), &Settings { depth, ..settings() });
        assert_eq!((picture.counts.of(RayKind::Eye), picture.counts.of(RayKind::Reflection)), (1, u64::from(depth)));
        assert_eq!(picture.color[0], [0.0; 3]);
    }
}
