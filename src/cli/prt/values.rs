//! Values of options: reflectance, tangents, exit functions.

use std::str::FromStr;

use clap::ValueEnum;
use glam::DVec3;

use crate::cli::number;
use crate::transfer::Tangents;
use crate::transfer::brdf::{Brdf, ExitBasis};

const BRDF: &str = "lambert:ALBEDO, phong:ALBEDO,SPECULAR,EXPONENT, cook-torrance:ALBEDO,SPECULAR,ROUGHNESS,F0, \
                    schlick:ALBEDO,SPECULAR,ROUGHNESS,ISOTROPY,F0, ward:ALBEDO,SPECULAR,ROUGHNESS_X,ROUGHNESS_Y or ashikhmin-shirley:ALBEDO,SPECULAR,EXPONENT_U,EXPONENT_V";

/// What a vertex makes of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum KindArg {
    /// A vector per vertex: the same radiance in all directions
    Diffuse,
    /// A matrix per vertex: radiance by direction
    Glossy,
    /// Visibility in 98,304 directions per vertex, for light of 6,144 coefficients
    AllFrequency,
    /// Visibility of 6,144 light texels by local direction: a sparse matrix
    BiScale,
}

/// How wide the hats of the light's texels are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum HatsArg {
    /// A texel alone
    One,
    /// To the centers of its neighbors
    Two,
}

/// Channels of transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ChannelsArg {
    /// One for all, with the reflectances of green
    Scalar,
    /// Red, green and blue
    Rgb,
}

/// How exit radiance is projected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ExitArg {
    /// The nearest combination on the hemisphere, by the inverse of the Gram matrix
    LeastSquares,
    /// Integrals with the functions over the hemisphere
    ZeroHemisphere,
}

/// How incident radiance reaches the BRDF.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum IncidentArg {
    /// In harmonics, by least squares: equation 1
    LeastSquares,
    /// In harmonics, by integrals over the hemisphere
    ZeroHemisphere,
    /// Direction by direction: the double integral of section 3.1
    Directions,
}

/// A BRDF with its figures, the same in all channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BrdfArg(pub(super) Brdf);

impl FromStr for BrdfArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
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
        brdf.check().map(|()| Self(brdf)).map_err(|error| error.to_string())
    }
}

/// Where tangents come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TangentsArg(pub(super) Tangents);

impl FromStr for TangentsArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "any" => Ok(Self(Tangents::Any)),
            "texture" => Ok(Self(Tangents::Texture)),
            _ => {
                let axis = DVec3::from(number::three(text, "X,Y,Z, or `any` or `texture`")?.map(f64::from));
                if axis == DVec3::ZERO {
                    return Err(format!("expected an axis with a length above 0, found `{text}`"));
                }
                Ok(Self(Tangents::Along(axis)))
            }
        }
    }
}

/// Functions of exit radiance: all of an order, or all but (1, 0).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RowsArg {
    order: usize,
    is_whole: bool,
}

impl FromStr for RowsArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = (1..=10).flat_map(|order| [(order, true), (order, false)]).find(|&(order, is_whole)| {
            let count = order * order - usize::from(!is_whole);
            count > 0 && text.trim().parse() == Ok(count)
        });
        let found = found.map(|(order, is_whole)| Self { order, is_whole });
        found.ok_or_else(|| {
            format!("expected a square from 1 to 100, or from 4 on one less (without l = 1, m = 0), found `{text}`")
        })
    }
}

impl Default for RowsArg {
    fn default() -> Self {
        Self { order: 5, is_whole: true }
    }
}

impl RowsArg {
    /// The basis.
    pub(super) fn basis(self) -> ExitBasis {
        let whole = || ExitBasis::of_order(self.order);
        if self.is_whole { whole() } else { ExitBasis::without_1_0(self.order).unwrap_or_else(|_| whole()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_squares_or_one_less() {
        let rows = |text: &str| text.parse::<RowsArg>().map(|rows| rows.basis().len());
        for count in [1, 3, 4, 8, 9, 15, 16, 24, 25, 99, 100] {
            assert_eq!(rows(&count.to_string()), Ok(count));
        }
        assert!(["0", "2", "10", "101", "-1", ""].iter().all(|text| rows(text).is_err()));
    }

    #[test]
    fn brdfs_and_tangents_are_read_and_bad_ones_refused() {
        let phong = Brdf::Phong { albedo: 0.1, specular: 0.5, exponent: 20.0 };
        assert_eq!("phong:0.1,0.5,20".parse(), Ok(BrdfArg(phong)));
        for text in ["lambert", "lambert:2", "lambert:0.1,0.2", "phong:0.1,0.5,nan", "ward:0,1,0,0.1", "mirror:1"] {
            assert!(text.parse::<BrdfArg>().is_err(), "{text}");
        }
        assert_eq!("0,0,2".parse(), Ok(TangentsArg(Tangents::Along(DVec3::new(0.0, 0.0, 2.0)))));
        assert!("0,0,0".parse::<TangentsArg>().is_err() && "some".parse::<TangentsArg>().is_err());
    }
}
