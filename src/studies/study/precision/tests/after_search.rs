//! Tests of the steps after a search: held-back input, traces, pictures of errors, runs for the next one.

use std::cell::Cell;
use std::fmt::Debug;

use super::*;

/// `1 + c1`, with the exact result as goal.
fn sum(c1: f64) -> String {
    case("mov r0, c0\nadd r0, r0, c1", &format!("c0 = [1, 1, 1, 1]\nc1 = [{c1}, {c1}, {c1}, {c1}]"))
}

fn setup(case: &str) -> Setup {
    Setup::from_bytes("other.toml", case.as_bytes(), Path::new("")).expect("a case")
}

fn holding_back(searched: &str, other: &str) -> Result<Precision, StudyError> {
    let subject =
        CaseSubject::new(setup(searched), "case").expect("it is drawn").holding_back(&setup(other), "other")?;
    let study = study(searched, "largest_absolute=0", &[FormatFamily::Float]);
    Ok(Precision { subject: Box::new(subject), ..study })
}

/// 1 + 2^-2 needs two mantissa bits, 1 + 2^-4 four.
#[test]
fn input_that_was_held_back_needs_so_many_bits_more() {
    for (other, spare) in [(0.25, Some(0)), (0.125, Some(1)), (0.0625, Some(2)), (1.0 / 512.0, None)] {
        let study = holding_back(&sum(0.25), &sum(other)).expect("the same program");
        with_outcome(&study, |outcome, _| {
            let family = &outcome.families[0];
            assert_eq!(family.curve.minimum.map(|minimum| minimum.digits), Some(2));
            // Without room for the sum it is rounded to 1 or to 1.25.
            let missed = family.held_back.expect("a case");
            assert_eq!((missed == 0.0, family.spare), (other == 0.25, spare), "{other}: {missed}");
        });
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
    with_outcome(&study, |outcome, runs| {
        let family = &outcome.families[0];
        let mixed = family.mixed.as_ref().expect("some");
        let missing = mixed.refuted.iter().filter(|refuted| refuted.worst.is_none()).count();
        assert_eq!((family.refutations.len(), missing), (mixed.refuted.len(), 0));
        let all = refutation_tables::all(&family.refutations, runs);
        let trace = refutation_tables::most_blamed(&family.refutations, family).expect("one");
        let table = refutation_tables::table("one".to_owned(), trace, runs);
        // Of the sum with one bit of mantissa: 1.25 is halfway between 1 and 1.5.
        let texts: Vec<Vec<String>> =
            table.rows().iter().map(|row| row.iter().map(|cell| cell.text()).collect()).collect();
        assert_eq!(texts.len(), 3 * 4, "three instructions of four components: {texts:?}");
        assert_eq!(texts[4][2..], ["add r0, r0, c1", "r", "1.25", "1.25", "1", "yes"]);
        assert_eq!(all.rows().len(), family.refutations.len() * texts.len());
    });
    let mut found = study.findings(&mut |_, _, _| {}).expect("it runs");
    let files = found.take_files(&Provenance::new("test")).expect("files");
    assert!(files.iter().any(|(name, _)| name == "traces_float.csv"), "{:?}", files.iter().map(|f| &f.0));
    assert!(files.iter().any(|(name, _)| name == "errors-float.png"));
}

/// Subject that counts its runs.
struct Counted {
    subject: CaseSubject,
    runs: Cell<u64>,
    /// Added to every value.
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

/// A longer search begins where the last ended, finds what one without it finds, and believes no value of another
/// subject or of a program that has changed.
#[test]
fn a_search_goes_on_where_the_last_ended() {
    let run = |case: &str, goal: &str, budget: u64, known: &KnownRuns, off: f64| {
        let subject = Counted { subject: CaseSubject::new(setup(case), "case").expect("drawn"), runs: 0.into(), off };
        let goal: Goal = goal.parse().expect("a goal");
        let mut progress = |_: &str, _, _| {};
        let study = Precision {
            subject: Box::new(CaseSubject::new(setup(case), "case").expect("drawn")),
            budget,
            ..study(case, "largest_codes<=1", &[FormatFamily::Float])
        };
        let mut runs = Runs::new(&subject, &goal, budget, known, &mut progress);
        let outcome = study.outcome(&mut runs).expect("it runs");
        let (made, json) = (runs.made, runs.known.to_json());
        let known: KnownRuns = serde_json::from_slice(&json).expect("its own file");
        let mixed = outcome.families[0].mixed.as_ref().map(|mixed| mixed.formats.clone());
        (subject.runs.get(), made, mixed, known)
    };
    let (case, goal) = (polynomial(), "largest_codes<=1");
    let none = KnownRuns::default();
    let (full_runs, full_made, full, _) = run(&case, goal, 10_000, &none, 0.0);
    let (some_runs, some_made, _, some) = run(&case, goal, 60, &none, 0.0);
    assert!(some_runs <= 60 && some_made == 60, "{some_runs} of {some_made}");
    let (runs, made, mixed, all) = run(&case, goal, 10_000, &some, 0.0);
    assert_eq!((made, &mixed), (full_made, &full));
    assert!(runs + 40 < full_runs && runs + some_runs >= full_runs, "{runs} of {full_runs} after {some_runs}");
    let (runs, made, mixed, _) = run(&case, goal, 10_000, &all, 0.0);
    assert_eq!((made, &mixed), (full_made, &full));
    // The runs of switches are on other devices and are made each time.
    assert!(runs < full_runs / 2, "{runs} of {full_runs}");
    // Other measures, other inputs and values that no longer hold.
    assert!(run(&case, "wrong_pixels<=0.1", 60, &all, 0.0).0 >= 59);
    assert!(run(&case.replace("0.7, 0.6", "0.6, 0.6"), goal, 60, &all, 0.0).0 >= 59);
    assert!(run(&case, goal, 60, &all, 0.25).0 >= 59);
}
