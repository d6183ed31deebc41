//! Conversion of constants from host values to register contents, once per draw and shared by all executors.

use crate::device::{ConstantStorage, Rules, Storage};
use std::collections::BTreeMap;

use super::FixedFunctionState;
use crate::isa::{ConstantValue, FIRST_LITERAL, FIRST_NAMED, Parameter, ParameterSource, Program, RegisterFile};
use crate::num::{self, Format};

/// Number of integer constant registers, and of boolean constant registers.
const FLOW_CONSTANTS: usize = 16;
/// Number of float constants of Direct3D programs (vs_2_0).
const FLOAT_CONSTANTS: usize = 256;
/// Number of float constants of an OpenGL fragment program, including literals.
const FRAGMENT_CONSTANTS: usize = FIRST_LITERAL as usize + 4096;
const FP32_ONE: u32 = 0x3f80_0000;
const FP32_255: u32 = 0x437f_0000;

/// Constants of one stage, set by the host. Unset constants are zero; definitions in the program (`def`, `defi`,
/// `defb`) take precedence.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Constants {
    /// Values of `c0` and up, as single-precision patterns. Constants beyond c255 (c511 in OpenGL fragment programs)
    /// are ignored.
    pub float: Vec<[u32; 4]>,
    /// Values of `i0` to `i15`.
    pub int: Vec<[i32; 4]>,
    /// Values of `b0` to `b15`.
    pub boolean: Vec<bool>,
    /// Values of constants that an OpenGL program declares by name ([`crate::isa::Parameter`]), as single-precision
    /// patterns. Names that the program does not declare are ignored.
    pub named: BTreeMap<String, [u32; 4]>,
    /// State that `!!ARBfp1.0` reads as `state.*`; `None`: OpenGL's default state.
    pub state: Option<Box<FixedFunctionState>>,
}

impl Constants {
    pub(crate) fn parameter(&self, parameter: &Parameter) -> [u32; 4] {
        match (parameter.source, &self.state) {
            (ParameterSource::Named(default), _) => self.named.get(&parameter.name).copied().unwrap_or(default),
            (ParameterSource::State(binding), Some(state)) => state.value(binding),
            (ParameterSource::State(binding), None) => FixedFunctionState::default().value(binding),
        }
    }
}

/// Constants in the form that instructions read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ResolvedConstants {
    /// `c#` in the register format, up to the last constant set or defined; higher constants are zero.
    pub float: Vec<[u32; 4]>,
    /// `i#`
    pub int: [[i32; 4]; FLOW_CONSTANTS],
    /// `b#`
    pub boolean: [bool; FLOW_CONSTANTS],
}

impl ResolvedConstants {
    /// Constants of a pixel program: clamped to [-1, 1] in ps_1_x, stored as the device's [`ConstantStorage`],
    /// converted to the register format, and rounded to the format of [`Storage::Constants`].
    pub fn pixel(program: &Program, rules: &Rules, host: &Constants) -> Self {
        let clamp = program.version.is_ps_1_x();
        Self::resolve(program, host, |bits| {
            let bits = if clamp { clamped_to_one(bits) } else { bits };
            let held = match rules.constant_storage {
                ConstantStorage::Register => num::ops::convert(&Format::FP32, rules.format, bits).bits,
                ConstantStorage::Snorm8 => snorm8(rules.format, bits, unorm_steps(magnitude(bits), 255)),
                ConstantStorage::Snorm8Cut => snorm8(rules.format, bits, cut_255ths(magnitude(bits))),
                ConstantStorage::Unorm8Expanded => unorm8_expanded(rules.format, bits),
            };
            let Some(storage) = rules.storage.of(Storage::Constants) else { return held };
            let narrowed = num::ops::convert(&rules.format, storage, held).bits;
            num::ops::convert(&storage, rules.format, narrowed).bits
        })
    }

    /// Constants of a vertex program, converted to the vertex format.
    pub fn vertex(program: &Program, rules: &Rules, host: &Constants) -> Self {
        Self::resolve(program, host, |bits| num::ops::convert(&Format::FP32, rules.vertex_format, bits).bits)
    }

    fn resolve(program: &Program, host: &Constants, convert: impl Fn(u32) -> u32) -> Self {
        let (from_host, most) = match program.version.is_fragment_program() {
            true => (usize::from(FIRST_NAMED), FRAGMENT_CONSTANTS),
            false => (FLOAT_CONSTANTS, FLOAT_CONSTANTS),
        };
        let mut out = Self {
            // Constants from `FIRST_NAMED` on are set by name, not by number.
            float: host.float.iter().take(from_host).map(|c| c.map(&convert)).collect(),
            int: [[0; 4]; FLOW_CONSTANTS],
            boolean: [false; FLOW_CONSTANTS],
        };
        for (to, from) in out.int.iter_mut().zip(&host.int) {
            *to = *from;
        }
        for (to, from) in out.boolean.iter_mut().zip(&host.boolean) {
            *to = *from;
        }
        // Definitions in the program override the host's values.
        for definition in &program.constants {
            let number = usize::from(definition.register.index);
            match definition.value {
                ConstantValue::Float(value) if definition.register.file == RegisterFile::Constant => {
                    if number >= out.float.len() && number < most {
                        out.float.resize(number + 1, [0; 4]);
                    }
                    if let Some(slot) = out.float.get_mut(number) {
                        *slot = value.map(&convert);
                    }
                }
                ConstantValue::Float(_) => {}
                ConstantValue::Int(value) => {
                    if let Some(slot) = out.int.get_mut(number) {
                        *slot = value;
                    }
                }
                ConstantValue::Bool(value) => {
                    if let Some(slot) = out.boolean.get_mut(number) {
                        *slot = value;
                    }
                }
            }
        }
        for parameter in &program.parameters {
            let value = host.parameter(parameter);
            let number = usize::from(parameter.register.index);
            if number >= out.float.len() && number < most {
                out.float.resize(number + 1, [0; 4]);
            }
            if let Some(slot) = out.float.get_mut(number) {
                *slot = value.map(&convert);
            }
        }
        out
    }
}

/// Clamps a single-precision pattern to [-1, 1]; NaN is unchanged.
fn clamped_to_one(bits: u32) -> u32 {
    let magnitude = magnitude(bits);
    if magnitude > FP32_ONE && magnitude <= 0x7f80_0000 { (bits & 0x8000_0000) | FP32_ONE } else { bits }
}

fn magnitude(bits: u32) -> u32 {
    bits & 0x7fff_ffff
}

/// `k / 255` with the sign of `bits`, rounded into `format`.
fn snorm8(format: Format, bits: u32, k: u32) -> u32 {
    num::from_ratio(format, bits >> 31 == 1 && k != 0, u128::from(k), 255).bits
}

/// `(2k - 255) / 255`, rounded into `format`, where k is the integer part of the exact `127.5 (c + 1)` and c is the
/// number clamped to [-1, 1]. NaN is stored like 0.
fn unorm8_expanded(format: Format, bits: u32) -> u32 {
    let magnitude = if magnitude(bits) > 0x7f80_0000 { 0 } else { magnitude(bits).min(FP32_ONE) };
    let (significand, exponent) = match magnitude >> 23 {
        0 => (magnitude, 1),
        field => ((magnitude & 0x007f_ffff) | 0x0080_0000, field),
    };
    // The magnitude is significand / 2^down, with down at least 23. If down is above 64, the magnitude is too small to
    // move 127.5 past an integer.
    let down = 150 - exponent;
    let term = if down > 64 { 0 } else { 255 * i128::from(significand) };
    let down = down.min(64);
    let whole = if bits >> 31 == 1 { (255_i128 << down) - term } else { (255_i128 << down) + term };
    let expanded = 2 * (whole >> (down + 1)) - 255;
    num::from_ratio(format, expanded < 0, expanded.unsigned_abs(), 255).bits
}

/// The single-precision product of a magnitude and 255, clamped to 255 and truncated to an integer. NaN gives 0.
///
/// The product is rounded before truncation, as in a driver written in C, so `k / 255` in single precision gives k
/// again.
fn cut_255ths(magnitude: u32) -> u32 {
    if magnitude >= FP32_ONE {
        return if magnitude > 0x7f80_0000 { 0 } else { 255 };
    }
    let product = num::ops::mul(Format::FP32, magnitude, FP32_255).bits;
    let (exponent, significand) = (product >> 23, (product & 0x007f_ffff) | 0x0080_0000);
    // The product is at most 255, so its exponent field is at most 134; a field below 127 means a product below 1.
    if exponent < 127 { 0 } else { significand >> (150 - exponent) }
}

/// Clamps a single-precision pattern to [0, 1] and rounds it to `k / steps` (halves up; `steps` below 2^24); returns k.
/// NaN gives 0.
pub fn unorm_steps(bits: u32, steps: u32) -> u32 {
    let magnitude = bits & 0x7fff_ffff;
    if bits >> 31 == 1 || magnitude > 0x7f80_0000 {
        return 0;
    }
    if magnitude >= FP32_ONE {
        return steps;
    }
    let field = magnitude >> 23;
    let (significand, exponent) = match field {
        0 => (magnitude, 1),
        _ => ((magnitude & 0x007f_ffff) | 0x0080_0000, field),
    };
    // value = significand / 2^down with 24 <= down <= 149; the nearest integer of value * steps is
    // floor((2 * significand * steps + 2^down) / 2^(down + 1)).
    let down = 150 - exponent;
    if down > 64 {
        return 0;
    }
    let doubled = 2 * u128::from(significand) * u128::from(steps) + (1u128 << down);
    u32::try_from(doubled >> (down + 1)).unwrap_or(steps)
}

/// Converts an interpolated colour to the value of `v#`: clamped to [0, 1], rounded to the colour iterator's precision,
/// converted to the register format. NaN gives 0.
pub fn delivered_color(rules: &Rules, bits: u32) -> u32 {
    use crate::device::ColorIterator;
    match rules.color_iterator {
        ColorIterator::Unorm(width) => {
            let steps = (1u32 << width.clamp(1, 16)) - 1;
            num::from_ratio(rules.format, false, u128::from(unorm_steps(bits, steps)), u128::from(steps)).bits
        }
        ColorIterator::Full => {
            let magnitude = bits & 0x7fff_ffff;
            let clamped = match bits >> 31 {
                1 => 0,
                _ if magnitude > 0x7f80_0000 => 0,
                _ => magnitude.min(FP32_ONE),
            };
            num::ops::convert(&Format::FP32, rules.format, clamped).bits
        }
    }
}
