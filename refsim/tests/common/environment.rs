//! Environment variables that select tests with more cases.
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

use std::env;
use std::ops::Range;

/// Returns `true` if `CROSSBAR_FULL` is set: tests cover their whole ranges.
pub(crate) fn is_full() -> bool {
    env::var_os("CROSSBAR_FULL").is_some_and(|value| !value.is_empty())
}

/// Returns `full` with `CROSSBAR_FULL=1`, otherwise `short`.
pub(crate) fn by_form<T>(short: T, full: T) -> T {
    if is_full() { full } else { short }
}

/// The first `short` seeds from 0, with `CROSSBAR_FULL=1` `times` as many; or only the seed in `CROSSBAR_SEED`.
pub(crate) fn seeds(short: u64, times: u64) -> Range<u64> {
    let one: Option<u64> = env::var("CROSSBAR_SEED").ok().and_then(|seed| seed.parse().ok());
    one.map_or(0..by_form(short, times * short), |seed| seed..seed + 1)
}

/// Returns `true` with `INSTA_UPDATE=always`: tests rewrite generated files, pages and snapshots.
pub(crate) fn writes_files() -> bool {
    env::var("INSTA_UPDATE").is_ok_and(|update| update == "always")
}
