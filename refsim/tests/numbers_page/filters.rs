//! Tests of the section "Bytes": missing components, filters of bytes, and borders.

use super::texels::{Channel, Class, component, table};
use super::{Random, probes};
use refsim::num::Format;
use refsim::texture::{
    AddressMode, BorderStorage, Filter, FilterArithmetic, Image, Lod, MipFilter, MissingChannels, SampleRules,
    SamplerState, SignedTexelMinimum, TexelFormat, TexelValues, TextureKind, WeightRounding, sample,
};

/// Extents of level 0; level 1 is half as large.
const SIZE: [i64; 2] = [8, 4];

/// A byte, and `true` if it is signed.
type Byte = (i64, bool);

struct Case<'a> {
    format: TexelFormat,
    channels: &'a [Channel],
    rules: SampleRules,
}

impl Case<'_> {
    /// Byte of a stored channel: its bits repeated from the highest; the upper byte of 16 bits.
    fn channel(&self, channel: &Channel, raw: u128) -> Byte {
        let (code, bits) = (channel.code(raw), i64::from(channel.bits));
        let bit = |place: i64| code >> (bits - 1 - place % bits) & 1;
        let byte = (0..8).fold(0, |byte, place| 2 * byte + bit(place));
        let signed = channel.class != Class::Unsigned;
        (if signed && byte > 127 { byte - 256 } else { byte }, signed)
    }

    /// Channel of a component, or its constant.
    fn source(&self, number: usize) -> Result<&Channel, i64> {
        let letters: String = self.channels.iter().map(|c| c.letter).collect();
        match (self.rules.missing_channels, letters.as_str()) {
            (MissingChannels::Xbox, "a") if number < 3 => Err(1),
            (MissingChannels::Xbox, "rg") if self.channels[0].bits == 16 => Ok(&self.channels[[0, 1, 1, 0][number]]),
            (MissingChannels::Xbox, "rg") => Ok(&self.channels[number % 2]),
            _ => component(self.channels, number),
        }
    }

    fn texel(&self, raw: u128) -> [Byte; 4] {
        [0, 1, 2, 3].map(|i| match self.source(i) {
            Ok(channel) => self.channel(channel, raw),
            Err(constant) => (255 * constant, false),
        })
    }

    fn border(&self, color: [f32; 4]) -> [Byte; 4] {
        if self.rules.border_storage == BorderStorage::Bytes && self.channels.iter().all(|c| c.class == Class::Unsigned)
        {
            return color.map(|c| ((f64::from(c.clamp(0.0, 1.0)) * 255.0 + 0.5).floor() as i64, false));
        }
        let stored = self.channels.iter().map(|c| c.place(c.store(color[c.component()], false)));
        self.texel(stored.fold(0, |raw, channel| raw | channel))
    }

    /// Register value of a byte, in single precision.
    fn value(&self, (byte, signed): Byte) -> f32 {
        let (numerator, denominator) = match (signed, self.rules.texel_values) {
            (false, _) => (byte, 255),
            (true, TexelValues::Fractions) => (byte, 127),
            (true, TexelValues::Bytes) => (2 * byte, 255),
        };
        let clamp = signed && self.rules.signed_texel_minimum == SignedTexelMinimum::Clamp;
        // A quotient of short integers, rounded to double and then to single, is rounded correctly.
        (if clamp { numerator.max(-denominator) } else { numerator } as f64 / denominator as f64) as f32
    }

    /// Texel and weight along an axis of `n` texels.
    fn place(&self, u: f32, n: i64) -> (i64, i64) {
        let bits = self.rules.filter_fraction_bits;
        let one = 1i64 << bits;
        let steps = f64::from(u) * (n * one) as f64;
        let half = if self.rules.filter_weight_rounding == WeightRounding::Nearest { 0.5 } else { 0.0 };
        let position = (steps + half).floor() as i64 - one / 2;
        (position.div_euclid(one), position.rem_euclid(one))
    }

    fn level(&self, image: &Image, level: u32, state: &SamplerState, [u, v]: [f32; 2]) -> [Byte; 4] {
        let size = SIZE.map(|n| n >> level);
        let ((x, wx), (y, wy)) = (self.place(u, size[0]), self.place(v, size[1]));
        let border = self.border(state.border.map(f32::from_bits));
        let at = |x: i64, y: i64| match state.address_u {
            AddressMode::Border if !(0..size[0]).contains(&x) || !(0..size[1]).contains(&y) => border,
            _ => {
                let [x, y] = [x.rem_euclid(size[0]), y.rem_euclid(size[1])];
                self.texel(image.raw(level, 0, y as u32, x as u32))
            }
        };
        let bits = self.rules.filter_fraction_bits;
        let row = |y: i64| lerp(at(x, y), at(x + 1, y), wx, bits);
        lerp(row(y), row(y + 1), wy, bits)
    }
}

/// `floor(a + w * (b - a) + 1/2)`.
fn lerp(a: [Byte; 4], b: [Byte; 4], weight: i64, bits: u8) -> [Byte; 4] {
    let one = 1i64 << bits;
    [0, 1, 2, 3].map(|i| {
        let ((first, signed), (second, _)) = (a[i], b[i]);
        ((2 * (first * one + weight * (second - first)) + one).div_euclid(2 * one), signed)
    })
}

fn rules(r: &mut Random) -> SampleRules {
    SampleRules {
        filter_fraction_bits: r.of(&[4, 5, 6, 8]),
        lod_fraction_bits: 8,
        signed_texel_minimum: r.of(SignedTexelMinimum::ALL),
        filter_weight_rounding: r.of(WeightRounding::ALL),
        filter_arithmetic: FilterArithmetic::ByteLerps,
        texel_values: r.of(TexelValues::ALL),
        missing_channels: r.of(MissingChannels::ALL),
        border_storage: r.of(BorderStorage::ALL),
        ..SampleRules::exact(Format::FP32)
    }
}

#[test]
fn bytes_are_filtered_as_the_page_says() {
    let mut r = Random::new(17);
    let formats = table();
    for _ in 0..probes(3_000) {
        let rules = rules(&mut r);
        let is_byte = |c: &Channel| {
            let others = rules.texel_values == TexelValues::Bytes && (c.bits < 8 || c.bits == 16);
            !matches!(c.class, Class::Float(..)) && (others || c.bits == 8)
        };
        let usable: Vec<_> = formats.iter().filter(|row| row.2.iter().all(is_byte)).collect();
        let (format, bytes, channels) = usable[r.below(usable.len())];
        let case = Case { format: *format, channels, rules };
        let extents = [SIZE[0] as u32, SIZE[1] as u32, 1];
        let data = (0..bytes * 40).map(|_| r.code());
        let image = Image::from_bytes(case.format, TextureKind::D2, extents, 2, data.collect()).unwrap();
        let mode = r.of(&[AddressMode::Wrap, AddressMode::Border]);
        let state = SamplerState {
            min: Filter::Linear,
            mag: Filter::Linear,
            mip: MipFilter::Linear,
            address_u: mode,
            address_v: mode,
            border: [0; 4].map(|_| r.between(-0.2, 1.2).to_bits()),
            ..SamplerState::NEAREST_CLAMP
        };
        let (at, level) = ([r.between(-1.5, 1.5), r.between(-1.5, 1.5)], r.below(257_i16));
        let [fine, coarse] = [0, 1].map(|level| case.level(&image, level, &state, at));
        let expected = lerp(fine, coarse, i64::from(level), 8).map(|byte| case.value(byte));
        let lod = Lod::Level((f32::from(level) / 256.0).to_bits());
        let coordinates = [at[0].to_bits(), at[1].to_bits(), 0, 0];
        let found = sample(Some(&image), &state, &rules, coordinates, lod).map(f32::from_bits);
        assert_eq!(found, expected, "{format}, {at:?}, level {level} / 256, {state:?}, {rules:?}");
        // A nearest read uses the same bytes, without a filter.
        let nearest = SamplerState { min: Filter::Nearest, mag: Filter::Nearest, mip: MipFilter::None, ..state };
        let texel = [0, 1].map(|i| (f64::from(at[i]) * SIZE[i] as f64).floor() as i64);
        let inside = (0..2).all(|i| (0..SIZE[i]).contains(&texel[i]));
        let [x, y] = [0, 1].map(|i| texel[i].rem_euclid(SIZE[i]) as u32);
        let border = case.border(state.border.map(f32::from_bits));
        let bytes = if inside || mode == AddressMode::Wrap { case.texel(image.raw(0, 0, y, x)) } else { border };
        let found = sample(Some(&image), &nearest, &rules, coordinates, Lod::Base).map(f32::from_bits);
        assert_eq!(found, bytes.map(|byte| case.value(byte)), "{format}, {at:?}, {rules:?}");
    }
}
