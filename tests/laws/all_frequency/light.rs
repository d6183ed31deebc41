//! Cube lights: flux, rotation, truncation.

use std::f64::consts::PI;

use crossbar::elementary::sin_cos;
use crossbar::geom::random::CounterRng;
use crossbar::picture::Picture;
use crossbar::sphere::{ClearSky, EnvironmentPicture, HarmonicLight};
use crossbar::transfer::grid::Segmentation;
use crossbar::transfer::light::{CubeLight, DiskSource, HaarLight, TruncationPriority};
use glam::{DMat3, DVec3};

use super::close;

fn turn() -> DMat3 {
    let (sin, cos) = sin_cos(0.7);
    DMat3::from_cols(DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0), DVec3::Z)
        * DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X)
}

fn random_directions(seed: u64, count: u64) -> impl Iterator<Item = DVec3> {
    let random = CounterRng::new(seed);
    (0..count).map(move |at| {
        let z = 2.0 * random.unit(at, 0, 0) - 1.0;
        let (sin, cos) = sin_cos(2.0 * PI * random.unit(at, 0, 1));
        DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z)
    })
}

/// 40 small sources, as in Figure 6.
fn sources() -> Vec<DiskSource> {
    random_directions(7, 40)
        .enumerate()
        .map(|(at, towards)| DiskSource {
            towards,
            radius: 0.03 + 0.001 * at as f64,
            radiance: [5.0, 4.0 + at as f64, 3.0],
        })
        .collect()
}

#[test]
fn a_constant_stays_a_constant() {
    let light = CubeLight::sampled(|_| [1.0, 0.25, 3.0]).expect("a light");
    let off = light.texels().iter().flat_map(|texel| [texel[0] - 1.0, texel[1] - 0.25, texel[2] - 3.0]);
    assert!(off.fold(0.0, |most: f64, off| most.max(off.abs())) < 1e-14);
    close(light.flux()[0], 4.0 * PI, 1e-11, "flux");
}

#[test]
fn a_disk_keeps_its_flux_however_small() {
    for (at, towards) in random_directions(3, 6).chain(DVec3::AXES).chain([DVec3::ONE]).enumerate() {
        for radius in [1e-6, 1e-3, 0.004_654, 0.03, 0.3, 1.5, 3.0, PI] {
            let source = DiskSource { towards: 3.0 * towards, radius, radiance: [1.0, 2.0, 0.0] };
            let light = CubeLight::from_disks(&[source], &DMat3::IDENTITY).expect("a light");
            let half = sin_cos(radius / 2.0).0;
            let expected = 4.0 * PI * half * half;
            for (channel, factor) in [1.0, 2.0, 0.0].into_iter().enumerate() {
                close(light.flux()[channel], factor * expected, 1e-12 * expected, &format!("disk {at} of {radius}"));
            }
            // The covered share of a fine texel is estimated on a grid of eighths of the radius, so it may exceed 1
            // slightly.
            let brightest = light.texels().iter().map(|texel| texel[0]).fold(0.0, f64::max);
            assert!(brightest <= 1.02 || radius < 1e-3, "{brightest}");
        }
    }
}

#[test]
fn disks_turn_with_their_matrix() {
    let (disks, turn) = (sources(), turn());
    let moved: Vec<DiskSource> =
        disks.iter().map(|disk| DiskSource { towards: turn * disk.towards, ..*disk }).collect();
    let [a, b] = [(&disks, &turn), (&moved, &DMat3::IDENTITY)]
        .map(|(disks, turn)| CubeLight::from_disks(disks, turn).expect("a light").flux());
    close(a[1], b[1], 1e-9, "flux");
}

/// The flux of pictures and generated lights equals the flux of their l = 0 harmonic, which is exact.
#[test]
fn generated_lights_have_the_flux_of_their_harmonics() {
    let flux = |light: &HarmonicLight| light.channels().each_ref().map(|channel| channel[0] * (4.0 * PI).sqrt());
    let sky = ClearSky {
        sun: DVec3::new(1.0, -1.0, 1.0),
        sun_radiance: [4e4; 3],
        zenith: [0.25, 0.4, 0.7],
        ground: [0.1; 3],
    };
    let mut pixels = vec![[0.0; 3]; 128 * 64];
    for (at, pixel) in pixels.iter_mut().enumerate() {
        *pixel = [(at % 128) as f32 / 128.0, 1.0 + (at / 128) as f32, 0.5];
    }
    let picture = Picture::rgb(128, 64, &pixels);
    let shown = EnvironmentPicture::new(&picture).expect("an environment");
    for (light, harmonic) in [
        (CubeLight::sky(&sky), sky.light(3).expect("a light")),
        (CubeLight::red_and_blue(), HarmonicLight::red_and_blue(3)),
        (CubeLight::from_picture(&shown), HarmonicLight::from_picture(3, &picture).expect("a light")),
    ] {
        let light = light.expect("a light");
        let found = light.harmonics(3).expect("a light");
        for (found, expected) in found.channels().iter().zip(harmonic.channels()) {
            let squares = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>();
            let off = squares(&mut found.iter().zip(expected).map(|(a, b)| a - b));
            // Texels of 3 degrees spread the sun.
            assert!(off < 1e-5 * squares(&mut expected.iter().copied()), "{found:?} {expected:?}");
        }
        let (found, expected) = (light.flux(), flux(&harmonic));
        for (found, expected) in found.into_iter().zip(expected) {
            // Point samples of a discontinuity at the horizon or between pixels.
            assert!((found / expected - 1.0).abs() < 3e-3, "{found} {expected}");
        }
    }
}

#[test]
fn truncation_keeps_what_was_asked_for() {
    let light = CubeLight::from_disks(&sources(), &DMat3::IDENTITY).expect("a light");
    for segmentation in [Segmentation::Quarters, Segmentation::Faces] {
        let haar = HaarLight::new(&light, segmentation);
        let priorities = [TruncationPriority::Magnitude, TruncationPriority::Area];
        let texel_energy: f64 = light.texels().iter().flatten().map(|value| value * value).sum();
        close(haar.energy(), texel_energy, 1e-12 * texel_energy, "Parseval");
        for keep in [0, 1, 100, 800, 6144] {
            let kept = priorities.map(|priority| haar.truncated(keep, priority));
            for truncated in &kept {
                assert_eq!(truncated.kept, keep.min(haar.nonzero()));
                assert_eq!((truncated.nonzero, truncated.light.nonzero()), (haar.nonzero(), truncated.kept));
                let same = |channel: usize| {
                    let pairs = truncated.light.channels()[channel].iter().zip(&haar.channels()[channel]);
                    pairs.into_iter().all(|(kept, whole)| kept == whole || *kept == 0.0)
                };
                assert!((0..3).all(same));
                close(truncated.kept_energy * truncated.energy, truncated.light.energy(), 1e-9, "kept energy");
            }
            // No selection keeps more energy than the selection of the largest magnitudes.
            assert!(kept.iter().all(|other| other.kept_energy <= kept[0].kept_energy + 1e-12), "{keep}");
            if keep >= haar.nonzero() {
                assert!(kept.iter().all(|all| all.light == haar && all.kept_energy == 1.0));
            }
        }
        let by_area = haar.truncated(60, TruncationPriority::Area);
        assert_ne!(by_area.light, haar.truncated(60, TruncationPriority::Magnitude).light);
    }
}

/// Figure 6: coefficients selected on six faces and drawn in 24 segments represent the same light.
#[test]
fn a_truncated_light_is_reprojected_without_change() {
    let light = CubeLight::from_disks(&sources(), &turn()).expect("a light");
    let faces = HaarLight::new(&light, Segmentation::Faces);
    let truncated = faces.truncated(300, TruncationPriority::Area).light;
    let reprojected = truncated.reprojected(Segmentation::Quarters);
    close(reprojected.energy(), truncated.energy(), 1e-9 * truncated.energy(), "energy");
    let pairs = reprojected.radiances().into_iter().zip(truncated.radiances());
    let off = pairs.flat_map(|(a, b)| [0, 1, 2].map(|k| (a[k] - b[k]).abs())).fold(0.0, f64::max);
    assert!(off < 1e-12, "{off:e}");
    // A wavelet of a whole face becomes up to four wavelets of quarters: more coefficients for the same light.
    assert!(reprojected.nonzero() >= truncated.nonzero());
    assert_eq!(faces.reprojected(Segmentation::Faces).segmentation(), Segmentation::Faces);
}
