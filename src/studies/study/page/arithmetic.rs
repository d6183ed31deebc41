//! Operations on operands of many formats: shaders, and the results that the emulator's arithmetic gives.

use rayon::prelude::*;
use refsim::exec::wgsl::number::{format_words, library};
use refsim::exec::wgsl::parts::Parts;
use refsim::num::{Format, NumberOperation as Op};
use serde_json::{Value, json};

use super::encode::base64;
use super::operands::PatternBits;

const SETS: u32 = 2048;

/// Entry points of `arithmetic.wgsl`, with the operations that each compiles in addition to the cheap ones.
const SHADERS: [(&str, &[Op]); 3] =
    [("alu_main", &[Op::Floor, Op::Sqrt]), ("power_main", &[Op::Exp2]), ("circle_main", &[Op::Sin])];

/// Operations, with their names in assembly, the shader that runs them, and the accuracy that WGSL (section 15.7.4)
/// requires of `f32`.
const OPERATIONS: [(Op, &str, usize, &str); 17] = [
    (Op::Add, "add", 0, "correctly rounded"),
    (Op::Sub, "sub", 0, "correctly rounded"),
    (Op::Mul, "mul", 0, "correctly rounded"),
    (Op::Mad, "mad", 0, "each step correctly rounded, or fused"),
    (Op::FusedMad, "fused mad", 0, "as x * y + z"),
    (Op::Div, "div", 0, "2.5 ULP"),
    (Op::Rcp, "rcp", 0, "2.5 ULP"),
    (Op::Rsq, "rsq", 0, "2 ULP"),
    (Op::Sqrt, "sqrt", 0, "as 1 / inverseSqrt(x)"),
    (Op::Min, "min", 0, "correctly rounded"),
    (Op::Max, "max", 0, "correctly rounded"),
    (Op::Floor, "floor", 0, "correctly rounded"),
    (Op::Frc, "frc", 0, "as x - floor(x)"),
    (Op::Exp2, "exp2", 1, "3 + 2 |x| ULP"),
    (Op::Log2, "log2", 1, "2^-21 in [0.5, 2], else 3 ULP"),
    (Op::Sin, "sin", 2, "2^-11 in [-pi, pi]"),
    (Op::Cos, "cos", 2, "2^-11 in [-pi, pi]"),
];

/// Formats, with the hardware that had them, and the adapter's own type with the format; the Radeon 8500's rounding is
/// not known, and its profile rounds down.
const FORMATS: [(&str, &str, Option<&str>); 8] = [
    ("s3.12", "Radeon 8500, if it rounded to nearest", None),
    ("s1.10", "GeForce FX fixed point", None),
    ("n3.8", "multiples of 1/255", None),
    ("e5m10", "fp16", Some("f16")),
    ("e7m16", "fp24", None),
    ("e7m16:rtz:ftz", "fp24, truncated and flushed", None),
    ("e8m7", "bfloat16", None),
    ("e8m23", "fp32", Some("f32")),
];

/// The data of the tables. `expected` has the results by operation, then format: little-endian patterns of the fewest
/// bytes that hold the format's width. `native` of a format is the adapter's own type with this format.
pub(super) fn arithmetic() -> Value {
    let formats = FORMATS.map(|(name, ..)| name.parse().unwrap_or(Format::FP32));
    let expected: Vec<Vec<String>> = (0..OPERATIONS.len())
        .into_par_iter()
        .map(|row| (0..FORMATS.len()).map(|column| base64(results(row, column, &formats[column]))).collect())
        .collect();
    let operations = OPERATIONS.map(|(operation, name, shader, accuracy)| {
        let (word, operands) = (operation.word(), operation.operands());
        json!({ "name": name, "word": word, "operands": operands, "shader": shader, "accuracy": accuracy })
    });
    let columns = FORMATS.into_iter().zip(&formats).map(|((name, title, native), format)| {
        let (words, bits) = (format_words(format), PatternBits::new(format));
        json!({
            "name": name, "title": title, "words": words, "width": format.width(), "bits": bits, "native": native,
        })
    });
    let constants =
        OPERATIONS.map(|(operation, ..)| format!("const {}: u32 = {}u;\n", operation.constant(), operation.word()));
    let native = concat!(include_str!("assets/native_operation.wgsl"), include_str!("assets/native.wgsl"));
    json!({
        "sets": SETS,
        "shaders": SHADERS.map(|(entry, operations)| shader(entry, operations, &formats)),
        "operations": operations,
        "formats": columns.collect::<Vec<_>>(),
        "expected": expected,
        "native": { "text": native, "constants": constants.concat() },
    })
}

/// Counter of an operand set, from which the generator derives the operands.
const fn counter(row: usize, column: usize, set: u32) -> u32 {
    (row as u32 * FORMATS.len() as u32 + column as u32) * SETS + set
}

fn results(row: usize, column: usize, format: &Format) -> Vec<u8> {
    let (bytes, bits) = (format.width().div_ceil(8) as usize, PatternBits::new(format));
    let result = |operands| OPERATIONS[row].0.evaluate(*format, operands).map_or(0, |outcome| outcome.bits);
    let sets = (0..SETS).map(|set| bits.set(counter(row, column, set)));
    sets.flat_map(|set| result(set).to_le_bytes().into_iter().take(bytes)).collect()
}

fn shader(entry: &'static str, operations: &[Op], formats: &[Format]) -> Value {
    let mut parts = Parts::default();
    operations.iter().for_each(|&operation| parts.add_operation(operation));
    formats.iter().for_each(|format| parts.add_format(format));
    let text = parts.of(&(library() + include_str!("assets/arithmetic.wgsl")), entry);
    json!({ "entry": entry, "text": text })
}
