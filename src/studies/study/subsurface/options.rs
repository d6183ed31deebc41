//! Options of the study, as on the command line.

use super::gather_way::{GatherWay, MapBits};
use crate::options::number;
use crate::options::one_of::{OneOf, one_of, variants};
use crate::study::StudyError;
use crate::subsurface::Material;
use crate::subsurface::kernels::LinkLayout;
use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::FloatTexels;

/// Maximum side of an atlas, in texels, for which `crossbar subsurface` gathers over all pairs by default.
pub(super) const ALL_PAIRS_SIDE: u32 = 32;
/// Maximum side of an atlas for all pairs; their time grows with the square of the number of texels.
const MAX_ALL_PAIRS_SIDE: u32 = 512;

/// Options of the study.
#[derive(Clone, Debug, clap::Args)]
pub struct SubsurfaceOptions {
    /// Millimeters per unit of the model; never guessed.
    #[arg(long, value_name = "MM", value_parser = number::positive)]
    pub mm_per_unit: f64,

    /// Texels along a side of the atlas: a power of two.
    #[arg(long = "atlas", value_name = "N", default_value_t = 128, value_parser = number::whole::<u32>(1..=8192))]
    pub side: u32,

    /// Links per texel; for fixed links 1, 4, 16, 64, ...
    #[arg(long, value_name = "L,L", value_delimiter = ',', default_value = "16", value_parser = number::whole::<u32>(1..=16384))]
    pub links: Vec<u32>,

    /// Layout of links; may be repeated [default: fixed]
    #[arg(long = "choice", value_name = "HOW", value_parser = choices())]
    pub choices: Vec<LinkLayout>,

    /// Factors per link; may be repeated [default: rgb, or scalar for a medium of one color]
    #[arg(long, value_name = "C", value_parser = rgb())]
    pub channels: Vec<bool>,

    /// Format of link textures; may be repeated [default: fp16]
    #[arg(long = "link-format", value_name = "F", value_parser = variants::<FloatTexels>())]
    pub link_formats: Vec<FloatTexels>,

    /// Format of the radiosity map; may be repeated [default: fp16]
    #[arg(long = "map", value_name = "F", value_parser = maps())]
    pub maps: Vec<MapBits>,

    /// Largest relative error of factors, in addition to 1e-5 of the total
    #[arg(long, value_name = "X", default_value_t = crate::subsurface::multipole::TOLERANCE, value_parser = number::positive)]
    pub tolerance: f64,

    #[arg(long, value_name = "YES", value_parser = yes_or_no(), help = format!(
        "Gather over all pairs of texels too [default: yes for atlases up to {ALL_PAIRS_SIDE}]"
    ))]
    all_pairs: Option<bool>,
}

/// Values of `--choice`: layouts of links.
fn choices() -> OneOf<LinkLayout> {
    let fixed = ("fixed", "All clusters of one level: 1, 4, 16, 64, ... links", LinkLayout::Fixed);
    let help = "Per texel, the cluster with the highest factor gives way to its four children";
    one_of([fixed, ("adaptive", help, LinkLayout::Adaptive)])
}

/// Values of `--channels`: `true` for a factor per channel, `false` for one factor.
fn rgb() -> OneOf<bool> {
    one_of([("scalar", "One, that of green", false), ("rgb", "Red, green and blue", true)])
}

/// Values of `--map`: formats of the radiosity map.
fn maps() -> OneOf<MapBits> {
    one_of([
        ("8bit", "8 bits per channel, whose levels the card generates", MapBits::Eight),
        ("fp16", "Half floats; passes compute the levels", MapBits::Float(FloatTexels::Fp16)),
        ("fp32", "Single floats; passes compute the levels", MapBits::Float(FloatTexels::Fp32)),
    ])
}

fn yes_or_no() -> OneOf<bool> {
    one_of([("yes", "Do it", true), ("no", "Do not", false)])
}

impl SubsurfaceOptions {
    /// Checks the options that do not depend on the medium. Fails if one is out of its range.
    pub fn check(&self) -> Result<(), StudyError> {
        if self.all_pairs == Some(true) && self.side > MAX_ALL_PAIRS_SIDE {
            let help = format!("leave out `--all-pairs`, or choose an `--atlas` of at most {MAX_ALL_PAIRS_SIDE}");
            return Err(StudyError::usage(format!("all pairs of {0} x {0} texels would take hours", self.side), help));
        }
        Ok(())
    }

    /// Returns `true` if all pairs of texels are gathered.
    pub fn gathers_all_pairs(&self) -> bool {
        self.all_pairs.unwrap_or(self.side <= ALL_PAIRS_SIDE)
    }

    /// Every combination of the options that may be repeated; each is a row of the table. Fails if no level of the
    /// atlas has the requested number of fixed links.
    pub fn ways(&self, material: &Material) -> Result<Vec<GatherWay>, StudyError> {
        let [r, g, b] = material.channels;
        let choices = or(&self.choices, LinkLayout::Fixed);
        let (channels, formats) = (or(&self.channels, r != g || g != b), or(&self.link_formats, FloatTexels::Fp16));
        let maps = or(&self.maps, MapBits::Float(FloatTexels::Fp16));
        let mut ways = Vec::new();
        for &choice in &choices {
            for &links in &self.links {
                let choice = link_choice(choice, links, self.side)?;
                for &rgb in &channels {
                    for &links in &formats {
                        ways.extend(maps.iter().map(|&map| GatherWay { choice, rgb, links, map }));
                    }
                }
            }
        }
        Ok(ways)
    }
}

/// The requested values, or the usual value.
fn or<T: Copy>(asked: &[T], usual: T) -> Vec<T> {
    if asked.is_empty() { vec![usual] } else { asked.to_vec() }
}

fn link_choice(choice: LinkLayout, links: u32, side: u32) -> Result<LinkChoice, StudyError> {
    match choice {
        LinkLayout::Adaptive => Ok(LinkChoice::Adaptive { count: links as usize }),
        LinkLayout::Fixed => {
            let found = (0..=side.max(1).ilog2())
                .map(|level| LinkChoice::Fixed { level })
                .find(|fixed| fixed.per_texel(side) == u64::from(links));
            found.ok_or_else(|| {
                let help = "fixed links are all clusters of a level: 1, 4, 16, 64, ... up to the number of texels";
                StudyError::usage(format!("no level of an atlas of {side} x {side} has {links} clusters"), help)
            })
        }
    }
}
