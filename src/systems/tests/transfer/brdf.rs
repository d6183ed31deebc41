//! Microfacets and microfacet models.

use std::f64::consts::PI;

use approx::assert_abs_diff_eq;
use crossbar_systems::all_frequency::factor::{
    Denominators, FacetDistribution, FresnelForm, Lobe, ProductFunction, Shadowing, TangentCosine,
};
use crossbar_systems::transfer::brdf::Brdf;
use glam::DVec3;

use crate::scene::Surface;
use crate::sphere::DirectionRule;

/// The distribution alone, times pi: no Fresnel reflectance, shadowing or denominators.
fn facets(distribution: FacetDistribution) -> Lobe {
    Lobe {
        albedo: 0.0,
        distribution,
        normal_incidence: 1.0,
        fresnel: FresnelForm::Constant,
        shadowing: Shadowing::None,
        denominators: Denominators::Product,
    }
}

fn schlick(roughness: f64, isotropy: f64) -> Lobe {
    facets(FacetDistribution::Schlick { roughness, isotropy, tangent: TangentCosine::Projected })
}

/// The lobe's value for view and light along h, so that the half vector is h.
fn at(lobe: &Lobe, h: DVec3) -> f64 {
    lobe.value(h, h)
}

#[test]
fn distributions_times_the_cosine_integrate_to_pi() {
    let rule = DirectionRule::hemisphere(255);
    for roughness in [0.2, 0.4, 1.0] {
        for lobe in [schlick(roughness, 1.0), facets(FacetDistribution::Beckmann { roughness })] {
            assert_abs_diff_eq!(rule.integral(|h| at(&lobe, h)), PI, epsilon = 1e-8);
        }
    }
}

#[test]
fn lobes_are_wide_across_the_tangent() {
    // Schlick's A(w) is the ratio to the isotropic lobe.
    let azimuth = |isotropy, h| at(&schlick(0.3, isotropy), h) / at(&schlick(0.3, 1.0), h);
    let [along, across] = [DVec3::new(-0.6, 0.0, 0.8), DVec3::new(0.0, 0.6, 0.8)];
    for (h, expected) in [(along, 0.5), (across, 2.0), (DVec3::Z, 0.5)] {
        assert_abs_diff_eq!(azimuth(0.25, h), expected, epsilon = 1e-14);
    }
    // Schlick's G(v) of view and light, v / (r - r v + v).
    let seen = |roughness, h| {
        let lobe = schlick(roughness, 1.0);
        at(&Lobe { shadowing: Shadowing::Model, ..lobe }, h) / at(&lobe, h)
    };
    assert_abs_diff_eq!(seen(0.3, DVec3::Z), 1.0, epsilon = 1e-14);
    for z in [0.8, 1e-3] {
        let h = DVec3::new((1.0_f64 - z * z).sqrt(), 0.0, z);
        let shadowed = z / (0.3 - 0.3 * z + z);
        let expected = shadowed * shadowed;
        assert_abs_diff_eq!(seen(0.3, h), expected, epsilon = 1e-9 * expected);
    }
}

#[test]
fn bad_figures_are_named() {
    let message = |brdf: Brdf| brdf.check().expect_err("refused").to_string();
    let found = message(Brdf::Lambert { albedo: 1.5 });
    assert_eq!(found, "expected a number from 0 to 1 for the albedo, found 1.5");
    let nan = Brdf::Phong { albedo: 0.5, specular: 0.5, exponent: f64::NAN };
    assert_eq!(message(nan), "expected a number from 0 to below 1e9 for the exponent, found NaN");
    let ward = Brdf::Ward { albedo: 0.0, specular: 0.5, roughness: [0.1, 0.0] };
    assert!(message(ward).contains("roughness"));
    for (surface, found) in [
        (Surface::Mirror { reflectance: [1.0; 3] }, "found a mirror: its reflectance is no function of two directions"),
        (
            Surface::Glass { index: 1.5, transmittance: [1.0; 3] },
            "found glass: its reflectance is no function of two directions",
        ),
    ] {
        let error = Brdf::of_surface(&surface, 0).expect_err("refused").to_string();
        assert_eq!(error, format!("expected a diffuse or glossy material, {found}"));
    }
    let glossy = Surface::Glossy { albedo: [0.1, 0.2, 0.3], specular: [0.4; 3], exponent: 9.0 };
    assert!(matches!(Brdf::of_surface(&glossy, 1), Ok(Brdf::Phong { exponent: 9.0, .. })));
}
