//! The long form: `CROSSBAR_FUZZ=1h` (or `30m`, or seconds) runs all suites in turn, with its own seeds, until the time
//! is up, and reports the number of comparisons.

use crate::agreement::{compare, report};
use crate::suite;
use std::io::Write as _;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Number of differences that are shrunk and printed; more are only counted.
const REPORTS: usize = 10;
/// The first seed, unless `CROSSBAR_SEED` names another. It is larger than all seeds of the suites, including
/// `CROSSBAR_FULL=1`.
const FIRST: u64 = 1 << 32;

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
    let [next, fragments] = [0, 0].map(AtomicU64::new);
    let faults = Mutex::new(Vec::new());
    // The first faults are shrunk and printed, the others are only counted.
    let fault = |told: &dyn Fn() -> String| {
        let mut faults = faults.lock().unwrap_or_else(PoisonError::into_inner);
        let text = if faults.len() < REPORTS { told() } else { String::new() };
        say(&text);
        faults.push(text);
    };
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    say(&format!("fuzzing {} suites for {text} on {workers} threads from seed {first}", suites.len()));
    let work = || {
        while Instant::now() < end {
            let n = next.fetch_add(1, Ordering::Relaxed);
            let (suite, seed) = (&suites[(n % suites.len() as u64) as usize], first + n / suites.len() as u64);
            match compare(&suite.case(seed), suite.turn(seed)) {
                Ok((drawn, differences)) => {
                    fragments.fetch_add(drawn.fragments(), Ordering::Relaxed);
                    differences.first().into_iter().for_each(|first| fault(&|| report(suite, seed, first)));
                }
                Err(why) => fault(&|| format!("seed {seed} of {} is no legal case: {why}", suite.name)),
            }
        }
    };
    std::thread::scope(|scope| (0..workers).for_each(|_| drop(scope.spawn(work))));
    say(&format!("compared {} cases of {} fragments", next.into_inner(), fragments.into_inner()));
    let faults = faults.into_inner().unwrap_or_else(PoisonError::into_inner);
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// Writes to standard error directly, because the test harness would withhold the text until the end.
fn say(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
