//! Progress of long work, on standard error: a bar on a terminal, a plain line now and then anywhere else.

use std::io::{self, IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::ProgressStyle;

use crate::report::digits::count;
use crate::report::visible::visible_line;

/// Work that is done earlier says nothing in plain lines.
const FIRST: Duration = Duration::from_secs(2);
/// From one plain line to the next.
const EVERY: Duration = Duration::from_secs(10);

/// True if errors are JSON for machines, which plain lines would disturb.
static SILENT: AtomicBool = AtomicBool::new(false);

/// Shows no plain lines from here on.
pub(super) fn silence() {
    SILENT.store(true, Ordering::Relaxed);
}

/// Shows how much of some work is done, until it is dropped.
#[derive(Debug)]
pub struct ProgressBar {
    /// It draws to standard error and hides itself where that is no terminal.
    bar: indicatif::ProgressBar,
    /// Set where standard error is no terminal.
    lines: Option<Mutex<PlainLines>>,
}

impl ProgressBar {
    /// A bar of `total` steps of `what`.
    pub fn new(what: &str, total: u64) -> Self {
        let bar = indicatif::ProgressBar::new(total).with_message(what.to_owned());
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:30}] {human_pos}/{human_len} {eta} left") {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        let plain = !io::stderr().is_terminal() && !SILENT.load(Ordering::Relaxed);
        Self { bar, lines: plain.then(|| Mutex::new(PlainLines::new(Instant::now()))) }
    }

    /// A spinner beside `what`.
    pub fn unending(what: &str) -> Self {
        let bar = indicatif::ProgressBar::new_spinner().with_message(what.to_owned());
        bar.enable_steady_tick(Duration::from_millis(200));
        Self { bar, lines: None }
    }

    /// `done` of `total` steps of `what` are done.
    pub fn show(&self, what: String, done: u64, total: u64) {
        self.bar.set_length(total);
        self.bar.set_position(done);
        self.bar.set_message(what);
        self.say();
    }

    /// `steps` more are done.
    pub fn advance(&self, steps: u64) {
        self.bar.inc(steps);
        self.say();
    }

    /// Writes a plain line if one is due.
    fn say(&self) {
        let Some(lines) = &self.lines else { return };
        let due = lines.lock().unwrap_or_else(PoisonError::into_inner).due(Instant::now());
        if due {
            let (done, total) = (self.bar.position(), self.bar.length().unwrap_or(0));
            // Nothing is to be done if nobody reads this.
            writeln!(io::stderr().lock(), "{}", plain_line(&self.bar.message(), done, total)).ok();
        }
    }
}

impl Drop for ProgressBar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// When the next plain line is due.
#[derive(Debug)]
struct PlainLines {
    next: Instant,
}

impl PlainLines {
    fn new(start: Instant) -> Self {
        Self { next: start + FIRST }
    }

    /// Returns `true` if a line is due; if so, the next one is put off.
    fn due(&mut self, now: Instant) -> bool {
        let due = now >= self.next;
        if due {
            self.next = now + EVERY;
        }
        due
    }
}

/// A line of progress: steps done, of all.
fn plain_line(what: &str, done: u64, total: u64) -> String {
    let what = visible_line(what);
    let what = if what.is_empty() { "working" } else { &what };
    format!("progress: {what}, {} of {} done", count(done.min(total)), count(total))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_lines_come_now_and_then() {
        let start = Instant::now();
        let mut lines = PlainLines::new(start);
        let due = [0, 1, 2, 3, 11, 12, 40, 41].map(|s| lines.due(start + Duration::from_secs(s)));
        assert_eq!(due, [false, false, true, false, false, true, true, false]);
    }

    #[test]
    fn a_plain_line_is_plain() {
        assert_eq!(plain_line("fp16", 3, 24), "progress: fp16, 3 of 24 done");
        assert_eq!(plain_line("a\x1b[2J\n", 1_000, 65_536), "progress: a\\u{1b}[2J\\n, 1,000 of 65,536 done");
    }
}
