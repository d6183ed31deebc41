//! Memory of the card that the passes use.

use super::gather::GatherProgram;
use super::levels::LeveledMap;
use super::link_textures::LinkTextures;
use super::options::{LightStage, SubsurfaceCardOptions};

/// Bytes of textures and targets by use, without the picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CardMemory {
    /// Names of the parts, each with its number of bytes.
    pub parts: Vec<(&'static str, u64)>,
}

impl CardMemory {
    pub(super) fn new(links: &LinkTextures, options: &SubsurfaceCardOptions, programs: &[GatherProgram]) -> Self {
        let texels = u64::from(links.side) * u64::from(links.side);
        let [map, levels, row] = LeveledMap::bytes(options.map, links.side, links.layout());
        let geometry = if options.light == LightStage::Texels { 2 * 16 * texels } else { 0 };
        let scattered = texels * options.scattered.format().bytes() as u64 * programs.len().min(2) as u64;
        let textures = programs.iter().map(GatherProgram::link_textures).sum();
        let parts = vec![
            ("links", links.bytes(options.links, textures)),
            ("radiosity map", map),
            ("levels", levels),
            ("levels side by side", row),
            ("scattered irradiance", scattered),
            ("geometry image and normal map", geometry),
        ];
        Self { parts: parts.into_iter().filter(|part| part.1 > 0).collect() }
    }

    /// Total number of bytes.
    pub fn bytes(&self) -> u64 {
        self.parts.iter().map(|part| part.1).sum()
    }
}
