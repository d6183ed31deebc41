//! What the options of `crossbar subsurface` ask for.

use glam::DVec3;

use super::args::Args;
use crate::cli::Problem;
use crate::cli::materials::published;
use crate::io::load_irradiances;
use crate::scene::Camera;
use crate::study::subsurface::{GatherWay, Lighting, MapBits};
use crate::subsurface::kernels::LinkLayout;
use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::{FloatTexels, Light};
use crate::subsurface::{Coefficients, Material};

/// Texels along a side up to which all pairs are gathered unasked.
const ALL_PAIRS: u32 = 32;
/// The most texels along a side for all pairs.
const MOST_ALL_PAIRS: u32 = 512;
/// The index of refraction where coefficients come without one.
const ETA: f64 = 1.3;

/// A published medium, or coefficients.
pub(super) fn material(args: &Args) -> miette::Result<Material> {
    match (&args.material, args.sigma_s, args.sigma_a) {
        (Some(name), ..) => Ok(published(name)?.material()),
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
    if !args.light.is_empty() {
        return Ok(Lighting::Lights(args.light.iter().map(|light| light.0).collect()));
    }
    let unit = |v: DVec3| v.normalize_or_zero();
    let towards = unit(camera.up()) + unit(camera.right()) - 0.5 * unit(camera.forward());
    Ok(Lighting::Lights(vec![Light::Directional { towards: towards.to_array(), irradiance: [1.0; 3] }]))
}

/// Whether all pairs are gathered.
pub(super) fn all_pairs(args: &Args) -> Result<bool, Problem> {
    let asked = args.all_pairs == Some(true);
    if asked && args.atlas > MOST_ALL_PAIRS {
        let help = format!("leave out `--all-pairs`, or choose an `--atlas` of at most {MOST_ALL_PAIRS}");
        return Err(Problem::usage(format!("all pairs of {0} x {0} texels would take hours", args.atlas), help));
    }
    Ok(asked || (args.all_pairs.is_none() && args.atlas <= ALL_PAIRS))
}
