//! Links to every texel equal equation 9 within a bound that is derived, not measured.
//!
//! The difference of two sums `sum over j of F_ij E_j` is at most the sum of E_j times the errors of both factors.
//!
//! *The links'*: the tolerance t times F_ij, and t times 1e-5 of the plane's total, as `Factors` promises.
//!
//! *The reference's*, for parts within the radii p and q of their mean points at distance d: with `s = r^2 + z^2` each
//! term of R_d is `g(s) = z (sigma s^-1 + s^(-3/2)) e^(-sigma sqrt s)`, whose derivatives alternate in sign and fall
//! with s. Along a direction u its second and third derivatives are
//! `2 g' + 4 g'' (r.u)^2` and `12 g'' (r.u) + 8 g''' (r.u)^3`: of terms of opposite signs the larger bounds the sum.
//!
//! - A far pair counts with R_d between mean points. First-order terms cancel in the mean, and the rest is at most half
//!   the largest second derivative times `p^2 + q^2`.
//! - A near pair is summed by positive weights that are exact to second order in both points, so sum and integral agree
//!   on the second-order polynomial, and the error of each is at most a sixth of the largest third derivative times `(p
//!   + q)^3`.

use crossbar::atlas::Atlas;
use crossbar::subsurface::links::{IrradianceMeans, LinkChoice, Links, MeanWeighting};
use crossbar::subsurface::{Dipole, Reference};
use glam::DVec3;

use super::links_models::{atlas, figure_7, medium, sphere, surface};

const SIDE: u32 = 16;
/// Distance from which the reference uses mean points of a pair, in sums of radii.
const NEAR: f64 = 5.0;

/// The largest second and third derivatives of R_d at distances of `least` to `most`.
fn derivatives(dipole: &Dipole, [least, most]: [f64; 2]) -> [f64; 2] {
    let sigma = dipole.sigma_tr();
    let mut sums = [0.0; 2];
    for z in [dipole.z_r(), dipole.z_v()] {
        let u = (least * least + z * z).sqrt();
        let falling = z * dipole.alpha_prime() / (4.0 * std::f64::consts::PI) * crossbar::elementary::exp(-sigma * u);
        let polynomial = |terms: &[f64]| terms.iter().fold(0.0, |sum, term| sum * sigma * u + term);
        // Derivatives with respect to s, without their signs.
        let square = u * u;
        let first = falling / 2.0 * polynomial(&[1.0, 3.0, 3.0]) / (square * square * u);
        let second = falling / 4.0 * polynomial(&[1.0, 6.0, 15.0, 15.0]) / (square * square * square * u);
        let third =
            falling / 8.0 * polynomial(&[1.0, 10.0, 45.0, 105.0, 105.0]) / (square * square * square * square * u);
        sums[0] += (2.0 * first).max(4.0 * second * most * most);
        sums[1] += (12.0 * second * most).max(8.0 * third * most * most * most);
    }
    sums
}

/// Texels as the reference sees them, in mm: mean points, areas, radii.
fn parts(atlas: &Atlas, mm_per_unit: f64) -> Vec<(DVec3, f64, f64)> {
    let part = |(index, texel): (u32, &crossbar::atlas::Texel)| {
        let part = atlas.part(index);
        let corners = part.polygons().flatten();
        let radius = corners.map(|corner| corner.distance(texel.point)).fold(0.0, f64::max);
        (mm_per_unit * texel.point, mm_per_unit * mm_per_unit * texel.area, mm_per_unit * radius)
    };
    (0..).zip(atlas.texels()).map(part).collect()
}

/// Error bound of a factor of the reference.
fn reference_error(dipole: &Dipole, from: (DVec3, f64, f64), to: (DVec3, f64, f64)) -> f64 {
    let (distance, reach) = (from.0.distance(to.0), from.2 + to.2);
    let [second, third] = derivatives(dipole, [(distance - reach).max(0.0), distance + reach]);
    let far = 0.5 * second * (from.2 * from.2 + to.2 * to.2);
    let near = 2.0 / 6.0 * third * reach * reach * reach;
    // Rounding may decide which of the two the reference chooses.
    let error = if (distance / (NEAR * reach) - 1.0).abs() < 1e-9 {
        far.max(near)
    } else if distance < NEAR * reach {
        near
    } else {
        far
    };
    to.1 * error
}

fn uneven(k: usize) -> f64 {
    0.1 + (k * 7919 % 31) as f64 / 31.0
}

#[test]
fn links_to_every_texel_are_equation_9_within_the_derived_bound() {
    let atlas = atlas(&sphere(3, 0.2), SIDE);
    let light: Vec<f64> = (0..(SIDE * SIDE) as usize).map(uneven).collect();
    let values: Vec<[f64; 3]> = light.iter().map(|value| [*value; 3]).collect();
    let (mut loosest, mut nearest) = (0.0_f64, 0.0_f64);
    // Texels of at most a tenth of a mean free path. The smaller they are, the closer the bound is to the tolerance.
    for (mm_per_unit, dipole) in
        [(0.2, figure_7()), (0.2, medium(1.0, 0.3)), (0.05, medium(3.0, 0.0)), (0.05, figure_7()), (0.02, figure_7())]
    {
        loosest = 0.0;
        let surface = surface(&atlas, mm_per_unit);
        let parts = parts(&atlas, mm_per_unit);
        let reference = Reference::new(&atlas, mm_per_unit, &dipole).expect("a scale");
        let exact = reference.radiosity(&light, &mut |_, _| ()).expect("one per texel");
        let means = IrradianceMeans::new(&surface, &values, MeanWeighting::Area).expect("one per texel");
        for tolerance in [0.01, 0.001] {
            let links = Links::new(&surface, &[dipole], LinkChoice::Fixed { level: 0 }, tolerance, &|_, _| ());
            let found = links.expect("links").gather(&means);
            for (i, (found, exact)) in found.iter().zip(&exact).enumerate() {
                let mut bound = 0.0;
                for (j, light) in light.iter().enumerate() {
                    let off = reference_error(&dipole, parts[i], parts[j]);
                    let factor = reference.factor(i, j) + off;
                    bound += light * (off + tolerance * (factor + 1e-5 * dipole.total()) + 1e-7 * factor);
                }
                let difference = (found[0] - exact).abs();
                assert!(difference <= bound, "{mm_per_unit} mm, {tolerance}, texel {i}: {difference} of {bound}");
                loosest = loosest.max(bound / exact / tolerance.max(0.01));
                nearest = nearest.max(difference / bound);
            }
        }
    }
    assert!(loosest < 4.0, "the last bound is {loosest} per cent of B: it says nothing");
    assert!(nearest > 1e-4, "the bound is {} times the largest difference", 1.0 / nearest);
}

/// Compares the derivatives in the bound with differences of R_d along a line.
#[test]
fn the_bound_s_derivatives_are_those_of_r_d() {
    for dipole in [figure_7(), medium(1.0, 0.3), medium(3.0, 0.0)] {
        for r in [0.05, 0.3, 1.0, 4.0] {
            let h = 1e-3 * (r + dipole.z_r());
            let at = |k: f64| dipole.r_d((r + k * h).abs());
            let second = (at(1.0) - 2.0 * at(0.0) + at(-1.0)) / (h * h);
            let third = (at(2.0) - 2.0 * at(1.0) + 2.0 * at(-1.0) - at(-2.0)) / (2.0 * h * h * h);
            let [most_second, most_third] = derivatives(&dipole, [r, r]);
            assert!(second.abs() <= most_second * 1.001, "{r}: {second} and {most_second}");
            assert!(third.abs() <= most_third * 1.001, "{r}: {third} and {most_third}");
        }
    }
}
