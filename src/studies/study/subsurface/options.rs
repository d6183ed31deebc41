//! Parameters of the study; its options are options of the program.

use refsim::device::Profile;
use refsim::machine::Executor;

use crate::card::CardError;
use crate::error::InputError;
use crate::geom::Mesh;
use crate::options::one_of::{OneOf, name, one_of, variants};
use crate::options::{number, or};
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::caster::CasterChoice;
use crate::subsurface::Material;
use crate::subsurface::kernels::LinkLayout;
use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::{FloatTexels, Light};
use crate::transfer::light::CubeLight;

/// Maximum side of an atlas, in texels, for which `crossbar subsurface` gathers over all pairs by default.
pub(super) const ALL_PAIRS_SIDE: u32 = 32;
/// Maximum side of an atlas for all pairs; their time grows with the square of the number of texels.
const MAX_ALL_PAIRS_SIDE: u32 = 512;

/// A model made of a medium, its lights, and the ways in which the card gathers.
#[derive(Debug)]
pub struct Parameters {
    /// The model's name.
    pub model: String,
    /// Its surface.
    pub mesh: Mesh,
    /// Its medium.
    pub material: Material,
    /// The light.
    pub lighting: Lighting,
    /// Ways of gathering; each has a row in the table.
    pub ways: Vec<GatherWay>,
    /// The card.
    pub profile: Profile,
    /// Switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// The executor of the card.
    pub executor: Executor,
    /// Caster of the shadow rays of an environment map.
    pub caster: CasterChoice,
    /// The camera of the pictures.
    pub camera: Camera,
    /// The options.
    pub options: SubsurfaceOptions,
}

/// The light on the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Lighting {
    /// Lights drawn by pass 1.
    Lights(Vec<Light>),
    /// Distant light of an environment map, per texel and with shadows; replaces pass 1.
    Environment(CubeLight),
}

/// The format of the radiosity map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "lowercase")]
pub enum MapBits {
    /// 8 bits per channel, whose levels the card generates.
    #[strum(serialize = "8bit")]
    Eight,
    /// Half floats; passes compute the levels.
    Fp16,
    /// Single floats; passes compute the levels.
    Fp32,
}

/// One way of gathering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherWay {
    /// Number and layout of links per texel.
    pub choice: LinkChoice,
    /// `true` for a factor per channel, `false` for green's factor for all channels.
    pub rgb: bool,
    /// Format of the link textures.
    pub links: FloatTexels,
    /// Format of the radiosity map.
    pub map: MapBits,
}

impl GatherWay {
    /// A name for tables and files.
    pub fn label(&self, side: u32) -> String {
        let channels = if self.rgb { "-rgb" } else { "" };
        let (choice, count) = (self.choice.word(), self.choice.per_texel(side));
        format!("{choice}-{count}{channels}-{}-map-{}", name(&self.links), name(&self.map))
    }
}

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
    #[arg(long = "map", value_name = "F", value_parser = variants::<MapBits>())]
    pub maps: Vec<MapBits>,

    /// Largest relative error of the links' factors, in addition to 1e-5 of the total
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
    let help = "Per texel, the cluster with the highest factor is repeatedly replaced by its four children";
    one_of([fixed, ("adaptive", help, LinkLayout::Adaptive)])
}

/// Values of `--channels`: `true` for a factor per channel, `false` for one factor.
fn rgb() -> OneOf<bool> {
    one_of([("scalar", "One factor, that of green", false), ("rgb", "Red, green and blue", true)])
}

fn yes_or_no() -> OneOf<bool> {
    one_of([("yes", "Gather over all pairs", true), ("no", "Leave out the sum over all pairs", false)])
}

impl SubsurfaceOptions {
    /// Checks the options that do not depend on the medium. Fails if one is out of its range.
    pub fn check(&self) -> Result<(), StudyError> {
        if self.all_pairs == Some(true) && self.side > MAX_ALL_PAIRS_SIDE {
            let help = format!("remove `--all-pairs`, or choose an `--atlas` of at most {MAX_ALL_PAIRS_SIDE}");
            return Err(StudyError::usage(format!("all pairs of {0} x {0} texels would take hours", self.side), help));
        }
        Ok(())
    }

    /// Returns `true` if all pairs of texels are gathered.
    pub fn gathers_all_pairs(&self) -> bool {
        self.all_pairs.unwrap_or(self.side <= ALL_PAIRS_SIDE)
    }

    /// Every combination of the options that may be repeated; fails if no level has that many fixed links.
    pub fn ways(&self, material: &Material) -> Result<Vec<GatherWay>, StudyError> {
        let [r, g, b] = material.channels;
        let (choices, channels) = (or(&self.choices, &[LinkLayout::Fixed]), or(&self.channels, &[r != g || g != b]));
        let (formats, maps) = (or(&self.link_formats, &[FloatTexels::Fp16]), or(&self.maps, &[MapBits::Fp16]));
        let mut ways = Vec::new();
        for &choice in &choices {
            for &links in &self.links {
                let choice = link_choice(choice, links, self.side)?;
                for (&rgb, &links) in channels.iter().flat_map(|rgb| formats.iter().map(move |links| (rgb, links))) {
                    ways.extend(maps.iter().map(|&map| GatherWay { choice, rgb, links, map }));
                }
            }
        }
        Ok(ways)
    }
}

fn link_choice(choice: LinkLayout, links: u32, side: u32) -> Result<LinkChoice, StudyError> {
    if choice == LinkLayout::Adaptive {
        return Ok(LinkChoice::Adaptive { count: links as usize });
    }
    let mut levels = (0..=side.max(1).ilog2()).map(|level| LinkChoice::Fixed { level });
    levels.find(|fixed| fixed.per_texel(side) == u64::from(links)).ok_or_else(|| {
        let help = "fixed links are all clusters of a level: 1, 4, 16, 64, ... up to the number of texels";
        StudyError::usage(format!("no level of an atlas of {side} x {side} has {links} clusters"), help)
    })
}

/// Error of a model for which no atlas exists.
pub fn no_atlas(error: InputError) -> StudyError {
    StudyError::coded("subsurface::atlas", error)
}

/// Error of the card.
pub(in crate::study) fn no_card(error: CardError) -> StudyError {
    StudyError::coded("subsurface::card", error)
}
