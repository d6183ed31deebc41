//! Functions of NaN, infinities and zeros, and at poles, as in C's library, which is exact there except for multiples
//! of pi.

use super::real::Function;

/// A function of doubles. Used if an operand is NaN, infinite or zero, and if there is no real result.
pub(super) fn special(function: Function, operands: &[f64]) -> f64 {
    use Function as F;
    let operand = |index: usize| operands.get(index).copied().unwrap_or_default();
    let (x, y) = (operand(0), operand(1));
    match function {
        F::Add => x + y,
        F::Subtract => x - y,
        F::Multiply => x * y,
        F::Divide => x / y,
        F::Negate => -x,
        F::Fma => libm::fma(x, y, operand(2)),
        F::Sqrt => libm::sqrt(x),
        F::Cbrt => libm::cbrt(x),
        F::Abs => x.abs(),
        F::Exp => libm::exp(x),
        F::Exp2 => libm::exp2(x),
        F::ExpM1 => libm::expm1(x),
        F::Log => libm::log(x),
        F::Log2 => libm::log2(x),
        F::Log10 => libm::log10(x),
        F::Log1P => libm::log1p(x),
        F::Pow => libm::pow(x, y),
        F::Hypot => libm::hypot(x, y),
        F::Sin => libm::sin(x),
        F::Cos => libm::cos(x),
        F::Tan => libm::tan(x),
        F::Asin => libm::asin(x),
        F::Acos => libm::acos(x),
        F::Atan => libm::atan(x),
        F::Atan2 => libm::atan2(x, y),
        F::Sinh => libm::sinh(x),
        F::Cosh => libm::cosh(x),
        F::Tanh => libm::tanh(x),
        F::Asinh => libm::asinh(x),
        F::Acosh => libm::acosh(x),
        F::Atanh => libm::atanh(x),
        F::Min => libm::fmin(x, y),
        F::Max => libm::fmax(x, y),
        F::Cast => x,
    }
}
