//! The rules of products and sums, applied to a format.

use super::rule_values::{AddMode, MadMode};
use super::rules::Rules;
use crate::num::{DotOrder, Env, Format, Outcome, ops};

/// The rules of products and sums for one format, and the arithmetic that follows from them. Units of cards ignore
/// them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SumRules {
    /// The format, with the rounding of products.
    pub(crate) products: Format,
    /// Sums of two numbers.
    pub(crate) add: AddMode,
    /// Rounding within `mad`.
    pub(crate) mad: MadMode,
    /// Rounding within dot products.
    pub(crate) dot: DotOrder,
    /// `true` if zero times infinity or NaN is +0.
    pub(crate) zero_wins: bool,
}

impl SumRules {
    /// The rules for vertices and addresses, and for a format without a device: every product and every sum is rounded
    /// into the format.
    pub const fn plain(format: Format) -> Self {
        let (add, mad, dot) = (AddMode::Rounded, MadMode::TwoRoundings, DotOrder::Sequential);
        Self { products: format, add, mad, dot, zero_wins: false }
    }

    /// Operands of a product. If zero wins and one operand is zero, the other infinite or NaN, both become +0.
    fn factors(&self, f: &Format, a: u32, b: u32) -> (u32, u32) {
        let wins = self.zero_wins && !f.unit.is_card() && (f.is_zero(a) || f.is_zero(b));
        if wins && !(f.is_finite(a) && f.is_finite(b)) { (0, 0) } else { (a, b) }
    }

    /// `a + b`
    pub fn add(&self, env: impl Into<Env>, a: u32, b: u32) -> Outcome {
        match self.add {
            AddMode::Rounded => ops::add(env, a, b),
            AddMode::Aligned(bits) => ops::sum_aligned(env, bits, &[a, b]),
        }
    }

    /// `a * b`
    pub fn mul(&self, env: impl Into<Env>, a: u32, b: u32) -> Outcome {
        let env = env.into();
        let (a, b) = self.factors(&env.format, a, b);
        ops::mul(self.products.tininess(env.tininess), a, b)
    }

    /// `a * b + c`: product and sum rounded separately, the exact result rounded once, or the product truncated first.
    /// A card's unit has its own rule.
    pub fn mad(&self, env: impl Into<Env>, a: u32, b: u32, c: u32) -> Outcome {
        let env = env.into();
        if env.format.unit.is_card() {
            return ops::mad(env, a, b, c);
        }
        let (x, y) = self.factors(&env.format, a, b);
        match self.mad {
            MadMode::TwoRoundings => {
                let product = self.mul(env, a, b);
                self.add(env, product.bits, c).also(product.flags)
            }
            MadMode::Fused => ops::fused_mad(env, x, y, c),
            MadMode::ProductCut => ops::product_cut_mad(env, x, y, c),
        }
    }

    /// The dot product of terms, summed in the accumulator's format; `self` holds the rules of that format. A card's
    /// unit has its own rule.
    pub fn dot(&self, env: impl Into<Env>, accumulator: Format, terms: &[(u32, u32)]) -> Outcome {
        let env = env.into();
        let format = env.format;
        let factors: Vec<(u32, u32)>;
        let terms = if self.zero_wins {
            factors = terms.iter().map(|&(a, b)| self.factors(&format, a, b)).collect();
            &factors
        } else {
            terms
        };
        let [sums, products] = [accumulator, self.products].map(|format| format.tininess(env.tininess));
        match self.dot {
            order if accumulator == format && self.products == format => ops::dot(env, order, terms),
            DotOrder::Exact => ops::dot_accumulated(env, sums, DotOrder::Exact, terms),
            order => ops::dot_of_products(env, products, sums, order, terms),
        }
    }
}

impl Rules {
    /// The rules of products and sums for a format of pixel arithmetic. Fixed point has neither exponents nor
    /// significands: its sums are rounded, and so are the products that the rules would truncate. Units of cards ignore
    /// the rules.
    pub fn sums_in(&self, format: Format) -> SumRules {
        if format.unit.is_card() {
            return SumRules::plain(format);
        }
        let products = self.product_rounding.map_or(format, |rounding| format.with_rounding(rounding));
        let zero_wins = self.zero_times_anything;
        let mut sums = SumRules { products, add: self.add, mad: self.mad, dot: self.dot, zero_wins };
        if format.is_fixed() {
            let plain = SumRules::plain(format);
            sums.add = plain.add;
            if sums.mad == MadMode::ProductCut {
                sums.mad = plain.mad;
            }
            if matches!(sums.dot, DotOrder::Aligned(_)) {
                sums.dot = plain.dot;
            }
        }
        sums
    }

    /// The rules of products and sums of vertex arithmetic.
    pub fn vertex_sums(&self) -> SumRules {
        SumRules { zero_wins: self.vertex_zero_times_anything, ..SumRules::plain(self.vertex_format) }
    }

    /// Returns `true` if a rule of sums has a value that needs floats.
    pub(super) fn needs_floats(&self, name: &str) -> bool {
        match name {
            "add" => matches!(self.add, AddMode::Aligned(_)),
            "dot" => matches!(self.dot, DotOrder::Aligned(_)),
            "mad" => self.mad == MadMode::ProductCut,
            _ => false,
        }
    }
}
