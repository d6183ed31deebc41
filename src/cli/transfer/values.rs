//! Values of options: reflectance, tangents.

use crate::options::number;
use crate::transfer::Tangents;
use crate::transfer::brdf::Brdf;

const BRDF: &str = "lambert:ALBEDO, phong:ALBEDO,SPECULAR,EXPONENT, cook-torrance:ALBEDO,SPECULAR,ROUGHNESS,F0, \
                    schlick:ALBEDO,SPECULAR,ROUGHNESS,ISOTROPY,F0, ward:ALBEDO,SPECULAR,ROUGHNESS_X,ROUGHNESS_Y or ashikhmin-shirley:ALBEDO,SPECULAR,EXPONENT_U,EXPONENT_V";

/// A BRDF with its parameters, the same in all channels.
pub(in crate::cli) fn brdf(text: &str) -> Result<Brdf, String> {
    let wrong = || format!("expected {BRDF}; found `{text}`");
    let (name, figures) = text.split_once(':').ok_or_else(wrong)?;
    let figures: Vec<f64> = figures.split(',').map(number::finite).collect::<Result<_, _>>()?;
    let brdf = match (name, &figures[..]) {
        ("lambert", &[albedo]) => Brdf::Lambert { albedo },
        ("phong", &[albedo, specular, exponent]) => Brdf::Phong { albedo, specular, exponent },
        ("cook-torrance", &[albedo, specular, roughness, normal_incidence]) => {
            Brdf::CookTorrance { albedo, specular, roughness, normal_incidence }
        }
        ("schlick", &[albedo, specular, roughness, isotropy, normal_incidence]) => {
            Brdf::Schlick { albedo, specular, roughness, isotropy, normal_incidence }
        }
        ("ward", &[albedo, specular, x, y]) => Brdf::Ward { albedo, specular, roughness: [x, y] },
        ("ashikhmin-shirley", &[albedo, specular, u, v]) => {
            Brdf::AshikhminShirley { albedo, specular, exponents: [u, v] }
        }
        _ => return Err(wrong()),
    };
    brdf.check().map(|()| brdf).map_err(|error| error.to_string())
}

/// Source of tangents: `any`, `texture`, or an axis X,Y,Z.
pub(in crate::cli) fn tangents(text: &str) -> Result<Tangents, String> {
    Tangents::try_from(text.to_owned())
}
