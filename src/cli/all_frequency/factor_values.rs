//! Values of the options of `crossbar all-frequency factor`.

use std::str::FromStr;

use clap::ValueEnum;

use crate::all_frequency::factor::{
    Denominators, FresnelForm, MerlChannel, OutsideDisc, Shadowing, Supersamples, TangentCosine,
};
use crate::cli::number;

/// Reflectance models.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ModelArg {
    /// Cook and Torrance 1982
    CookTorrance,
    /// Schlick 1994, anisotropic
    Schlick,
    /// Phong, as MTL files have it
    Phong,
    /// The same radiance in all directions
    Lambert,
}

/// What stands in front of a lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DenominatorsArg {
    /// 1 / (4 pi v_z s_z)
    Normalised,
    /// 1 / (pi v_z s_z), as Cook and Torrance print it
    #[value(name = "printed-1982")]
    Printed1982,
    /// 1
    Product,
    /// 1/4
    Quarter,
}

/// Forms of Fresnel's term.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FresnelArg {
    /// Fresnel's formula for dielectrics
    Dielectric,
    /// Schlick's approximation
    Schlick,
    /// The same at all angles
    Constant,
}

/// Light that facets take from each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ShadowingArg {
    /// As the model has it
    Model,
    /// None
    None,
}

/// The w of Schlick's azimuth factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum TangentArg {
    /// Of the half vector's projection onto the surface
    Projected,
    /// Of the half vector itself
    HalfVector,
}

/// Texels outside of the disc.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum OutsideArg {
    /// 0
    Zero,
    /// The formula below the horizon
    Continued,
    /// The rim's value
    Rim,
}

/// When f is cut off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ClampWhenArg {
    /// Each sample, before the mean is taken
    Before,
    /// The mean
    After,
}

/// A channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ChannelArg {
    Red,
    Green,
    Blue,
}

/// Where f is cut off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LimitArg(pub(super) Option<f64>);

impl FromStr for LimitArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "none" { Ok(Self(None)) } else { number::positive(text).map(|limit| Self(Some(limit))) }
    }
}

/// Samples along an edge of a texel: view and light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SupersamplesArg(pub(super) Supersamples);

impl FromStr for SupersamplesArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let edge = |text: &str| text.parse::<usize>().ok().filter(|edge| (1..=16).contains(edge));
        let found = text.split_once('x').and_then(|(view, light)| Some((edge(view)?, edge(light)?)));
        let (view, light) =
            found.ok_or_else(|| format!("expected two numbers from 1 to 16 as in 4x4, found `{text}`"))?;
        Ok(Self(Supersamples { view, light }))
    }
}

impl From<DenominatorsArg> for Denominators {
    fn from(arg: DenominatorsArg) -> Self {
        match arg {
            DenominatorsArg::Normalised => Self::Normalised,
            DenominatorsArg::Printed1982 => Self::Printed1982,
            DenominatorsArg::Product => Self::Product,
            DenominatorsArg::Quarter => Self::Quarter,
        }
    }
}

impl From<FresnelArg> for FresnelForm {
    fn from(arg: FresnelArg) -> Self {
        match arg {
            FresnelArg::Dielectric => Self::Dielectric,
            FresnelArg::Schlick => Self::Schlick,
            FresnelArg::Constant => Self::Constant,
        }
    }
}

impl From<ShadowingArg> for Shadowing {
    fn from(arg: ShadowingArg) -> Self {
        match arg {
            ShadowingArg::Model => Self::Model,
            ShadowingArg::None => Self::None,
        }
    }
}

impl From<TangentArg> for TangentCosine {
    fn from(arg: TangentArg) -> Self {
        match arg {
            TangentArg::Projected => Self::Projected,
            TangentArg::HalfVector => Self::HalfVector,
        }
    }
}

impl From<OutsideArg> for OutsideDisc {
    fn from(arg: OutsideArg) -> Self {
        match arg {
            OutsideArg::Zero => Self::Zero,
            OutsideArg::Continued => Self::Continued,
            OutsideArg::Rim => Self::Rim,
        }
    }
}

impl From<ChannelArg> for MerlChannel {
    fn from(arg: ChannelArg) -> Self {
        match arg {
            ChannelArg::Red => Self::Red,
            ChannelArg::Green => Self::Green,
            ChannelArg::Blue => Self::Blue,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_and_supersamples_are_read_and_bad_ones_refused() {
        assert_eq!("none".parse(), Ok(LimitArg(None)));
        assert_eq!("2.5".parse(), Ok(LimitArg(Some(2.5))));
        assert!("0".parse::<LimitArg>().is_err() && "-1".parse::<LimitArg>().is_err());
        assert_eq!("16x1".parse(), Ok(SupersamplesArg(Supersamples::VIEW)));
        assert!(["4", "0x4", "17x1", "4x4x4", "x"].iter().all(|text| text.parse::<SupersamplesArg>().is_err()));
    }
}
