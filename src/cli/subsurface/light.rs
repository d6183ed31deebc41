//! The light of `crossbar subsurface`.

use std::str::FromStr;

use glam::DVec3;

use crate::cli::Problem;
use crate::cli::transfer::light::DistantLightArg;
use crate::options::number::three_finite;
use crate::scene::Camera;
use crate::study::subsurface::Lighting;
use crate::subsurface::on_card::Light;
use crate::transfer::light::CubeLight;

/// A light of pass 1, or distant light as in the commands about transfer.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum LightArg {
    /// `ambient:R,G,B`, `directional:X,Y,Z:R,G,B` or `point:X,Y,Z:R,G,B[:K0,K1,K2]`.
    OfPass(Light),
    /// A picture, a table, `disk:...`, `constant...` or `red-and-blue`.
    Environment(DistantLightArg),
}

const LIGHT: &str = "ambient:R,G,B (radiance), directional:X,Y,Z:R,G,B (towards the light; irradiance) or \
     point:X,Y,Z:R,G,B[:K0,K1,K2] (place; intensity; attenuation, by default 0,0,1), or an environment map: a \
     lat-long, angular-probe, cube-cross or cube-strip picture, disk:X,Y,Z:DEGREES[:R,G,B], constant[:R,G,B], \
     sky:X,Y,Z (towards the sun), red-and-blue, scene:SCENE@X,Y,Z (as seen from a place in a scene)";

impl FromStr for LightArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("expected {LIGHT}, found `{text}`");
        let three = |part: &str| three_finite(part).ok_or_else(wrong);
        let color = |part: &str| three(part).ok().filter(|c| c.iter().all(|&value| value >= 0.0)).ok_or_else(wrong);
        Ok(Self::OfPass(match text.split(':').collect::<Vec<_>>()[..] {
            ["ambient", radiance] => Light::Sky { radiance: color(radiance)? },
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
            ["ambient" | "directional" | "point", ..] => return Err(wrong()),
            // A prefix that names no light; a single letter is a drive.
            [word, _, ..] if word.len() > 1 && !["disk", "constant", "sky", "scene"].contains(&word) => {
                return Err(wrong());
            }
            _ => return text.parse().map(Self::Environment).map_err(|_| wrong()),
        }))
    }
}

/// A coefficient for all channels, or one per channel.
pub(super) fn coefficient(text: &str) -> Result<[f64; 3], String> {
    let one = || text.trim().parse().ok().filter(|value: &f64| value.is_finite()).map(|value| [value; 3]);
    let found = one().or_else(|| three_finite(text)).filter(|values| values.iter().all(|&value| value >= 0.0));
    found.ok_or_else(|| {
        format!("expected a coefficient of at least 0 per mm, or three coefficients as R,G,B, found `{text}`")
    })
}

/// The requested light; by default, a white light above and beside the eye.
pub(super) fn lighting(asked: &[LightArg], camera: &Camera) -> miette::Result<Lighting> {
    if let [LightArg::Environment(light)] = asked {
        return environment(light).map(Lighting::Environment);
    }
    if !asked.is_empty() {
        let of_pass = |light: &LightArg| if let LightArg::OfPass(light) = light { Some(*light) } else { None };
        let lights: Option<Vec<Light>> = asked.iter().map(of_pass).collect();
        return Ok(Lighting::Lights(lights.ok_or_else(|| {
            let help = "remove the other lights: an environment map replaces all lights of pass 1";
            Problem::usage("expected a single environment map, found another `--light` in addition", help)
        })?));
    }
    let unit = |v: DVec3| v.normalize_or_zero();
    let towards = unit(camera.up()) + unit(camera.right()) - 0.5 * unit(camera.forward());
    Ok(Lighting::Lights(vec![Light::Directional { towards: towards.to_array(), irradiance: [1.0; 3] }]))
}

/// Distant light, sampled at the texels of a cube.
fn environment(light: &DistantLightArg) -> miette::Result<CubeLight> {
    let refused = |found: String| Problem::usage(found, "docs/papers/cpca.md describes the pictures of lights");
    let cube = light.distant()?.cube();
    let cube = cube.map_err(|error| refused(error.to_string()))?;
    match cube.texels().iter().flatten().find(|&&radiance| radiance < 0.0) {
        Some(found) => Err(refused(format!("expected radiances of at least 0, found {found}")).into()),
        None => Ok(cube),
    }
}
