//! Images, states and reads.

use super::random::Random;
use crate::sampling::switched;
use refsim::exec::SamplerBinding;
use refsim::num::Format;
use refsim::texture::{
    AddressMode, Filter, Image, MipFilter, SampleRules, SamplerState, SignedTexelMinimum, TargetRounding, TexelFormat,
    TextureError, TextureKind, encode,
};

/// Words per read in the test's shader.
pub(crate) const READ_WORDS: usize = 56;
const KINDS: [TextureKind; 5] =
    [TextureKind::D1, TextureKind::D2, TextureKind::Rectangle, TextureKind::Cube, TextureKind::Volume];
const MODES: [AddressMode; 4] = [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border];

/// A texture and its sampler state; `image` is `None` for an unbound sampler.
pub(crate) struct Case {
    pub(crate) image: Option<Image>,
    pub(crate) state: SamplerState,
    pub(crate) rules: SampleRules,
}

impl Case {
    pub(crate) fn binding(&self) -> Option<SamplerBinding<'_>> {
        self.image.as_ref().map(|image| SamplerBinding { image, state: self.state })
    }
}

/// A read by a quad: coordinates, bias and gradients by lane.
#[derive(Debug)]
pub(crate) struct Read {
    pub(crate) sampler: usize,
    pub(crate) coordinates: [[u32; 4]; 4],
    pub(crate) detail: u32,
    pub(crate) bias: [u32; 4],
    pub(crate) gradients: [[[u32; 4]; 2]; 4],
    pub(crate) run: u32,
}

impl Read {
    pub(crate) fn words(&self) -> [u32; READ_WORDS] {
        let mut words = [0; READ_WORDS];
        for (lane, (at, gradients)) in self.coordinates.iter().zip(&self.gradients).enumerate() {
            for c in 0..4 {
                words[4 * c + lane] = at[c];
                words[24 + 4 * c + lane] = gradients[0][c];
                words[40 + 4 * c + lane] = gradients[1][c];
            }
            words[16 + lane] = self.bias[lane];
        }
        words[20] = self.sampler as u32;
        words[21] = self.detail;
        words[22] = self.run;
        words
    }
}

/// Every texel format with every kind of texture, an unbound sampler, and textures of the maximum size.
pub(crate) fn cases(random: &mut Random, main: Format) -> Result<Vec<Case>, TextureError> {
    let mut out = vec![Case { image: None, state: SamplerState::default(), rules: rules(random, main) }];
    for &format in TexelFormat::ALL {
        for kind in KINDS {
            let side = |r: &mut Random| if r.coin() { 1 << r.below(5) } else { 1 + r.below(13) };
            let (width, height, depth) = (side(random), side(random), side(random).min(6));
            let extents = match kind {
                TextureKind::D1 => [width, 1, 1],
                TextureKind::Cube => [width, width, 1],
                TextureKind::Volume => [width.min(8), height.min(8), depth],
                _ => [width, height, 1],
            };
            out.push(case(random, main, format, kind, extents)?);
        }
    }
    for width in [16_384, 16_383] {
        out.push(case(random, main, TexelFormat::L8, TextureKind::D1, [width, 1, 1])?);
        out.push(case(random, main, TexelFormat::R16f, TextureKind::D2, [width, 3, 1])?);
    }
    Ok(out)
}

fn case(
    random: &mut Random,
    main: Format,
    format: TexelFormat,
    kind: TextureKind,
    extents: [u32; 3],
) -> Result<Case, TextureError> {
    let most = match kind {
        TextureKind::Rectangle => 1,
        _ => extents[0].max(extents[1]).max(extents[2]).ilog2() + 1,
    };
    let levels = if random.below(4) == 0 { 1 } else { 1 + random.below(most) };
    let mut image = Image::new(format, kind, extents, levels)?;
    let size = format.bytes();
    for texel in image.bytes_mut().chunks_exact_mut(size) {
        let raw = if format.record().is_float() && random.below(8) != 0 {
            let values = [0; 4].map(|_: u32| random.spread(-6, 3).to_bits());
            encode(format, Format::FP32, values, TargetRounding::Nearest)
        } else {
            (0..4).fold(0, |raw, _| raw << 32 | u128::from(random.bits()))
        };
        texel.copy_from_slice(&raw.to_le_bytes()[..size]);
    }
    let state = state(random, levels);
    Ok(Case { image: Some(image), state, rules: rules(random, main) })
}

fn state(random: &mut Random, levels: u32) -> SamplerState {
    let filters = [Filter::Nearest, Filter::Linear, Filter::Linear];
    SamplerState {
        min: random.of(&filters),
        mag: random.of(&filters),
        mip: random.of(&[MipFilter::None, MipFilter::Nearest, MipFilter::Linear, MipFilter::Linear]),
        address_u: random.of(&MODES),
        address_v: random.of(&MODES),
        address_w: random.of(&MODES),
        border: [0; 4]
            .map(|_: u32| if random.below(8) == 0 { random.edge() } else { random.between(-1.5, 1.5).to_bits() }),
        lod_bias: match random.below(4) {
            0 => random.between(-3.0, 3.0).to_bits(),
            1 if random.below(6) == 0 => random.edge(),
            _ => 0,
        },
        max_mip_level: if random.below(3) == 0 { random.below(levels + 2) as u8 } else { 0 },
    }
}

pub(crate) fn rules(random: &mut Random, format: Format) -> SampleRules {
    let mut rules = SampleRules {
        filter_fraction_bits: if random.coin() { 8 } else { random.below(13) },
        lod_fraction_bits: if random.coin() { 8 } else { random.below(9) },
        signed_texel_minimum: random.of(&[SignedTexelMinimum::Clamp, SignedTexelMinimum::BelowMinusOne]),
        ..SampleRules::exact(format)
    };
    (
        rules.filter_weight_rounding,
        rules.filter_arithmetic,
        rules.texel_values,
        rules.missing_channels,
        rules.border_storage,
    ) = switched(random.bits());
    rules
}

/// A read of sampler `number`.
pub(crate) fn read(random: &mut Random, number: usize, case: &Case) -> Read {
    let size = case.image.as_ref().map_or([1; 3], |i| [i.width(), i.height(), i.slices()]);
    let kind = case.image.as_ref().map_or(TextureKind::D2, Image::kind);
    let smooth = random.below(3) != 0;
    // Steps from a fraction of a texel to the whole image.
    let step = random.spread(-14, 2);
    let start = [0, 1, 2, 3].map(|c: usize| coordinate(random, kind, size[c.min(2)]));
    let mut coordinates = [[0; 4]; 4];
    for (lane, at) in coordinates.iter_mut().enumerate() {
        for (c, x) in at.iter_mut().enumerate() {
            let (right, down) = ((lane & 1) as f32, (lane >> 1) as f32);
            *x = if smooth {
                let slope = step * (1.0 + c as f32 / 3.0);
                let scale = if kind == TextureKind::Rectangle { size[c.min(2)] as f32 } else { 1.0 };
                (f32::from_bits(start[c]) + scale * (slope * right - 0.6 * slope * down)).to_bits()
            } else {
                coordinate(random, kind, size[c.min(2)])
            };
        }
    }
    let gradients =
        [0; 4].map(|_: u32| {
            [0; 2].map(|_: u32| {
                [0; 4].map(|_: u32| {
                    if random.below(24) == 0 { random.edge() } else { (step * random.between(-1.0, 1.0)).to_bits() }
                })
            })
        });
    let bias =
        [0; 4].map(|_: u32| if random.below(12) == 0 { random.edge() } else { random.between(-5.0, 5.0).to_bits() });
    let run = if random.below(4) == 0 { random.below(16) } else { 15 };
    Read { sampler: number, coordinates, detail: random.below(3), bias, gradients, run }
}

fn coordinate(random: &mut Random, kind: TextureKind, size: u32) -> u32 {
    let scale = if kind == TextureKind::Rectangle { size as f32 } else { 1.0 };
    let texels = |r: &mut Random| r.below(4 * size + 1) as f32 - (2 * size) as f32;
    match random.below(16) {
        0..2 => random.edge(),
        2 => random.bits(),
        3..5 => (texels(random) / size as f32 * scale).to_bits(),
        5 => (texels(random) / size as f32 * scale).to_bits().wrapping_add(1),
        6 => (texels(random) / size as f32 * scale).to_bits().wrapping_sub(1),
        7 => ((texels(random) + 0.5) / size as f32 * scale).to_bits(),
        8 => random.spread(-30, 30).to_bits(),
        // Equal magnitudes matter for cube maps.
        9..11 if kind == TextureKind::Cube => random.of(&[1.0f32, -1.0, 0.5]).to_bits(),
        _ => (random.between(-1.5, 2.5) * scale).to_bits(),
    }
}
