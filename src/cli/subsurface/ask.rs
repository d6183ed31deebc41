//! The parameters that the options of `crossbar subsurface` make.

use glam::{DMat3, DVec3};

use super::args::Args;
use super::values::LightArg;
use crate::cli::Problem;
use crate::cli::materials::published;
use crate::cli::transfer::light::DistantLightArg;
use crate::io::load_irradiances;
use crate::scene::Camera;
use crate::study::subsurface::{ALL_PAIRS_SIDE, GatherWay, Lighting, MAX_ALL_PAIRS_SIDE, MapBits};
use crate::subsurface::kernels::LinkLayout;
use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::{FloatTexels, Light};
use crate::subsurface::{Coefficients, Material};
use crate::transfer::light::{CubeLight, Decimation};

/// The index of refraction where coefficients come without one.
const ETA: f64 = 1.3;

/// A published medium, or coefficients.
pub(super) fn material(args: &Args) -> miette::Result<Material> {
    match (&args.material, args.sigma_s, args.sigma_a) {
        (Some(name), ..) => {
            let published = published(name)?.material();
            let Some(eta) = args.eta else { return Ok(published) };
            let made = Material::new(format!("{}, eta {eta}", published.name), published.channels, eta);
            made.map_err(|error| Problem::usage(error.to_string(), "leave out `--eta` for the published one").into())
        }
        (None, Some(s), Some(a)) => {
            let channel = |c: usize| Coefficients { sigma_s_prime: s[c], sigma_a: a[c] };
            let made = Material::new("the coefficients given", [0, 1, 2].map(channel), args.eta.unwrap_or(ETA));
            made.map_err(|error| Problem::usage(error.to_string(), "coefficients are per mm").into())
        }
        _ => {
            let help = "add `--material NAME` (see `crossbar materials`), or `--sigma-s` and `--sigma-a` per mm";
            Err(Problem::usage("expected a medium", help).into())
        }
    }
}

/// Every combination of what may be repeated.
pub(super) fn ways(args: &Args, material: &Material) -> Result<Vec<GatherWay>, Problem> {
    let [r, g, b] = material.channels;
    let choices = or(&args.choice, LinkLayout::Fixed);
    let (channels, formats) = (or(&args.channels, r != g || g != b), or(&args.link_format, FloatTexels::Fp16));
    let maps = or(&args.map, MapBits::Float(FloatTexels::Fp16));
    let mut ways = Vec::new();
    for &choice in &choices {
        for &links in &args.links {
            let choice = link_choice(choice, links, args.atlas)?;
            for &rgb in &channels {
                for &links in &formats {
                    let way = |&map: &MapBits| GatherWay { choice, rgb, links, map, half: args.half };
                    ways.extend(maps.iter().map(way));
                }
            }
        }
    }
    Ok(ways)
}

fn or<T: Copy + PartialEq>(asked: &[T], usual: T) -> Vec<T> {
    let mut all: Vec<T> = Vec::new();
    for &one in asked {
        if !all.contains(&one) {
            all.push(one);
        }
    }
    if all.is_empty() { vec![usual] } else { all }
}

fn link_choice(choice: LinkLayout, links: u32, side: u32) -> Result<LinkChoice, Problem> {
    match choice {
        LinkLayout::Adaptive => Ok(LinkChoice::Adaptive { count: links as usize }),
        LinkLayout::Fixed => {
            let found = (0..=side.max(1).ilog2())
                .map(|level| LinkChoice::Fixed { level })
                .find(|fixed| fixed.per_texel(side) == u64::from(links));
            found.ok_or_else(|| {
                let help = "fixed links are all clusters of a level: 1, 4, 16, 64, ... up to the number of texels";
                Problem::usage(format!("no level of an atlas of {side} x {side} has {links} clusters"), help)
            })
        }
    }
}

/// The light that was asked for; else a white one from above and beside the eye.
pub(super) fn lighting(args: &Args, camera: &Camera) -> miette::Result<Lighting> {
    if let Some(path) = &args.irradiance {
        return Ok(Lighting::ByFace(load_irradiances(path)?));
    }
    if let [LightArg::Environment(light)] = &args.light[..] {
        return environment(light).map(Lighting::Environment);
    }
    if !args.light.is_empty() {
        let of_pass = |light: &LightArg| if let LightArg::OfPass(light) = light { Some(*light) } else { None };
        let lights: Option<Vec<Light>> = args.light.iter().map(of_pass).collect();
        return Ok(Lighting::Lights(lights.ok_or_else(|| {
            let help = "lights of pass 1 may be repeated; an environment map takes their place";
            Problem::usage("expected one environment map alone, found other `--light` beside it", help)
        })?));
    }
    let unit = |v: DVec3| v.normalize_or_zero();
    let towards = unit(camera.up()) + unit(camera.right()) - 0.5 * unit(camera.forward());
    Ok(Lighting::Lights(vec![Light::Directional { towards: towards.to_array(), irradiance: [1.0; 3] }]))
}

/// Distant light in the texels of a cube.
fn environment(light: &DistantLightArg) -> miette::Result<CubeLight> {
    let refused = |found: String| Problem::usage(found, "docs/papers/cpca.md says which pictures are lights");
    let cube = light.distant()?.cube(&DMat3::IDENTITY, Decimation::SolidAngle);
    let cube = cube.map_err(|error| refused(error.to_string()))?;
    match cube.texels().iter().flatten().find(|&&radiance| radiance < 0.0) {
        Some(found) => Err(refused(format!("expected radiances of at least 0, found {found}")).into()),
        None => Ok(cube),
    }
}

/// Refuses options of lights where the light is a table of faces or an environment map.
pub(super) fn require_lights(args: &Args) -> Result<(), Problem> {
    let has_map = args.light.iter().any(|light| matches!(light, LightArg::Environment(_)));
    let of_lights = [
        ("--pass-1", args.pass_1.is_some()),
        ("--direct", args.direct.is_some()),
        ("--diffuse", args.diffuse.is_some()),
        ("--frames", args.frames > 0),
    ];
    match of_lights.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) if has_map || args.irradiance.is_some() => {
            let help = "it is for `--light` of the kinds sky, directional and point; what enters is known here";
            Err(Problem::usage(format!("`{option}` changes nothing without lights of pass 1"), help))
        }
        _ => Ok(()),
    }
}

/// Returns `true` if all pairs are gathered.
pub(super) fn all_pairs(args: &Args) -> Result<bool, Problem> {
    let asked = args.all_pairs == Some(true);
    if asked && args.atlas > MAX_ALL_PAIRS_SIDE {
        let help = format!("leave out `--all-pairs`, or choose an `--atlas` of at most {MAX_ALL_PAIRS_SIDE}");
        return Err(Problem::usage(format!("all pairs of {0} x {0} texels would take hours", args.atlas), help));
    }
    Ok(asked || (args.all_pairs.is_none() && args.atlas <= ALL_PAIRS_SIDE))
}
