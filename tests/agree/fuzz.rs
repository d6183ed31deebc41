//! The long form: `CROSSBAR_FUZZ=1h` (or `30m`, or seconds) runs all suites in turn, with its own seeds, until the time
//! is up, and reports the number of comparisons.

use crate::agreement::{compare, report};
use crate::executors::EXECUTORS;
use crate::suite::{self, Suite};
use std::io::Write as _;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Number of differences that are shrunk and printed; more are only counted.
const REPORTS: usize = 10;
/// The first seed, unless `CROSSBAR_SEED` names another. It is larger than all seeds of the suites, including
/// `CROSSBAR_FULL=1`.
const FIRST: u64 = 1 << 32;

/// Counts and reports of a run.
#[derive(Default)]
struct Counts {
    cases: u64,
    draws: u64,
    fragments: u64,
    /// Per executor: draws, fragments, cases that differ.
    executors: Vec<(u64, u64, u64)>,
    reports: Vec<String>,
    illegal: Vec<String>,
}

/// `90`, `90s`, `30m` or `1h`.
fn duration(text: &str) -> Option<Duration> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = match &text[digits.len()..] {
        "" | "s" => 1,
        "m" => 60,
        "h" => 3600,
        _ => return None,
    };
    Some(Duration::from_secs(digits.parse::<u64>().ok()?.checked_mul(unit)?))
}

pub(crate) fn fuzz() {
    let Ok(text) = std::env::var("CROSSBAR_FUZZ") else { return };
    let time = duration(&text).unwrap_or_else(|| panic!("CROSSBAR_FUZZ is `90`, `30m` or `1h`, found `{text}`"));
    let first = std::env::var("CROSSBAR_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(FIRST);
    let (suites, end) = (suite::all(), Instant::now() + time);
    let counts = Mutex::new(Counts { executors: vec![(0, 0, 0); EXECUTORS.len()], ..Counts::default() });
    let next = AtomicU64::new(0);
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    say(&format!("fuzzing {} suites for {text} on {workers} threads from seed {first}", suites.len()));
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                while Instant::now() < end {
                    let n = next.fetch_add(1, Ordering::Relaxed);
                    let suite = &suites[(n % suites.len() as u64) as usize];
                    one(suite, first + n / suites.len() as u64, &counts);
                }
            });
        }
    });
    let counts = counts.into_inner().unwrap_or_else(PoisonError::into_inner);
    say(&summary(&counts));
    assert!(counts.illegal.is_empty(), "cases that are not legal:\n{}", counts.illegal.join("\n"));
    let found: u64 = counts.executors.iter().map(|e| e.2).sum();
    assert_eq!(found, 0, "{}", counts.reports.join("\n\n"));
}

/// Compares one case.
fn one(suite: &Suite, seed: u64, counts: &Mutex<Counts>) {
    let case = suite.case(seed);
    let turn = suite.turn(seed);
    let result = compare(&case, turn);
    let mut counts = counts.lock().unwrap_or_else(PoisonError::into_inner);
    let (drawn, differences) = match result {
        Ok(compared) => compared,
        Err(why) => {
            counts.illegal.push(format!("seed {seed} of {}: {why}", suite.name));
            return;
        }
    };
    let (draws, fragments) = (drawn.events.len() as u64, drawn.fragments());
    counts.cases += 1;
    counts.draws += draws;
    counts.fragments += fragments;
    for (entry, executor) in counts.executors.iter_mut().zip(EXECUTORS.iter()) {
        if executor.draws(turn) {
            entry.0 += draws;
            entry.1 += fragments;
        }
    }
    for difference in &differences {
        counts.executors[difference.executor].2 += 1;
    }
    if let Some(first) = differences.first()
        && counts.reports.len() < REPORTS
    {
        let text = report(suite, seed, first);
        say(&text);
        counts.reports.push(text);
    }
}

fn summary(counts: &Counts) -> String {
    let mut text = format!(
        "compared {} programs in {} draws of {} fragments\nexecutor            draws   fragments  cases that differ",
        counts.cases, counts.draws, counts.fragments
    );
    for (executor, (draws, fragments, differ)) in EXECUTORS.iter().zip(&counts.executors) {
        text.push_str(&format!("\n{:16} {draws:8} {fragments:11} {differ:18}", executor.name));
    }
    text
}

/// Writes to standard error directly, because the test harness would withhold the text until the end.
fn say(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
