//! The operations of expressions over intervals.

use super::dyadic::Dyadic;
use super::functions as made;
use super::interval::{Real, RealInterval};
use super::{power, series};

macro_rules! functions {
    ($($name:literal $variant:ident $operands:literal;)*) => {
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
        }
    };
}

functions! {
    "+" Add 2; "-" Subtract 2; "*" Multiply 2; "/" Divide 2; "-" Negate 1; "fma" Fma 3; "sqrt" Sqrt 1; "cbrt" Cbrt 1;
    "fabs" Abs 1; "exp" Exp 1; "exp2" Exp2 1; "expm1" ExpM1 1; "log" Log 1; "log2" Log2 1; "log10" Log10 1;
    "log1p" Log1P 1; "pow" Pow 2; "hypot" Hypot 2; "sin" Sin 1; "cos" Cos 1; "tan" Tan 1; "asin" Asin 1; "acos" Acos 1;
    "atan" Atan 1; "atan2" Atan2 2; "sinh" Sinh 1; "cosh" Cosh 1; "tanh" Tanh 1; "asinh" Asinh 1; "acosh" Acosh 1;
    "atanh" Atanh 1; "fmin" Min 2; "fmax" Max 2; "cast" Cast 1;
}

macro_rules! constants {
    ($($name:literal $variant:ident;)*) => {
        /// A constant that FPCore names.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Constant { $($variant,)* }

        impl Constant {
            pub(crate) fn named(name: &str) -> Option<Self> {
                match name { $($name => Some(Self::$variant),)* _ => None }
            }
        }
    };
}

constants! {
    "E" E; "LOG2E" Log2E; "LOG10E" Log10E; "LN2" Ln2; "LN10" Ln10; "PI" Pi; "PI_2" Pi2; "PI_4" Pi4; "M_1_PI" OverPi;
    "M_2_PI" TwoOverPi; "M_2_SQRTPI" TwoOverRootPi; "SQRT2" Sqrt2; "SQRT1_2" SqrtHalf;
}

impl Constant {
    /// The constant, to about `bits` bits.
    pub(crate) fn value(self, bits: u64) -> RealInterval {
        let [one, ten] = [1, 10].map(RealInterval::integer);
        let pi = || series::pi(bits);
        let log = |x: &RealInterval| made::log(x, bits);
        // No divisor is zero.
        let over = |x: &RealInterval, y: RealInterval| x.over(&y, bits).unwrap_or_else(|| x.clone());
        match self {
            Self::E => made::exp(&one, bits),
            Self::Log2E => over(&one, series::ln_2(bits)),
            Self::Log10E => over(&one, log(&ten)),
            Self::Ln2 => series::ln_2(bits),
            Self::Ln10 => log(&ten),
            Self::Pi => pi(),
            Self::Pi2 => pi().scaled(-1),
            Self::Pi4 => pi().scaled(-2),
            Self::OverPi => over(&one, pi()),
            Self::TwoOverPi => over(&one, pi().scaled(-1)),
            Self::TwoOverRootPi => over(&one, pi().root(2, bits).scaled(-1)),
            Self::Sqrt2 => RealInterval::integer(2).root(2, bits),
            Self::SqrtHalf => RealInterval::integer(2).scaled(-2).root(2, bits),
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

/// `true` if the whole interval is above zero, `false` if none of it is; `None` if some is.
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
