//! Operations on operands of many formats: shaders, and the results that the emulator's arithmetic gives.

use rayon::prelude::*;
use refsim::exec::wgsl::number::{format_words, library};
use refsim::exec::wgsl::parts::Parts;
use refsim::num::{Format, NumberOperation as Op};
use serde::Serialize;

use super::encode::base64;
use super::operands::PatternBits;

/// Operand sets per operation and format.
const SETS: u32 = 2048;

/// Entry points of `arithmetic.wgsl`, with the operations that each compiles in addition to the cheap ones.
const SHADERS: [(&str, &[Op]); 3] =
    [("alu_main", &[Op::Floor, Op::Sqrt]), ("power_main", &[Op::Exp2]), ("circle_main", &[Op::Sin])];

/// Operations, with their names in assembly and the shader that runs them.
const OPERATIONS: [(Op, &str, usize); 17] = [
    (Op::Add, "add", 0),
    (Op::Sub, "sub", 0),
    (Op::Mul, "mul", 0),
    (Op::Mad, "mad", 0),
    (Op::FusedMad, "fused mad", 0),
    (Op::Div, "div", 0),
    (Op::Rcp, "rcp", 0),
    (Op::Rsq, "rsq", 0),
    (Op::Sqrt, "sqrt", 0),
    (Op::Min, "min", 0),
    (Op::Max, "max", 0),
    (Op::Floor, "floor", 0),
    (Op::Frc, "frc", 0),
    (Op::Exp2, "exp2", 1),
    (Op::Log2, "log2", 1),
    (Op::Sin, "sin", 2),
    (Op::Cos, "cos", 2),
];

/// Formats, with the hardware that had them; the Radeon 8500's rounding is not known, and its profile rounds down.
const FORMATS: [(&str, &str); 8] = [
    ("s3.12", "Radeon 8500, if it rounded to nearest"),
    ("s1.10", "GeForce FX fixed point"),
    ("n3.8", "multiples of 1/255"),
    ("e5m10", "fp16"),
    ("e7m16", "fp24"),
    ("e7m16:rtz:ftz", "fp24, truncated and flushed"),
    ("e8m7", "bfloat16"),
    ("e8m23", "fp32"),
];

/// Formats whose operands the adapter's own `f32` and `f16` receive.
const NATIVE: [&str; 2] = ["e8m23", "e5m10"];

/// All that the page needs for its table of operations.
#[derive(Debug, Serialize)]
pub(super) struct Arithmetic {
    sets: u32,
    shaders: Vec<ArithmeticShader>,
    pub(super) operations: Vec<OperationColumn>,
    pub(super) formats: Vec<FormatColumn>,
    /// Results by operation, then format: little-endian patterns of the fewest bytes that hold the format's width.
    expected: Vec<Vec<String>>,
    native: NativeShader,
}

#[derive(Debug, Serialize)]
struct ArithmeticShader {
    entry: &'static str,
    text: String,
}

/// An operation of the table.
#[derive(Debug, Serialize)]
pub(super) struct OperationColumn {
    pub(super) name: &'static str,
    word: u32,
    operands: usize,
    shader: usize,
    /// Accuracy that WGSL requires of `f32`, in words.
    accuracy: &'static str,
}

/// A format of the table.
#[derive(Debug, Serialize)]
pub(super) struct FormatColumn {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    words: [u32; 8],
    width: u32,
    bits: PatternBits,
    /// The adapter's own type with this format.
    native: Option<&'static str>,
}

#[derive(Debug, Serialize)]
struct NativeShader {
    text: &'static str,
    /// Constants that name the operations.
    constants: String,
}

impl Arithmetic {
    /// Computes all results by [`refsim::num`].
    pub(super) fn compute() -> Self {
        let formats = FORMATS.map(|(name, title)| (name, title, format(name)));
        let expected = (0..OPERATIONS.len())
            .into_par_iter()
            .map(|row| (0..FORMATS.len()).map(|column| base64(results(row, column, &formats[column].2))).collect())
            .collect();
        let operations = OPERATIONS.map(|(operation, name, shader)| OperationColumn {
            name,
            word: operation.word(),
            operands: operation.operands(),
            shader,
            accuracy: accuracy(operation),
        });
        Self {
            sets: SETS,
            shaders: SHADERS.map(|(entry, operations)| shader(entry, operations, &formats)).into(),
            operations: operations.into(),
            formats: formats.map(|(name, title, format)| column(name, title, &format)).into(),
            expected,
            native: NativeShader {
                text: concat!(include_str!("assets/native_operation.wgsl"), include_str!("assets/native.wgsl")),
                constants: OPERATIONS
                    .map(|(operation, ..)| format!("const {}: u32 = {}u;\n", operation.constant(), operation.word()))
                    .concat(),
            },
        }
    }
}

fn format(name: &str) -> Format {
    name.parse().unwrap_or(Format::FP32)
}

fn column(name: &'static str, title: &'static str, format: &Format) -> FormatColumn {
    let native = NATIVE.iter().position(|native| *native == name).map(|at| ["f32", "f16"][at]);
    let bits = PatternBits::new(format);
    FormatColumn { name, title, words: format_words(format), width: format.width(), bits, native }
}

/// Counter of an operand set, from which the generator derives the operands.
const fn counter(row: usize, column: usize, set: u32) -> u32 {
    (row as u32 * FORMATS.len() as u32 + column as u32) * SETS + set
}

fn operand_sets(row: usize, column: usize, format: &Format) -> impl Iterator<Item = [u32; 3]> {
    let bits = PatternBits::new(format);
    (0..SETS).map(move |set| bits.set(counter(row, column, set)))
}

fn results(row: usize, column: usize, format: &Format) -> Vec<u8> {
    let bytes = format.width().div_ceil(8) as usize;
    let result = |operands| OPERATIONS[row].0.evaluate(*format, operands).map_or(0, |outcome| outcome.bits);
    operand_sets(row, column, format).flat_map(|set| result(set).to_le_bytes().into_iter().take(bytes)).collect()
}

fn shader(entry: &'static str, operations: &[Op], formats: &[(&str, &str, Format)]) -> ArithmeticShader {
    let mut parts = Parts::default();
    operations.iter().for_each(|&operation| parts.add_operation(operation));
    formats.iter().for_each(|(.., format)| parts.add_format(format));
    let text = parts.of(&(library() + include_str!("assets/arithmetic.wgsl")), entry);
    ArithmeticShader { entry, text }
}

/// Accuracy that WGSL (section 15.7.4) requires of `f32`.
const fn accuracy(operation: Op) -> &'static str {
    match operation {
        Op::Add | Op::Sub | Op::Mul | Op::Floor | Op::Min | Op::Max => "correctly rounded",
        Op::Mad => "each step correctly rounded, or fused",
        Op::FusedMad => "as x * y + z",
        Op::Div | Op::Rcp => "2.5 ULP",
        Op::Rsq => "2 ULP",
        Op::Sqrt => "as 1 / inverseSqrt(x)",
        Op::Frc => "as x - floor(x)",
        Op::Exp2 => "3 + 2 |x| ULP",
        Op::Log2 => "2^-21 in [0.5, 2], else 3 ULP",
        Op::Sin | Op::Cos => "2^-11 in [-pi, pi]",
        _ => "",
    }
}
