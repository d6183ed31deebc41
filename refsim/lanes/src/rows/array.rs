//! One operation on arrays of any length, in the rows and vector code that programs run in.

use super::code::{LaneCode, LaneOp, OPERANDS};
use super::ops;
use super::slots::Slots;
use crate::lanes::{AnyLane, LANES, SimdLevel};
use crate::num::{self, Format, NumberOperation};

/// Larger finite doubles are replaced by this one. It is out of range in every format and, like all larger doubles, a
/// multiple of the range in which fixed point wraps.
const FAR: f64 = f64::from_bits((1023 + 200) << 52);

/// Slot of the result; the operands are in the slots before it.
const RESULT: u16 = 3;

/// An operation of a number format on arrays, 256 elements at a time: the arithmetic of the batch executor, equal to
/// [`crate::num::ops`] bit for bit.
///
/// ```
/// use refsim_lanes::ArrayOperation;
/// use refsim_lanes::num::NumberOperation;
///
/// let mut product = ArrayOperation::new("s3.12:rdn".parse()?, NumberOperation::Mul).expect("a number of numbers");
/// let mut out = [0.0; 3];
/// // Half of the smallest number is lost; 8 is beyond the largest number; a third is rounded before it is multiplied.
/// product.doubles([&[1.0 / 4096.0, 4.0, 1.0 / 3.0], &[0.5, 4.0, 1.0], &[]], &mut out);
/// assert_eq!(out, [0.0, 7.999755859375, 0.333251953125]);
/// # Ok::<(), refsim_lanes::num::FormatError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ArrayOperation {
    format: Format,
    /// `None` to round only.
    operation: Option<NumberOperation>,
    lane: AnyLane,
    simd: SimdLevel,
    slots: Slots,
}

impl ArrayOperation {
    /// Creates an operation. `None` for formats that registers cannot have ([`Format::for_registers`]), and for
    /// operations whose operands or results are not all numbers of the format.
    pub fn new(format: Format, operation: NumberOperation) -> Option<Self> {
        use NumberOperation as Op;
        let known = matches!(
            operation,
            Op::Add
                | Op::Sub
                | Op::Mul
                | Op::Div
                | Op::Mad
                | Op::FusedMad
                | Op::Min
                | Op::Max
                | Op::Neg
                | Op::Abs
                | Op::Floor
                | Op::Frc
                | Op::Rcp
                | Op::Rsq
                | Op::Sqrt
                | Op::Exp2
                | Op::Log2
                | Op::Saturate
        );
        Self::of(format, Some(operation).filter(|_| known)?.into())
    }

    /// Creates a rounding of doubles into a format, without an operation. `None` as for [`Self::new`].
    pub fn rounding(format: Format) -> Option<Self> {
        Self::of(format, None)
    }

    fn of(format: Format, operation: Option<NumberOperation>) -> Option<Self> {
        let format = format.for_registers().ok()?;
        let (lane, slots) = (AnyLane::new(format), Slots::new(usize::from(RESULT) + 1));
        Some(Self { format, operation, lane, simd: SimdLevel::widest(), slots })
    }

    /// Number of operands, 1 to 3.
    pub fn operands(&self) -> usize {
        self.operation.map_or(1, NumberOperation::operands)
    }

    /// Computes with numbers: each operand is first rounded into the format; NaN becomes 0 in formats without NaN. An
    /// operand of one element is used for all elements; other missing elements are 0. Results are exact doubles, except
    /// for normalized formats, where they are the nearest doubles.
    pub fn doubles(&mut self, operands: [&[f64]; 3], out: &mut [f64]) {
        self.blocks(operands, out, Self::round_row, |unit, from, out| {
            unit.run(LaneCode::Widen, 0, from);
            out.copy_from_slice(&unit.slots.wide[..out.len()]);
        });
    }

    /// Computes with bit patterns of the format, in the low bits; other bits are ignored. Missing elements are treated
    /// as in [`Self::doubles`].
    pub fn patterns(&mut self, operands: [&[u32]; 3], out: &mut [u32]) {
        let decode = |unit: &mut Self, to: u16, some: &[u32], start: usize| {
            fill(unit.slots.row_mut(to), some, start, |bits| bits);
            unit.run(LaneCode::Plain(NumberOperation::Decode), to, to);
        };
        self.blocks(operands, out, decode, |unit, from, out| {
            unit.run(LaneCode::Plain(NumberOperation::Encode), RESULT, from);
            out.copy_from_slice(&unit.slots.row(RESULT)[..out.len()]);
        });
    }

    /// Rounds doubles into the row of an operand.
    fn round_row(&mut self, to: u16, some: &[f64], start: usize) {
        if self.format.denominator() != 1 {
            // A double is not exact in units of a normalized format, so `num` rounds it.
            let (format, lane) = (self.format, self.lane);
            let raw = |x| lane.decode(num::from_f64(format, x).bits);
            return fill(self.slots.row_mut(to), some, start, raw);
        }
        // NaN gets a single pattern, whose bits the lanes can increment; numbers are limited to binades that the lanes
        // can scale.
        let near = |x: f64| match x {
            _ if x.is_nan() => f64::NAN,
            _ if x.is_finite() && x.abs() > FAR => FAR.copysign(x),
            _ => x,
        };
        fill(&mut self.slots.wide, some, start, near);
        self.run(LaneCode::Narrow, to, to);
    }

    /// Runs the operation block by block: `load` fills the row of an operand from a start index, `store` receives the
    /// row of the result.
    fn blocks<T: Copy>(
        &mut self,
        operands: [&[T]; 3],
        out: &mut [T],
        load: impl Fn(&mut Self, u16, &[T], usize),
        store: impl Fn(&mut Self, u16, &mut [T]),
    ) {
        let operands = &operands[..self.operands()];
        for (to, some) in (0..).zip(operands).filter(|(_, some)| some.len() == 1) {
            load(self, to, &[some[0]; LANES], 0);
        }
        for (block, out) in out.chunks_mut(LANES).enumerate() {
            for (to, some) in (0..).zip(operands).filter(|(_, some)| some.len() != 1) {
                load(self, to, some, block * LANES);
            }
            let result = match self.operation {
                None => 0,
                Some(operation) => {
                    let args = [0, 1, 2].map(|k| k.min(self.operands() as u16 - 1));
                    self.run_all(LaneCode::Plain(operation), RESULT, args);
                    RESULT
                }
            };
            store(self, result, out);
        }
    }

    fn run(&mut self, code: LaneCode, to: u16, from: u16) {
        self.run_all(code, to, [from; 3]);
    }

    fn run_all(&mut self, code: LaneCode, to: u16, [a, b, c]: [u16; 3]) {
        let mut args = [a; OPERANDS];
        (args[1], args[2]) = (b, c);
        let op = LaneOp { code, to, args, zero_wins: false };
        ops::run(&self.lane, self.simd, &[op], &mut self.slots);
    }
}

/// Fills a row with a part of an array; missing elements are 0.
#[inline]
fn fill<T: Copy, R: Copy + Default>(row: &mut [R; LANES], some: &[T], start: usize, f: impl Fn(T) -> R) {
    let rest = some.get(start..).unwrap_or_default();
    let (given, missing) = row.split_at_mut(rest.len().min(LANES));
    given.iter_mut().zip(rest).for_each(|(to, &from)| *to = f(from));
    missing.fill(R::default());
}
