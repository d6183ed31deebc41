//! Pass 2 on the host, in the order and precision of the programs: the bits that the card must give.
//!
//! Per texel and channel the sum starts at 0 and takes link after link: the product with the factor, rounded, then the
//! sum, rounded. At the end of a pass it is rounded into the target, from which the next pass goes on; the last pass
//! multiplies by the reciprocal of the map's scale first. Single floats flush subnormal numbers to zero.

use rayon::prelude::*;
use refsim::num::{Format, ops};
use refsim::texture::TextureError;

use super::gather::{GatherProgram, map_texture};
use super::link_textures::LinkTextures;
use super::options::SubsurfaceCardOptions;
use crate::card::Texels;
use crate::subsurface::kernels::MapTexture;

/// Sums of the gather over the levels of a map (finest first, as [`super::SubsurfaceCard::read_levels`] gives
/// them) on a device whose half precision is `half`.
///
/// # Errors
/// [`TextureError`] never for links and levels of one atlas.
pub fn gathered(
    levels: &[Texels],
    links: &LinkTextures,
    programs: &[GatherProgram],
    half: Format,
    options: &SubsurfaceCardOptions,
) -> Result<Texels, TextureError> {
    let map = map_texture(options);
    let rounded = |texels: Texels, format| Ok(Texels::from_image(&texels.to_image(format)?));
    let textures: Vec<Texels> = (0..links.texture_count())
        .map(|index| rounded(links.on_card(index, map), options.links.format()))
        .collect::<Result<_, TextureError>>()?;
    let arithmetic = Arithmetic { half: options.half.then_some(half) };
    let side = links.side as usize;
    let mut sums = Texels::from_fn([side; 2], |_, _| [0.0; 4]);
    for (pass, program) in programs.iter().enumerate() {
        let factor = if pass + 1 == programs.len() { (1.0 / options.map.scale()) as f32 } else { 1.0 };
        let row = |y: usize| {
            let texel = |x: usize| {
                let mut sum = sums.row(y)[x].map(|value| arithmetic.taken(value));
                for link in program.from..program.from + program.links {
                    let (factors, texel) = arithmetic.link(links, &textures, map, levels, link, [x, y]);
                    for channel in 0..3 {
                        let product = arithmetic.mul(arithmetic.taken(texel[channel]), factors[channel]);
                        sum[channel] = arithmetic.add(sum[channel], product);
                    }
                }
                sum.map(|value| flushed(value * factor))
            };
            (0..side).map(texel).collect::<Vec<_>>()
        };
        let texels = (0..side).into_par_iter().flat_map_iter(row).collect();
        sums = rounded(Texels { width: side, height: side, texels }, options.scattered.format())?;
    }
    Ok(sums)
}

/// The arithmetic of `R` or `H` instructions, on single floats that hold their values.
#[derive(Clone, Copy, Debug)]
struct Arithmetic {
    half: Option<Format>,
}

impl Arithmetic {
    /// A value as a register holds it.
    fn taken(self, value: f32) -> f32 {
        match self.half {
            Some(half) => self.to_single(ops::convert(&Format::FP32, half, value.to_bits()).bits, half),
            None => flushed(value),
        }
    }

    fn to_single(self, bits: u32, half: Format) -> f32 {
        f32::from_bits(ops::convert(&half, Format::FP32, bits).bits)
    }

    fn in_half(self, half: Format, a: f32, b: f32, operation: fn(Format, u32, u32) -> u32) -> f32 {
        let [a, b] = [a, b].map(|value| ops::convert(&Format::FP32, half, value.to_bits()).bits);
        self.to_single(operation(half, a, b), half)
    }

    fn mul(self, a: f32, b: f32) -> f32 {
        match self.half {
            Some(half) => self.in_half(half, a, b, |format, a, b| ops::mul(format, a, b).bits),
            None => flushed(a * b),
        }
    }

    fn add(self, a: f32, b: f32) -> f32 {
        match self.half {
            Some(half) => self.in_half(half, a, b, |format, a, b| ops::add(format, a, b).bits),
            None => flushed(a + b),
        }
    }

    /// The factors of a link, and the texel of the map that it leads to.
    fn link(
        self,
        links: &LinkTextures,
        textures: &[Texels],
        map: MapTexture,
        levels: &[Texels],
        link: usize,
        [x, y]: [usize; 2],
    ) -> ([f32; 3], [f32; 4]) {
        let at = |texture: usize| textures[texture].row(y)[x].map(|value| self.taken(value));
        if let Some(level) = links.level {
            let (group, place) = (link / 4, link % 4);
            let factors = match (links.rgb, place) {
                (false, place) => [at(group)[place]; 3],
                (true, 3) => [0, 1, 2].map(|channel| at(3 * group + channel)[3]),
                (true, place) => {
                    let [r, g, b, _] = at(3 * group + place);
                    [r, g, b]
                }
            };
            let level = &levels[level as usize];
            return (factors, level.row(link / level.width)[link % level.width]);
        }
        let [u, v, factor, level] = at(link * if links.rgb { 2 } else { 1 });
        let [r, g, b, _] = if links.rgb { at(2 * link + 1) } else { [factor; 4] };
        let width = if map == MapTexture::Leveled { 1.0 / level } else { level };
        let index = (links.side / (width as u32).max(1)).ilog2();
        let level = &levels[index as usize];
        let [column, row] = [u, v].map(|place| ((place * width) as usize).min(level.width - 1));
        ([r, g, b], level.row(row)[column])
    }
}

/// Subnormal numbers are zeros of their sign.
fn flushed(value: f32) -> f32 {
    if value.is_subnormal() { 0.0_f32.copysign(value) } else { value }
}
