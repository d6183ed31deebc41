//! Figure 2: the number of terms.

use super::{EntryFindings, StudyError, models, solved};
use crate::report::{Cell, Table};

const TERMS: [usize; 7] = [1, 2, 4, 6, 8, 10, 16];

const HOW: &str = "Figure 2 shows Cook-Torrance reflectance with more and more terms: in the textbook form, and as the \
    facet distribution alone, which is nearest to the errors of section 3.";

pub(super) fn figure() -> Result<EntryFindings, StudyError> {
    let mut table = Table::of("Figure 2: error by terms", "form terms relative_squared_error");
    let mut falls = Vec::new();
    for (form, lobe) in models::cook_torrance() {
        let factorization = models::factorization(&lobe, TERMS[TERMS.len() - 1])?;
        let error = |terms: usize| factorization.relative_squared_error(terms);
        TERMS.into_iter().for_each(|terms| table.push([form.into(), terms.into(), Cell::measured(error(terms))]));
        falls.push(error(1) / error(10));
    }
    let row = solved("one-term-over-ten", falls[0])?.with_readings(falls[1..].iter().copied());
    let row = row.confined([1.0, f64::INFINITY], "each term removes the square of its singular value from the error");
    Ok(EntryFindings::new([HOW.to_owned()], [row], [], [table]))
}
