//! Compares photons traced through a medium with exact results: counts balance, mean paths depend only on volume and
//! surface, half spaces have the albedo of Chandrasekhar's H function.

use crate::environment::by_form;
use approx::assert_relative_eq;
use crossbar::quadrature::SIXTEEN;
use crossbar::subsurface::fresnel::mean_transmittance;
use crossbar::subsurface::{Coefficients, Dipole};

use super::walk::{self, PhotonEntry, PhotonWalk, WalkTally};

/// Maximum distance in half widths, which one of 10^4 correct results exceeds. The seeds are fixed, so the verdicts are
/// fixed, too.
const FAR: f64 = 2.3;

fn medium(sigma_s_prime: f64, sigma_a: f64, eta: f64, photons: u64) -> PhotonWalk {
    let (coefficients, photons) = (Coefficients { sigma_s_prime, sigma_a }, photons * by_form(1, 50));
    PhotonWalk { coefficients, eta, entry: PhotonEntry::Diffuse, photons, max_steps: 100_000, seed: 1 }
}

fn balanced(tally: &WalkTally, walk: &PhotonWalk) {
    assert_eq!(tally.fates().iter().sum::<u64>(), walk.photons);
}

/// The mean path of light from all directions in a body without absorption. For any scattering, radiance inside is
/// eta^2 times the radiance outside, so the path is 4 V / S times eta^2 over the mean transmittance.
fn mean_path(volume_by_surface: f64, eta: f64) -> f64 {
    4.0 * volume_by_surface * eta * eta / mean_transmittance(eta)
}

#[test]
fn without_absorption_all_photons_leave_a_sphere_after_the_mean_path() {
    for (sigma, eta, radius) in [(1.0, 1.3, 10.0), (0.1, 1.5, 3.0), (4.0, 1.0, 2.0)] {
        let walk = medium(sigma, 0.0, eta, 20_000);
        let tally = walk::sphere(&walk, radius, &[radius, 2.0 * radius]);
        assert_eq!(tally.fates(), [walk.photons, 0, 0]);
        let path = tally.mean_path();
        let exact = mean_path(radius / 3.0, eta);
        assert!(path.distance(exact) < FAR, "sigma {sigma}, eta {eta}: {path:?}, exactly {exact}");
    }
}

/// Chandrasekhar's H function of isotropic scattering at the sixteen points of [0, 1], and the albedo of a half space
/// for a beam at the cosine `mu`: `1 - H(mu) sqrt(1 - albedo)`.
fn half_space_albedo(albedo: f64, mu: f64) -> f64 {
    let root = (1.0 - albedo).sqrt();
    let next = |h: &[f64], mu: f64| {
        let sum: f64 = SIXTEEN.iter().zip(h).map(|(&(x, weight), h)| weight * x * h / (mu + x)).sum();
        1.0 / (root + 0.5 * albedo * sum)
    };
    let mut h = vec![1.0; SIXTEEN.len()];
    for _ in 0..400 {
        h = SIXTEEN.iter().zip(&h).map(|(&(x, _), &old)| 0.5 * (old + next(&h, x))).collect();
    }
    1.0 - root * next(&h, mu)
}

#[test]
fn half_spaces_without_a_boundary_have_chandrasekhars_albedo() {
    assert_relative_eq!(half_space_albedo(1.0, 0.5), 1.0);
    for (albedo, mu) in [(0.5, 1.0), (0.9, 0.3), (0.99, 0.8)] {
        let walk = PhotonWalk { entry: PhotonEntry::Beam(mu), ..medium(albedo, 1.0 - albedo, 1.0, 50_000) };
        let tally = walk::half_space(&walk, &[1.0, 10.0]);
        balanced(&tally, &walk);
        let (total, exact) = (tally.total(), half_space_albedo(albedo, mu));
        assert!(total.distance(exact) < FAR, "albedo {albedo}, cosine {mu}: {total:?}, exactly {exact}");
    }
}

/// Compares the dipole with the walk in a half space, as docs/papers/subsurface.md prints both: bounds of rings in mean
/// free paths, the light that leaves in each ring after a million photons of another seed, and the dipole's share.
#[test]
fn the_dipole_is_as_far_off_as_the_page_says() {
    let walk = PhotonWalk { seed: 7, ..medium(2.21, 0.0012, 1.3, 20_000) };
    let dipole = Dipole::new(walk.coefficients, walk.eta).unwrap();
    let printed = [
        (0.25, 0.0644, 0.0157),
        (1.0, 0.1373, 0.1424),
        (4.0, 0.3258, 0.3442),
        (16.0, 0.3043, 0.3099),
        (64.0, 0.0740, 0.0819),
    ];
    let radii = printed.map(|(paths, _, _)| paths * dipole.mean_free_path());
    let tally = walk::half_space(&walk, &radii);
    balanced(&tally, &walk);
    assert!(tally.total().distance(0.9085) < FAR, "{:?}", tally.total());
    let mut inner = 0.0;
    for (bin, (&(_, walked, ring), outer)) in printed.iter().zip(radii).enumerate() {
        assert!(tally.fraction(bin).distance(walked) < FAR, "ring {bin}: {:?}, printed {walked}", tally.fraction(bin));
        assert_eq!(format!("{:.4}", dipole.ring(inner, outer)), format!("{ring:.4}"));
        inner = outer;
    }
}

#[test]
fn a_large_sphere_is_a_half_space() {
    let walk = medium(1.0, 0.05, 1.3, 20_000);
    let [flat, round] = [walk::half_space(&walk, &[2.0]), walk::sphere(&walk, 1000.0, &[2.0])];
    let gap = (flat.total().mean - round.total().mean).abs();
    assert!(gap < 2.0 * (flat.total().half_width + round.total().half_width), "{gap}");
}
