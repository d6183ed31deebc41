//! The operations of expressions over intervals.

use super::dyadic::Dyadic;
use super::functions as made;
use super::interval::{Real, RealInterval};
use super::{power, series};

macro_rules! functions {
    ($($name:literal $variant:ident $operands:literal $special:expr;)*) => {
        /// A function of numbers, by its name in FPCore.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Function { $($variant,)* }

        impl Function {
            /// The function with this name and number of operands.
            pub(crate) fn named(name: &str, operands: usize) -> Option<Self> {
                match (name, operands) { $(($name, $operands) => Some(Self::$variant),)* _ => None }
            }

            /// Numbers of operands that functions with this name may have.
            pub(crate) fn operands(name: &str) -> Vec<usize> {
                [$(($name, $operands),)*].iter().filter(|known| known.0 == name).map(|known| known.1).collect()
            }

            /// The function of doubles, as in C's library, which is exact for NaN, infinities and zeros and at poles,
            /// except for multiples of pi. Used only there, and for operations that are exact in doubles.
            pub(crate) fn special(self, operands: &[f64]) -> f64 {
                let special: fn(f64, f64, f64) -> f64 = match self { $(Self::$variant => $special,)* };
                let operand = |index: usize| operands.get(index).copied().unwrap_or_default();
                special(operand(0), operand(1), operand(2))
            }
        }
    };
}

functions! {
    "+" Add 2 |x, y, _| x + y;
    "-" Subtract 2 |x, y, _| x - y;
    "*" Multiply 2 |x, y, _| x * y;
    "/" Divide 2 |x, y, _| x / y;
    "-" Negate 1 |x, _, _| -x;
    "fma" Fma 3 libm::fma;
    "sqrt" Sqrt 1 |x, _, _| libm::sqrt(x);
    "cbrt" Cbrt 1 |x, _, _| libm::cbrt(x);
    "fabs" Abs 1 |x, _, _| x.abs();
    "exp" Exp 1 |x, _, _| libm::exp(x);
    "exp2" Exp2 1 |x, _, _| libm::exp2(x);
    "expm1" ExpM1 1 |x, _, _| libm::expm1(x);
    "log" Log 1 |x, _, _| libm::log(x);
    "log2" Log2 1 |x, _, _| libm::log2(x);
    "log10" Log10 1 |x, _, _| libm::log10(x);
    "log1p" Log1P 1 |x, _, _| libm::log1p(x);
    "pow" Pow 2 |x, y, _| libm::pow(x, y);
    "hypot" Hypot 2 |x, y, _| libm::hypot(x, y);
    "sin" Sin 1 |x, _, _| libm::sin(x);
    "cos" Cos 1 |x, _, _| libm::cos(x);
    "tan" Tan 1 |x, _, _| libm::tan(x);
    "asin" Asin 1 |x, _, _| libm::asin(x);
    "acos" Acos 1 |x, _, _| libm::acos(x);
    "atan" Atan 1 |x, _, _| libm::atan(x);
    "atan2" Atan2 2 |x, y, _| libm::atan2(x, y);
    "sinh" Sinh 1 |x, _, _| libm::sinh(x);
    "cosh" Cosh 1 |x, _, _| libm::cosh(x);
    "tanh" Tanh 1 |x, _, _| libm::tanh(x);
    "asinh" Asinh 1 |x, _, _| libm::asinh(x);
    "acosh" Acosh 1 |x, _, _| libm::acosh(x);
    "atanh" Atanh 1 |x, _, _| libm::atanh(x);
    "fmin" Min 2 |x, y, _| libm::fmin(x, y);
    "fmax" Max 2 |x, y, _| libm::fmax(x, y);
    "cast" Cast 1 |x, _, _| x;
}

/// Names of FPCore's constants.
const CONSTANTS: [&str; 13] =
    ["E", "LOG2E", "LOG10E", "LN2", "LN10", "PI", "PI_2", "PI_4", "M_1_PI", "M_2_PI", "M_2_SQRTPI", "SQRT2", "SQRT1_2"];

/// A constant, one of [`CONSTANTS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Constant(&'static str);

impl Constant {
    pub(crate) fn named(name: &str) -> Option<Self> {
        CONSTANTS.into_iter().find(|known| *known == name).map(Self)
    }

    /// The constant, to about `bits` bits.
    pub(crate) fn value(self, bits: u64) -> RealInterval {
        let [one, ten] = [1, 10].map(RealInterval::integer);
        let (pi, ln_2) = (series::pi(bits), series::ln_2(bits));
        // No divisor is zero.
        let over = |x: &RealInterval, y: &RealInterval| x.over(y, bits).unwrap_or_else(|| x.clone());
        match self.0 {
            "E" => made::exp(&one, bits),
            "LOG2E" => over(&one, &ln_2),
            "LOG10E" => over(&one, &made::log(&ten, bits)),
            "LN2" => ln_2,
            "LN10" => made::log(&ten, bits),
            "PI" => pi,
            "PI_2" => pi.scaled(-1),
            "PI_4" => pi.scaled(-2),
            "M_1_PI" => over(&one, &pi),
            "M_2_PI" => over(&one, &pi.scaled(-1)),
            "M_2_SQRTPI" => over(&one, &pi.root(2, bits).scaled(-1)),
            "SQRT2" => RealInterval::integer(2).root(2, bits),
            _ => RealInterval::integer(2).scaled(-2).root(2, bits),
        }
    }
}

/// A function of reals, to about `bits` bits.
pub(crate) fn apply(function: Function, operands: &[Real], bits: u64) -> Real {
    if operands.contains(&Real::Undefined) {
        return Real::Undefined;
    }
    let ranges: Option<Vec<&RealInterval>> =
        operands.iter().map(|x| if let Real::Range(range) = x { Some(range) } else { None }).collect();
    let Some(ranges) = ranges else { return Real::Unknown };
    match ranges[..] {
        [x] => unary(function, x, bits),
        [x, y] => binary(function, x, y, bits),
        [x, y, z] => Real::Range(x.times(y, bits).plus(z, bits)),
        _ => Real::Unknown,
    }
}

fn unary(function: Function, x: &RealInterval, bits: u64) -> Real {
    use Function as F;
    let one = RealInterval::integer(1);
    let defined = match function {
        F::Sqrt => {
            x.order(&RealInterval::integer(0)).map(|order| order.is_ge()).or((!x.low.is_negative()).then_some(true))
        }
        F::Log | F::Log2 | F::Log10 => positive(x),
        F::Log1P => positive(&x.plus(&one, bits)),
        F::Asin | F::Acos => not_above(&x.abs(), &one),
        F::Atanh => x.abs().order(&one).map(|order| order.is_lt()),
        F::Acosh => not_above(&one, x),
        _ => Some(true),
    };
    match defined {
        Some(true) => {}
        Some(false) => return Real::Undefined,
        None => return Real::Unknown,
    }
    let range = match function {
        F::Negate => Some(x.negated()),
        F::Abs => Some(x.abs()),
        F::Sqrt => Some(x.root(2, bits)),
        F::Cbrt => Some(x.root(3, bits)),
        F::Exp => Some(made::exp(x, bits)),
        F::Exp2 => Some(power::exp2(x, bits)),
        F::ExpM1 => Some(made::exp(x, bits).minus(&one, bits)),
        F::Log => Some(made::log(x, bits)),
        F::Log2 => power::log2(x, bits),
        F::Log10 => made::log(x, bits).over(&made::log(&RealInterval::integer(10), bits), bits),
        F::Log1P => Some(made::log(&x.plus(&one, bits), bits)),
        F::Sin => Some(made::circular(true, x, bits)),
        F::Cos => Some(made::circular(false, x, bits)),
        F::Tan => made::circular(true, x, bits).over(&made::circular(false, x, bits), bits),
        F::Asin => made::asin(x, bits),
        F::Acos => made::asin(x, bits).map(|asin| series::pi(bits).scaled(-1).minus(&asin, bits)),
        F::Atan => Some(made::atan(x, bits)),
        F::Sinh => Some(made::sum_of_exponentials(x, false, bits)),
        F::Cosh => Some(made::sum_of_exponentials(x, true, bits)),
        F::Tanh => made::tanh(x, bits),
        F::Asinh if x.is_negative() => Some(made::asinh(&x.negated(), bits).negated()),
        F::Asinh => Some(made::asinh(x, bits)),
        F::Acosh => Some(made::acosh(x, bits)),
        F::Atanh => made::atanh(x, bits),
        _ => Some(x.clone()),
    };
    range.map_or(Real::Unknown, Real::Range)
}

/// `true` if the whole interval is above zero, `false` if no part of it is, `None` if only a part is.
fn positive(x: &RealInterval) -> Option<bool> {
    match x {
        _ if x.is_positive() => Some(true),
        _ if x.is_negative() || x.high.is_zero() => Some(false),
        _ => None,
    }
}

/// `true` if all of `x` is at most all of `y`, `false` if all of `x` is above; otherwise `None`.
fn not_above(x: &RealInterval, y: &RealInterval) -> Option<bool> {
    if x.high <= y.low { Some(true) } else { (x.low > y.high).then_some(false) }
}

fn binary(function: Function, x: &RealInterval, y: &RealInterval, bits: u64) -> Real {
    use Function as F;
    let range = match function {
        F::Add => Some(x.plus(y, bits)),
        F::Subtract => Some(x.minus(y, bits)),
        F::Multiply => Some(x.times(y, bits)),
        F::Divide if y.as_point().is_some_and(Dyadic::is_zero) => return Real::Undefined,
        F::Divide => x.over(y, bits),
        F::Pow => return power::pow(x, y, bits),
        F::Hypot => Some(x.squared(bits).plus(&y.squared(bits), bits).root(2, bits)),
        F::Atan2 => return made::atan2(x, y, bits),
        F::Min => Some(RealInterval { low: (&x.low).min(&y.low).clone(), high: (&x.high).min(&y.high).clone() }),
        F::Max => Some(RealInterval { low: (&x.low).max(&y.low).clone(), high: (&x.high).max(&y.high).clone() }),
        _ => None,
    };
    range.map_or(Real::Unknown, Real::Range)
}
