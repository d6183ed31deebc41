//! Computed values: operations in a number format, each exact result rounded once.
//!
//! Sums, products, quotients and square roots come from `refsim::num`, or from the host in double precision, where IEEE
//! 754 fixes every bit. All other operations round the enclosure of the exact result: every one is correctly rounded.

use std::cmp::Ordering;

use num_traits::ToPrimitive;
use refsim::num::{Format, Unpacked, from_f64, from_parts, ops, to_f64, unpack};

use super::graph::{Graph, Operation};
use super::real::{Dyadic, End, Function, Real, RealInterval, apply};

/// Numbers of bits of computations over the reals, tried in this order until the rounded result is decided.
pub(super) const PRECISIONS: [u64; 8] = [96, 192, 384, 768, 1536, 3072, 6144, 12_288];

/// Exponent beyond which numbers are zero or infinite in every format.
const FAR: i64 = 1 << 20;

/// A number format to compute in; its numbers are bit patterns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arithmetic {
    /// Double precision.
    Double,
    /// A format of the emulator.
    Number(Format),
}

/// Value that a pattern represents.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FormatNumber {
    Nan,
    Infinite,
    /// A number, without the sign of a zero.
    Finite(Dyadic),
}

impl Arithmetic {
    /// Layout, written as formats are written, such as `e8m23`.
    pub(super) fn layout(self) -> String {
        match self {
            Self::Double => "e11m52".to_owned(),
            Self::Number(format) => format.to_string(),
        }
    }

    /// Width in bits.
    pub(super) fn width(self) -> u32 {
        match self {
            Self::Double => 64,
            Self::Number(format) => format.width(),
        }
    }

    pub(super) fn decode(self, bits: u64) -> FormatNumber {
        let finite = |negative, digits: u64, exponent: i64| {
            let digits = num_bigint::BigInt::from(digits);
            FormatNumber::Finite(Dyadic::new(if negative { -digits } else { digits }, exponent))
        };
        match self {
            Self::Double => {
                let (negative, field, fraction) = (bits >> 63 != 0, (bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
                match (field, fraction) {
                    (0x7ff, 0) => FormatNumber::Infinite,
                    (0x7ff, _) => FormatNumber::Nan,
                    (0, _) => finite(negative, fraction, -1074),
                    _ => finite(negative, fraction | 1 << 52, field.cast_signed() - 1075),
                }
            }
            Self::Number(format) => match unpack(&format, bits as u32) {
                Unpacked::Nan { .. } => FormatNumber::Nan,
                Unpacked::Inf { .. } => FormatNumber::Infinite,
                Unpacked::Finite { sign, sig, exp, .. } => finite(sign, sig, exp.into()),
            },
        }
    }

    /// Rounds once; an unbounded end counts as beyond the largest number.
    pub(super) fn encode(self, end: &End) -> u64 {
        let (negative, digits, exponent) = match end {
            End::At(x) => (x.is_negative(), x.digits.magnitude().clone(), x.exponent),
            infinite => (infinite.is_negative(), 1u32.into(), FAR),
        };
        // The 120 leading bits, and a sticky bit for the others.
        let drop = digits.bits().saturating_sub(120);
        let sticky = digits.trailing_zeros().unwrap_or_default() < drop;
        let kept = (&digits >> drop).to_u128().unwrap_or_default();
        let exponent = (exponent + drop.cast_signed()).clamp(-FAR, FAR);
        match self {
            Self::Number(format) => from_parts(format, negative, kept, exponent as i32, sticky).bits.into(),
            Self::Double => double(negative, kept, exponent, sticky),
        }
    }

    /// Returns `true` if the format has no infinity and no NaN.
    pub(super) fn is_fixed(self) -> bool {
        matches!(self, Self::Number(format) if format.is_fixed())
    }

    /// A double, rounded once.
    pub(super) fn rounded(self, x: f64) -> u64 {
        match self {
            Self::Double if x.is_nan() => self.nan(),
            Self::Double => x.to_bits(),
            Self::Number(format) => from_f64(format, x).bits.into(),
        }
    }

    /// The value as a double; exact, except for NaN.
    pub(super) fn value(self, bits: u64) -> f64 {
        match self {
            Self::Double => f64::from_bits(bits),
            Self::Number(format) => to_f64(&format, bits as u32),
        }
    }

    pub(super) fn nan(self) -> u64 {
        match self {
            Self::Double => f64::NAN.to_bits(),
            Self::Number(format) => format.canonical_nan().unwrap_or_default().into(),
        }
    }

    /// Index of a number (not NaN) among all numbers of the format in ascending order; both zeros have index 0.
    pub(super) fn ordinal(self, bits: u64) -> i64 {
        let width = self.width();
        let signed = (bits << (64 - width)).cast_signed() >> (64 - width);
        match self {
            _ if self.is_fixed() => signed,
            _ if signed < 0 => -(bits & ((1 << (width - 1)) - 1)).cast_signed(),
            _ => signed,
        }
    }

    /// The number with this index.
    pub(super) fn at_ordinal(self, ordinal: i64) -> u64 {
        let width = self.width();
        match self {
            _ if self.is_fixed() => ordinal.cast_unsigned() & (u64::MAX >> (64 - width)),
            _ if ordinal < 0 => ordinal.unsigned_abs() | 1 << (width - 1),
            _ => ordinal.unsigned_abs(),
        }
    }

    /// Indices of the smallest and the largest finite number.
    pub(super) fn finite_ordinals(self) -> [i64; 2] {
        match self {
            Self::Double => [-0x7fef_ffff_ffff_ffff, 0x7fef_ffff_ffff_ffff],
            Self::Number(format) => [format.min_finite(), format.max_finite()].map(|bits| self.ordinal(bits.into())),
        }
    }

    /// Bits of error: `log2(1 + n)`, where `n` counts the numbers from one value to the other; all bits if a result is
    /// NaN.
    pub(super) fn error_bits(self, computed: u64, exact: u64) -> f64 {
        if self.decode(computed) == FormatNumber::Nan {
            return self.width().into();
        }
        let distance = self.ordinal(computed).abs_diff(self.ordinal(exact));
        crate::elementary::ln(1.0 + distance as f64) / std::f64::consts::LN_2
    }

    /// The rounded value of an interval, if all its points round to the same number.
    pub(super) fn decided(self, range: &RealInterval) -> Option<u64> {
        let [low, high] = [&range.low, &range.high].map(|end| self.encode(end));
        (self.ordinal(low) == self.ordinal(high)).then_some(high)
    }

    /// The real value of a pattern that is a number.
    pub(super) fn real(self, bits: u64) -> Real {
        match self.decode(bits) {
            FormatNumber::Finite(x) => Real::Range(RealInterval::point(x)),
            _ => Real::Undefined,
        }
    }

    /// Computes all nodes; truth values are 0 and 1.
    pub(super) fn values(self, graph: &Graph, inputs: &[u64], constants: &[Option<u64>]) -> Vec<u64> {
        let mut values: Vec<u64> = Vec::with_capacity(graph.0.len());
        for (node, constant) in graph.0.iter().zip(constants) {
            let value = match (&node.operation, constant) {
                (_, Some(bits)) => *bits,
                (Operation::Variable(variable), _) => inputs[*variable],
                (operation, _) => {
                    let operands = operation.operands().iter().map(|&operand| values[operand]).collect::<Vec<_>>();
                    self.operation(operation, &operands)
                }
            };
            values.push(value);
        }
        values
    }

    /// The constants of a graph, rounded once; `None` for other nodes.
    pub(super) fn constants(self, graph: &Graph) -> Vec<Option<u64>> {
        let is_constant = |operation: &Operation| matches!(operation, Operation::Number(..) | Operation::Constant(_));
        let all = graph.0.iter().map(|node| {
            is_constant(&node.operation).then(|| {
                let alone = Graph(vec![node.clone()]);
                let decided = PRECISIONS.iter().find_map(|&bits| match alone.reals(&[], bits, None).pop() {
                    Some(Real::Range(range)) => self.decided(&range),
                    _ => None,
                });
                decided.unwrap_or_else(|| self.nan())
            })
        });
        all.collect()
    }

    /// One operation on patterns.
    pub(super) fn operation(self, operation: &Operation, operands: &[u64]) -> u64 {
        let is_true = |operand: &u64| *operand != 0;
        match operation {
            Operation::Variable(_) | Operation::Number(..) | Operation::Constant(_) => 0,
            Operation::Truth(truth) => u64::from(*truth),
            Operation::Compare(comparison, _) => {
                let order = self.order(operands[0], operands[1]);
                u64::from(comparison.holds(order))
            }
            Operation::Connect { all: true, .. } => u64::from(operands.iter().all(is_true)),
            Operation::Connect { all: false, .. } => u64::from(operands.iter().any(is_true)),
            Operation::Not(_) => u64::from(operands[0] == 0),
            Operation::If(_) => operands[if operands[0] != 0 { 1 } else { 2 }],
            Operation::Apply(function, _) => self.function(*function, operands),
        }
    }

    fn order(self, x: u64, y: u64) -> Option<Ordering> {
        let is_nan = |bits| self.decode(bits) == FormatNumber::Nan;
        (!is_nan(x) && !is_nan(y)).then(|| self.ordinal(x).cmp(&self.ordinal(y)))
    }

    fn function(self, function: Function, operands: &[u64]) -> u64 {
        if let Some(bits) = self.native(function, operands) {
            return bits;
        }
        let is_regular = |bits: &u64| matches!(self.decode(*bits), FormatNumber::Finite(x) if !x.is_zero());
        let special = || {
            let values: Vec<f64> = operands.iter().map(|&bits| self.value(bits)).collect();
            self.rounded(function.special(&values))
        };
        if !operands.iter().all(is_regular) {
            return special();
        }
        let reals: Vec<Real> = operands.iter().map(|&bits| self.real(bits)).collect();
        let mut last = None;
        for bits in std::iter::once(64).chain(PRECISIONS) {
            match apply(function, &reals, bits) {
                Real::Range(range) => match self.decided(&range) {
                    Some(bits) => return bits,
                    None => last = Some(range),
                },
                Real::Undefined => return special(),
                Real::Unknown | Real::Truth(_) => {}
            }
        }
        // If even the highest precision does not decide, the value is at a rounding boundary.
        last.map_or(self.nan(), |range| self.encode(&range.high))
    }

    /// Operations whose exact result is rational.
    fn native(self, function: Function, operands: &[u64]) -> Option<u64> {
        use Function as F;
        if let Self::Double = self {
            let is_exact =
                matches!(function, F::Add | F::Subtract | F::Multiply | F::Divide | F::Sqrt | F::Negate | F::Abs);
            return is_exact.then(|| {
                let values: Vec<f64> = operands.iter().map(|&bits| f64::from_bits(bits)).collect();
                self.rounded(function.special(&values))
            });
        }
        let Self::Number(format) = self else { return None };
        let word = |index: usize| operands.get(index).copied().unwrap_or_default() as u32;
        let (x, y) = (word(0), word(1));
        let outcome = match function {
            F::Add => ops::add(format, x, y),
            F::Subtract => ops::sub(format, x, y),
            F::Multiply => ops::mul(format, x, y),
            F::Divide => ops::div(format, x, y),
            F::Sqrt => ops::sqrt(format, x),
            F::Negate => ops::neg(format, x),
            F::Abs => ops::abs(format, x),
            F::Fma => ops::fused_mad(format, x, y, word(2)),
            _ => return None,
        };
        Some(outcome.bits.into())
    }
}

impl Operation {
    /// The operands, as indices of earlier nodes.
    pub(super) fn operands(&self) -> &[usize] {
        match self {
            Self::Variable(_) | Self::Number(..) | Self::Constant(_) | Self::Truth(_) => &[],
            Self::Apply(_, operands) | Self::Connect { operands, .. } => operands,
            Self::Compare(_, pair) => pair,
            Self::Not(operand) => std::slice::from_ref(operand),
            Self::If(parts) => parts,
        }
    }
}

/// Rounds `digits 2^exponent`, with more nonzero bits below it if `sticky`, to the nearest double.
fn double(negative: bool, digits: u128, exponent: i64, sticky: bool) -> u64 {
    let sign = u64::from(negative) << 63;
    if digits == 0 {
        return sign;
    }
    let top = exponent + i64::from(128 - digits.leading_zeros());
    if top > 1024 {
        return f64::INFINITY.to_bits() | sign;
    }
    let unit = (top - 53).max(-1074);
    let drop = unit - exponent;
    let (kept, up) = match drop {
        ..=0 => (digits << drop.unsigned_abs(), false),
        1..=127 => {
            let (kept, half) = (digits >> drop, digits >> (drop - 1) & 1 == 1);
            let below = sticky || digits & ((1 << (drop - 1)) - 1) != 0;
            (kept, half && (below || kept & 1 == 1))
        }
        _ => (0, false),
    };
    // The hidden bit adds 1 to the exponent field, and so does a carry.
    let magnitude = ((unit + 1074).cast_unsigned() << 52) + kept as u64 + u64::from(up);
    magnitude.min(f64::INFINITY.to_bits()) | sign
}
