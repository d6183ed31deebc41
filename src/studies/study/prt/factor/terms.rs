//! Errors by number of terms.

use crate::all_frequency::factor::{DiscSamples, Factorization, ProductErrors};
use crate::report::{Cell, Chart, NamedChart, Scale, Series, Table};

/// Every number of terms up to this one has a row.
const EACH: usize = 20;

/// The errors of the product with a number of terms.
pub(super) struct TermErrors {
    pub(super) terms: usize,
    pub(super) errors: ProductErrors,
}

/// Errors for each number of terms up to 20, and for all available vectors.
pub(super) fn by_terms(disc: &DiscSamples, found: &Factorization) -> Vec<TermErrors> {
    let terms = found.terms();
    let each = (1..=terms.min(EACH)).chain((terms > EACH).then_some(terms));
    each.map(|terms| TermErrors { terms, errors: disc.errors(&found.factors(terms)) }).collect()
}

pub(super) fn table(rows: &[TermErrors], found: &Factorization) -> Table {
    let mut table = Table::of(
        "Errors by terms, over pairs of texels above the horizon",
        "terms singular_value relative_squared_error rms max least below_0_% splits_a_pair",
    );
    for TermErrors { terms, errors } in rows {
        table.push([
            (*terms).into(),
            Cell::measured(found.singular_values()[terms - 1]),
            Cell::error(found.relative_squared_error(*terms)),
            Cell::error(errors.rms),
            Cell::error(errors.max),
            Cell::measured(errors.least),
            Cell::percent(100.0 * errors.negative),
            found.split_pair(*terms).is_some().into(),
        ]);
    }
    table
}

/// Charts of the singular values, and of the error of Figure 2 by number of terms.
pub(super) fn charts(found: &Factorization) -> Vec<NamedChart> {
    let value = |(k, &value): (usize, &f64)| ((k + 1) as f64, value);
    let values: Vec<(f64, f64)> = found.singular_values()[..found.rank()].iter().enumerate().map(value).collect();
    let most = found.rank().min(64);
    let errors: Vec<(f64, f64)> =
        (1..=most).map(|terms| (terms as f64, found.relative_squared_error(terms))).filter(|at| at.1 > 1e-30).collect();
    let of = |name: &str, title: &str, y: &str, points: Vec<(f64, f64)>, caption: &str| {
        let line = Series { label: "ours".to_owned(), points };
        let chart = Chart {
            title: title.to_owned(),
            x: "terms".to_owned(),
            y: y.to_owned(),
            y_scale: Scale::Logarithmic,
            lines: vec![line],
            ..Chart::default()
        };
        NamedChart { name: name.to_owned(), chart, caption: caption.to_owned() }
    };
    [
        of(
            "spectrum",
            "Singular values",
            "singular value",
            values,
            "All singular values that can be distinguished from 0.",
        ),
        of(
            "error",
            "Error by terms",
            "relative squared error",
            errors,
            "The sum of squared differences by the sum of squares over all pairs of texels, as in Figure 2.",
        ),
    ]
    .into_iter()
    .filter(|chart| chart.chart.lines[0].points.len() > 1)
    .collect()
}
