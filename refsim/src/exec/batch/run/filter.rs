//! Filtered reads in rows, from one level of a texture of any kind, nearest or linear.
//!
//! First the texels and weights of every lane are computed (`address`), then each component is combined: fixed point as
//! an exact sum that is rounded once, bytes in rounded steps, floats in the single-precision steps defined by
//! [`crate::texture`].

use std::sync::OnceLock;

use refsim_lanes::{AnyLane, LANES, LaneRow, SimdLevel, Slots};

use super::address::{AxisTaps, TexelAxis, Weights, cube, linear, nearest};
use super::channel::{channel_in_slot, channel_of, pays_by_code, ratios};
use super::component::FilteredComponent;
use super::corners::{BORDER, add_weighted, combine, combine_bytes, corner_numbers, corner_weights};
use crate::exec::SamplerBinding;
use crate::exec::batch::formats::LaneFormats;
use crate::exec::batch::schedule::FetchStep;
use crate::exec::lower::Arith;
use crate::texture::{AddressMode, Filter, Image, MipFilter, SampleRules, SampledComponent, SamplerState, TextureKind};

/// Maximum number of texels of a level with a table: 4 MiB. Texels of larger levels are decoded on each read.
const MAX_TABLE_TEXELS: usize = 1 << 18;

/// A level that is read in rows.
#[derive(Debug)]
pub(crate) struct FilteredLevel {
    kind: TextureKind,
    axes: [TexelAxis; 3],
    /// Texels per slice.
    slice: u32,
    /// Linear filter weights.
    weights: Weights,
    components: [FilteredComponent; 4],
    /// The numerator, byte, or single-precision value by texel and component. Built on first use, but never for large
    /// levels.
    texels: OnceLock<Vec<[u32; 4]>>,
    border: [u32; 4],
    /// For reads without a filter: the raw values by texel and component, and the border's. Built as `texels` are.
    raw: OnceLock<Vec<[u32; 4]>>,
    codes: Box<DecodedCodes>,
    /// Byte offset of the level, and its number of texels.
    start: usize,
    count: usize,
}

/// Tables indexed by the code of a channel, built on first use.
#[derive(Debug, Default)]
struct DecodedCodes {
    /// The numerator or byte for each code of a narrow channel, by component; not built if the level has few texels.
    narrow: [OnceLock<Vec<u32>>; 4],
    /// Raw values of unsigned and signed bytes, by the byte's bits.
    bytes: [OnceLock<Vec<u32>>; 2],
}

/// Unrounded results of all lanes, by component: sums of numerators, bytes, or single-precision values.
pub(super) type FilteredRows = [[f64; LANES]; 4];

/// Image and rules of a read, and the lanes that read a large image.
#[derive(Clone, Copy)]
pub(super) struct TexelSource<'t> {
    pub(super) image: &'t Image,
    pub(super) rules: &'t SampleRules,
    pub(super) run: &'t LaneRow,
}

impl FilteredLevel {
    /// Prepares the only level that a binding reads, which does not depend on the level of detail.
    pub(crate) fn new(binding: &SamplerBinding<'_>, rules: &SampleRules, lane: &AnyLane) -> Self {
        let SamplerBinding { image, state } = binding;
        // A mip filter implies a single level here: textures with more levels need a level of detail.
        let last = image.levels().len() - 1;
        let number = if state.mip == MipFilter::None { usize::from(state.max_mip_level).min(last) } else { 0 };
        Self::of_level(binding, number, rules, lane)
    }

    pub(super) fn of_level(binding: &SamplerBinding<'_>, number: usize, rules: &SampleRules, lane: &AnyLane) -> Self {
        let SamplerBinding { image, state } = binding;
        let (sources, border) = (rules.sources(image.format()), rules.border(image.format(), state.border));
        let mut components = [FilteredComponent::Constant(0); 4];
        for (component, source) in components.iter_mut().zip(sources.into_iter().zip(border)) {
            *component = FilteredComponent::new(source, state, rules, lane);
        }
        let level = image.levels()[number];
        let axis = |size: u32, asked| match image.kind() {
            TextureKind::Cube => TexelAxis { size, scale: size.into(), mode: AddressMode::Clamp },
            TextureKind::Rectangle if asked != AddressMode::Border => {
                TexelAxis { size, scale: 1.0, mode: AddressMode::Clamp }
            }
            TextureKind::Rectangle => TexelAxis { size, scale: 1.0, mode: asked },
            _ => TexelAxis { size, scale: size.into(), mode: asked },
        };
        Self {
            kind: image.kind(),
            axes: [
                axis(level.width, state.address_u),
                axis(level.height, state.address_v),
                axis(level.slices, state.address_w),
            ],
            slice: level.width * level.height,
            weights: Weights { bits: rules.filter_fraction_bits.min(12), rounding: rules.filter_weight_rounding },
            components,
            texels: OnceLock::new(),
            raw: OnceLock::new(),
            border: std::array::from_fn(|c| components[c].kept(border[c], rules)),
            codes: Box::default(),
            start: level.offset,
            count: level.width as usize * level.height as usize * level.slices as usize,
        }
    }

    /// Returns `true` if texels are decoded on each read instead of being cached.
    pub(crate) fn is_large(&self) -> bool {
        self.count > MAX_TABLE_TEXELS
    }

    /// The decoded texels of the level, slice by slice, row by row; `None` for a large level.
    fn texels(&self, source: TexelSource<'_>) -> Option<&[[u32; 4]]> {
        (!self.is_large()).then(|| self.texels.get_or_init(|| self.decoded(source)).as_slice())
    }

    fn decoded(&self, source: TexelSource<'_>) -> Vec<[u32; 4]> {
        let stored = source.image.bytes()[self.start..].chunks_exact(source.image.format().bytes()).take(self.count);
        let decoders = std::array::from_fn::<_, 4, _>(|component| self.decoder(component, source.rules));
        stored.map(|texel| decoders.each_ref().map(|decode| decode(texel))).collect()
    }

    /// The raw values of the texels and, at the end, the border; `None` for a large level, or if reads combine texels.
    fn raw_texels(&self, filter: Filter, source: TexelSource<'_>, formats: &LaneFormats) -> Option<&[[u32; 4]]> {
        if self.is_large() || self.is_linear(filter) {
            return None;
        }
        let rounded = || {
            let mut kept = self.decoded(source);
            kept.push(self.border);
            let mut raw = Vec::with_capacity(kept.len());
            for texels in kept.chunks(LANES) {
                let mut rows = [[0; LANES]; 4];
                for (c, row) in rows.iter_mut().enumerate() {
                    let mut numbers = [0.0; LANES];
                    for (number, texel) in numbers.iter_mut().zip(texels) {
                        *number = self.components[c].number(texel[c]);
                    }
                    self.round_component(c, &numbers, (source.rules, formats), row);
                }
                raw.extend((0..texels.len()).map(|i| rows.each_ref().map(|row| row[i])));
            }
            raw
        };
        Some(self.raw.get_or_init(rounded))
    }

    fn is_linear(&self, filter: Filter) -> bool {
        filter == Filter::Linear && self.weights.bits > 0
    }

    /// Decodes a component of a stored texel, by a table of codes if there are fewer codes than texels.
    fn decoder<'l>(&'l self, component: usize, rules: &'l SampleRules) -> impl Fn(&[u8]) -> u32 + 'l {
        let read = self.components[component];
        let narrow = read.fixed_point_channel().filter(|&channel| pays_by_code(channel, self.count));
        let codes =
            narrow.map(|channel| (channel, self.codes.narrow[component].get_or_init(|| read.codes(channel, rules))));
        move |texel| match codes {
            Some((channel, values)) => values[channel_of(channel, texel) as usize & (values.len() - 1)],
            None => read.decode(texel, rules),
        }
    }

    /// Reads texels with the sampler's filter into the slots of the step; from a large image only for enabled lanes.
    pub(crate) fn read(
        &self,
        (image, state): (&Image, &SamplerState),
        rules: &SampleRules,
        step: &FetchStep,
        formats: &LaneFormats,
        (run, slots): (&LaneRow, &mut Slots),
    ) {
        let source = TexelSource { image, rules, run };
        if let Some(texels) = self.raw_texels(state.min, source, formats) {
            let from = (&*slots, formats.simd());
            let numbers = match self.kind {
                TextureKind::D1 => self.nearest_numbers::<1>(step, from),
                TextureKind::Volume => self.nearest_numbers::<3>(step, from),
                _ => self.nearest_numbers::<2>(step, from),
            };
            let border = texels.last().copied().unwrap_or_default();
            for (c, to) in step.to.iter().enumerate() {
                let Some(to) = *to else { continue };
                for (value, &number) in slots.row_mut(to).iter_mut().zip(&numbers) {
                    *value = texels.get(number as usize).unwrap_or(&border)[c];
                }
            }
            return;
        }
        let mut rows = [[0.0; LANES]; 4];
        self.add_up(state.min, source, step, (slots, formats.simd()), &mut rows);
        self.round(&rows, step, (rules, formats), slots);
    }

    /// Indices of the nearest texels.
    fn nearest_numbers<const AXES: usize>(&self, step: &FetchStep, (slots, simd): (&Slots, SimdLevel)) -> LaneRow {
        let (mut taps, mut numbers) = ([AxisTaps::ZERO; AXES], [[0; LANES]; 1]);
        self.place(step.coordinates.map(|slot| slots.row(slot)), (simd, self.weights), &mut taps, &mut numbers);
        numbers[0]
    }

    /// Computes the unrounded results of a step, for the components that it needs.
    pub(super) fn add_up(
        &self,
        filter: Filter,
        source: TexelSource<'_>,
        step: &FetchStep,
        from: (&Slots, SimdLevel),
        rows: &mut FilteredRows,
    ) {
        match (self.is_linear(filter), self.kind) {
            (false, TextureKind::D1) => self.read_axes::<1, 1>(source, step, from, rows),
            (false, TextureKind::Volume) => self.read_axes::<3, 1>(source, step, from, rows),
            (false, _) => self.read_axes::<2, 1>(source, step, from, rows),
            (true, TextureKind::D1) => self.read_axes::<1, 2>(source, step, from, rows),
            (true, TextureKind::Volume) => self.read_axes::<3, 8>(source, step, from, rows),
            (true, _) => self.read_axes::<2, 4>(source, step, from, rows),
        }
    }

    /// Rounds results into the slots of the step.
    pub(super) fn round(
        &self,
        rows: &FilteredRows,
        step: &FetchStep,
        (rules, formats): (&SampleRules, &LaneFormats),
        slots: &mut Slots,
    ) {
        for (c, to) in step.to.iter().enumerate() {
            if let Some(to) = *to {
                self.round_component(c, &rows[c], (rules, formats), slots.row_mut(to));
            }
        }
    }

    fn round_component(
        &self,
        component: usize,
        row: &[f64; LANES],
        (rules, formats): (&SampleRules, &LaneFormats),
        out: &mut LaneRow,
    ) {
        let (simd, lane) = (formats.simd(), formats.lane(Arith::Main));
        match self.components[component] {
            FilteredComponent::Constant(raw) => out.fill(raw),
            FilteredComponent::Byte(_, signed) => {
                let raw = self.raw_bytes(signed, rules, lane);
                for (out, &byte) in out.iter_mut().zip(row) {
                    *out = raw[usize::from(byte as i32 as u8)];
                }
            }
            FilteredComponent::Ratio(_, denominator) => ratios(lane, simd, row, denominator, out),
            FilteredComponent::Single(_) => ratios(lane, simd, row, 1.0, out),
        }
    }

    /// Raw values of bytes, by the byte's bits.
    fn raw_bytes(&self, signed: bool, rules: &SampleRules, lane: &AnyLane) -> &[u32] {
        let raw = |bits: u8| {
            let byte = if signed { bits.cast_signed().into() } else { bits.into() };
            channel_in_slot(SampledComponent::Byte { byte, signed }.value(rules), rules.format, lane)
        };
        self.codes.bytes[usize::from(signed)].get_or_init(|| (0..=u8::MAX).map(raw).collect())
    }

    pub(super) fn component(&self, number: usize) -> FilteredComponent {
        self.components[number]
    }

    /// [`Self::add_up`] along `AXES` axes with `CORNERS` texels.
    fn read_axes<const AXES: usize, const CORNERS: usize>(
        &self,
        source: TexelSource<'_>,
        step: &FetchStep,
        (slots, simd): (&Slots, SimdLevel),
        rows: &mut FilteredRows,
    ) {
        let bits = if CORNERS == 1 { 0 } else { self.weights.bits };
        let mut taps = [AxisTaps::ZERO; AXES];
        let mut numbers = [[0; LANES]; CORNERS];
        let at = step.coordinates.map(|slot| slots.row(slot));
        self.place(at, (simd, self.weights), &mut taps, &mut numbers);
        // Unit of the product of all axes' weights; it and its reciprocal are powers of two.
        let unit = 1.0 / (1u64 << (usize::from(bits) * AXES)) as f64;
        let mut weights = [[1.0; LANES]; CORNERS];
        let integers = self.components.iter().any(|c| matches!(c, FilteredComponent::Ratio(..)));
        if CORNERS > 1 && integers {
            simd.run(
                #[inline(always)]
                || corner_weights(&taps, bits, &mut weights),
            );
        }
        let texels = self.texels(source);
        for (c, result) in rows.iter_mut().enumerate().filter(|&(c, _)| step.to[c].is_some()) {
            match self.components[c] {
                FilteredComponent::Constant(_) => {}
                FilteredComponent::Ratio(..) => {
                    let mut row = [0; LANES];
                    result.fill(0.0);
                    for (numbers, weights) in numbers.iter().zip(&weights) {
                        self.gather(c, (source, texels), numbers, &mut row);
                        simd.run(
                            #[inline(always)]
                            || add_weighted(&row, weights, unit, result),
                        );
                    }
                }
                FilteredComponent::Byte(..) | FilteredComponent::Single(_) => {
                    let mut corners = [[0; LANES]; CORNERS];
                    for (corner, numbers) in corners.iter_mut().zip(&numbers) {
                        self.gather(c, (source, texels), numbers, corner);
                    }
                    let bytes = matches!(self.components[c], FilteredComponent::Byte(..));
                    simd.run(
                        #[inline(always)]
                        || match bytes {
                            true => combine_bytes(&mut corners, &taps, bits, result),
                            false => combine(&mut corners, &taps, bits, result),
                        },
                    );
                }
            }
        }
    }

    /// Computes the taps of every lane, and the indices of the texels at the corners.
    fn place<const AXES: usize, const CORNERS: usize>(
        &self,
        [x, y, z, _]: [&LaneRow; 4],
        (simd, weights): (SimdLevel, Weights),
        taps: &mut [AxisTaps; AXES],
        numbers: &mut [LaneRow; CORNERS],
    ) {
        let (mut face, mut u, mut v) = ([0; LANES], [0; LANES], [0; LANES]);
        let mut coordinates = [x, y, z];
        if self.kind == TextureKind::Cube {
            simd.run(
                #[inline(always)]
                || cube([x, y, z], &mut face, [&mut u, &mut v]),
            );
            coordinates = [&u, &v, z];
        }
        simd.run(
            #[inline(always)]
            || {
                for ((taps, axis), coordinate) in taps.iter_mut().zip(self.axes).zip(coordinates) {
                    match CORNERS {
                        1 => nearest(coordinate, axis, &mut taps.texels[0]),
                        _ => linear(coordinate, axis, weights, taps),
                    }
                }
                let strides = [1, self.axes[0].size, self.slice];
                corner_numbers(taps, strides, (&face, self.slice), numbers);
            },
        );
    }

    /// Gathers a component of the texels with these indices.
    fn gather(
        &self,
        component: usize,
        (source, texels): (TexelSource<'_>, Option<&[[u32; 4]]>),
        numbers: &LaneRow,
        out: &mut LaneRow,
    ) {
        if let Some(texels) = texels {
            for (value, &number) in out.iter_mut().zip(numbers) {
                *value = texels.get(number as usize).unwrap_or(&self.border)[component];
            }
            return;
        }
        let size = source.image.format().bytes();
        let bytes = source.image.bytes().get(self.start..).unwrap_or_default();
        let decode = self.decoder(component, source.rules);
        for ((value, &number), &run) in out.iter_mut().zip(numbers).zip(source.run) {
            *value = match number {
                _ if run == 0 => 0,
                BORDER => self.border[component],
                _ => {
                    let texel = bytes.get(number as usize * size..).and_then(|bytes| bytes.get(..size));
                    texel.map_or(0, &decode)
                }
            };
        }
    }
}
