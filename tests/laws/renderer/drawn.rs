//! Compares eye rays and mirrors that a card draws with traced ones.

use crossbar::card::RasterizedEyes;
use crossbar::geom::exact::Sides;
use crossbar::io::scenes;
use crossbar::renderer::environment::{self, EnvironmentCard};
use crossbar::renderer::{RenderedPicture, Settings, whitted};
use crossbar::scene::{Camera, Surface};
use crossbar::tracer::HostTracer;
use refsim::machine::{Executor, ExecutorKind};

use super::{Builder, by_whitted_rays, lamp, of, settings};
use crate::support::profile;

/// Fraction of the pixels in which a channel differs by more than two 255ths.
fn differing(one: &RenderedPicture, other: &RenderedPicture) -> f64 {
    let far = |(a, b): &(&[f64; 3], &[f64; 3])| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 2.0 / 255.0);
    one.color.iter().zip(&other.color).filter(far).count() as f64 / one.color.len() as f64
}

/// Except at edges, a card's rasterizer finds what rays through pixel centers hit; all further rays are traced as
/// before.
#[test]
fn drawn_eye_rays_see_what_cast_ones_hit() {
    let scene = scenes::named("cornell-box").expect("a scene");
    let camera = scene.views[0].camera(48, 48).expect("a camera");
    let settings = Settings::default();
    let cast = by_whitted_rays(&scene, &camera, &settings);
    let mut host = HostTracer::new(scene.mesh(), Sides::Both);
    let mut eyes = RasterizedEyes::new(&profile("r200"), scene.mesh(), camera, &mut host).expect("a raster");
    let drawn = whitted::render(&scene, &camera, &settings, &mut eyes, &mut |_| {}).expect("a picture");
    assert_eq!(eyes.drawn, 48 * 48);
    let other = cast.first.iter().zip(&drawn.first).filter(|(a, b)| a.map(|a| a.triangle) != b.map(|b| b.triangle));
    assert!(other.count() < 48 * 48 / 100);
    let off = cast.first.iter().zip(&drawn.first).filter_map(|(a, b)| {
        let (a, b) = (a.as_ref()?, b.as_ref()?);
        (a.triangle == b.triangle).then(|| f64::from((a.t - b.t).abs() / a.t))
    });
    // The card rounds vertices to its subpixel grid.
    let most = off.fold(0.0, f64::max);
    assert!(most < 0.03, "{most}: depths along the view");
    assert!(differing(&cast, &drawn) < 0.01);
}

/// A mirror under a ceiling that is far away shows the quarters of the ceiling where rays find them, so the map's faces
/// have the right orientation. A near ceiling appears displaced.
#[test]
fn an_environment_map_is_right_for_what_is_far_away() {
    let mirror = Surface::Mirror { reflectance: [0.9, 0.6, 0.3] };
    let with_ceiling = |height: f32| {
        let mut builder = Builder::default();
        builder.quad([-0.1, -0.1, 0.0], [0.2, 0.0, 0.0], [0.0, 0.2, 0.0], of(mirror));
        for (x, y, color) in [
            (-1.0, -1.0, [0.9, 0.1, 0.1]),
            (0.0, -1.0, [0.1, 0.9, 0.1]),
            (-1.0, 0.0, [0.1, 0.1, 0.9]),
            (0.0, 0.0, [0.6; 3]),
        ] {
            let corner = [height * x, height * y, height];
            builder.quad(corner, [0.0, height, 0.0], [height, 0.0, 0.0], lamp(color));
        }
        builder.scene()
    };
    let camera = Camera::new([0.05, 0.03, 0.4], [0.05, 0.03, 0.0], [0.0, 1.0, 0.0], 0.15, 32, 32).expect("a camera");
    let executor = Executor::from(ExecutorKind::Batch);
    for device in ["r200", "ideal-fp32"] {
        let difference = |height: f32| {
            let (scene, profile) = (with_ceiling(height), profile(device));
            let card = EnvironmentCard { profile: &profile, executor: &executor };
            let mut host = HostTracer::new(scene.mesh(), Sides::Both);
            let drawn = environment::render(&scene, &camera, &settings(), card, &mut host, &mut |_| {}).expect("drawn");
            differing(&by_whitted_rays(&scene, &camera, &settings()), &drawn)
        };
        let [far, near] = [difference(100.0), difference(0.5)];
        assert!(far < 0.15 && near > far + 0.1, "{device}: {far}, {near}");
    }
    let more = Settings { samples: 4, ..settings() };
    let (scene, profile) = (with_ceiling(100.0), profile("r200"));
    let card = EnvironmentCard { profile: &profile, executor: &executor };
    let mut host = HostTracer::new(scene.mesh(), Sides::Both);
    let refused = environment::render(&scene, &camera, &more, card, &mut host, &mut |_| {});
    assert!(refused.expect_err("refused").to_string().contains("one sample per pixel"));
}
