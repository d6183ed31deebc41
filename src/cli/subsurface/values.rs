//! Options of `crossbar subsurface`.

use std::str::FromStr;

use crate::cli::one_of::{OneOf, one_of};
use crate::cli::transfer::light::DistantLightArg;
use crate::study::subsurface::MapBits;
use crate::subsurface::kernels::{DirectLight, LinkLayout};
use crate::subsurface::on_card::{FloatTexels, Light};

/// The choices of links, for `--choice`.
pub(super) fn choices() -> OneOf<LinkLayout> {
    let fixed = ("fixed", "All clusters of one level: 1, 4, 16, 64, ... links", LinkLayout::Fixed);
    let help = "Per texel, the cluster with the highest factor gives way to its four children";
    one_of([fixed, ("adaptive", help, LinkLayout::Adaptive)])
}

/// Factors per link, for `--channels`: true for one per channel.
pub(super) fn rgb() -> OneOf<bool> {
    one_of([("scalar", "One, that of green", false), ("rgb", "Red, green and blue", true)])
}

/// The formats of the radiosity map, for `--map`.
pub(super) fn maps() -> OneOf<MapBits> {
    one_of([
        ("8bit", "8 bits per channel, whose levels the card makes itself", MapBits::Eight),
        ("fp16", "Half floats, levels by passes", MapBits::Float(FloatTexels::Fp16)),
        ("fp32", "Single floats, levels by passes", MapBits::Float(FloatTexels::Fp32)),
    ])
}

/// The stages that can compute direct light, for `--direct`.
pub(super) fn direct_light() -> OneOf<DirectLight> {
    let vertex = ("vertex", "At vertices, interpolated", DirectLight::ByVertex);
    one_of([vertex, ("fragment", "At each fragment", DirectLight::ByFragment)])
}

/// Yes or no.
pub(super) fn yes_or_no() -> OneOf<bool> {
    one_of([("yes", "Do it", true), ("no", "Do not", false)])
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
