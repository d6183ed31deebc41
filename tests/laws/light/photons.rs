//! Photon maps: biased, and by how much.

use crossbar::renderer::path::Direct;
use crossbar::renderer::photon::{self, Photons};
use crossbar::renderer::{Picture, Settings, path};
use crossbar::scene::{Material, Scene, Surface};

use super::{host, of, room, room_camera, settings, white};

/// The mean of a picture, the lamp's own pixels left out.
fn mean(picture: &Picture, scene: &Scene) -> [f64; 3] {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for (color, hit) in picture.color.iter().zip(&picture.first) {
        if hit.is_some_and(|hit| !scene.material(hit.triangle).emits()) {
            sum = [0, 1, 2].map(|channel| sum[channel] + color[channel]);
            count += 1.0;
        }
    }
    sum.map(|channel| channel / count)
}

/// The largest difference of the means of a room by both renderers, as a share.
fn bias(block: &Material, gather: u32) -> f64 {
    let scene = room(1.0, block);
    let camera = room_camera(12, 12);
    let settings = |samples| Settings { samples, depth: 30, ..settings() };
    let photons = Photons { global: 20_000, caustic: 20_000, nearest: 50, radius: 0.3, gather };
    let mapped = photon::render(&scene, &camera, &settings(16), &photons, &mut host(&scene), &mut |_| {});
    let mapped = mapped.expect("a picture");
    assert!(mapped.counts.photon >= 20_000 && mapped.not_finite == 0);
    let walked = path::render(&scene, &camera, &settings(144), Direct::Both, &mut host(&scene), &mut |_| {});
    let (a, b) = (mean(&mapped, &scene), mean(&walked.expect("a picture"), &scene));
    (0..3).map(|channel| (a[channel] / b[channel] - 1.0).abs()).fold(0.0, f64::max)
}

/// With final gather the maps are only seen by way of another surface: edges of disks and blur come to less than 3 % of the mean, and chance to 1 %.
#[test]
fn gathered_photons_agree_with_paths() {
    for block in [white(0.5), of(Surface::Mirror { reflectance: [0.9; 3] })] {
        let bias = bias(&block, 6);
        assert!(bias < 0.04, "{bias}");
    }
}

/// Glass lights the floor by caustics alone, which the caustic map blurs over at most 0.3 of a room of 2.
#[test]
fn caustics_keep_their_energy() {
    let bias = bias(&of(Surface::Glass { index: 1.5, transmittance: [1.0; 3] }), 6);
    assert!(bias < 0.06, "{bias}");
}

/// The map seen directly loses what of its disks hangs over edges.
#[test]
fn the_map_itself_is_near() {
    let bias = bias(&white(0.5), 0);
    assert!(bias < 0.15, "{bias}");
}
