//! Records of runs: they read back unchanged, and runs are compared with them.

use crossbar_studies::report::{Cell, Table};
use crossbar_studies::study::reproduce::tested::compared;
use crossbar_studies::study::reproduce::{
    Contradiction, Dependence, EntryFindings, EntryRecord, Method, PaperRow, RecordMade, RecordStatus, RowSource,
    printed,
};

const ENTRY: &str = "cpca-coherence";

/// Findings of every kind that a record stores: readings, a range, a contradiction.
fn found(value: f64) -> EntryFindings {
    let row = |id: &str, dependence| {
        PaperRow::new(("r300", Method::Pipeline), printed(id).expect("a figure"), (value, dependence))
            .expect("it is judged")
    };
    let contradiction = Contradiction::if_holds(true, "two rates of one signal");
    let on = Dependence::Calibrated { on: "this figure" };
    let rows = vec![
        row("cpca/rate-bird-rec", Dependence::Counted).with_readings([value, value / 3.0]),
        row("cpca/rate-bird-sc", Dependence::Predicted { from: "overdraw" }).contradicted(contradiction),
        row("cpca/rate-bird-both", on).confined([1.0, f64::INFINITY], "a tree"),
    ];
    let mut table = Table::of("Points", "points error");
    table.push(["10,000".into(), Cell::measured(value / 7.0).marked("*")]);
    let text = vec!["Of 10,000 points".to_owned()];
    EntryFindings { rows, text, tables: vec![table], questions: vec!["which?"], ..EntryFindings::default() }
}

/// The record of such findings, parsed as the program parses its records.
fn record(value: f64) -> &'static EntryRecord {
    let text = EntryRecord::new(ENTRY, &found(value), RecordMade::default()).text().expect("a file");
    Box::leak(Box::new(EntryRecord::parse(ENTRY, &text).expect("what was written")))
}

/// A record restores the findings of its run. Verdicts follow from bounds and are not in the file.
#[test]
fn records_round_trip() {
    let (full, judged) = (found(10.0), record(10.0).findings().expect("the figures"));
    let mut rows = judged.rows[judged.rows.len() - full.rows.len()..].to_vec();
    assert_eq!(
        rows.iter().map(PaperRow::verdict).collect::<Vec<_>>(),
        full.rows.iter().map(PaperRow::verdict).collect::<Vec<_>>()
    );
    assert!(rows.iter().all(|row| row.source == RowSource::Recorded));
    rows.iter_mut().for_each(|row| row.source = RowSource::Computed);
    assert_eq!(rows, full.rows);
    let words = |found: &EntryFindings| (found.text.clone(), found.questions.clone(), found.tables.clone());
    assert_eq!(words(&judged), words(&full));
}

#[test]
fn files_of_other_entries_and_without_cells_are_refused() {
    let text = EntryRecord::new(ENTRY, &found(10.0), RecordMade::default()).text().expect("a file");
    let refused = |entry, text: &str| EntryRecord::parse(entry, text).expect_err("refused");
    assert!(refused("cpca-figure-2", &text).contains("found the record of `cpca-coherence`"));
    assert!(refused(ENTRY, &text.replace("measured", "guessed")).contains("expected a cell"));
    assert!(refused(ENTRY, "").contains("missing field"));
}

#[test]
fn a_run_at_full_size_is_held_against_its_record() {
    let sources = |value: f64| compared(record(10.0), found(value)).rows.into_iter().map(|row| row.source);
    assert!(sources(10.0).all(|source| source == RowSource::Confirmed));
    assert!(sources(10.0_f64.next_up()).all(|source| source == RowSource::Differs { recorded: 10.0 }));
}

/// Cells of every kind, encoded as in a record, and decoded again.
#[test]
fn cells_read_back() {
    let cells: Vec<Cell> = vec![
        Cell::Empty,
        "a text, of words | and bars".into(),
        "".into(),
        7_u64.into(),
        (-7_i64).into(),
        true.into(),
        0.1.into(),
        Cell::decimals(-0.0, 3).marked("*"),
        Cell::measured(1.0 / 3.0),
        Cell::ratio(1e300).marked("(implied)"),
        Cell::percent(f64::INFINITY),
        Cell::error(5e-324),
        Cell::decimals(0.125, 2).marked("*"),
    ];
    let mut table = Table::of("Cells", "a b c d e f g h i j k l m");
    table.push(cells.clone());
    let found = EntryFindings { tables: vec![table], ..EntryFindings::default() };
    let text = EntryRecord::new(ENTRY, &found, RecordMade::default()).text().expect("a file");
    assert!(text.contains("\"decimals2 0.125 *\""), "{text}");
    let read: &EntryRecord = Box::leak(Box::new(EntryRecord::parse(ENTRY, &text).expect("what was written")));
    assert_eq!(read.findings().expect("the figures").tables[0].rows()[0], cells);
    for other in ["12", "counts 12", "count twelve", "decimals 1", "ratio 1 ?", "ratio"] {
        let error = EntryRecord::parse(ENTRY, &text.replace("decimals2 0.125 *", other)).expect_err(other);
        assert!(error.ends_with(&format!("expected a cell of a table, found `{other}`")), "{error}");
    }
}

/// The status sentence contains the numbers; a time that rounds to -0 is printed as 0.
#[test]
fn a_record_says_how_it_was_made() {
    let [command, version, commit] = ["crossbar reproduce", "1.0", "abc"].map(str::to_owned);
    let made = RecordMade { command, version, commit, processor_s: Some(1540.2), wall_s: -0.04 };
    let made: &RecordMade = Box::leak(Box::new(made));
    assert_eq!(
        RecordStatus::Recorded(made).sentence(),
        "Rows and tables are recorded: `crossbar reproduce`, version 1.0 (abc), 1,540 s of processor time and 0 s of \
         wall-clock time."
    );
}
