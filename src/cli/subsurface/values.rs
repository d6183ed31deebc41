//! What the options of `crossbar subsurface` can be.

use std::str::FromStr;

use clap::ValueEnum;

use crate::cli::transfer::light::DistantLightArg;
use crate::study::subsurface::MapBits;
use crate::subsurface::kernels::{Combine, DirectLight, EyeTransmittance};
use crate::subsurface::on_card::{FloatTexels, Light, LightStage};

/// Which links.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ChoiceArg {
    /// All clusters of one level: 1, 4, 16, 64, ... links
    Fixed,
    /// Per texel, the cluster with the highest factor gives way to its four children
    Adaptive,
}

/// Factors per link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ChannelsArg {
    /// One, that of green
    Scalar,
    /// Red, green and blue
    Rgb,
}

/// Floats of textures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FloatArg {
    /// Half precision
    Fp16,
    /// Single precision
    Fp32,
}

impl From<FloatArg> for FloatTexels {
    fn from(arg: FloatArg) -> Self {
        match arg {
            FloatArg::Fp16 => Self::Fp16,
            FloatArg::Fp32 => Self::Fp32,
        }
    }
}

/// The radiosity map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MapArg {
    /// 8 bits per channel, whose levels the card makes itself
    #[value(name = "8bit")]
    Eight,
    /// Half floats, levels by passes
    Fp16,
    /// Single floats, levels by passes
    Fp32,
}

impl From<MapArg> for MapBits {
    fn from(arg: MapArg) -> Self {
        match arg {
            MapArg::Eight => Self::Eight,
            MapArg::Fp16 => Self::Float(FloatTexels::Fp16),
            MapArg::Fp32 => Self::Float(FloatTexels::Fp32),
        }
    }
}

/// Where light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum StageArg {
    /// At vertices, interpolated
    Vertex,
    /// At each texel, or each fragment
    Fragment,
}

impl From<StageArg> for LightStage {
    fn from(arg: StageArg) -> Self {
        match arg {
            StageArg::Vertex => Self::Vertices,
            StageArg::Fragment => Self::Texels,
        }
    }
}

impl From<StageArg> for DirectLight {
    fn from(arg: StageArg) -> Self {
        match arg {
            StageArg::Vertex => Self::ByVertex,
            StageArg::Fragment => Self::ByFragment,
        }
    }
}

/// The Fresnel transmittance towards the eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum FresnelArg {
    /// Computed by the program
    Exact,
    /// Read from a table by the cosine
    Table,
    /// Its mean over the hemisphere
    Mean,
}

impl From<FresnelArg> for EyeTransmittance {
    fn from(arg: FresnelArg) -> Self {
        match arg {
            FresnelArg::Exact => Self::Exact,
            FresnelArg::Table => Self::Table,
            FresnelArg::Mean => Self::Mean,
        }
    }
}

/// How scattered and direct light make a color.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum CombineArg {
    /// Their sum
    Added,
    /// Their product
    Modulated,
}

impl From<CombineArg> for Combine {
    fn from(arg: CombineArg) -> Self {
        match arg {
            CombineArg::Added => Self::Added,
            CombineArg::Modulated => Self::Modulated,
        }
    }
}

/// Yes or no.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum YesNo {
    /// Do it
    Yes,
    /// Do not
    No,
}

/// A light: one of pass 1, or distant light as the commands on transfer read it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum LightArg {
    /// `sky:R,G,B`, `directional:X,Y,Z:R,G,B` or `point:X,Y,Z:R,G,B[:K0,K1,K2]`.
    OfPass(Light),
    /// A picture, a table, `disk:...`, `constant...` or `red-and-blue`.
    Environment(DistantLightArg),
}

const LIGHT: &str = "sky:R,G,B (radiance), directional:X,Y,Z:R,G,B (towards the light; irradiance) or \
     point:X,Y,Z:R,G,B[:K0,K1,K2] (place; intensity; attenuation, else 0,0,1), or an environment map: a lat-long, angular-probe \
     or cube-cross picture, disk:X,Y,Z:DEGREES[:R,G,B], constant[:R,G,B], red-and-blue";

impl FromStr for LightArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("expected {LIGHT}, found `{text}`");
        let three = |part: &str| three(part).ok_or_else(wrong);
        let color = |part: &str| three(part).ok().filter(|c| c.iter().all(|&value| value >= 0.0)).ok_or_else(wrong);
        Ok(Self::OfPass(match text.split(':').collect::<Vec<_>>()[..] {
            ["sky", radiance] => Light::Sky { radiance: color(radiance)? },
            ["directional", towards, irradiance] => {
                let towards = three(towards)?;
                if towards == [0.0; 3] {
                    return Err(wrong());
                }
                Light::Directional { towards, irradiance: color(irradiance)? }
            }
            ["point", place, intensity] => {
                let (position, intensity) = (three(place)?, color(intensity)?);
                Light::Point { position, intensity, attenuation: [0.0, 0.0, 1.0] }
            }
            ["point", place, intensity, attenuation] => {
                let (position, intensity, attenuation) = (three(place)?, color(intensity)?, color(attenuation)?);
                if attenuation == [0.0; 3] {
                    return Err(wrong());
                }
                Light::Point { position, intensity, attenuation }
            }
            ["sky" | "directional" | "point", ..] => return Err(wrong()),
            // A word that no light begins with; a letter is a drive.
            [word, _, ..] if word.len() > 1 && !["disk", "constant"].contains(&word) => return Err(wrong()),
            _ => return text.parse().map(Self::Environment).map_err(|_| wrong()),
        }))
    }
}

/// Three finite numbers.
fn three(text: &str) -> Option<[f64; 3]> {
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|number| number.trim().parse().ok().filter(|value: &f64| value.is_finite())).collect();
    numbers?.try_into().ok()
}

/// A coefficient for all channels, or one for each.
pub(super) fn coefficient(text: &str) -> Result<[f64; 3], String> {
    let one = || text.trim().parse().ok().filter(|value: &f64| value.is_finite()).map(|value| [value; 3]);
    let found = one().or_else(|| three(text)).filter(|values| values.iter().all(|&value| value >= 0.0));
    found.ok_or_else(|| format!("expected a number of at least 0, or three as R,G,B, per mm, found `{text}`"))
}

/// A point in space.
pub(super) fn place(text: &str) -> Result<[f64; 3], String> {
    three(text).ok_or_else(|| format!("expected three numbers as X,Y,Z, found `{text}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_are_read_and_bad_ones_refused() {
        let light = |text: &str| text.parse::<LightArg>();
        let of_pass = |light| Ok(LightArg::OfPass(light));
        assert_eq!(light("sky:1,0.5,0"), of_pass(Light::Sky { radiance: [1.0, 0.5, 0.0] }));
        let point = Light::Point { position: [0.0, -1.0, 2.0], intensity: [3.0; 3], attenuation: [0.0, 0.0, 1.0] };
        assert_eq!(light("point:0,-1,2:3,3,3"), of_pass(point));
        for map in ["probe.hdr", "disk:0,0,1:30", "constant", "red-and-blue"] {
            assert!(matches!(light(map), Ok(LightArg::Environment(_))), "{map}");
        }
        let bad = [
            "sky",
            "sky:1,2",
            "sky:-1,0,0",
            "sky:inf,0,0",
            "directional:0,0,0:1,1,1",
            "point:1,1,1:1,1,1:0,0,0",
            "sun:1,1,1",
            "disk:0,0,0:30",
            "constant:-1,0,0",
        ];
        for text in bad {
            assert!(light(text).is_err(), "{text}");
        }
        assert_eq!((coefficient("2"), coefficient("1,2,3")), (Ok([2.0; 3]), Ok([1.0, 2.0, 3.0])));
        assert!(coefficient("-1").is_err() && coefficient("1,2").is_err() && coefficient("nan").is_err());
    }
}
