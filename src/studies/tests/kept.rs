//! Results that are kept while long work runs.

use std::cell::Cell;
use std::fs;
use std::rc::Rc;

use crossbar_base::error::InputError;
use crossbar_studies::kept::{KeptResults, KeptWork, SpentTime};
use crossbar_studies::study::reproduce::tested::bunny_in_pieces;

fn work(program: &str, entry: &str) -> KeptWork {
    KeptWork::new(program, format!("crossbar reproduce {entry}"), &[]).expect("no inputs")
}

thread_local!(static NOW: Cell<f64> = const { Cell::new(0.0) });

fn clock() -> SpentTime {
    SpentTime { processor_s: Some(2.0 * NOW.get()), wall_s: NOW.get() }
}

/// A result read back from the folder is bit-identical to the computed one, and each result is computed only once.
#[test]
fn work_that_was_stopped_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept = |program, entry| KeptResults::new(folder.path().join("kept"), work(program, entry), clock);
    let computed = Cell::new(0);
    let get = |kept: &KeptResults, name: &str| {
        kept.get(name, || {
            computed.set(computed.get() + 1);
            Ok::<_, InputError>((computed.get(), [-0.0, f64::from_bits(1), 0.1_f64]))
        })
    };
    let first = get(&kept("1", "a"), "one").expect("computed");
    let again = get(&kept("1", "a"), "one").expect("kept");
    assert_eq!((first.0, again.0, again.1.map(f64::to_bits)), (1, 1, first.1.map(f64::to_bits)));
    assert_eq!(get(&kept("1", "a"), "two").expect("computed").0, 2);
    fs::write(folder.path().join("kept/other"), "a file of its own").expect("written");
    kept("1", "a").require_no_other_work().expect("work of its own");
    for (program, entry) in [("1", "b"), ("2", "a")] {
        let refused = kept(program, entry).require_no_other_work().expect_err("other work").to_string();
        assert!(refused.contains("/one.kept: expected a result of\n"), "{refused}");
        let [expected, found] = match program {
            "2" => ["crossbar 2", "crossbar 1"],
            _ => ["crossbar reproduce b", "crossbar reproduce a"],
        };
        assert!(refused.ends_with(&format!("\n{expected}\nfound a result of\n{found}")), "{refused}");
        let before = computed.get();
        assert_eq!(get(&kept(program, entry), "one").expect("computed").0, before + 1, "of other work");
    }
    let none = || InputError::new("", "no result");
    let failed = kept("1", "a").get::<u8, _>("three", || Err(none()));
    assert!(failed == Err(none()) && !folder.path().join("kept/three.kept").exists());
    kept("1", "a").remove().expect("removed");
    assert!(!folder.path().join("kept").exists());
    kept("1", "a").remove().expect("nothing to remove");
}

/// The time of a continued run includes the time of each earlier run until its last result, once.
#[test]
fn time_is_that_of_all_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    let open = || KeptResults::new(folder.path().to_owned(), work("1", "a"), clock);
    let spend = |kept: &KeptResults, name: &str, seconds: f64| {
        let compute = || {
            NOW.set(NOW.get() + seconds);
            Ok::<_, InputError>(0)
        };
        kept.get(name, compute).expect("a result");
    };
    NOW.set(1000.0);
    let first = open();
    spend(&first, "one", 10.0);
    spend(&first, "two", 5.0);
    assert_eq!(first.spent(), SpentTime { processor_s: Some(30.0), wall_s: 15.0 });
    // The run stops in the middle of the third result.
    NOW.set(5000.0);
    let second = open();
    for name in ["one", "two", "three"] {
        spend(&second, name, 7.0);
    }
    assert_eq!(second.spent(), SpentTime { processor_s: Some(44.0), wall_s: 22.0 });
}

#[test]
fn a_damaged_result_is_computed_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept = KeptResults::new(folder.path().to_owned(), work("1", "a"), clock);
    let get = |result: u32| kept.get("one", || Ok::<_, InputError>(result)).expect("a result");
    assert_eq!([get(7), get(8)], [7, 7]);
    let path = folder.path().join("one.kept");
    let whole = fs::read(&path).expect("a file");
    for damaged in [whole[..whole.len() - 1].to_vec(), b"nothing".to_vec(), Vec::new()] {
        fs::write(&path, damaged).expect("written");
        assert_eq!([get(9), get(8)], [9, 9]);
        fs::write(&path, &whole).expect("written");
        assert_eq!(get(8), 7);
    }
    // A result of another type.
    assert_eq!(kept.get("one", || Ok::<_, InputError>(String::from("anew"))).expect("a result"), "anew");
}

/// A run that reuses another run's segments, or its model, gives the same result as a run that stores no pieces.
#[test]
fn pieces_make_the_same_model() {
    let folder = tempfile::tempdir().expect("a folder");
    let kept = || Some(Rc::new(KeptResults::new(folder.path().to_owned(), work("1", "a"), SpentTime::default)));
    let [without, first, taken] = [None, kept(), kept()].map(|kept| bunny_in_pieces(kept).expect("compressed"));
    assert_eq!((&first.0, &taken.0), (&without.0, &without.0), "computed and kept, and taken");
    assert_eq!([first.1, taken.1], [true, false], "a model that is taken needs no visibility");
    // The run stops before the last segment.
    let path = |piece: &str| folder.path().join(format!("{piece}.kept"));
    for piece in ["bunny", "bunny-segment-21"] {
        fs::remove_file(path(piece)).expect("a piece");
    }
    let written = || fs::metadata(path("bunny-segment-00")).and_then(|file| file.modified()).expect("a piece");
    let before = written();
    assert_eq!(bunny_in_pieces(kept()).expect("compressed").0, without.0, "gone on");
    assert_eq!(written(), before, "taken, and not written again");
}
