//! Spherical harmonics of a reflectance, by integration over both directions.

use crate::all_frequency::factor::{DiscSamples, ProductErrors, harmonic_errors};
use crate::error::InputError;
use crate::report::{Cell, Table};
use crate::sphere::function_count;

/// The orders of the paper's table.
const ORDERS: std::ops::RangeInclusive<usize> = 4..=7;

/// Errors of an order.
pub(super) struct HarmonicRow {
    pub(super) order: usize,
    pub(super) errors: ProductErrors,
}

/// Errors for all orders with fewer functions than there are texels.
pub(super) fn rows(disc: &DiscSamples) -> Result<Vec<HarmonicRow>, InputError> {
    let orders = ORDERS.filter(|&order| disc.counts().iter().all(|&count| count > function_count(order)));
    orders.map(|order| Ok(HarmonicRow { order, errors: harmonic_errors(disc.samples(), order)? })).collect()
}

pub(super) fn table(rows: &[HarmonicRow]) -> Table {
    let title = "Errors of spherical harmonics at the same pairs";
    let mut table = Table::of(title, "order functions relative_squared_error rms max");
    for HarmonicRow { order, errors } in rows {
        table.push([
            (*order).into(),
            function_count(*order).into(),
            Cell::error(errors.relative_squared_error),
            Cell::error(errors.rms),
            Cell::error(errors.max),
        ]);
    }
    table
}
