//! Tests of the steps after a search: held-back input, traces, pictures of errors, and known runs for the next search.

use std::cell::Cell;
use std::fmt::Debug;
use std::fs;
use std::rc::Rc;

use crossbar_studies::report::Provenance;
use crossbar_studies::study::StudyError;
use crossbar_studies::study::precision::{Goal, Measured, PrecisionMeasure, StudiedProgram};

use super::*;

/// Case that computes `1 + c1`; its goal is the exact result.
fn sum(c1: f64) -> String {
    case("mov r0, c0\nadd r0, r0, c1", &format!("c0 = [1, 1, 1, 1]\nc1 = [{c1}, {c1}, {c1}, {c1}]"))
}

fn holding_back(searched: &str, other: &str) -> Result<Precision, StudyError> {
    let subject = subject(searched).holding_back(&setup(other), "other")?;
    Ok(study_of(Box::new(subject), "largest_absolute=0", &[FormatFamily::Float]))
}

/// 1 + 2^-2 needs two mantissa bits, 1 + 2^-4 needs four.
#[test]
fn input_that_was_held_back_needs_so_many_bits_more() {
    for (other, spare) in [(0.25, Some(0)), (0.125, Some(1)), (0.0625, Some(2)), (1.0 / 512.0, None)] {
        let document = document(&holding_back(&sum(0.25), &sum(other)).expect("the same program"));
        let family = &document["families"][0];
        assert_eq!(digits(&family["minimum"]), Some(2));
        // With too few bits, the sum is rounded to 1 or to 1.25.
        let missed = family["held_back"].as_f64().expect("a case");
        assert_eq!((missed == 0.0, family["spare"].as_u64()), (other == 0.25, spare), "{other}: {missed}");
    }
    let other = holding_back(&sum(0.25), &case("mov r0, c0\nsub r0, r0, c1", "c0 = [1, 1, 1, 1]\nc1 = [1, 1, 1, 1]"));
    let message = other.err().expect("another program").to_string();
    assert_eq!(message, "other: expected a case with the same pixel program, found another program");
    let other = holding_back(&sum(0.25).replace("rgba32f", "rgba8"), &sum(0.25));
    let message = other.err().expect("no codes").to_string();
    assert_eq!(message, "other: expected a case with the measure `largest_codes`, found none");
}

#[test]
fn a_refutation_has_its_trace() {
    let study = study(&sum(0.25), "largest_absolute=0", &[FormatFamily::Float]);
    let document = document(&study);
    let places = column(&document, "refuted_float", "largest_error_at_column_row");
    assert!(!places.is_empty() && places.iter().all(|place| place.is_string()), "{document}");
    let files = StudyFiles::of(&study);
    let rows = files.rows("traces_float.csv");
    assert_eq!(rows.len(), places.len() * 3 * 4, "three instructions of four components");
    // The sum with one mantissa bit: 1.25 is halfway between 1 and 1.5.
    let refuted = texts(&document, "refuted_float", "line");
    let sum = &rows[rows.iter().position(|row| row["refuted_line"] == refuted[0]).expect("a trace") + 4];
    let cells = ["instruction", "component", "exact", "mixed", "one_bit_less", "one_bit_less_differs"];
    assert_eq!(cells.map(|key| &*sum[key]), ["add r0, r0, c1", "r", "1.25", "1.25", "1", "yes"]);
    let page = std::str::from_utf8(files.bytes("index.html")).expect("text");
    assert!(page.contains("with line") && page.contains("The refutation of the instruction most to blame"));
    assert!(!files.bytes("errors-float.png").is_empty());
}

/// Subject that counts its runs.
struct Counted {
    subject: CaseSubject,
    runs: Rc<Cell<u64>>,
    /// Offset added to every value.
    off: f64,
}

impl PrecisionSubject for Counted {
    fn title(&self) -> String {
        self.subject.title()
    }

    fn profile(&self) -> &Profile {
        self.subject.profile()
    }

    fn programs(&self) -> Vec<StudiedProgram<'_>> {
        self.subject.programs()
    }

    fn measures(&self) -> &[PrecisionMeasure] {
        self.subject.measures()
    }

    fn default_goal(&self) -> Goal {
        self.subject.default_goal()
    }

    fn content(&self) -> &dyn Debug {
        self.subject.content()
    }

    fn measure(&self, profile: &Profile, executor: ExecutorKind, wanted: Option<&str>) -> Result<Measured, StudyError> {
        self.runs.set(self.runs.get() + u64::from(wanted.is_some()));
        let mut measured = self.subject.measure(profile, executor, wanted)?;
        measured.values.iter_mut().for_each(|(_, value)| *value += self.off);
        Ok(measured)
    }
}

/// A longer search continues where the last one ended, finds the same result as a search without known runs, and uses
/// no value of another subject or of a changed program.
#[test]
fn a_search_goes_on_where_the_last_ended() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |case: &str, goal: &str, budget: u64, known: Option<&[u8]>, off: f64| {
        let file = folder.path().join("runs.json");
        known.map_or_else(|| fs::write(&file, ""), |known| fs::write(&file, known)).expect("a file");
        let runs = Rc::new(Cell::new(0));
        let counted = Counted { subject: subject(case), runs: Rc::clone(&runs), off };
        let study = study_of(Box::new(counted), goal, &[FormatFamily::Float]);
        let study = Precision { budget, known: KnownRuns::of_folder(folder.path()), ..study };
        let mut found = findings(&study);
        let document = found.plain_document();
        let files = found.take_files(&Provenance::new("test")).expect("files");
        let (_, json) = files.into_iter().find(|(name, _)| name == "runs.json").expect("its own file");
        let mixed = document["mixed_float"].as_array().map(|_| texts(&document, "mixed_float", "format"));
        (runs.get(), document["runs"].as_u64().expect("a count"), mixed, json)
    };
    let (case, goal) = (polynomial(), "largest_codes<=1");
    let (full_runs, full_made, full, _) = run(&case, goal, 10_000, None, 0.0);
    let (some_runs, some_made, _, some) = run(&case, goal, 60, None, 0.0);
    assert!(some_runs <= 60 && some_made == 60, "{some_runs} of {some_made}");
    let (runs, made, mixed, all) = run(&case, goal, 10_000, Some(&some), 0.0);
    assert!(mixed.is_some());
    assert_eq!((made, &mixed), (full_made, &full));
    assert!(runs + 40 < full_runs && runs + some_runs >= full_runs, "{runs} of {full_runs} after {some_runs}");
    let (runs, made, mixed, _) = run(&case, goal, 10_000, Some(&all), 0.0);
    assert_eq!((made, &mixed), (full_made, &full));
    // Runs for switches are on other devices, so they are made each time.
    assert!(runs < full_runs / 2, "{runs} of {full_runs}");
    // Different measures, different inputs, and values that no longer hold.
    assert!(run(&case, "wrong_pixels<=0.1", 60, Some(&all), 0.0).0 >= 59);
    assert!(run(&case.replace("0.7, 0.6", "0.6, 0.6"), goal, 60, Some(&all), 0.0).0 >= 59);
    assert!(run(&case, goal, 60, Some(&all), 0.25).0 >= 59);
}
