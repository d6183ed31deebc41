//! The same reflectance by spherical harmonics.

use crate::all_frequency::factor::{DiscSamples, HarmonicFit, HarmonicSides, ProductErrors, harmonic_errors};
use crate::error::InputError;
use crate::report::{Cell, Table};
use crate::sphere::function_count;

/// The orders of the paper's table.
const ORDERS: std::ops::RangeInclusive<usize> = 4..=7;

/// Errors of an order.
pub(super) struct HarmonicRow {
    pub(super) order: usize,
    pub(super) fit: HarmonicFit,
    pub(super) sides: HarmonicSides,
    pub(super) errors: ProductErrors,
}

/// All orders, fits and sides; none where the texels are fewer than the functions.
pub(super) fn rows(disc: &DiscSamples) -> Result<Vec<HarmonicRow>, InputError> {
    let mut rows = Vec::new();
    for sides in [HarmonicSides::View, HarmonicSides::Light, HarmonicSides::Both] {
        for fit in [HarmonicFit::ZeroHemisphere, HarmonicFit::LeastSquares] {
            for order in ORDERS.filter(|&order| disc.counts().iter().all(|&count| count > function_count(order))) {
                rows.push(HarmonicRow {
                    order,
                    fit,
                    sides,
                    errors: harmonic_errors(disc.samples(), order, fit, sides)?,
                });
            }
        }
    }
    Ok(rows)
}

pub(super) fn table(rows: &[HarmonicRow]) -> Table {
    let mut table = Table::of(
        "Errors of spherical harmonics at the same pairs",
        "expanded fit order functions relative_squared_error rms max",
    );
    for HarmonicRow { order, fit, sides, errors } in rows {
        let sides = match sides {
            HarmonicSides::View => "view",
            HarmonicSides::Light => "light",
            HarmonicSides::Both => "both",
        };
        let fit = match fit {
            HarmonicFit::ZeroHemisphere => "zero hemisphere",
            HarmonicFit::LeastSquares => "least squares",
        };
        table.push([
            sides.into(),
            fit.into(),
            (*order).into(),
            function_count(*order).into(),
            Cell::error(errors.relative_squared_error),
            Cell::error(errors.rms),
            Cell::error(errors.max),
        ]);
    }
    table
}
