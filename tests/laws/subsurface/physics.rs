//! The dipole and the boundary: compares closed forms with quadrature, and checks figures that follow from the paper's
//! material.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use crossbar::elementary::{exp, ln};
use crossbar::quadrature::graded_integral;
use crossbar::subsurface::fresnel::{internal_reflectance, internal_reflectance_polynomial, mean_transmittance};
use crossbar::subsurface::{Coefficients, Dipole, MAX_ETA, Material, fresnel_transmittance};
use std::f64::consts::PI;

/// The material of the paper's Figure 7, per mm.
const FIGURE_7: Coefficients = Coefficients { sigma_s_prime: 2.21, sigma_a: 0.0012 };

/// Reflectances of both polarizations as printed in textbooks, `sin(a - b) / sin(a + b)` and
/// `tan(a - b) / tan(a + b)`, with Snell's law for the refracted angle b.
fn reflectances(eta: f64, cos_a: f64) -> [f64; 2] {
    let sin_a = (1.0 - cos_a * cos_a).sqrt();
    let sin_b = sin_a / eta;
    if sin_b >= 1.0 {
        return [1.0, 1.0];
    }
    let cos_b = (1.0 - sin_b * sin_b).sqrt();
    if sin_a < 1e-6 {
        let normal = (eta - 1.0) / (eta + 1.0);
        return [normal * normal; 2];
    }
    let sine = |sign: f64| sin_a * cos_b + sign * cos_a * sin_b;
    let cosine = |sign: f64| cos_a * cos_b - sign * sin_a * sin_b;
    let across = sine(-1.0) / sine(1.0);
    let along = across * cosine(1.0) / cosine(-1.0);
    [across * across, along * along]
}

#[test]
fn transmittance_is_that_of_fresnels_formulas() {
    for eta in [1.0 / 3.0, 1.0 / 1.5, 1.0 / 1.3, 0.999, 1.0, 1.001, 1.3, 1.5, 3.0] {
        for step in 0..=1000 {
            let cosine = f64::from(step) / 1000.0;
            let [across, along] = reflectances(eta, cosine);
            let expected = if cosine == 0.0 { 0.0 } else { 1.0 - 0.5 * (across + along) };
            assert_abs_diff_eq!(fresnel_transmittance(eta, cosine), expected, epsilon = 1e-10);
        }
    }
}

#[test]
fn nothing_passes_beyond_the_critical_angle_or_from_behind() {
    for eta in [1.3_f64, 1.5, 2.7] {
        assert_eq!(fresnel_transmittance(1.0 / eta, 0.99 * (1.0 - 1.0 / (eta * eta)).sqrt()), 0.0, "total reflection");
    }
    for cosine in [0.0, -0.0, -0.5, f64::NAN, f64::NEG_INFINITY] {
        assert_eq!(fresnel_transmittance(1.3, cosine), 0.0);
    }
    assert_eq!(fresnel_transmittance(1.3, 1.0 + 1e-15), fresnel_transmittance(1.3, 1.0));
}

/// The mean reflectance for light from outside, in closed form (Walsh 1926, Duntley 1942).
fn walsh(n: f64) -> f64 {
    let square = |x: f64| x * x;
    let (n2, n4) = (n * n, n * n * n * n);
    0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * square(n + 1.0))
        + n2 * square(n2 - 1.0) / (square(n2 + 1.0) * (n2 + 1.0)) * ln((n - 1.0) / (n + 1.0))
        - 2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0))
        + 8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * square(n4 - 1.0)) * ln(n)
}

#[test]
fn means_of_fresnels_formula_are_those_of_the_closed_form() {
    for eta in [1.05, 1.2, 1.3, 1.5, 2.0, 3.0] {
        assert_abs_diff_eq!(mean_transmittance(eta), 1.0 - walsh(eta), epsilon = 2e-11);
        // From inside; light beyond the critical angle is reflected entirely.
        let critical = (1.0 - 1.0 / (eta * eta)).sqrt();
        let inside = 1.0
            - graded_integral(1.0 - critical, 60, |above| {
                2.0 * (critical + above) * fresnel_transmittance(1.0 / eta, critical + above)
            });
        assert_abs_diff_eq!(internal_reflectance(eta), inside, epsilon = 1e-9);
    }
    assert_abs_diff_eq!(mean_transmittance(1.0), 1.0, epsilon = 1e-15);
    let rounded = [1.3, 1.5].map(|eta| format!("{:.6}", mean_transmittance(eta)));
    assert_eq!(rounded, ["0.938868", "0.908222"]);
}

#[test]
fn the_polynomial_for_the_internal_reflectance_is_as_far_off_as_the_page_says() {
    let both = |eta| format!("{:.6} {:.6}", internal_reflectance_polynomial(eta), internal_reflectance(eta));
    assert_eq!([1.3, 1.5].map(both), ["0.444763 0.444457", "0.596733 0.596346"]);
    let off = |eta: f64| (internal_reflectance_polynomial(eta) - internal_reflectance(eta)).abs();
    let worst = |to: f64| (0..=1000).map(|i| off(1.0 + (to - 1.0) * f64::from(i) / 1000.0)).fold(0.0, f64::max);
    assert!((0.00159..0.00161).contains(&worst(2.2)), "{}", worst(2.2));
    assert!((0.0158..0.0160).contains(&worst(MAX_ETA)), "{}", worst(MAX_ETA));
}

/// The integral of R_d over a disc, by quadrature of R_d itself.
fn summed(dipole: &Dipole, radius: f64) -> f64 {
    graded_integral(radius, 40, |r| 2.0 * PI * r * dipole.r_d(r))
}

fn media() -> Vec<Dipole> {
    let figures = [(2.21, 0.0012), (1.0, 0.0), (0.03, 1.45), (7.38, 0.0002), (20.4, 0.0), (1e-3, 1e3)];
    let media = figures.map(|(sigma_s_prime, sigma_a)| Coefficients { sigma_s_prime, sigma_a });
    media.iter().flat_map(|&c| [1.0, 1.3, 1.5, 3.0].map(|eta| Dipole::new(c, eta).unwrap())).collect()
}

#[test]
fn discs_and_the_plane_are_integrals_of_r_d() {
    for dipole in media() {
        for radius in [1e-3, 0.1, 1.0, 10.0, 300.0].map(|paths| paths * dipole.mean_free_path()) {
            assert_relative_eq!(dipole.disc(radius), summed(&dipole, radius), max_relative = 1e-12);
            let outside = dipole.total() - dipole.beyond(radius);
            assert_abs_diff_eq!(outside, dipole.disc(radius), epsilon = 1e-14);
        }
        assert_relative_eq!(dipole.total(), dipole.beyond(0.0), max_relative = 1e-13);
        assert_relative_eq!(dipole.total(), dipole.integrated_total(), max_relative = 1e-12);
        if dipole.coefficients().sigma_a == 0.0 {
            assert_relative_eq!(dipole.total(), 1.0, max_relative = 1e-15);
        }
    }
}

#[test]
fn r_d_is_the_printed_formula() {
    for dipole in media() {
        let Coefficients { sigma_s_prime, sigma_a } = dipole.coefficients();
        let eta = dipole.eta();
        let f_dr = -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
        let a = (1.0 + f_dr) / (1.0 - f_dr);
        let t = sigma_s_prime + sigma_a;
        let tr = (3.0 * sigma_a * t).sqrt();
        let [zr, zv] = [1.0 / t, (1.0 + 4.0 * a / 3.0) / t];
        assert_relative_eq!(dipole.z_v(), zv, max_relative = 1e-14);
        for r in [0.0, 0.2 * zr, 3.0 * zr, 9.0 * zr] {
            let [dr, dv] = [zr, zv].map(|z| (r * r + z * z).sqrt());
            let sum = zr * (tr * dr + 1.0) * exp(-tr * dr) / (dr * dr * dr)
                + zv * (tr * dv + 1.0) * exp(-tr * dv) / (dv * dv * dv);
            assert_relative_eq!(dipole.r_d(r), sigma_s_prime / t / (4.0 * PI) * sum, max_relative = 1e-11);
        }
    }
}

#[test]
fn totals_and_radii_of_figure_7() {
    let [a, b] = [1.3, 1.5].map(|eta| Dipole::new(FIGURE_7, eta).unwrap());
    let totals = [a, b].map(|dipole| format!("{:.6}", dipole.total()));
    assert_eq!(totals, ["0.897233", "0.867847"]);
    assert_eq!(format!("{:.3}", a.diffusion_length()), "11.208");
    for (dipole, radii) in [(a, ["1.486", "6.99", "20.97"]), (b, ["1.663", "8.31", "23.28"])] {
        let [half, most, nearly] = [0.5, 0.9, 0.99].map(|fraction| dipole.radius_of(fraction));
        assert_eq!([format!("{half:.3}"), format!("{most:.2}"), format!("{nearly:.2}")], radii);
        assert_relative_eq!(dipole.disc(most), 0.9 * dipole.total(), max_relative = 1e-13);
    }
    assert_eq!([a.radius_of(0.0), a.radius_of(-1.0), a.radius_of(f64::NAN)], [0.0; 3]);
    assert_eq!(a.radius_of(1.0), f64::INFINITY);
}

#[test]
fn figures_that_make_no_medium_are_refused() {
    let is_refused = |s, a, eta| Dipole::new(Coefficients { sigma_s_prime: s, sigma_a: a }, eta).is_err();
    assert!([f64::NAN, -1.0, 0.0, 1e-31].into_iter().all(|s| is_refused(s, 0.5, 1.3)));
    assert!([f64::INFINITY, -0.5].into_iter().all(|a| is_refused(1.0, a, 1.3)));
    let opaque = Coefficients { sigma_s_prime: 1.0, sigma_a: 1e31 }.check().unwrap_err().to_string();
    assert_eq!(opaque, "expected at most 1e30 per mm for the absorption coefficient, found 1e31");
    assert!([0.9, f64::NAN].into_iter().all(|eta| is_refused(1.0, 0.5, eta)));
    let bad = [FIGURE_7, FIGURE_7, Coefficients { sigma_s_prime: 0.0, sigma_a: 0.0 }];
    let message = Material::new("mine", bad, 1.3).unwrap_err().to_string();
    assert!(message.starts_with("blue channel: expected a reduced"), "{message}");
}
