//! Computed values: operations in a number format, each exact result rounded once.
//!
//! Sums, products, quotients and square roots come from `refsim::num`, or from the host in double precision, where IEEE
//! 754 fixes every bit. All other operations round the enclosure of the exact result: every one is correctly rounded.

use std::cmp::Ordering;

use num_bigint::{BigInt, BigUint};
use num_traits::ToPrimitive;
use num_traits::float::FloatCore;
use refsim::num::{Format, from_f64, from_parts, ops, to_f64};

use super::graph::{Graph, Operation};
use super::real::{Dyadic, End, Function, Real, RealInterval, apply};
use crate::geom::exact::ratio::to_f64 as to_double;

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

impl Arithmetic {
    /// Layout in the syntax of formats, such as `e8m23`.
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
            Self::Double => {
                let digits = BigUint::from(kept << 1 | u128::from(sticky));
                // Numbers of 121 bits with exponents beyond these are zero or infinite.
                let [up, down] = [exponent - 1, 1 - exponent].map(|places| places.clamp(0, 1400));
                let magnitude = to_double(&(digits << up), &(BigUint::from(1u32) << down));
                (if negative { -magnitude } else { magnitude }).to_bits()
            }
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
        if self.value(computed).is_nan() {
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
        let x = self.value(bits);
        let (digits, exponent, sign) = FloatCore::integer_decode(x);
        let number = || RealInterval::point(Dyadic::new(BigInt::from(digits) * sign, exponent.into()));
        if x.is_finite() { Real::Range(number()) } else { Real::Undefined }
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
        let is_nan = |bits| self.value(bits).is_nan();
        (!is_nan(x) && !is_nan(y)).then(|| self.ordinal(x).cmp(&self.ordinal(y)))
    }

    fn function(self, function: Function, operands: &[u64]) -> u64 {
        use Function as F;
        let values = || operands.iter().map(|&bits| self.value(bits)).collect::<Vec<f64>>();
        let special = || self.rounded(function.special(&values()));
        let word = |index: usize| operands.get(index).copied().unwrap_or_default() as u32;
        let (x, y) = (word(0), word(1));
        // Operations whose exact result is rational.
        let outcome = match (self, function) {
            (Self::Double, F::Add | F::Subtract | F::Multiply | F::Divide | F::Sqrt | F::Negate | F::Abs) => {
                return special();
            }
            (Self::Number(format), F::Add) => Some(ops::add(format, x, y)),
            (Self::Number(format), F::Subtract) => Some(ops::sub(format, x, y)),
            (Self::Number(format), F::Multiply) => Some(ops::mul(format, x, y)),
            (Self::Number(format), F::Divide) => Some(ops::div(format, x, y)),
            (Self::Number(format), F::Sqrt) => Some(ops::sqrt(format, x)),
            (Self::Number(format), F::Negate) => Some(ops::neg(format, x)),
            (Self::Number(format), F::Abs) => Some(ops::abs(format, x)),
            (Self::Number(format), F::Fma) => Some(ops::fused_mad(format, x, y, word(2))),
            _ => None,
        };
        if let Some(outcome) = outcome {
            return outcome.bits.into();
        }
        if values().iter().any(|x| *x == 0.0 || !x.is_finite()) {
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
