//! `--light`: distant light by name, by figures, from a picture or from a place in a scene.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use glam::DVec3;

use crate::cli::{Problem, ProgressBar, scene_name, view};
use crate::geom::exact::Sides;
use crate::io::{load_cube_table, load_light_sources};
use crate::options::number;
use crate::renderer::environment::seen_around;
use crate::renderer::{Settings, path};
use crate::report::digits::{Quantity, shown};
use crate::sphere::{ClearSky, EnvironmentPicture, HarmonicLight};
use crate::tracer::HostTracer;
use crate::transfer::grid::LIGHT_SIDE;
use crate::transfer::light::{CubeLight, DiskSource, DistantLight};

pub(in crate::cli) const LIGHT: &str = "constant[:R,G,B], disk:X,Y,Z:DEGREES[:R,G,B] (towards the light; angular \
     radius), sky:X,Y,Z (towards the sun), red-and-blue, scene:SCENE@X,Y,Z (as seen from a place in a \
     scene), a lat-long, angular-probe, cube-cross or cube-strip picture (EXR, HDR, PNG); for all-frequency and \
     bi-scale also a table of a cube's texels (.csv) or of small sources (.sources.csv)";
pub(in crate::cli) const DEFAULT_LIGHT: &str = "sky:1,-1,1";

/// Samples per texel of light in a scene.
const SAMPLES: u32 = 16;

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
    Scene { scene: PathBuf, at: DVec3 },
}

impl FromStr for DistantLightArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("expected {LIGHT}; found `{text}`");
        let three = |part: &str| number::three(part, "X,Y,Z or R,G,B").map(|part| part.map(f64::from));
        let color = |part: &str| three(part).ok().filter(|c| c.iter().all(|&value| value >= 0.0)).ok_or_else(wrong);
        let towards = |part: &str| three(part).map(DVec3::from).ok().filter(|&v| v != DVec3::ZERO).ok_or_else(wrong);
        if let Some(scene) = text.strip_prefix("scene:") {
            let (scene, at) = scene.rsplit_once('@').filter(|(scene, _)| !scene.is_empty()).ok_or_else(wrong)?;
            return Ok(Self::Scene { scene: scene.into(), at: three(at)?.into() });
        }
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
        let found = shown(degrees, Quantity::Exact);
        match degrees <= 180.0 {
            true => Ok(Self::Disk { towards, degrees, radiance }),
            false => Err(format!("expected an angular radius of at most 180 degrees, found `{found}`")),
        }
    }

    /// The file from which the light is read, if any.
    pub(in crate::cli) fn file(&self) -> Option<&Path> {
        match self {
            Self::Picture(path) => Some(path),
            Self::Scene { scene, .. } => scene_name::named_file(scene).first().copied(),
            _ => None,
        }
    }

    pub(in crate::cli) fn name(&self) -> String {
        match self {
            Self::Constant(_) => "a constant light".to_owned(),
            Self::Disk { degrees, .. } => format!("a disk of {degrees} degrees"),
            Self::Sky { .. } => "a clear sky with a sun".to_owned(),
            Self::RedAndBlue => "a red and a blue disk".to_owned(),
            Self::Picture(path) => path.display().to_string(),
            Self::Scene { scene, at } => {
                let at = at.as_vec3().to_array().map(|at| at.to_string()).join(", ");
                format!("the light at {at} in {}", scene.display())
            }
        }
    }

    /// The light, before it is sampled at the texels of a cube.
    pub(in crate::cli) fn distant(&self) -> miette::Result<DistantLight> {
        Ok(match self {
            Self::Constant(radiance) => DistantLight::Constant(*radiance),
            &Self::Disk { towards, degrees, radiance } => {
                DistantLight::Disks(vec![DiskSource { towards, radius: degrees.to_radians(), radiance }])
            }
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
            Self::Scene { scene, at } => DistantLight::Texels(seen_from(scene, *at)?),
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
            Self::Scene { scene, at } => seen_from(scene, *at)?.harmonics(order),
        };
        Ok(made.map_err(|error| Problem::usage(error.to_string(), "see this command's `--help`"))?)
    }
}

/// The light at a place in a scene, by path tracing with one camera per face of the cube of texels.
fn seen_from(path: &Path, at: DVec3) -> miette::Result<CubeLight> {
    let scene = scene_name::surroundings(path)?;
    if scene.point_lights.is_empty() && scene.emitters().is_empty() {
        let what = format!("{}: expected a scene with lights, found none", path.display());
        return Err(Problem::usage(what, "docs/scenes.md says how a scene gets lights").into());
    }
    let no_place = |what: String| {
        Problem::usage(format!("{}: {what}", path.display()), "give a place inside the scene, in units of the scene")
    };
    // Beyond this bound, single precision does not separate the place from the faces of a cube around it.
    if at.abs().max_element() >= f64::from(1 << 24) {
        let what = format!("expected a place of light within 2^24 of the origin, found {}", at.as_vec3());
        return Err(no_place(what).into());
    }
    let (mut tracer, bar) = (HostTracer::new(scene.mesh(), Sides::Both), ProgressBar::new("light in the scene", 6));
    let settings = Settings { samples: SAMPLES, ..Settings::default() };
    let mut faces = 0..;
    let texels = seen_around(at, LIGHT_SIDE as u32, |camera| {
        bar.show("light in the scene".to_owned(), faces.next().unwrap_or(6), 6);
        Ok(path::render(&scene, camera, &settings, path::Direct::Both, &mut tracer, &mut |_| ())?.color)
    });
    let texels = texels.map_err(|error| no_place(error.to_string()))?;
    if texels.iter().flatten().all(|&radiance| radiance == 0.0) {
        return Err(no_place(format!("expected a place that light reaches, found {}", at.as_vec3())).into());
    }
    Ok(CubeLight::new(texels).map_err(|error| no_place(error.to_string()))?)
}

const fn clear_sky(sun: DVec3) -> ClearSky {
    ClearSky { sun, sun_radiance: SUN, zenith: ZENITH, ground: GROUND }
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.to_string_lossy().to_ascii_lowercase().ends_with(ending)
}

fn no_light(path: &Path, error: &dyn std::fmt::Display) -> Problem {
    Problem::usage(format!("{}: {error}", path.display()), "docs/papers/cpca.md describes the pictures of lights")
}
