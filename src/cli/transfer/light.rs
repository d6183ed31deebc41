//! `--light`: distant light by name, by parameters or from a picture.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use glam::DVec3;

use crate::cli::{Problem, view};
use crate::io::{load_cube_table, load_light_sources};
use crate::options::number;
use crate::report::digits::{Quantity, shown};
use crate::sphere::{ClearSky, EnvironmentPicture, HarmonicLight};
use crate::transfer::grid::LIGHT_SIDE;
use crate::transfer::light::{CubeLight, DiskSource, DistantLight};

/// Forms of light in harmonics, and forms of light on the texels of a cube, for help texts.
pub(in crate::cli) const HARMONIC_LIGHT: &str = "constant[:R,G,B], disk:X,Y,Z:DEGREES[:R,G,B] (towards the light; angular \
     radius), sky:X,Y,Z (towards the sun), red-and-blue, or a lat-long, angular-probe or cube-cross picture";
pub(in crate::cli) const CUBE_LIGHT: &str = "constant[:R,G,B], disk:X,Y,Z:DEGREES[:R,G,B] (towards the light; angular \
     radius), sky:X,Y,Z (towards the sun), red-and-blue, a lat-long, angular-probe or cube-cross picture, a table of a \
     cube's texels (.csv) or of small sources (.sources.csv)";
/// The default light.
pub(in crate::cli) const DEFAULT_LIGHT: &str = "sky:1,-1,1";

const LIGHT: &str = "constant[:R,G,B], disk:X,Y,Z:DEGREES[:R,G,B] (towards the light; angular radius), sky:X,Y,Z \
     (towards the sun), red-and-blue, or a lat-long, angular-probe or cube-cross picture (EXR, HDR, PNG)";

/// Radiances of the clear sky at its zenith, of the ground below it, and of the sun.
const ZENITH: [f64; 3] = [0.25, 0.4, 0.7];
const GROUND: [f64; 3] = [0.1; 3];
const SUN: [f64; 3] = [4e4, 3.7e4, 3.2e4];

/// A light before its projection to harmonics of an order.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::cli) enum DistantLightArg {
    Constant([f64; 3]),
    Disk { towards: DVec3, degrees: f64, radiance: [f64; 3] },
    Sky { sun: DVec3 },
    RedAndBlue,
    Picture(PathBuf),
}

impl FromStr for DistantLightArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("expected {LIGHT}; found `{text}`");
        let three = |part: &str| number::three(part, "X,Y,Z or R,G,B").map(|part| part.map(f64::from));
        let color = |part: &str| three(part).ok().filter(|c| c.iter().all(|&value| value >= 0.0)).ok_or_else(wrong);
        let towards = |part: &str| three(part).map(DVec3::from).ok().filter(|&v| v != DVec3::ZERO).ok_or_else(wrong);
        Ok(match text.split(':').collect::<Vec<_>>()[..] {
            ["constant"] => Self::Constant([1.0; 3]),
            ["constant", radiance] => Self::Constant(color(radiance)?),
            ["red-and-blue"] => Self::RedAndBlue,
            ["sky", sun] => Self::Sky { sun: towards(sun)? },
            ["disk", at, degrees] => Self::disk(towards(at)?, degrees, [1.0; 3])?,
            ["disk", at, degrees, radiance] => Self::disk(towards(at)?, degrees, color(radiance)?)?,
            ["sky" | "disk" | "red-and-blue" | "constant" | "", ..] => return Err(wrong()),
            _ => Self::Picture(text.into()),
        })
    }
}

impl DistantLightArg {
    fn disk(towards: DVec3, degrees: &str, radiance: [f64; 3]) -> Result<Self, String> {
        let degrees = number::positive(degrees)?;
        if degrees > 180.0 {
            return Err(format!(
                "expected an angular radius of at most 180 degrees, found `{}`",
                shown(degrees, Quantity::Exact)
            ));
        }
        Ok(Self::Disk { towards, degrees, radiance })
    }

    /// The file from which the light is read, if any.
    pub(in crate::cli) fn file(&self) -> Option<&Path> {
        if let Self::Picture(path) = self { Some(path) } else { None }
    }

    /// A short name of the light.
    pub(in crate::cli) fn name(&self) -> String {
        match self {
            Self::Constant(_) => "a constant light".to_owned(),
            Self::Disk { degrees, .. } => format!("a disk of {degrees} degrees"),
            Self::Sky { .. } => "a clear sky with a sun".to_owned(),
            Self::RedAndBlue => "a red and a blue disk".to_owned(),
            Self::Picture(path) => path.display().to_string(),
        }
    }

    /// The light, before it is sampled at the texels of a cube.
    pub(in crate::cli) fn distant(&self) -> miette::Result<DistantLight> {
        Ok(match self {
            Self::Constant(radiance) => DistantLight::Constant(*radiance),
            Self::Disk { towards, degrees, radiance } => DistantLight::Disks(vec![DiskSource {
                towards: *towards,
                radius: degrees.to_radians(),
                radiance: *radiance,
            }]),
            Self::Sky { sun } => DistantLight::Sky(clear_sky(*sun)),
            Self::RedAndBlue => DistantLight::RedAndBlue,
            Self::Picture(path) if has_ending(path, ".sources.csv") => {
                DistantLight::Disks(load_light_sources(path)?.into_iter().map(DiskSource::from).collect())
            }
            Self::Picture(path) if has_ending(path, ".csv") => {
                // Truncated light has texels below 0.
                let light = CubeLight::signed(load_cube_table(path, LIGHT_SIDE)?);
                DistantLight::Texels(light.map_err(|error| no_light(path, &error))?)
            }
            Self::Picture(path) => {
                let picture = EnvironmentPicture::new(&view::picture(path)?);
                DistantLight::Picture(picture.map_err(|error| no_light(path, &error))?)
            }
        })
    }

    /// The light, projected to harmonics of an order.
    pub(in crate::cli) fn of_order(&self, order: usize) -> miette::Result<HarmonicLight> {
        let made = match self {
            Self::Constant(radiance) => HarmonicLight::constant(order, *radiance),
            Self::Disk { towards, degrees, radiance } => {
                HarmonicLight::disk(order, *towards, degrees.to_radians(), *radiance)
            }
            Self::Sky { sun } => clear_sky(*sun).light(order),
            Self::RedAndBlue => Ok(HarmonicLight::red_and_blue(order)),
            Self::Picture(path) => {
                let read = HarmonicLight::from_picture(order, &view::picture(path)?);
                return Ok(read.map_err(|error| no_light(path, &error))?);
            }
        };
        Ok(made.map_err(|error| Problem::usage(error.to_string(), "see this command's `--help`"))?)
    }
}

const fn clear_sky(sun: DVec3) -> ClearSky {
    ClearSky { sun, sun_radiance: SUN, zenith: ZENITH, ground: GROUND }
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.to_string_lossy().to_ascii_lowercase().ends_with(ending)
}

fn no_light(path: &Path, error: &dyn std::fmt::Display) -> Problem {
    Problem::usage(format!("{}: {error}", path.display()), "docs/papers/cpca.md says which pictures are lights")
}
