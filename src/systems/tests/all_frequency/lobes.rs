//! Forms of lobes.

use std::f64::consts::PI;

use crossbar_systems::all_frequency::factor::{
    Denominators, FacetDistribution, FresnelForm, Lobe, ProductFunction, Shadowing, TangentCosine,
};
use crossbar_systems::transfer::brdf::Brdf;
use glam::DVec3;

const VIEW: DVec3 = DVec3::new(0.6, 0.0, 0.8);
const LIGHT: DVec3 = DVec3::new(-0.48, 0.36, 0.8);

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-14 * expected.abs(), "{found} {expected}");
}

#[test]
fn the_default_forms_are_those_of_the_models() {
    let lobe = Lobe { albedo: 0.2, ..Lobe::cook_torrance(0.4, 0.5) };
    let brdf = Brdf::CookTorrance { albedo: 0.2, specular: 1.0, roughness: 0.4, normal_incidence: 0.5 };
    close(lobe.value(VIEW, LIGHT), brdf.value(VIEW, LIGHT) * LIGHT.z);
    let lobe = Lobe { albedo: 0.1, ..Lobe::schlick(0.2, 0.3, 0.8) };
    let brdf = Brdf::Schlick { albedo: 0.1, specular: 1.0, roughness: 0.2, isotropy: 0.3, normal_incidence: 0.8 };
    close(lobe.value(VIEW, LIGHT), brdf.value(VIEW, LIGHT) * LIGHT.z);
}

#[test]
fn each_form_has_its_factor() {
    let lobe = Lobe::cook_torrance(0.4, 0.5);
    let with = |denominators| Lobe { denominators, ..lobe }.value(VIEW, LIGHT);
    let normalised = with(Denominators::Normalised);
    close(with(Denominators::Printed1982), 4.0 * normalised);
    close(with(Denominators::Product), 4.0 * PI * VIEW.z * LIGHT.z * normalised);
    close(with(Denominators::Quarter), PI * VIEW.z * LIGHT.z * normalised);
    // At normal incidence there is no shadowing, and all forms of Fresnel's term agree.
    let head_on = |fresnel, shadowing| Lobe { fresnel, shadowing, ..lobe }.value(DVec3::Z, DVec3::Z);
    for fresnel in [FresnelForm::Dielectric, FresnelForm::Schlick, FresnelForm::Constant] {
        for shadowing in [Shadowing::Model, Shadowing::None] {
            close(head_on(fresnel, shadowing), 0.5 / (4.0 * PI * 0.16));
        }
    }
    assert_eq!(Lobe::cook_torrance(0.4, 0.0).value(VIEW, LIGHT), 0.0, "a boundary without contrast");
    let Lobe { distribution: FacetDistribution::Schlick { roughness, isotropy, .. }, .. } =
        Lobe::schlick(0.2, 0.3, 0.8)
    else {
        panic!("Schlick's")
    };
    let distribution = FacetDistribution::Schlick { roughness, isotropy, tangent: TangentCosine::HalfVector };
    let half = Lobe { distribution, ..Lobe::schlick(0.2, 0.3, 0.8) };
    assert!(half.value(VIEW, LIGHT) > Lobe::schlick(0.2, 0.3, 0.8).value(VIEW, LIGHT), "w nearer to 0");
}

#[test]
fn bad_figures_are_named() {
    let message = |lobe: Lobe| lobe.check().expect_err("refused").to_string();
    assert!(message(Lobe::cook_torrance(0.0, 0.5)).contains("roughness"));
    assert!(message(Lobe::cook_torrance(0.4, 1.0)).contains("from 0 to below 1"));
    assert!(message(Lobe { fresnel: FresnelForm::Constant, ..Lobe::cook_torrance(0.4, 1.5) }).contains("1.5"));
    assert!(message(Lobe::schlick(0.2, 0.0, 0.5)).contains("isotropy"));
    assert!(Lobe { fresnel: FresnelForm::Constant, ..Lobe::cook_torrance(0.4, 1.0) }.check().is_ok());
}
