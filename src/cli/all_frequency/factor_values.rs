//! Values of the options of `crossbar all-frequency factor`.

use std::str::FromStr;

use clap::ValueEnum;

use crate::all_frequency::factor::Supersamples;
use crate::options::number;

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

/// Where f is cut off; infinity for `none`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LimitArg(pub(super) f64);

impl FromStr for LimitArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "none" { Ok(Self(f64::INFINITY)) } else { number::positive(text).map(Self) }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_and_supersamples_are_read_and_bad_ones_refused() {
        assert_eq!("none".parse(), Ok(LimitArg(f64::INFINITY)));
        assert_eq!("2.5".parse(), Ok(LimitArg(2.5)));
        assert!("0".parse::<LimitArg>().is_err() && "-1".parse::<LimitArg>().is_err());
        assert_eq!("16x1".parse(), Ok(SupersamplesArg(Supersamples { view: 16, light: 1 })));
        assert!(["4", "0x4", "17x1", "4x4x4", "x"].iter().all(|text| text.parse::<SupersamplesArg>().is_err()));
    }
}
