//! Errors by number of terms, errors of spherical harmonics, and files of G, F and the singular values.

use std::fmt::Write as _;

use glam::DVec3;

use crate::all_frequency::factor::{DiscSamples, Factorization, ProductErrors, ProductFactors, harmonic_errors};
use crate::error::InputError;
use crate::io::write_npy_array;
use crate::report::{Cell, Chart, Findings, NamedChart, Scale, Series, Table, not_encoded};
use crate::sphere::function_count;
use crate::study::StudyError;

/// Every number of terms up to this one has a row.
const EACH: usize = 20;
/// The orders of the paper's table of harmonics.
const ORDERS: std::ops::RangeInclusive<usize> = 4..=7;

/// Errors for each number of terms up to 20, and for all available vectors.
pub(super) fn terms(disc: &DiscSamples, found: &Factorization) -> Table {
    let terms = found.terms();
    let row = |terms: usize| {
        let errors = disc.errors(&found.factors(terms));
        [
            terms.into(),
            Cell::measured(found.singular_values()[terms - 1]),
            Cell::error(found.relative_squared_error(terms)),
            Cell::error(errors.rms),
            Cell::error(errors.max),
            Cell::measured(errors.least),
            Cell::percent(100.0 * errors.negative),
            found.split_pair(terms).is_some().into(),
        ]
    };
    let columns = "terms singular_value relative_squared_error rms max least below_0_% splits_a_pair";
    let each = (1..=terms.min(EACH)).chain((terms > EACH).then_some(terms));
    Table::of("Errors by terms, over pairs of texels above the horizon", columns).with(each.map(row))
}

/// Errors of harmonics, by integration over both directions, for all orders with fewer functions than there are texels.
pub(super) fn harmonics(disc: &DiscSamples) -> Result<Vec<(usize, ProductErrors)>, InputError> {
    let orders = ORDERS.filter(|&order| disc.counts().iter().all(|&count| count > function_count(order)));
    orders.map(|order| Ok((order, harmonic_errors(disc.samples(), order)?))).collect()
}

pub(super) fn harmonic_table(rows: &[(usize, ProductErrors)]) -> Table {
    let row = |(order, errors): &(usize, ProductErrors)| {
        let [relative, rms, max] = [errors.relative_squared_error, errors.rms, errors.max].map(Cell::error);
        [(*order).into(), function_count(*order).into(), relative, rms, max]
    };
    let title = "Errors of spherical harmonics at the same pairs";
    Table::of(title, "order functions relative_squared_error rms max").with(rows.iter().map(row))
}

/// Charts of the singular values, and of the error of Figure 2 by number of terms.
pub(super) fn charts(found: &Factorization) -> impl Iterator<Item = NamedChart> {
    let value = |(k, &value): (usize, &f64)| ((k + 1) as f64, value);
    let values: Vec<(f64, f64)> = found.singular_values()[..found.rank()].iter().enumerate().map(value).collect();
    let most = found.rank().min(64);
    let errors: Vec<(f64, f64)> =
        (1..=most).map(|terms| (terms as f64, found.relative_squared_error(terms))).filter(|at| at.1 > 1e-30).collect();
    let of = |(name, title, y, points, caption): (&str, &str, &str, Vec<(f64, f64)>, &str)| NamedChart {
        name: name.to_owned(),
        chart: Chart {
            title: title.to_owned(),
            x: "terms".to_owned(),
            y: y.to_owned(),
            y_scale: Scale::Logarithmic,
            lines: vec![Series { label: "ours".to_owned(), points }],
            ..Chart::default()
        },
        caption: caption.to_owned(),
    };
    let of_values = "All singular values that can be distinguished from 0.";
    let of_errors =
        "The sum of squared differences divided by the sum of squares, over all pairs of texels, as in Figure 2.";
    let charts = [
        ("spectrum", "Singular values", "singular value", values, of_values),
        ("error", "Error by terms", "relative squared error", errors, of_errors),
    ];
    charts.into_iter().filter(|(.., points, _)| points.len() > 1).map(of)
}

/// Stores tables with a row per texel: as text with the texel's direction, and as f32 arrays without it.
pub(super) fn keep(found: &mut Findings, all: &Factorization, factors: &ProductFactors) -> Result<(), StudyError> {
    // Writing to a string cannot fail.
    let mut values = "singular_value\n".to_owned();
    all.singular_values().iter().for_each(|value| _ = writeln!(values, "{value:e}"));
    found.keep_file("singular_values.csv", values.into_bytes());
    let terms = factors.terms();
    let sides = [
        ("view_factors", "g", factors.view_map(), ProductFactors::view_texel as fn(&ProductFactors, usize) -> &[f64]),
        ("light_factors", "f", factors.light_map(), ProductFactors::light_texel),
    ];
    for (name, letter, map, texel) in sides {
        let mut text = "x,y,z".to_owned();
        (1..=terms).for_each(|k| _ = write!(text, ",{letter}{k}"));
        text.push('\n');
        let mut numbers = Vec::with_capacity(map.texels() * terms);
        for at in 0..map.texels() {
            let DVec3 { x, y, z } = map.direction(at % map.side(), at / map.side());
            _ = write!(text, "{x:e},{y:e},{z:e}");
            texel(factors, at).iter().for_each(|value| _ = write!(text, ",{value:e}"));
            text.push('\n');
            numbers.extend(texel(factors, at).iter().map(|&value| value as f32));
        }
        found.keep_file(format!("{name}.csv"), text.into_bytes());
        let mut bytes = Vec::new();
        write_npy_array(&[map.texels(), terms], &numbers, &mut bytes).map_err(|reason| not_encoded("NPY", reason))?;
        found.keep_file(format!("{name}.npy"), bytes);
    }
    Ok(())
}
