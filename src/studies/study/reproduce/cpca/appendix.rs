//! Section 9, and the related part of section 3.2: hemispherical projections.

use super::{EntryFindings, HOST, RunResult, Shared, StudyError, equation};
use crate::sphere::{Hemisphere, HemisphereProjection, ProjectionErrors, function_count, function_index};

/// Order of the projected functions.
const ORDER: usize = 5;

use HemisphereProjection::{EvenReflection, OddReflection, ZeroHemisphere};

/// Prefixes of figures' names, projections, and orders of their targets.
const PROJECTIONS: [(&str, HemisphereProjection, usize); 4] = [
    ("zero", ZeroHemisphere, 5),
    ("odd-8", OddReflection, 8),
    ("even-7", EvenReflection, 7),
    ("even-5", EvenReflection, 5),
];
const HOW: &str = "The Gram matrix of the harmonics over the hemisphere, its spectrum and the errors of projections are computed in f64. Odd and \
    even reflection follow the paper's formulas; its words in parentheses are swapped. Errors are squared errors over the hemisphere, of functions \
    whose square integrates to one over the sphere; section 3.2 prints the square roots of two of these errors.";

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
    for (id, projection, order) in PROJECTIONS {
        let ProjectionErrors { worst, average } = projection.error(ORDER, order).on(HOST)?;
        let row = |what: &str, ours: f64| equation(&format!("{id}-{what}"), ours);
        rows.extend([row("worst", worst)?, row("average", average)?]);
        if projection == ZeroHemisphere {
            let percent = |error: f64| 100.0 * error.sqrt();
            rows.extend([row("worst-rms", percent(worst))?, row("average-rms", percent(average))?]);
        } else {
            let functions = (0..function_count(order)).filter(|&index| projection.uses(order, index)).count();
            rows.push(row("functions", functions as f64)?);
        }
    }
    Ok(EntryFindings::new([HOW.into()], rows, [], []))
}
