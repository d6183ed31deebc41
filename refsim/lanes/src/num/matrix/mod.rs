//! Sums of products in the matrix units of GPUs, Volta to Blackwell and CDNA1 to CDNA3: `D = A B + C`, bit for bit.
//!
//! A [`MatrixUnit`] is a rule with its parameters. A dot product of any length is computed in blocks, in order of k;
//! the result of a block is the addend of the next. [`UNITS`] is the table of units with sources; docs/matrix_units.md
//! has the rules and their confidence. Zeros are left out of sums, so padding to whole blocks changes nothing.
//!
//! ```
//! use refsim_lanes::num::matrix::{Element, MatrixUnit, Operand};
//!
//! let volta = MatrixUnit::find("volta_f16_f32")?;
//! // 1 * 1 - 2^-12 * 2^-12: the last product is below the 23 bits that Volta keeps, but within Turing's 24.
//! let [a, b] = [[0x3c00, 0x8c00], [0x3c00, 0x0c00]];
//! let [a, b] = [&a, &b].map(|codes| Operand { element: Element::FP16, codes, scales: &[] });
//! assert_eq!(volta.dot(a, b, 0), 0x3f800000);
//! assert_eq!(MatrixUnit::find("turing_f16_f32")?.dot(a, b, 0), 0x3f7fffff);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod element;
mod rules;
mod table;

use crate::num::aligned::{Addend, Alignment, aligned};

pub(crate) use element::Value;
pub use element::{Element, ResultFormat};
pub use table::UNITS;

/// Rule by which the addends of a block are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// NVIDIA's adder: addends are aligned to the largest exponent, which is at least `least`, truncated, and added
    /// exactly.
    Aligned {
        /// Least exponent that addends are aligned to.
        least: i32,
    },
    /// Two aligned sums of 16 products per block of 32; the addend is then added, rounded to nearest even (`mma.sync`
    /// with FP8).
    Synchronous {
        /// Least exponent that products are aligned to.
        least: i32,
    },
    /// Blocks of 64 products in four groups of 16: the exact sums of the groups, times their scales, are aligned.
    Groups,
    /// The exact sum of a block, rounded once (CDNA1).
    Exact,
    /// Single precision, 2 or 4 products in pairs, subnormal numbers flushed (CDNA2).
    Pairs,
    /// Aligned products; their sum and `c` are rounded down (CDNA3).
    Floored {
        /// Products of even and of odd index are summed separately.
        halves: bool,
    },
    /// Fused multiply-adds, one after the other.
    Fused,
}

/// A matrix unit for one combination of types.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MatrixUnit {
    /// Name.
    pub name: &'static str,
    /// Chips and instructions.
    pub chips: &'static str,
    /// Types of a and b, in any combination.
    pub operands: &'static [Element],
    /// Type of c.
    pub addend: Element,
    /// Products per instruction.
    pub length: usize,
    /// Products per block.
    pub block: usize,
    /// Bits of each addend that an aligned adder keeps below the largest exponent; `None` for other rules.
    pub bits: Option<u32>,
    /// Rule of summation.
    pub rule: Rule,
    /// Numbers per scale and the scale's type, if a and b have scales.
    pub scaling: Option<(usize, Element)>,
    /// Type and rounding of d.
    pub result: ResultFormat,
    /// Evidence for the rule: `measured` (it agrees with results of GPUs), `two models` or `one model` (it agrees with
    /// published models).
    pub evidence: &'static str,
    /// The sources: measured results, chips, and models that agree.
    pub source: &'static str,
}

/// One operand of a dot product: numbers along k.
#[derive(Clone, Copy, Debug)]
pub struct Operand<'a> {
    /// Their type.
    pub element: Element,
    /// Their patterns.
    pub codes: &'a [u64],
    /// Patterns of the scales, one per group of numbers ([`MatrixUnit::scaling`]); empty if there are no scales.
    pub scales: &'a [u8],
}

/// Error for an unknown unit, or operands that a unit does not accept.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("{what}: expected {expected}, found {found}")]
#[diagnostic(
    code(num::matrix_unit),
    help("`crossbar units` lists the types of each unit; A is M x K, B is K x N, C and D are M x N")
)]
pub struct MatrixError {
    what: String,
    expected: String,
    found: String,
}

impl MatrixError {
    /// Creates an error about `what`.
    pub fn new(what: impl Into<String>, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self { what: what.into(), expected: expected.into(), found: found.into() }
    }
}

impl MatrixUnit {
    /// This unit with another number of bits below the largest exponent, 1 to 60; `None` for units without an aligned
    /// adder.
    pub fn with_bits(self, kept: u32) -> Option<Self> {
        self.bits.filter(|_| (1..=60).contains(&kept)).map(|_| Self { bits: Some(kept), ..self })
    }

    /// Checks that the operands have accepted types, equal lengths, and the required scales.
    ///
    /// # Errors
    /// If they don't.
    pub fn check(&self, a: &Operand<'_>, b: &Operand<'_>) -> Result<(), MatrixError> {
        for (side, operand) in [("a", a), ("b", b)] {
            if !self.operands.contains(&operand.element) {
                let names: Vec<&str> = self.operands.iter().map(|element| element.name).collect();
                let what = format!("type of {side} of {}", self.name);
                return Err(MatrixError::new(what, names.join(" "), operand.element.name));
            }
            let wanted = self.scaling.map_or(0, |(share, _)| operand.codes.len().div_ceil(share));
            if operand.scales.len() != wanted {
                let what = format!("scales of {side} of {}", self.name);
                return Err(MatrixError::new(what, wanted.to_string(), operand.scales.len().to_string()));
            }
        }
        let [long, other] = [a, b].map(|operand| operand.codes.len());
        let same = long == other && long > 0;
        same.then_some(()).ok_or_else(|| MatrixError::new("length of b", format!("{long}, above 0"), other.to_string()))
    }

    /// The dot product of operands that pass [`Self::check`], plus `c`, a pattern of [`Self::addend`]; returns a word
    /// of [`Self::result`].
    pub fn dot(&self, a: Operand<'_>, b: Operand<'_>, c: u64) -> u64 {
        let mut sum = (c, self.addend);
        for start in (0..a.codes.len()).step_by(self.block) {
            sum = (self.block_sum(a, b, start, sum), self.result.element);
        }
        sum.0
    }

    /// The sum of the block that begins at `start`, plus an addend of any type.
    pub fn block_sum(&self, a: Operand<'_>, b: Operand<'_>, start: usize, (c, element): (u64, Element)) -> u64 {
        let (addend, result, bits) = (element.decode(c), self.result, self.bits.unwrap_or(0));
        match self.rule {
            Rule::Aligned { least } => rules::adder(&self.addends(a, b, start, addend), bits, least, result),
            Rule::Synchronous { least } => rules::synchronous(&self.products(a, b, start), c, bits, least, result),
            Rule::Groups => {
                let scales: Vec<[Value; 2]> =
                    (start..).step_by(rules::GROUP).map_while(|k| self.scales(a, b, k)).take(4).collect();
                rules::groups(&self.products(a, b, start), &scales, addend, bits, result)
            }
            Rule::Exact => rules::exact(&self.values(a, start), &self.values(b, start), c),
            Rule::Pairs => {
                let is_first = start.is_multiple_of(self.length);
                rules::pairs(&self.values(a, start), &self.values(b, start), self.block, addend, is_first)
            }
            Rule::Floored { halves } => rules::floored(&self.products(a, b, start), addend, halves),
            Rule::Fused => rules::fused(a.codes[start], b.codes[start], c, result.element),
        }
    }

    /// The addends of a block of an aligned adder, `c` last: exact, and as truncated by the adder. `None` for other
    /// rules, and if an addend is NaN or infinite.
    pub fn kept(
        &self,
        a: Operand<'_>,
        b: Operand<'_>,
        start: usize,
        (c, element): (u64, Element),
    ) -> Option<Vec<[f64; 2]>> {
        let (Rule::Aligned { least }, Some(bits)) = (self.rule, self.bits) else { return None };
        let number = |value| if let Value::Finite(addend) = value { Some(addend) } else { None };
        let addends = self.addends(a, b, start, element.decode(c));
        let addends: Vec<Addend> = addends.into_iter().map(number).collect::<Option<_>>()?;
        let top = addends.iter().filter(|x| x.magnitude != 0).map(|x| x.exponent).fold(least, i32::max);
        let cut = |x: Addend| aligned([Addend { exponent: x.exponent.min(top), ..x }], bits, Some(top), Alignment::Cut);
        let scaled = |size: f64, exponent: i32| {
            let half = exponent / 2;
            size * crate::num::power_of_two(half) * crate::num::power_of_two(exponent - half)
        };
        let both = |x: Addend| {
            let exact = scaled(x.magnitude as f64, x.exponent - x.fraction.cast_signed());
            [if x.negative { -exact } else { exact }, scaled(cut(x).sum as f64, top - bits.cast_signed())]
        };
        Some(addends.into_iter().map(both).collect())
    }

    fn values(&self, operand: Operand<'_>, start: usize) -> Vec<Value> {
        operand.codes.iter().skip(start).take(self.block).map(|&code| operand.element.decode(code)).collect()
    }

    fn products(&self, a: Operand<'_>, b: Operand<'_>, start: usize) -> Vec<Value> {
        self.values(a, start).into_iter().zip(self.values(b, start)).map(|(a, b)| a.times(b)).collect()
    }

    /// Products, multiplied by the block's power-of-two scales, then `c`.
    fn addends(&self, a: Operand<'_>, b: Operand<'_>, start: usize, c: Value) -> Vec<Value> {
        let mut addends = self.products(a, b, start);
        if let Some([sa, sb]) = self.scales(a, b, start) {
            for product in &mut addends {
                match (&mut *product, sa, sb) {
                    (Value::Finite(x), Value::Finite(sa), Value::Finite(sb)) => x.exponent += sa.exponent + sb.exponent,
                    (_, Value::Finite(_), Value::Finite(_)) => {}
                    _ => *product = Value::Nan,
                }
            }
        }
        addends.push(c);
        addends
    }

    fn scales(&self, a: Operand<'_>, b: Operand<'_>, k: usize) -> Option<[Value; 2]> {
        let (share, element) = self.scaling?;
        let scale = |operand: Operand<'_>| operand.scales.get(k / share).map(|&code| element.decode(code.into()));
        Some([scale(a)?, scale(b)?])
    }
}
