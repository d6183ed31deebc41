//! The dipole's own error, from a photon random walk through a half space with a smooth boundary. Without the boundary,
//! the albedo of the walk must match Chandrasekhar's H function.

use std::f64::consts::TAU;

use crate::environment::by_form;
use approx::assert_relative_eq;
use crossbar::elementary::{ln, sin_cos};
use crossbar::geom::random::CounterRng;
use crossbar::quadrature::SIXTEEN;
use crossbar::subsurface::fresnel_transmittance;
use glam::DVec3;
use rayon::prelude::*;

use super::links_models::figure_7;

/// Standard deviations that a correct result exceeds in one of 10^5 cases.
const FAR: f64 = 4.5;

/// A half space, with lengths in mean free paths.
#[derive(Clone, Copy)]
struct HalfSpace {
    albedo: f64,
    eta: f64,
    /// The cosine of the angle of incidence of a beam; `None` for equal radiance from all directions.
    beam: Option<f64>,
    seed: u64,
}

fn around(cosine: f64, turn: f64) -> DVec3 {
    let ((sin, cos), sine) = (sin_cos(TAU * turn), (1.0 - cosine * cosine).max(0.0).sqrt());
    DVec3::new(sine * cos, sine * sin, cosine)
}

impl HalfSpace {
    /// Follows a photon that has passed the boundary at the origin: exponentially distributed steps, absorbed or
    /// scattered isotropically at the end of each, reflected by Fresnel's formula at the boundary. Returns the squared
    /// distance at which it leaves; `None` if it is absorbed.
    fn leaves(self, photon: u64) -> Option<f64> {
        let (stream, mut event) = (CounterRng::new(self.seed), 0);
        let mut pair = || {
            let bits = stream.bits(photon, event, 0);
            event += 1;
            [bits >> 32, bits & 0xffff_ffff].map(|half| (half as f64 + 0.5) / 4_294_967_296.0)
        };
        let outside = self.beam.unwrap_or_else(|| {
            loop {
                let [u, v] = pair();
                if v < fresnel_transmittance(self.eta, u.sqrt()) {
                    break u.sqrt();
                }
            }
        });
        let (square, [turn, _]) = ((1.0 - outside * outside) / (self.eta * self.eta), pair());
        let (mut at, mut direction) = (DVec3::ZERO, around((1.0 - square).sqrt(), turn));
        loop {
            let [u, chance] = pair();
            let (step, length) = (-ln(u), if direction.z < 0.0 { at.z / -direction.z } else { f64::INFINITY });
            at += step.min(length) * direction;
            at.z = at.z.max(0.0);
            if step < length {
                if chance >= self.albedo {
                    return None;
                }
                let [u, turn] = pair();
                direction = around(1.0 - 2.0 * u, turn);
            } else if pair()[0] < fresnel_transmittance(1.0 / self.eta, -direction.z) {
                return Some(at.length_squared());
            } else {
                direction.z = -direction.z;
            }
        }
    }

    /// Requires that these shares of the photons leave: in the rings between consecutive radii, which are ascending, and
    /// in all.
    fn require(self, photons: u64, shares: &[f64], radii: &[f64], total: f64) {
        let photons = photons * by_form(1, 50);
        let squares: Vec<f64> = (0..photons).into_par_iter().filter_map(|photon| self.leaves(photon)).collect();
        let mut inner = 0.0;
        for (share, radius) in shares.iter().zip(radii).map(|(&s, &r)| (s, r)).chain([(total, f64::INFINITY)]) {
            inner = if radius.is_finite() { inner } else { 0.0 };
            let left = squares.iter().filter(|&&square| (inner..radius * radius).contains(&square)).count() as f64;
            let deviation = (photons as f64 * share * (1.0 - share)).sqrt();
            let off = (left - photons as f64 * share) / deviation;
            assert!(off.abs() < FAR, "within {radius}: {left} of {photons}, {off} standard deviations from {share}");
            inner = radius * radius;
        }
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
        let medium = HalfSpace { albedo, eta: 1.0, beam: Some(mu), seed: 1 };
        medium.require(50_000, &[], &[], half_space_albedo(albedo, mu));
    }
}

/// Compares the dipole with the walk in a half space, as in docs/papers/subsurface.md: radii of rings in mean free
/// paths, the share of a million other photons that leaves in each ring, and the dipole's share.
#[test]
fn the_dipole_is_as_far_off_as_the_page_says() {
    let dipole = figure_7();
    let walked = [0.0644, 0.1373, 0.3258, 0.3043, 0.0740];
    let (paths, rings) = ([0.25, 1.0, 4.0, 16.0, 64.0], ["0.0157", "0.1424", "0.3442", "0.3099", "0.0819"]);
    let medium = HalfSpace { albedo: dipole.alpha_prime(), eta: 1.3, beam: None, seed: 7 };
    medium.require(20_000, &walked, &paths, 0.9085);
    let radii = paths.map(|paths| paths * dipole.mean_free_path());
    let inner = [0.0].into_iter().chain(radii);
    let found: Vec<String> =
        inner.zip(radii).map(|(inner, outer)| format!("{:.4}", dipole.ring(inner, outer))).collect();
    assert_eq!(found, rings);
}
