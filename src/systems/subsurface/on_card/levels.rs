//! The radiosity map and its levels: the card generates levels of an 8-bit map, passes compute levels of a float map.

use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{Machine, TextureId};
use refsim::output::WriteMask;
use refsim::raster::Viewport;
use refsim::texture::{MipFilter, SamplerState};

use super::options::MapFormat;
use crate::card::{CardError, FullScreenPass, Levels, ReadTexture, Texels, nearest, new_target};
use crate::subsurface::kernels::{self, LinkLayout};

#[derive(Debug)]
pub(super) struct LeveledMap {
    pub(super) format: MapFormat,
    pub(super) side: u32,
    pub(super) map: TextureId,
    float: Option<FloatLevels>,
}

/// Levels of a float map as separate rectangles, drawn by a program, because rectangles have no levels.
#[derive(Debug)]
struct FloatLevels {
    levels: Levels,
    mean: CheckedProgram,
    /// All levels side by side, for adaptive links.
    row: Option<(TextureId, CheckedProgram)>,
}

impl LeveledMap {
    pub(super) fn new(
        machine: &mut Machine,
        format: MapFormat,
        side: u32,
        layout: LinkLayout,
    ) -> Result<Self, CardError> {
        let texels = format.format();
        if format.is_leveled() {
            let map = machine.create_target_with_levels(texels, side, side, side.ilog2() + 1)?;
            return Ok(Self { format, side, map, float: None });
        }
        let profile = machine.profile();
        let (mean, copy) = (kernels::MEAN.checked(profile)?, kernels::COPY.checked(profile)?);
        let size = [side as usize; 2];
        let map = new_target(machine, texels, size)?;
        let levels = Levels::new(machine, texels, size)?;
        let row = match layout {
            LinkLayout::Fixed => None,
            LinkLayout::Adaptive => Some((new_target(machine, texels, [2 * size[0], size[1]])?, copy)),
        };
        Ok(Self { format, side, map, float: Some(FloatLevels { levels, mean, row }) })
    }

    /// Bytes on the card: the map, its levels, and the row of levels.
    pub(super) fn bytes(format: MapFormat, side: u32, layout: LinkLayout) -> u64 {
        let texel = format.format().bytes() as u64;
        let base = u64::from(side) * u64::from(side) * texel;
        let levels: u64 = (0..=side.ilog2()).map(|level| base >> (2 * level)).sum();
        let row = if !format.is_leveled() && layout == LinkLayout::Adaptive { 2 * base } else { 0 };
        levels + row
    }

    pub(super) fn fill(&self, machine: &mut Machine) -> Result<(), CardError> {
        let Some(float) = &self.float else {
            machine.generate_mipmaps(self.map)?;
            return Ok(());
        };
        float.levels.fill(machine, self.map, &float.mean)?;
        let Some((row, copy)) = &float.row else { return Ok(()) };
        for level in 0..=self.side.ilog2() {
            let width = self.side >> level;
            let x = (2 * self.side - 2 * width).cast_signed();
            let constants = &Constants::default();
            let part = Some(Viewport { x, ..Viewport::new(width, width) });
            let textures = &nearest([self.level(level)]);
            FullScreenPass { program: copy, constants, textures, target: *row, mask: WriteMask::ALL, part }
                .draw_counting(machine, [width as usize; 2])?;
        }
        Ok(())
    }

    /// The texture of a level; for a map with levels, the map itself.
    fn level(&self, level: u32) -> TextureId {
        match (&self.float, level.checked_sub(1)) {
            (Some(float), Some(below)) => float.levels.targets().get(below as usize).copied().unwrap_or(self.map),
            _ => self.map,
        }
    }

    /// The texture that pass 2 reads: one level for fixed links; if `None`, all levels for adaptive links.
    pub(super) fn read(&self, level: Option<u32>) -> ReadTexture {
        let state = SamplerState::NEAREST_CLAMP;
        match (&self.float, level) {
            (None, Some(level)) => (self.map, SamplerState { max_mip_level: level as u8, ..state }),
            (None, None) => {
                let lod_bias = (-0.5_f32).to_bits();
                (self.map, SamplerState { mip: MipFilter::Nearest, lod_bias, ..state })
            }
            (Some(_), Some(level)) => (self.level(level), state),
            (Some(float), None) => (float.row.as_ref().map_or(self.map, |(row, _)| *row), state),
        }
    }

    /// The values of all levels, finest first, as the programs read them.
    pub(super) fn read_back(&self, machine: &Machine) -> Result<Vec<Texels>, CardError> {
        if self.format.is_leveled() {
            return Ok(Texels::levels_of(machine.read_back(self.map)?));
        }
        (0..=self.side.ilog2()).map(|level| Ok(Texels::read_back(machine, self.level(level))?)).collect()
    }
}
