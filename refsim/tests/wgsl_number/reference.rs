//! Expected results of the shader's operations, from `refsim::num`.

use refsim::exec::unorm_steps;
use refsim::num::{Format, FormatKind, NumberOperation, Unpacked, from_ratio, ops, unpack};

/// The operation on bit patterns of `format`, as a bit pattern; masks and addresses in the shader's representation.
/// `None` for operations whose operands are not numbers.
pub(crate) fn reference(operation: NumberOperation, format: &Format, a: u32, b: u32, c: u32) -> Option<u32> {
    use NumberOperation as Op;
    let plain = operation.evaluate(format, [a, b, c]).map(|outcome| outcome.bits);
    Some(match operation {
        Op::Less | Op::LessEqual | Op::Equal => return plain.map(|bits| if bits == 1 { u32::MAX } else { 0 }),
        Op::AddressFloor => integer(format, ops::floor(format, a).bits),
        Op::AddressNearest => {
            let nearest = ops::round_to_int_with(format, a, refsim::num::Rounding::NearestEven, false);
            integer(format, nearest.bits)
        }
        Op::Steps => from_ratio(format, false, unorm_steps(a, b).into(), b.into()).bits,
        Op::Factor => factor(format, a, b),
        Op::JoinPattern => a | (ops::convert(format, *format, b).bits & 0xffff) << c,
        Op::JoinShort => a | unorm_steps(b, 65535) << c,
        Op::JoinByte => a | unorm_steps(b, 255) << c,
        Op::JoinSignedByte => a | signed_byte(b) << c,
        Op::SplitPattern => ops::convert(format, *format, a >> b & 0xffff & format.mask()).bits,
        Op::SplitShort => from_ratio(format, false, (a >> b & 0xffff).into(), 65535).bits,
        Op::SplitByte => from_ratio(format, false, (a >> b & 0xff).into(), 255).bits,
        Op::SplitSignedByte => {
            let byte = a >> b & 0xff;
            from_ratio(format, byte < 128, byte.abs_diff(128).into(), 127).bits
        }
        _ => return plain,
    })
}

/// `128 + 127 x` to the nearest, ties up, for x from -128/127 to 1; 128 for NaN. The product is exact in double
/// precision, and so is the sum near an integer.
fn signed_byte(bits: u32) -> u32 {
    let x = f64::from(f32::from_bits(bits));
    if x.is_nan() { 128 } else { (128.0 + (127.0 * x).clamp(-128.0, 127.0) + 0.5).floor() as u32 }
}

/// Truncates a number to an `i32`, saturating; NaN becomes 0.
fn integer(format: &Format, bits: u32) -> u32 {
    match unpack(format, bits) {
        Unpacked::Nan { .. } => 0,
        Unpacked::Inf { sign } => if sign { i32::MIN } else { i32::MAX }.cast_unsigned(),
        Unpacked::Finite { sign, sig, exp, den } => {
            let sig = sig / u64::from(den);
            let magnitude =
                if exp >= 0 { i128::from(sig) << exp.min(60) } else { i128::from(sig) >> exp.unsigned_abs().min(100) };
            let value = if sign { -magnitude } else { magnitude };
            (value.clamp(i32::MIN.into(), i32::MAX.into()) as i32).cast_unsigned()
        }
    }
}

/// The first factor, under the rule that zero times anything is zero.
fn factor(format: &Format, a: u32, b: u32) -> u32 {
    let passed = ops::max(format, a, a).bits;
    let zero = format.is_zero(a) || format.is_zero(b);
    let finite = format.is_finite(a) && format.is_finite(b);
    match format.kind {
        FormatKind::Float { .. } if zero && !finite => 0,
        _ => passed,
    }
}
