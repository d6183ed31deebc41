//! Ways to gather light.

use std::fmt;

use crate::subsurface::links::LinkChoice;
use crate::subsurface::on_card::FloatTexels;

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
        let (choice, count, links) = (self.choice.word(), self.choice.per_texel(side), name(self.links));
        format!("{choice}-{count}{channels}-{links}-map-{}", self.map)
    }

    /// Returns `true` if the other way of gathering uses the same links.
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
