//! Values of the options of `crossbar cpca precompute`.

use std::str::FromStr;

use clap::ValueEnum;

use crate::transfer::brdf::ExitBasis;

/// Kind of transfer at a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum KindArg {
    /// A vector per vertex: the same radiance in all directions
    Diffuse,
    /// A matrix per vertex: radiance by direction
    Glossy,
}

/// Functions of exit radiance: all functions of an order, or all but (1, 0).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RowsArg {
    order: usize,
    is_whole: bool,
}

impl FromStr for RowsArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = (1..=10).flat_map(|order| [(order, true), (order, false)]).find(|&(order, is_whole)| {
            let count = order * order - usize::from(!is_whole);
            count > 0 && text.trim().parse() == Ok(count)
        });
        let found = found.map(|(order, is_whole)| Self { order, is_whole });
        found.ok_or_else(|| {
            format!("expected a square from 1 to 100, or one less than a square from 4 on (without l = 1, m = 0), found `{text}`")
        })
    }
}

impl Default for RowsArg {
    fn default() -> Self {
        Self { order: 5, is_whole: true }
    }
}

impl RowsArg {
    pub(super) fn basis(self) -> ExitBasis {
        let whole = || ExitBasis::of_order(self.order);
        if self.is_whole { whole() } else { ExitBasis::without_1_0(self.order).unwrap_or_else(|_| whole()) }
    }
}
