//! Sums of products in the matrix units of GPUs, Volta to Blackwell and CDNA1 to CDNA3: `D = A B + C`, bit for bit.
//!
//! A [`MatrixUnit`] is a rule with its numbers. A dot product of any length goes through it in blocks, in order of k;
//! the result of a block is the addend of the next. [`UNITS`] is the table of units with sources; docs/matrix_units.md
//! has the rules and their confidence. Zeros are left out of sums, so padding to whole blocks changes nothing.
//!
//! ```
//! use refsim_lanes::num::matrix::{Element, MatrixUnit, Operand};
//!
//! let volta = MatrixUnit::find("volta_f16_f32")?;
//! // 1 * 1 - 2^-12 * 2^-12: below the 23 bits that Volta keeps, within the 24 of Turing.
//! let [a, b] = [[0x3c00, 0x8c00], [0x3c00, 0x0c00]];
//! let [a, b] = [&a, &b].map(|codes| Operand { element: Element::FP16, codes, scales: &[] });
//! assert_eq!(volta.dot(a, b, 0), 0x3f800000);
//! assert_eq!(MatrixUnit::find("turing_f16_f32")?.dot(a, b, 0), 0x3f7fffff);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod amd;
mod element;
mod nvidia;
mod result;
mod table;

use crate::num::aligned::{Addend, Alignment, aligned};

pub use element::{Element, Value};
pub use result::ResultFormat;
pub use table::UNITS;

/// How the addends of a block become a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// NVIDIA's aligned adder: `bits` below the largest exponent, which is at least `least`.
    Aligned {
        /// Products of a block.
        block: usize,
        /// Bits of each addend that are kept below the largest exponent.
        bits: u32,
        /// Least exponent that addends are aligned to.
        least: i32,
    },
    /// Two aligned sums of 16 of a block's 32 products each; the addend is added to nearest even (`mma.sync` with FP8).
    Synchronous {
        /// Bits of each product that are kept below the largest exponent.
        bits: u32,
        /// Least exponent that products are aligned to.
        least: i32,
    },
    /// Blocks of 64 in four groups of 16: the exact sums of the groups, times their scales, are aligned.
    Groups {
        /// Bits that are kept below the largest exponent.
        bits: u32,
    },
    /// The exact sum of a block, rounded once (CDNA1).
    Exact {
        /// Products of a block.
        block: usize,
    },
    /// Single precision, 2 or 4 products in pairs, subnormal numbers flushed (CDNA2).
    Pairs {
        /// Products of a block.
        block: usize,
    },
    /// Aligned products, then floors (CDNA3).
    Floored {
        /// Products of a block.
        block: usize,
        /// Products of even and of odd index are summed apart.
        halves: bool,
    },
    /// Fused multiply-adds, one after the other.
    Fused,
}

/// Scales of the operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scaling {
    /// Numbers that share a scale: 32 or 16.
    pub block: usize,
    /// `true` for ue4m3 (E4M3 whose sign is ignored), `false` for ue8m0 (a power of two).
    pub is_e4m3: bool,
}

impl Scaling {
    /// Decodes a scale.
    pub fn decode(self, code: u8) -> Value {
        match (self.is_e4m3, code) {
            (true, _) => Element::E4M3.decode((code & 0x7f).into()),
            (false, 0xff) => Value::Nan,
            (false, _) => {
                Value::Finite(Addend { negative: false, magnitude: 1, exponent: i32::from(code) - 127, fraction: 0 })
            }
        }
    }
}

/// How a rule is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// Results of GPUs agree with it.
    Measured,
    /// Two models that others made agree with it.
    TwoModels,
    /// One model agrees with it.
    OneModel,
}

impl Evidence {
    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::TwoModels => "two models",
            Self::OneModel => "one model",
        }
    }
}

/// A matrix unit for one combination of types.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MatrixUnit {
    /// Name.
    pub name: &'static str,
    /// Chips and instructions.
    pub chips: &'static str,
    /// Types of a and b; any two may meet.
    pub operands: &'static [Element],
    /// Type of c.
    pub addend: Element,
    /// Products of one instruction.
    pub length: usize,
    /// The sum.
    pub rule: Rule,
    /// Scales of a and b, if they have any.
    pub scaling: Option<Scaling>,
    /// Type and rounding of d.
    pub result: ResultFormat,
    /// How the rule is known.
    pub evidence: Evidence,
    /// The measurements, their chip, and the models that agree.
    pub source: &'static str,
}

/// One operand of a dot product: numbers along k.
#[derive(Clone, Copy, Debug)]
pub struct Operand<'a> {
    /// Their type.
    pub element: Element,
    /// Their patterns.
    pub codes: &'a [u64],
    /// Patterns of the scales, one for each [`Scaling::block`] numbers; empty without scales.
    pub scales: &'a [u8],
}

/// Operands that a unit does not take, or no unit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[error("{what}: expected {expected}, found {found}")]
#[diagnostic(code(num::matrix_unit), help("`crossbar units` lists the units with their types"))]
pub struct MatrixError {
    what: String,
    expected: String,
    found: String,
}

impl MatrixError {
    /// Creates the error of some `what`.
    pub fn new(what: impl Into<String>, expected: impl Into<String>, found: impl Into<String>) -> Self {
        Self { what: what.into(), expected: expected.into(), found: found.into() }
    }
}

impl MatrixUnit {
    /// The same unit with another number of bits below the largest exponent, 1 to 60; `None` of units without an
    /// aligned adder.
    pub fn with_bits(mut self, kept: u32) -> Option<Self> {
        let (Rule::Aligned { bits, .. } | Rule::Synchronous { bits, .. } | Rule::Groups { bits }) = &mut self.rule
        else {
            return None;
        };
        *bits = kept;
        (1..=60).contains(&kept).then_some(self)
    }

    /// Bits that are kept below the largest exponent, of aligned adders.
    pub const fn bits(&self) -> Option<u32> {
        match self.rule {
            Rule::Aligned { bits, .. } | Rule::Synchronous { bits, .. } | Rule::Groups { bits } => Some(bits),
            _ => None,
        }
    }

    /// Products of a block.
    pub const fn block(&self) -> usize {
        match self.rule {
            Rule::Aligned { block, .. } | Rule::Exact { block } | Rule::Pairs { block } => block,
            Rule::Floored { block, .. } => block,
            Rule::Synchronous { .. } => 32,
            Rule::Groups { .. } => 64,
            Rule::Fused => 1,
        }
    }

    /// Checks that operands have types that the unit takes, one length, and their scales.
    ///
    /// # Errors
    /// If they do not.
    pub fn check(&self, a: &Operand<'_>, b: &Operand<'_>) -> Result<(), MatrixError> {
        for (side, operand) in [("a", a), ("b", b)] {
            if !self.operands.contains(&operand.element) {
                let names: Vec<&str> = self.operands.iter().map(|element| element.name).collect();
                let what = format!("type of {side} of {}", self.name);
                return Err(MatrixError::new(what, names.join(" "), operand.element.name));
            }
            let wanted = self.scaling.map_or(0, |scaling| operand.codes.len().div_ceil(scaling.block));
            if operand.scales.len() != wanted {
                let what = format!("scales of {side} of {}", self.name);
                return Err(MatrixError::new(what, wanted.to_string(), operand.scales.len().to_string()));
            }
        }
        let [long, other] = [a, b].map(|operand| operand.codes.len());
        let same = long == other && long > 0;
        same.then_some(()).ok_or_else(|| MatrixError::new("length of b", format!("{long}, above 0"), other.to_string()))
    }

    /// The dot product of operands that pass [`Self::check`], and `c`, a pattern of [`Self::addend`]: a word of
    /// [`Self::result`].
    pub fn dot(&self, a: Operand<'_>, b: Operand<'_>, c: u64) -> u64 {
        let mut sum = (c, self.addend);
        for start in (0..a.codes.len().max(1)).step_by(self.block()) {
            sum = (self.block_sum(a, b, start, sum), self.result.element());
        }
        sum.0
    }

    /// The sum of the block that begins at `start`, and an addend of some type.
    pub fn block_sum(&self, a: Operand<'_>, b: Operand<'_>, start: usize, (c, element): (u64, Element)) -> u64 {
        let [x, y] = [self.values(a, start), self.values(b, start)];
        let products = || -> Vec<Value> { x.iter().zip(&y).map(|(a, b)| a.times(*b)).collect() };
        let addend = element.decode(c);
        match self.rule {
            Rule::Aligned { bits, least, .. } => match self.scaled(products(), a, b, start) {
                Some(products) => nvidia::block(&products, addend, bits, least, self.result),
                None => self.result.special(Value::Nan),
            },
            Rule::Synchronous { bits, least } => nvidia::synchronous(&products(), c, bits, least, self.result),
            Rule::Groups { bits } => {
                let pairs: Vec<nvidia::GroupScales> =
                    (start..).step_by(16).map_while(|k| self.pair_of_scales(a, b, k)).take(4).collect();
                nvidia::groups(&products(), &pairs, addend, bits, self.result)
            }
            Rule::Exact { .. } => amd::exact(&products(), addend, self.result),
            Rule::Pairs { block } => amd::pairs(&x, &y, block, addend),
            Rule::Floored { halves, .. } => amd::floored(&products(), addend, halves),
            Rule::Fused => {
                let one = |values: &[Value]| values.first().copied().unwrap_or(Element::FP32.decode(0));
                amd::fused(one(&x), one(&y), addend, self.result)
            }
        }
    }

    /// The addends of a block of an aligned adder, `c` last: exact, and as they are kept, in units of the last bit
    /// kept; with the exponent of that unit. `None` for other rules, and if an addend is NaN or infinite.
    pub fn kept(
        &self,
        a: Operand<'_>,
        b: Operand<'_>,
        start: usize,
        (c, element): (u64, Element),
    ) -> Option<(Vec<(Addend, i128)>, i32)> {
        let Rule::Aligned { bits, least, .. } = self.rule else { return None };
        let [x, y] = [self.values(a, start), self.values(b, start)];
        let mut values = self.scaled(x.iter().zip(&y).map(|(a, b)| a.times(*b)).collect(), a, b, start)?;
        values.push(element.decode(c));
        let number = |value: &Value| if let Value::Finite(addend) = value { Some(*addend) } else { None };
        let addends: Vec<Addend> = values.iter().map(number).collect::<Option<_>>()?;
        let top = addends.iter().filter(|x| x.magnitude != 0).map(|x| x.exponent).fold(least, i32::max);
        let cut = |addend: Addend| {
            aligned([addend].into_iter().filter(|x| x.magnitude != 0), bits, Some(top), Alignment::Cut)
        };
        Some((addends.iter().map(|&x| (x, cut(x).sum)).collect(), top - bits.cast_signed()))
    }

    fn values(&self, operand: Operand<'_>, start: usize) -> Vec<Value> {
        operand.codes.iter().skip(start).take(self.block()).map(|&code| operand.element.decode(code)).collect()
    }

    /// The scales of the k-th numbers.
    fn pair_of_scales(&self, a: Operand<'_>, b: Operand<'_>, k: usize) -> Option<(Value, Value)> {
        let scaling = self.scaling?;
        let [a, b] = [a, b].map(|operand| operand.scales.get(k / scaling.block).map(|&code| scaling.decode(code)));
        a.zip(b)
    }

    /// Products with the exponents of the block's scales added; `None` if a scale is NaN.
    fn scaled(&self, mut products: Vec<Value>, a: Operand<'_>, b: Operand<'_>, start: usize) -> Option<Vec<Value>> {
        let Some((sa, sb)) = self.pair_of_scales(a, b, start) else { return Some(products) };
        let (Value::Finite(sa), Value::Finite(sb)) = (sa, sb) else { return None };
        for product in &mut products {
            if let Value::Finite(addend) = product {
                addend.exponent += sa.exponent + sb.exponent;
            }
        }
        Some(products)
    }
}
