//! Parameters of the study.

use std::fmt;

use refsim::device::Profile;
use refsim::machine::Executor;

use crate::geom::Mesh;
use crate::scene::Camera;
use crate::subsurface::Material;
use crate::subsurface::kernels::ViewKernel;
use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::{FloatTexels, Light, LightStage};
use crate::transfer::light::CubeLight;

/// A model of a medium, its lights, and the ways in which the card gathers.
#[derive(Debug)]
pub struct Parameters {
    /// The model's name.
    pub model: String,
    /// Its surface.
    pub mesh: Mesh,
    /// Millimeters of a unit of the mesh.
    pub mm_per_unit: f64,
    /// Its medium.
    pub material: Material,
    /// Texels along a side of the atlas.
    pub side: u32,
    /// How light is gathered: a row of the table for each.
    pub ways: Vec<GatherWay>,
    /// The largest relative error of factors.
    pub tolerance: f64,
    /// The light.
    pub lighting: Lighting,
    /// Where pass 1 computes light.
    pub stage: LightStage,
    /// Points of the model, in its units, at which radiosity is asked for.
    pub probes: Vec<[f64; 3]>,
    /// True to gather over all pairs of texels too.
    pub reference: bool,
    /// Photons per channel that walk beside the dipole; `None` for none.
    pub photons: Option<u64>,
    /// `true` to list links: of the probes' texels, or of all without probes.
    pub link_table: bool,
    /// True to run every gather with each value of the card's rounding switches too.
    pub roundings: bool,
    /// The card.
    pub profile: Profile,
    /// The switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// The executor of the card.
    pub executor: Executor,
    /// The camera of the pictures.
    pub camera: Camera,
    /// Pass 3.
    pub view: ViewKernel,
    /// Diffuse reflectance for direct light.
    pub diffuse: f64,
    /// Factor of radiance in pictures; `None` for auto-exposure: 18 % grey on average.
    pub exposure: Option<f64>,
    /// Pictures with the lights turned all the way round the model in so many steps.
    pub frames: u32,
}

/// The light on the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Lighting {
    /// Lights, by pass 1.
    Lights(Vec<Light>),
    /// Flux that has entered each face, per area: E of equation 8.
    ByFace(Vec<[f64; 3]>),
    /// Distant light of an environment map, per texel and with shadows, in place of pass 1.
    Environment(CubeLight),
}

/// The format of the radiosity map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapBits {
    /// 8 bits per channel, scaled so that the brightest texel is 1.
    Eight,
    /// Floats.
    Float(FloatTexels),
}

/// One way of gathering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherWay {
    /// Links per texel, and which.
    pub choice: LinkChoice,
    /// A factor per channel, or green's for all.
    pub rgb: bool,
    /// The textures of links.
    pub links: FloatTexels,
    /// The radiosity map.
    pub map: MapBits,
    /// True if pass 2 computes in half precision.
    pub half: bool,
}

impl Parameters {
    /// Returns `true` if no way before this one gathers over the same links.
    pub(super) fn has_new_links(&self, at: usize) -> bool {
        !self.ways[..at].iter().any(|other| other.has_links_of(&self.ways[at]))
    }

    /// The ways whose links are not those of an earlier one.
    pub(super) fn ways_with_links(&self) -> impl Iterator<Item = GatherWay> + '_ {
        (0..self.ways.len()).filter(|at| self.has_new_links(*at)).map(|at| self.ways[at])
    }
}

impl GatherWay {
    /// A name for tables and files.
    pub fn label(&self, side: u32) -> String {
        let half = if self.half { "-half" } else { "" };
        format!("{}-{}-map-{}{half}", self.links_label(side), name(self.links), self.map)
    }

    /// A name of the links, which formats do not change.
    pub(super) fn links_label(&self, side: u32) -> String {
        let channels = if self.rgb { "-rgb" } else { "" };
        format!("{}-{}{channels}", self.choice.word(), self.choice.per_texel(side))
    }

    /// Returns `true` if the other way gathers over the same links.
    pub(super) fn has_links_of(&self, other: &Self) -> bool {
        (self.choice, self.rgb) == (other.choice, other.rgb)
    }
}

impl fmt::Display for MapBits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Eight => f.write_str("8bit"),
            Self::Float(texels) => f.write_str(name(*texels)),
        }
    }
}

/// The name of a float format.
pub(super) fn name(texels: FloatTexels) -> &'static str {
    match texels {
        FloatTexels::Fp16 => "fp16",
        FloatTexels::Fp32 => "fp32",
    }
}
