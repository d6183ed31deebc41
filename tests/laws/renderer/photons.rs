//! Photon maps: bounds on their bias.

use crate::environment::by_form;
use crossbar::renderer::path::Direct;
use crossbar::renderer::photon::Photons;
use crossbar::renderer::{RayKind, RenderedPicture, Settings};
use crossbar::scene::{Material, Scene, Surface};

use super::{by_paths, by_photons, of, room, room_camera, settings, white};

/// The mean of a picture and its variance, without the pixels that show the lamp.
fn mean(picture: &RenderedPicture, scene: &Scene) -> [[f64; 2]; 3] {
    let (mut sums, mut count) = ([[0.0; 2]; 3], 0.0);
    for pixel in 0..picture.color.len() {
        if picture.first[pixel].is_some_and(|hit| !scene.material(hit.triangle).emits()) {
            for (channel, [sum, variance]) in sums.iter_mut().enumerate() {
                *sum += picture.color[pixel][channel];
                *variance += picture.variance[pixel][channel];
            }
            count += 1.0;
        }
    }
    sums.map(|[sum, variance]| [sum / count, variance / (count * count)])
}

/// The means of both renderers in a room differ relatively by at most `bound`, after 3 standard deviations are
/// subtracted. The photons are also random, but shared by all pixels; their error is part of the bound.
fn assert_bias_below(bound: f64, block: &Material, gather: u32) {
    let scene = room(1.0, block);
    let camera = room_camera(12, 12);
    // With `CROSSBAR_FULL=1`, enough samples that little more than the bias remains.
    let full = by_form(1, 20);
    let settings = |samples: u32| Settings { samples: samples * full, depth: 30, ..settings() };
    let photons = Photons { global: 20_000, caustic: 20_000, nearest: 50, radius: 0.3, gather };
    let mapped = by_photons(&scene, &camera, &settings(16), &photons);
    assert!(mapped.counts.of(RayKind::Photon) >= 20_000 && mapped.not_finite == 0);
    let walked = by_paths(&scene, &camera, &settings(144), Direct::Both);
    let (a, b) = (mean(&mapped, &scene), mean(&walked, &scene));
    for channel in 0..3 {
        let ([mapped, chance], [walked, more]) = (a[channel], b[channel]);
        let (bias, chance) = (mapped / walked - 1.0, 3.0 * (chance + more).sqrt() / walked);
        assert!(bias.abs() < bound + chance, "channel {channel}: {bias}, of which {chance} may be chance");
    }
}

/// With final gather the maps are only visible through another surface, so their blur hardly matters.
#[test]
fn gathered_photons_agree_with_paths() {
    assert_bias_below(0.02, &white(0.5), 6);
    assert_bias_below(0.03, &of(Surface::Mirror { reflectance: [0.9; 3] }), 6);
}

/// Glass lights the floor by caustics alone, which the caustic map blurs over at most 0.3 of a room of 2. The floor
/// below the glass is included: there flux and radiance differ by the square of the index.
#[test]
fn caustics_keep_their_energy() {
    assert_bias_below(0.03, &of(Surface::Glass { index: 1.5, transmittance: [1.0; 3] }), 6);
}

/// A directly visible map loses the parts of its estimation disks that extend beyond edges.
#[test]
fn the_map_itself_is_near() {
    assert_bias_below(0.05, &white(0.5), 0);
}
