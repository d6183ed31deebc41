//! Section 9 and the related part of section 3.2: hemispherical projections.

use super::{EntryFindings, HOST, PaperRow, ReproduceError, every_digit, failed};
use crate::report::{Cell, Table};
use crate::sphere::{Hemisphere, HemisphereProjection, ProjectionErrors, function_count, function_index};

/// Order of the projected functions.
const ORDER: usize = 5;

/// Projection with its target order, and the printed values: functions with a coefficient, worst and average error with
/// their digits.
struct Printed {
    name: &'static str,
    projection: HemisphereProjection,
    order: usize,
    functions: Option<f64>,
    worst: (f64, u8),
    average: (f64, u8),
}

use HemisphereProjection::{EvenReflection, OddReflection, ZeroHemisphere};

const PRINTED: [Printed; 4] = [
    Printed {
        name: "zero hemisphere",
        projection: ZeroHemisphere,
        order: 5,
        functions: None,
        worst: (0.125, 3),
        average: (0.0402, 4),
    },
    Printed {
        name: "odd reflection, order 8",
        projection: OddReflection,
        order: 8,
        functions: Some(28.0),
        worst: (0.145, 3),
        average: (0.044, 3),
    },
    Printed {
        name: "even reflection, order 7",
        projection: EvenReflection,
        order: 7,
        functions: Some(28.0),
        worst: (0.022, 3),
        average: (0.0036, 4),
    },
    Printed {
        name: "even reflection, order 5",
        projection: EvenReflection,
        order: 5,
        functions: Some(15.0),
        worst: (0.193, 3),
        average: (0.030, 3),
    },
];

const HOW: &str = "The Gram matrix of the harmonics over the hemisphere, its spectrum and the errors of projections in f64. Odd and even reflection are \
    taken by their formulas: the words in the paper's parentheses are exchanged. Errors are squared, over the hemisphere, of functions whose square \
    integrates to one over the sphere; section 3.2 prints the roots of two of them.";

pub(in crate::study::reproduce) fn findings() -> Result<EntryFindings, ReproduceError> {
    let hemisphere = Hemisphere::new(ORDER);
    let values = &hemisphere.spectrum().values;
    let [largest, second, least] = [values[0], values[values.len() - 2], values[values.len() - 1]];
    let cost = hemisphere.drop_costs()[function_index(1, 0)];
    let number = |what: &str, printed: f64, decimals: u8, ours: f64| -> PaperRow {
        every_digit(what, (printed, decimals, "-"), "section 9.1", ours)
    };
    let mut rows = vec![
        number("smallest singular value of A", 6.59e-6, 8, least),
        number("second smallest singular value of A", 3.10e-4, 6, second),
        number("largest singular value of A", 1.0, 0, largest),
        number("squared error without (l, m) = (1, 0)", 1.48e-5, 7, cost),
    ];
    for printed in &PRINTED {
        rows.extend(projection_rows(printed)?);
    }
    Ok(EntryFindings { text: vec![HOW.into()], rows, tables: vec![orders()?], ..EntryFindings::default() })
}

fn error(projection: HemisphereProjection, [signal, order]: [usize; 2]) -> Result<ProjectionErrors, ReproduceError> {
    projection.error(signal, order).map_err(|e| failed(HOST)(&e))
}

fn projection_rows(printed: &Printed) -> Result<Vec<PaperRow>, ReproduceError> {
    let Printed { name, projection, order, .. } = *printed;
    let ProjectionErrors { worst, average } = error(projection, [ORDER, order])?;
    let row = |what: &str, (value, decimals): (f64, u8), ours: f64| {
        every_digit(format!("{name}: {what} error"), (value, decimals, "-"), "section 9.2", ours)
    };
    let mut rows = vec![row("worst", printed.worst, worst), row("average", printed.average, average)];
    if let Some(functions) = printed.functions {
        let ours = (0..function_count(order)).filter(|&index| projection.uses(order, index)).count() as f64;
        rows.push(every_digit(format!("{name}: functions"), (functions, 0, "functions"), "section 9.2", ours));
    } else {
        let root = |what: &str, percent: f64, ours: f64| {
            every_digit(format!("{name}: {what} RMS error"), (percent, 0, "%"), "section 3.2", 100.0 * ours.sqrt())
        };
        rows.extend([root("worst", 35.0, worst), root("average", 20.0, average)]);
    }
    Ok(rows)
}

/// Table for other orders, with functions of an order projected to the same order.
fn orders() -> Result<Table, ReproduceError> {
    let mut table = Table::of(
        "Projections of functions of an order onto the same order, and what the cheapest function to drop costs",
        "order functions zero_worst zero_average odd_worst odd_average even_worst even_average drop_cost",
    );
    for order in 2..=8 {
        let mut cells: Vec<Cell> = vec![order.into(), function_count(order).into()];
        for projection in [ZeroHemisphere, OddReflection, EvenReflection] {
            let ProjectionErrors { worst, average } = error(projection, [order, order])?;
            cells.extend([worst, average].map(Cell::measured));
        }
        let costs = Hemisphere::new(order).drop_costs();
        cells.push(Cell::measured(costs.into_iter().fold(f64::INFINITY, f64::min)));
        table.push(cells);
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A literal reading of "odd" and "even" in the text would give other values.
    #[test]
    fn odd_and_even_are_told_apart() {
        let literal = error(EvenReflection, [ORDER, 8]).expect("errors");
        let printed = PRINTED.iter().find(|printed| printed.projection == OddReflection).expect("odd reflection");
        assert!(literal.worst < printed.worst.0 / 10.0 && literal.average < printed.average.0 / 10.0);
    }
}
