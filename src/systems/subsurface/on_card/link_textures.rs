//! Links as textures in the layout that the programs of pass 2 read.

use super::options::FloatTexels;
use crate::card::{CardError, Texels};
use crate::subsurface::kernels::{GatherKernel, LinkLayout, MapTexture};
use crate::subsurface::links::{EncodedLinks, LinkChoice, Links, MeanWeighting, link_textures};
use crate::subsurface::multipole::SurfaceMoments;

/// The links of all texels as textures, before rounding.
#[derive(Clone, Debug)]
pub struct LinkTextures {
    pub(super) side: u32,
    pub(super) level: Option<u32>,
    pub(super) rgb: bool,
    pub(super) count: usize,
    /// The textures of [`EncodedLinks`].
    textures: Vec<Texels>,
}

impl LinkTextures {
    /// Creates the textures of links. [`MeanWeighting::Area`] is for the map that pass 1 writes, irradiance times area;
    /// [`MeanWeighting::Count`] weighs texels equally.
    pub fn new(links: &Links, surface: &SurfaceMoments, weighting: MeanWeighting) -> Self {
        let encoded = EncodedLinks::new(links, surface, weighting);
        let level = match links.choice() {
            LinkChoice::Fixed { level } => Some(level),
            LinkChoice::Adaptive { .. } => None,
        };
        let textures = (0..encoded.texture_count()).map(|index| encoded.texture(index)).collect();
        Self { side: links.side(), level, rgb: links.channels() == 3, count: links.per_texel(), textures }
    }

    /// Uses textures in the layout of [`EncodedLinks`], with `count` links per texel; all lead to one level or, if
    /// `None`, each to its own. Fails with [`CardError::Input`] for another number of textures or texels.
    pub fn from_textures(
        side: u32,
        level: Option<u32>,
        rgb: bool,
        count: usize,
        textures: Vec<Texels>,
    ) -> Result<Self, CardError> {
        CardError::check_size("textures of links", link_textures(level.is_some(), rgb, count), textures.len())?;
        for texture in &textures {
            CardError::check_size("texels of a texture of links", side as usize * side as usize, texture.texels.len())?;
        }
        if let Some(level) = level {
            let width = (side >> level.min(31)) as usize;
            CardError::check_size("links to a level", width * width, count)?;
        }
        Ok(Self { side, level, rgb, count, textures })
    }

    pub(super) fn layout(&self) -> LinkLayout {
        if self.level.is_some() { LinkLayout::Fixed } else { LinkLayout::Adaptive }
    }

    /// The program that reads the links and a map of this type.
    pub(super) fn kernel(&self, map: MapTexture, half: bool) -> GatherKernel {
        GatherKernel { layout: self.layout(), rgb: self.rgb, map, half, continues: false, tiles: 1 }
    }

    pub(super) fn check(&self, format: FloatTexels) -> Result<(), CardError> {
        let (largest, format) = format.largest();
        let mut values = self.textures.iter().flat_map(|texture| &texture.texels).flatten();
        match values.find(|value| value.is_nan() || **value > largest) {
            Some(&found) => Err(CardError::input(format!(
                "expected factors of links of at most {largest:e} in textures of {format} texels, found {found:e}: \
                 the areas of the model's texels differ too much; remove faces that are far larger than the \
                 others, or store links in fp32"
            ))),
            None => Ok(()),
        }
    }

    /// Bytes of `count` textures on the card.
    pub(super) fn bytes(&self, format: FloatTexels, count: usize) -> u64 {
        let texels = u64::from(self.side) * u64::from(self.side);
        texels * count as u64 * format.format().bytes() as u64
    }

    /// Combines textures from `first` on as tiles of one texture, row by row; tiles beyond `count` are 0.
    pub(super) fn tiled(&self, first: usize, count: usize, tiles: usize, map: MapTexture) -> Texels {
        if tiles == 1 {
            return self.on_card(first, map);
        }
        let all: Vec<Texels> = (first..first + count).map(|index| self.on_card(index, map)).collect();
        let side = self.side as usize;
        Texels::from_fn([tiles * side; 2], |x, y| {
            all.get(y / side * tiles + x / side).map_or([0.0; 4], |texels| texels.row(y % side)[x % side])
        })
    }

    /// Converts a texture to the layout that [`GatherKernel`] reads.
    pub(super) fn on_card(&self, index: usize, map: MapTexture) -> Texels {
        let size = [self.side as usize; 2];
        let at = |texture: usize, x: usize, y: usize| self.textures[texture].row(y)[x];
        match (self.level, self.rgb) {
            (Some(_), false) => self.textures[index].clone(),
            (Some(_), true) => {
                // For four links, three textures of one channel each become three textures of one link each, with the
                // fourth link in w.
                let (group, link) = (index / 3 * 3, index % 3);
                Texels::from_fn(size, |x, y| {
                    let channels = [0, 1, 2].map(|channel| at(group + channel, x, y));
                    let [r, g, b] = channels.map(|factors| factors[link]);
                    [r, g, b, channels[link][3]]
                })
            }
            (None, true) if index % 2 == 1 => self.textures[index].clone(),
            (None, _) => Texels::from_fn(size, |x, y| {
                let [u, v, factor, level] = at(index, x, y);
                let width = (self.side >> (level as u32).min(31)) as f32;
                [u, v, factor, if map == MapTexture::Leveled { 1.0 / width } else { width }]
            }),
        }
    }
}
