//! Section 9, and the related part of section 3.2: hemispherical projections.

use super::{EntryFindings, HOST, PaperRow, RunResult, Shared, StudyError, equation};
use crate::sphere::{Hemisphere, HemisphereProjection, ProjectionErrors, function_count, function_index};

/// Order of the projected functions.
const ORDER: usize = 5;

/// Projection with its target order; `id` is the prefix of its figures' names.
struct Projected {
    id: &'static str,
    projection: HemisphereProjection,
    order: usize,
}

use HemisphereProjection::{EvenReflection, OddReflection, ZeroHemisphere};

const PROJECTIONS: [Projected; 4] = [
    Projected { id: "zero", projection: ZeroHemisphere, order: 5 },
    Projected { id: "odd-8", projection: OddReflection, order: 8 },
    Projected { id: "even-7", projection: EvenReflection, order: 7 },
    Projected { id: "even-5", projection: EvenReflection, order: 5 },
];

const HOW: &str = "The Gram matrix of the harmonics over the hemisphere, its spectrum and the errors of projections are computed in f64. Odd and \
    even reflection follow the formulas: the paper's words in parentheses are swapped. Errors are squared errors over the hemisphere, of functions \
    whose square integrates to one over the sphere; section 3.2 prints the square roots of two of them.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let hemisphere = Hemisphere::new(ORDER);
    let values = &hemisphere.spectrum().values;
    let [largest, second, least] = [values[0], values[values.len() - 2], values[values.len() - 1]];
    let cost = hemisphere.drop_costs()[function_index(1, 0)];
    let mut rows = vec![
        equation("singular-least", least)?,
        equation("singular-second", second)?,
        equation("singular-largest", largest)?,
        equation("dropped", cost)?,
    ];
    for projected in &PROJECTIONS {
        rows.extend(projection_rows(projected)?);
    }
    Ok(EntryFindings::new([HOW.into()], rows, [], []))
}

fn error(projection: HemisphereProjection, [signal, order]: [usize; 2]) -> Result<ProjectionErrors, StudyError> {
    projection.error(signal, order).on(HOST)
}

fn projection_rows(&Projected { id, projection, order }: &Projected) -> Result<Vec<PaperRow>, StudyError> {
    let ProjectionErrors { worst, average } = error(projection, [ORDER, order])?;
    let row = |what: &str, ours: f64| equation(&format!("{id}-{what}"), ours);
    let mut rows = vec![row("worst", worst)?, row("average", average)?];
    if projection == ZeroHemisphere {
        let percent = |error: f64| 100.0 * error.sqrt();
        rows.extend([row("worst-rms", percent(worst))?, row("average-rms", percent(average))?]);
    } else {
        let functions = (0..function_count(order)).filter(|&index| projection.uses(order, index)).count();
        rows.push(row("functions", functions as f64)?);
    }
    Ok(rows)
}
