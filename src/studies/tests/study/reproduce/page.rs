//! Sentences and counts at the top of the page.

use crossbar_studies::report::{SummaryLine, Verdict};
use crossbar_studies::study::reproduce::report::findings;
use crossbar_studies::study::reproduce::tested::summary_lines;
use crossbar_studies::study::reproduce::{
    ENTRIES, EntryFindings, PaperRow, ReproduceEntry, Reproduced, RowSource, RowVerdict,
};

use super::rows::row;

fn entry(id: &str) -> ReproduceEntry {
    *ENTRIES.iter().find(|entry| entry.id == id).expect("an entry")
}

fn found(values: &[(f64, RowSource)]) -> Reproduced {
    let mut rows: Vec<PaperRow> = values.iter().map(|(value, _)| row(*value)).collect();
    rows.iter_mut().zip(values).for_each(|(row, (_, source))| row.source = *source);
    vec![(entry("ray-engine-figure-7"), EntryFindings { rows, ..EntryFindings::default() })]
}

/// A missed figure is a finding; a value that differs from its record fails the command.
#[test]
fn only_a_difference_from_the_record_fails() {
    let missed = found(&[(20.0, RowSource::Computed), (30.0, RowSource::Confirmed)]);
    assert!(missed[0].1.rows.iter().all(|row| row.verdict() == RowVerdict::Missed));
    let differs = found(&[(15.6, RowSource::Differs { recorded: 15.5 })]);
    assert_eq!([&missed, &differs].map(|found| findings(found).verdict()), [Verdict::Done, Verdict::Failed]);
}

/// Sentences have the singular for one figure, and the plural for several.
#[test]
fn sentences_agree_with_their_numbers() {
    let of = |values: &[(f64, RowSource)]| findings(&found(values)).conclusions().join(" ");
    assert_eq!(
        of(&[(20.0, RowSource::Computed)]),
        "Of 1 figure not used for calibration, 1 is missed. Causes of misses: model lost 1."
    );
    assert_eq!(
        of(&[(15.6, RowSource::Confirmed), (15.7, RowSource::Recorded)]),
        "Of 2 figures not used for calibration, 2 are predicted within numerical bounds. Recorded at full size: 2; \
         recomputed with the same bits: 1."
    );
}

/// Values for which the verdict of `row` is predicted, and missed.
const HIT: f64 = 15.6;
const MISS: f64 = 20.0;

#[test]
fn a_line_counts_the_rows_of_its_paper_alone() {
    let with = |values: &[f64]| EntryFindings {
        rows: values.iter().map(|value| row(*value)).collect(),
        ..EntryFindings::default()
    };
    let found = vec![
        (entry("ray-engine-figure-7"), with(&[HIT, MISS, MISS])),
        (entry("ray-engine-equation-11"), with(&[HIT])),
        (entry("cpca-figure-2"), with(&[HIT])),
    ];
    let [engine, cpca] = &summary_lines(&found)[..] else { panic!("two papers have entries") };
    let count = |line: &SummaryLine, verdict: RowVerdict| {
        line.tally.iter().find(|counted| counted.what == verdict.to_string()).map(|counted| counted.count)
    };
    assert_eq!([RowVerdict::Predicted, RowVerdict::Missed].map(|of| count(engine, of)), [Some(2), Some(2)]);
    assert_eq!(engine.text, "Rows are missed in ray-engine-figure-7 (2 of 3).");
    assert_eq!(engine.heading, found[0].0.title);
    assert_eq!((count(cpca, RowVerdict::Missed), cpca.text.as_str()), (Some(0), "No row is missed."));
}
