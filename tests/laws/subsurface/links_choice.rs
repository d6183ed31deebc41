//! Laws of links: they tile the atlas once, gather with their factors, and do not depend on the number of threads.

use approx::assert_relative_eq;
use crossbar::subsurface::Dipole;
use crossbar::subsurface::links::{EncodedLinks, IrradianceMeans, LinkChoice, LinkPlace, Links, MeanWeighting};
use crossbar::subsurface::multipole::{ClusterId, Factors, SurfaceMoments};
use refsim::num::Format;

use super::links_models::{atlas, figure_7, medium, root, sphere, surface, texels};

const SIDE: u32 = 16;

fn links(surface: &SurfaceMoments, dipoles: &[Dipole], choice: LinkChoice) -> Links {
    Links::new(surface, dipoles, choice, 0.01).expect("links")
}

fn dented() -> SurfaceMoments {
    surface(&atlas(&sphere(3, 0.2), SIDE), 4.0)
}

/// The used links of a texel cover every texel once, in the largest number of the form 1 + 3 k if they are adaptive.
/// Uniform light gathers the sum of their factors, which is the factor of the whole surface.
#[test]
fn links_tile_the_atlas_and_gather_the_row_sum() {
    let surface = dented();
    let factors = Factors::new(&surface, [figure_7()], 0.01).expect("a tolerance");
    let wholes: Vec<[f64; 1]> = texels(SIDE).map(|texel| factors.factor(texel, root(&surface))).collect();
    let ones = vec![[1.0; 3]; (SIDE * SIDE) as usize];
    let means = IrradianceMeans::new(&surface, &ones, MeanWeighting::Area).expect("one per texel");
    let fixed = (0..5).map(|level| LinkChoice::Fixed { level });
    let adaptive = [1, 2, 3, 4, 15, 16, 17, 31, 32, 64, 255, 256, 300].map(|count| LinkChoice::Adaptive { count });
    for choice in fixed.chain(adaptive) {
        let links = links(&surface, &[figure_7()], choice);
        for ((texel, found), [whole]) in texels(SIDE).zip(links.gather(&means)).zip(&wholes) {
            let mut covered = vec![0; (SIDE * SIDE) as usize];
            let (mut used, mut sum) = (0, 0.0);
            // Padding has the factor 0, which no link has.
            for (ClusterId { level, y, x }, factor) in links.of(texel).filter(|(_, factor)| factor[0] > 0.0) {
                let size = 1 << level;
                for (v, u) in (0..size).flat_map(|v| (0..size).map(move |u| (v, u))) {
                    covered[((y * size + v) * SIDE + x * size + u) as usize] += 1;
                }
                used += 1;
                sum += f64::from(factor[0]);
            }
            assert!(covered.iter().all(|count| *count == 1), "{choice:?} at {texel:?}: {covered:?}");
            assert_relative_eq!(found[0], sum, max_relative = 1e-13);
            assert_relative_eq!(found[1], *whole, max_relative = 0.01);
            if let LinkChoice::Adaptive { count } = choice
                && count <= 64
            {
                assert_eq!((links.per_texel(), used), (count, 1 + (count - 1) / 3 * 3));
            }
        }
    }
}

/// An irradiance without symmetry.
fn uneven(k: usize) -> f64 {
    let k = k as u64;
    ((k * 2_654_435_761 + 12345) % 1000) as f64 / 1000.0
}

/// The card's map holds E a / (mean a), so stored factors times its plain means equal factors times area-weighted
/// means.
#[test]
fn stored_factors_make_plain_means_weigh_by_area() {
    let surface = dented();
    let light: Vec<[f64; 3]> = (0..256).map(|k| [uneven(k); 3]).collect();
    let mean_area = surface.area() / 256.0;
    let map: Vec<[f64; 3]> = texels(SIDE)
        .zip(&light)
        .map(|([x, y], value)| value.map(|v| v * surface.cluster_area(ClusterId { level: 0, y, x }) / mean_area))
        .collect();
    let plain = IrradianceMeans::new(&surface, &map, MeanWeighting::Count).expect("one per texel");
    let by_area = IrradianceMeans::new(&surface, &light, MeanWeighting::Area).expect("one per texel");
    let links = links(&surface, &[figure_7()], LinkChoice::Fixed { level: 2 });
    let encoded = EncodedLinks::new(&links, &surface, MeanWeighting::Area);
    assert_eq!((encoded.texture_count(), links.per_texel()), (4, 16));
    let textures: Vec<_> = (0..4).map(|k| encoded.texture(k)).collect();
    for (k, exact) in links.gather(&by_area).iter().enumerate() {
        let mut sum = 0.0;
        for (link, (cluster, _)) in links.of([0, 0]).enumerate() {
            sum += f64::from(textures[link / 4].texels[k][link % 4]) * plain.of(cluster)[0];
        }
        assert_relative_eq!(sum, exact[0], max_relative = 1e-6);
    }
}

#[test]
fn textures_are_laid_out_as_the_page_says() {
    let surface = dented();
    let dipoles = [medium(2.19, 0.0021), medium(2.62, 0.0041), medium(3.0, 0.0071)];
    let count = |dipoles: &[Dipole], choice| {
        let links = links(&surface, dipoles, choice);
        EncodedLinks::new(&links, &surface, MeanWeighting::Count).texture_count()
    };
    let (fixed, adaptive) = (LinkChoice::Fixed { level: 2 }, LinkChoice::Adaptive { count: 16 });
    assert_eq!([count(&dipoles[..1], fixed), count(&dipoles, fixed)], [4, 12]);
    assert_eq!([count(&dipoles[..1], adaptive), count(&dipoles, adaptive)], [16, 32]);

    let rgb = links(&surface, &dipoles, adaptive);
    let encoded = EncodedLinks::new(&rgb, &surface, MeanWeighting::Count);
    let (place, factors) = (encoded.texture(6), encoded.texture(7));
    for (k, texel) in texels(SIDE).enumerate() {
        let (cluster, found) = rgb.of(texel).nth(3).expect("a link");
        let LinkPlace { u, v, level } = LinkPlace::new(SIDE, cluster);
        assert_eq!(place.texels[k], [u, v, found[0], level]);
        assert_eq!(factors.texels[k], [found[0], found[1], found[2], 0.0]);
    }
}

#[test]
fn places_are_exact_in_fp16_up_to_1024_and_half_of_them_are_not_at_2048() {
    let rounded = |value: f32| {
        let bits = refsim::num::ops::convert(&Format::FP32, Format::FP16, value.to_bits()).bits;
        refsim::num::to_f64(&Format::FP16, bits)
    };
    let wrong = |side: u32| {
        (0..side)
            .filter(|&x| {
                let u = LinkPlace::new(side, ClusterId { level: 0, y: 0, x }).u;
                rounded(u) != f64::from(u)
            })
            .count()
    };
    assert_eq!([64, 512, 1024, 2048].map(wrong), [0, 0, 0, 1024]);
}

#[test]
fn lost_factors_are_counted() {
    // Green light of a dense absorber on a large model: factors at large distances vanish.
    let surface = surface(&atlas(&sphere(3, 0.2), SIDE), 20.0);
    let links = links(&surface, &[medium(0.74, 0.3)], LinkChoice::Fixed { level: 2 });
    let encoded = EncodedLinks::new(&links, &surface, MeanWeighting::Count);
    let lost = encoded.lost(Format::FP16);
    let used = || links.factors().iter().filter(|factor| **factor > 0.0);
    assert_eq!(lost.factors, used().count());
    let exp2 = |exponent: i32| refsim::num::power_of_two(exponent) as f32;
    assert_eq!(lost.flushed, used().filter(|factor| **factor <= exp2(-25)).count());
    assert!(lost.flushed > 0 && lost.denormal > 0, "{lost:?}");
    let below = used().filter(|factor| **factor < exp2(-14)).count();
    assert_eq!(lost.flushed + lost.denormal, below);
    assert_eq!(encoded.lost(Format::FP32).flushed, 0);
}

#[test]
fn bad_choices_are_refused() {
    let surface = dented();
    let one = &[figure_7()][..];
    for (dipoles, choice) in [
        (one, LinkChoice::Fixed { level: 5 }),
        (one, LinkChoice::Adaptive { count: 0 }),
        (one, LinkChoice::Adaptive { count: usize::MAX / 16 }),
        (&[figure_7(); 2], LinkChoice::Fixed { level: 2 }),
    ] {
        assert!(Links::new(&surface, dipoles, choice, 0.01).is_err(), "{choice:?}");
    }
    assert!(IrradianceMeans::new(&surface, &[[1.0; 3]; 7], MeanWeighting::Area).is_err());
}
