//! Renderers that estimate the same integral agree, pixel by pixel, within their standard errors.

use crossbar::renderer::path::Direct;
use crossbar::renderer::{RayKind, RenderedPicture, Settings};
use crossbar::scene::{Scene, Surface};

use super::{by_distributed_rays, by_paths, host, of, room, room_camera, settings, white};

/// Maximum number of standard deviations between two pixels: with a normal distribution, one of 1.7 million channels
/// exceeds it, so a correct picture of 16 x 16 fails once in 2,000 seeds.
const PIXEL_FAR: f64 = 5.0;

fn paths(scene: &Scene, settings: &Settings, direct: Direct) -> RenderedPicture {
    of_size(16, scene, settings, direct)
}

fn of_size(size: u32, scene: &Scene, settings: &Settings, direct: Direct) -> RenderedPicture {
    by_paths(scene, &room_camera(size, size), settings, direct)
}

/// Side of small pictures. Walks rarely find the lamp, so a pixel needs many samples before its mean is normally
/// distributed.
const FEW: u32 = 4;
/// 96 samples for each of 16 x 16 pixels.
const MANY: u32 = 96 * 16;

/// Compares pixel by pixel, and checks the mean square of all deviations: its expectation is 1, and its standard
/// deviation about (2 / n)^(1/2), more for long tails.
fn agree(a: &RenderedPicture, b: &RenderedPicture) {
    let (mut squares, mut count, mut sum, mut spread) = (0.0, 0.0, 0.0, 0.0);
    for pixel in 0..a.color.len() {
        for channel in 0..3 {
            let variance = a.variance[pixel][channel] + b.variance[pixel][channel];
            let off = a.color[pixel][channel] - b.color[pixel][channel];
            if variance == 0.0 {
                assert!(off.abs() < 1e-9, "pixel {pixel}: no chance, and {off} off");
                continue;
            }
            assert!(
                off * off < PIXEL_FAR * PIXEL_FAR * variance,
                "pixel {pixel}: {off} off, spread {}",
                variance.sqrt()
            );
            squares += off * off / variance;
            count += 1.0;
            sum += off;
            spread += variance;
        }
    }
    // Channels of a pixel are correlated: only a third of them is independent.
    let wide = 5.0 * (2.0 / (count / 3.0_f64)).sqrt();
    assert!(count > 0.0, "something was left to chance");
    assert!((squares / count - 1.0).abs() < wide, "mean square {} of {count}", squares / count);
    assert!(sum * sum < 16.0 * 3.0 * spread, "together {sum} off, spread {}", spread.sqrt());
}

#[test]
fn three_ways_to_the_lamp() {
    let scene = room(1.6, &white(0.5));
    let settings = |seed, samples| Settings { samples, depth: 4, seed, ..settings() };
    agree(&paths(&scene, &settings(1, 96), Direct::Both), &paths(&scene, &settings(3, 96), Direct::Emitters));
    let few = |seed, direct| of_size(FEW, &scene, &settings(seed, MANY), direct);
    agree(&few(1, Direct::Both), &few(2, Direct::Walk));
}

#[test]
fn roulette_does_not_show() {
    // Paths of up to 3 hits use no roulette; paths of 12 do.
    let gloss = of(Surface::Glossy { albedo: [0.3; 3], specular: [0.6, 0.5, 0.4], exponent: 20.0 });
    let scene = room(1.6, &gloss);
    let settings = |seed| Settings { samples: MANY, depth: 12, seed, ..settings() };
    let few = |seed, direct| of_size(FEW, &scene, &settings(seed), direct);
    let both = few(4, Direct::Both);
    agree(&both, &few(5, Direct::Walk));
    agree(&both, &few(6, Direct::Emitters));
}

#[test]
fn distributed_rays_are_paths_with_one_diffuse_hit() {
    let scene = room(1.0, &white(0.5));
    let once = |seed| Settings { samples: 64, depth: 1, seed, ..settings() };
    let camera = room_camera(16, 16);
    agree(&by_distributed_rays(&scene, &camera, &once(6)), &paths(&scene, &once(7), Direct::Both));
    // A mirror in between: both renderers have one more hit, and there is no light path between diffuse surfaces that
    // only the walk finds.
    let mirror = room(1.0, &of(Surface::Mirror { reflectance: [0.9; 3] }));
    assert!(by_distributed_rays(&mirror, &camera, &once(8)).counts.of(RayKind::Reflection) > 0);
}

#[test]
fn a_lens_is_sharp_at_its_focus() {
    use crossbar::renderer::{Lens, eye};
    use crossbar::scene::Camera;
    // A wall of two shades seen from the front: with the wall in focus the edge stays sharp, otherwise it blurs.
    let mut builder = super::Builder::default();
    builder.quad([-4.0, -4.0, 0.0], [4.0, 0.0, 0.0], [0.0, 8.0, 0.0], white(0.25));
    builder.quad([0.0, -4.0, 0.0], [4.0, 0.0, 0.0], [0.0, 8.0, 0.0], white(1.0));
    let scene = builder.scene();
    let camera = Camera::new([0.0, 0.0, 5.0], [0.0; 3], [0.0, 1.0, 0.0], 0.4, 16, 1).expect("a camera");
    let shades = |focus| {
        let lens = Some(Lens { radius: 0.5, focus });
        let settings = Settings { samples: 64, lens, ..settings() };
        let picture = eye::render(&scene, &camera, &settings, &mut host(&scene), &mut |_| {}).expect("a picture");
        // Pixels that mix both shades.
        picture.variance.iter().filter(|variance| variance[0] > 1e-4).count()
    };
    assert_eq!(shades(5.0), 0);
    assert!(shades(2.5) >= 2);
}
