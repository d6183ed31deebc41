//! What the shader's operations must give, by `refsim::num`.

use refsim::exec::unorm_steps;
use refsim::exec::wgsl::number::Operation;
use refsim::num::{Format, FormatKind, Unpacked, from_ratio, ops, unpack};

/// The operation on bit patterns of `format`, as a bit pattern; masks and addresses as the shader has them. `None` for
/// what is no operation on numbers.
pub(crate) fn reference(operation: Operation, format: &Format, a: u32, b: u32, c: u32) -> Option<u32> {
    use Operation as Op;
    let mask = |outcome: refsim::num::Outcome| if outcome.bits == 1 { u32::MAX } else { 0 };
    Some(match operation {
        Op::Add => ops::add(format, a, b).bits,
        Op::Sub => ops::sub(format, a, b).bits,
        Op::Mul => ops::mul(format, a, b).bits,
        Op::Div => ops::div(format, a, b).bits,
        Op::Mad => ops::mad(format, a, b, c).bits,
        Op::FusedMad => ops::fused_mad(format, a, b, c).bits,
        Op::Min => ops::min(format, a, b).bits,
        Op::Max => ops::max(format, a, b).bits,
        Op::Neg => ops::neg(format, a).bits,
        Op::Abs => ops::abs(format, a).bits,
        Op::Floor => ops::floor(format, a).bits,
        Op::Frc => ops::frc(format, a).bits,
        Op::Rcp => ops::rcp(format, a).bits,
        Op::Rsq => ops::rsq(format, a).bits,
        Op::Exp2 => ops::exp2(format, a).bits,
        Op::Log2 => ops::log2(format, a).bits,
        Op::Saturate => ops::saturate01(format, a).bits,
        Op::Sqrt => ops::sqrt(format, a).bits,
        Op::SelectNonNegative => ops::cmp(format, a, b, c).bits,
        Op::SelectAboveHalf => ops::cnd(format, a, b, c).bits,
        Op::Less => mask(ops::lt(format, a, b)),
        Op::LessEqual => mask(ops::le(format, a, b)),
        Op::Equal => mask(ops::eq(format, a, b)),
        Op::AddressFloor => integer(format, ops::floor(format, a).bits),
        Op::AddressNearest => {
            let nearest = ops::round_to_int_with(format, a, refsim::num::Rounding::NearestEven, false);
            integer(format, nearest.bits)
        }
        Op::Scale => ops::scale(format, a, b.cast_signed()).bits,
        Op::Steps => from_ratio(format, false, unorm_steps(a, b).into(), b.into()).bits,
        Op::Factor => factor(format, a, b),
        Op::Sin => ops::sin(format, a).bits,
        Op::Cos => ops::cos(format, a).bits,
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
        Op::Convert | Op::Decode | Op::Encode | Op::Select | Op::And | Op::Or | Op::AndNot => return None,
    })
}

/// `128 + 127 x` to the nearest, halves up, x from -128/127 to 1; 128 for NaN. Doubles hold the product, and the sum
/// where it comes near an integer.
fn signed_byte(bits: u32) -> u32 {
    let x = f64::from(f32::from_bits(bits));
    if x.is_nan() { 128 } else { (128.0 + (127.0 * x).clamp(-128.0, 127.0) + 0.5).floor() as u32 }
}

/// The number truncated to an `i32`, saturated; NaN gives 0.
fn integer(format: &Format, bits: u32) -> u32 {
    match unpack(format, bits) {
        Unpacked::Nan { .. } => 0,
        Unpacked::Inf { sign } => if sign { i32::MIN } else { i32::MAX }.cast_unsigned(),
        Unpacked::Finite { sign, sig, exp } => {
            let magnitude =
                if exp >= 0 { i128::from(sig) << exp.min(60) } else { i128::from(sig) >> exp.unsigned_abs().min(100) };
            let value = if sign { -magnitude } else { magnitude };
            (value.clamp(i32::MIN.into(), i32::MAX.into()) as i32).cast_unsigned()
        }
    }
}

/// The first factor under the rule that zero times anything is zero.
fn factor(format: &Format, a: u32, b: u32) -> u32 {
    let passed = ops::max(format, a, a).bits;
    let zero = format.is_zero(a) || format.is_zero(b);
    let finite = format.is_finite(a) && format.is_finite(b);
    match format.kind {
        FormatKind::Float { .. } if zero && !finite => 0,
        _ => passed,
    }
}
