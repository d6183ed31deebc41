//! BRDFs obey physics, and their matrices obey algebra.

use std::f64::consts::PI;

use crossbar::elementary::on_circle;
use crossbar::sphere::{DirectionRule, HarmonicRotation, function_band, harmonics};
use crossbar::transfer::brdf::{Brdf, ExitBasis, brdf_matrix};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

use super::close;

const MODELS: [Brdf; 10] = [
    Brdf::Lambert { albedo: 0.7 },
    Brdf::Phong { albedo: 0.3, specular: 0.6, exponent: 20.0 },
    Brdf::CookTorrance { albedo: 0.2, specular: 1.0, roughness: 0.3, normal_incidence: 0.6 },
    Brdf::CookTorrance { albedo: 0.0, specular: 1.0, roughness: 0.8, normal_incidence: 0.95 },
    Brdf::Schlick { albedo: 0.2, specular: 1.0, roughness: 0.3, isotropy: 0.4, normal_incidence: 0.6 },
    Brdf::Schlick { albedo: 0.0, specular: 1.0, roughness: 0.6, isotropy: 1.0, normal_incidence: 0.9 },
    Brdf::Ward { albedo: 0.2, specular: 0.4, roughness: [0.15, 0.5] },
    Brdf::Ward { albedo: 0.0, specular: 1.0, roughness: [0.3, 0.3] },
    Brdf::AshikhminShirley { albedo: 0.5, specular: 0.3, exponents: [5.0, 60.0] },
    Brdf::AshikhminShirley { albedo: 1.0, specular: 0.04, exponents: [10.0, 10.0] },
];

fn direction() -> impl Strategy<Value = DVec3> {
    (0.01..1.0, 0.0..1.0).prop_map(|(z, turns)| at(z, turns))
}

fn at(z: f64, turns: f64) -> DVec3 {
    let ([x, y], radius) = (on_circle(turns), (1.0 - z * z).sqrt());
    DVec3::new(radius * x, radius * y, z)
}

proptest! {
    #[test]
    fn light_may_run_backwards(view in direction(), s in direction()) {
        for brdf in MODELS {
            let [there, back] = [brdf.value(view, s), brdf.value(s, view)];
            prop_assert!(there >= 0.0 && there.is_finite());
            prop_assert!((there - back).abs() <= 1e-12 * there.max(1.0), "{brdf:?}: {there} {back}");
            prop_assert_eq!(brdf.value(view, s.with_z(-s.z)), 0.0);
            // A half turn, and mirrors along the axes, change nothing.
            for mirror in [DVec3::new(-1.0, -1.0, 1.0), DVec3::new(1.0, -1.0, 1.0)] {
                let mirrored = brdf.value(mirror * view, mirror * s);
                prop_assert!((there - mirrored).abs() <= 1e-12 * there.max(1.0));
            }
        }
    }

    #[test]
    fn isotropic_ones_may_be_turned(view in direction(), s in direction(), turns in 0.0..1.0) {
        let [x, y] = on_circle(turns);
        let turn = DMat3::from_cols(DVec3::new(x, y, 0.0), DVec3::new(-y, x, 0.0), DVec3::Z);
        for brdf in MODELS.into_iter().filter(Brdf::is_isotropic) {
            let [before, after] = [brdf.value(view, s), brdf.value(turn * view, turn * s)];
            prop_assert!((before - after).abs() <= 1e-10 * before.max(1.0), "{brdf:?}: {before} {after}");
        }
    }
}

#[test]
fn no_energy_is_made() {
    let rule = DirectionRule::hemisphere(127);
    for brdf in MODELS {
        for z in [0.05, 0.2, 0.5, 0.8, 0.999] {
            for turns in [0.0, 0.11, 0.24] {
                let s = at(z, turns);
                let reflected = rule.integral(|view| brdf.value(view, s) * view.z);
                assert!(reflected > 0.0 && reflected <= 1.0, "{brdf:?} from {s}: {reflected}");
            }
        }
    }
}

#[test]
fn head_on_the_lobe_of_phong_reflects_its_share() {
    let rule = DirectionRule::hemisphere(200);
    let brdf = Brdf::Phong { albedo: 0.3, specular: 0.6, exponent: 20.0 };
    close(rule.integral(|view| brdf.value(view, DVec3::Z) * view.z), 0.9, 1e-12, "albedo");
}

#[test]
fn the_matrix_of_lambert_is_a_product_of_two_integrals() {
    let exit = ExitBasis::of_order(5);
    let found = brdf_matrix(&Brdf::Lambert { albedo: 0.7 }, &exit, 6, &DirectionRule::hemisphere(20)).expect("B");
    // Computed with a finer rule than necessary.
    let rule = DirectionRule::hemisphere(60);
    let [view, light] = [rule.project(5, |_| 1.0), rule.project(6, |s| s.z)];
    assert_eq!([found.row_count(), found.column_count()], [25, 36]);
    for (row, y) in found.rows().zip(view) {
        for (found, z) in row.iter().zip(&light) {
            close(*found, 0.7 / PI * y * z, 1e-14, "an element");
        }
    }
}

#[test]
fn isotropic_matrices_join_equal_azimuths_only() {
    let exit = ExitBasis::of_order(5);
    for brdf in [MODELS[1], MODELS[2]] {
        let b = brdf_matrix(&brdf, &exit, 5, &DirectionRule::hemisphere(63)).expect("B");
        for (i, row) in b.rows().enumerate() {
            for (j, &value) in row.iter().enumerate() {
                let [(l, m), (k, n)] = [function_band(i), function_band(j)];
                if m != n {
                    close(value, 0.0, 1e-12, "another azimuth");
                } else {
                    close(
                        b.row(l * (l + 1) - m.unsigned_abs())[k * (k + 1) - m.unsigned_abs()],
                        value,
                        1e-12,
                        "m and -m",
                    );
                }
            }
        }
    }
}

#[test]
fn turning_an_anisotropic_brdf_turns_its_matrix() {
    let exit = ExitBasis::of_order(5);
    let rule = DirectionRule::hemisphere(63);
    let of =
        |roughness| brdf_matrix(&Brdf::Ward { albedo: 0.2, specular: 0.4, roughness }, &exit, 5, &rule).expect("B");
    let [b, turned] = [of([0.3, 0.6]), of([0.6, 0.3])];
    let quarter = HarmonicRotation::new(5, &DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z)).expect("a rotation");
    // R B R^-1, column by column and then row by row.
    let by_rows = |matrix: &crossbar::linalg::Matrix| {
        let mut out = matrix.clone();
        for (row, from) in matrix.rows().enumerate() {
            quarter.apply(from, out.row_mut(row));
        }
        out
    };
    let both = by_rows(&by_rows(&b).transposed()).transposed();
    let mut most: f64 = 0.0;
    for (row, expected) in both.rows().zip(turned.rows()) {
        for (found, expected) in row.iter().zip(expected) {
            // The rule is unchanged by a quarter turn only if its number of azimuths is divisible by 4: here it is 64.
            close(*found, *expected, 1e-12, "an element");
            most = most.max(expected.abs());
        }
    }
    assert!(most > 0.1 && b != turned);
}

#[test]
fn bases_hold_the_functions_that_they_name() {
    let at = DVec3::new(0.48, -0.6, 0.64);
    let mut all = [0.0; 25];
    harmonics(5, at, &mut all);
    let without = ExitBasis::without_1_0(5).expect("order 5");
    let mut found = vec![0.0; 24];
    without.values(at, &mut found);
    assert!(found.iter().eq(all.iter().take(2).chain(&all[3..])));
    assert_eq!((without.len(), ExitBasis::of_order(4).len(), ExitBasis::Radiance.len()), (24, 16, 1));
    assert!(ExitBasis::without_1_0(1).is_err());
}
