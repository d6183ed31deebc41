//! The rules of products and sums, applied to a format.

use super::rules::{AddMode, MadMode, Rules};
use crate::num::{DotOrder, Format};

/// The rules of products and sums as they hold for one format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SumRules {
    /// Where products are rounded: the format with the rounding of products.
    pub(crate) products: Format,
    /// Sums of two numbers.
    pub(crate) add: AddMode,
    /// Rounding within `mad`.
    pub(crate) mad: MadMode,
    /// Rounding within dot products.
    pub(crate) dot: DotOrder,
}

impl SumRules {
    /// Those of vertices and addresses: every product and every sum is rounded by the format.
    pub(crate) const fn plain(format: Format) -> Self {
        let (add, mad, dot) = (AddMode::Rounded, MadMode::TwoRoundings, DotOrder::Sequential);
        Self { products: format, add, mad, dot }
    }
}

impl Rules {
    /// The rules of products and sums in a format of pixel arithmetic; units of cards have their own. Fixed point has
    /// neither exponents nor significands: there sums are rounded, and what would cut a product has two roundings.
    pub(crate) fn sums_in(&self, format: Format) -> SumRules {
        if format.unit.is_card() {
            return SumRules::plain(format);
        }
        let products = self.product_rounding.map_or(format, |rounding| format.with_rounding(rounding));
        let mut sums = SumRules { products, add: self.add, mad: self.mad, dot: self.dot };
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

    /// Returns `true` if a rule of sums with this name has, by its value, no meaning for registers in fixed point.
    pub(super) fn needs_floats(&self, name: &str) -> bool {
        match name {
            "add" => matches!(self.add, AddMode::Aligned(_)),
            "dot" => matches!(self.dot, DotOrder::Aligned(_)),
            "mad" => self.mad == MadMode::ProductCut,
            _ => false,
        }
    }
}
