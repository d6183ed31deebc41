//! Printed figures, and how near the models have to come.

use std::sync::LazyLock;

use crossbar::study::reproduce::report::{Reproduced, held};
use crossbar::study::reproduce::{ENTRIES, Judgement, Row, TOLERANCE, choose};

/// Worked out once.
static FOUND: LazyLock<Reproduced> = LazyLock::new(|| {
    ENTRIES.iter().map(|entry| (*entry, entry.reproduce().expect("an entry can be worked out"))).collect()
});

fn rows<'a>(found: &'a Reproduced, id: &str) -> Vec<&'a Row> {
    found.iter().filter(|(entry, _)| entry.id == id).flat_map(|(_, found)| &found.rows).collect()
}

/// Section 6.1, by the paper's own equation: to the digits.
#[test]
fn the_rates_give_every_printed_digit() {
    let judged: Vec<_> = rows(&FOUND, "equation-11").iter().map(|row| row.judge_rates()).collect();
    let (reproduced, calibrated) = (Judgement::Reproduced, Judgement::Calibrated);
    assert_eq!(judged, [reproduced, reproduced, calibrated, calibrated, reproduced, calibrated]);
}

/// No figure of the GeForce cards went into the pipeline model, so each has to come near by itself.
#[test]
fn the_pipeline_comes_near_what_it_never_saw() {
    for row in rows(&FOUND, "equation-11") {
        let model = row.pipeline.as_ref().expect("the pipeline has an opinion");
        assert_eq!(model.calibrated_on, None, "{}", row.what);
        let error = row.symmetric_error(model.value);
        assert!(
            error.abs() <= TOLERANCE,
            "{} on {}: {} is off by {:.1} %",
            row.what,
            row.device,
            model.value,
            100.0 * error
        );
    }
    let misses = FOUND.iter().flat_map(|(_, f)| &f.rows).filter(|row| row.judge_pipeline() == Judgement::Explained);
    assert!(misses.clone().all(|row| row.note.contains("To know more one would need")), "a miss says what to find out");
    assert_eq!(misses.count(), 3, "the vertex variant on three cards");
    assert!(held(&FOUND));
}

#[test]
fn charts_and_tables_are_not_empty() {
    for (entry, found) in FOUND.iter() {
        assert!(!found.text.is_empty(), "{}", entry.id);
        assert!(found.tables.iter().all(|table| !table.rows().is_empty()), "{}", entry.id);
        assert!(found.charts.iter().all(|chart| chart.chart.svg().is_ok()), "{}", entry.id);
    }
    assert_eq!(choose(&["figure-7".to_owned()]).expect("an entry").len(), 1);
    assert!(choose(&["figure-8".to_owned()]).is_err());
}
