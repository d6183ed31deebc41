//! Figure 3: ten terms of Cook and Torrance's model by roughness.

use super::forms::{TERMS, bare, centers};
use super::{HOST, PaperRow, RunResult, StudyError, solved};
use crate::all_frequency::factor::{DiscSamples, FactorSampling, Lobe};
use crate::report::Table;
use crate::study::prt::{BrdfFactors, FactorSubject, SweptRoughness, roughness_table};

const ROUGHNESSES: [f64; 5] = [0.2, 0.25, 0.3, 0.4, 0.5];
/// Mean FLIP error of spheres above which their difference counts as visible; we chose it before we computed any error.
const SEEN: f64 = 0.05;

pub(super) struct Figure3 {
    pub(super) row: PaperRow,
    pub(super) tables: Vec<Table>,
    /// Number of texels of a map above the horizon.
    pub(super) inside: usize,
}

pub(super) fn sweep() -> Result<Figure3, StudyError> {
    let lobe = Lobe::cook_torrance(0.4, 0.5);
    let textbook = swept("normalised", lobe)?;
    let bare = swept("distribution alone", bare(lobe))?;
    let row = solved("roughness", threshold(&textbook.1))?;
    let table = centers().table(&lobe, &mut |_, _| ()).on(HOST)?;
    let [inside, _] = DiscSamples::new(&table).counts();
    Ok(Figure3 { row, tables: vec![textbook.0, bare.0], inside })
}

fn swept(form: &str, lobe: Lobe) -> Result<(Table, Vec<SweptRoughness>), StudyError> {
    let study = BrdfFactors {
        name: form.to_owned(),
        subject: FactorSubject::Lobe(lobe),
        sampling: FactorSampling::default(),
        terms: Some(TERMS),
    };
    let rows = study.sweep(&ROUGHNESSES).on(HOST)?;
    let table = roughness_table(&rows, &format!("Errors of {TERMS} terms by roughness, {form}"));
    Ok((table, rows))
}

/// Largest roughness at which the difference is visible, interpolated linearly between two roughnesses of the sweep; 0
/// if it is visible at no roughness.
fn threshold(rows: &[SweptRoughness]) -> f64 {
    let Some(last) = rows.iter().rposition(|row| row.flip > SEEN) else { return 0.0 };
    let Some(next) = rows.get(last + 1) else { return rows[last].roughness };
    let row = &rows[last];
    row.roughness + (next.roughness - row.roughness) * (row.flip - SEEN) / (row.flip - next.flip)
}
