//! Progress of long work, on standard error: a bar on a terminal, otherwise a plain line from time to time. Long work
//! announces itself once, with the options that would make it faster.

use std::io::{self, IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use indicatif::{ProgressDrawTarget, ProgressStyle};

use crate::report::digits::count;
use crate::report::visible::visible_line;

const FIRST: Duration = Duration::from_secs(2);
const EVERY: Duration = Duration::from_secs(10);
/// Estimated remaining time above which work announces itself.
const LONG: Duration = Duration::from_secs(45);

/// `true` with `--quiet`, and if errors are JSON, which other lines would corrupt.
static SILENT: AtomicBool = AtomicBool::new(false);

pub(super) fn silence() {
    SILENT.store(true, Ordering::Relaxed);
}

/// Shows the progress of some work until it is dropped.
#[derive(Debug)]
pub struct ProgressBar {
    /// The bar on standard error, hidden unless that is a terminal.
    bar: indicatif::ProgressBar,
    /// `true` if standard error is not a terminal.
    is_plain: bool,
    said: Mutex<Said>,
    /// Options that would make the work faster; empty if there are none.
    quicker: &'static str,
}

impl ProgressBar {
    /// Creates a bar with `total` steps of `what`.
    pub fn new(what: &str, total: u64) -> Self {
        let bar = indicatif::ProgressBar::new(total).with_message(what.to_owned());
        if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:30}] {human_pos}/{human_len} {eta} left") {
            bar.set_style(style.progress_chars("=> "));
        }
        let is_plain = !begin(&bar) && !io::stderr().is_terminal();
        Self { bar, is_plain, said: Mutex::default(), quicker: "" }
    }

    /// Sets the options that would make long work faster, such as "a smaller `--size`".
    #[must_use]
    pub fn quicker(mut self, quicker: &'static str) -> Self {
        self.quicker = quicker;
        self
    }

    /// Creates a spinner labelled `what`.
    pub fn unending(what: &str) -> Self {
        let bar = indicatif::ProgressBar::new_spinner().with_message(what.to_owned());
        begin(&bar);
        Self { bar, is_plain: false, said: Mutex::default(), quicker: "" }
    }

    /// Reports that `done` of `total` steps of `what` are done.
    pub fn show(&self, what: String, done: u64, total: u64) {
        self.bar.set_length(total);
        self.bar.set_position(done);
        self.bar.set_message(what);
        self.say();
    }

    /// Reports that `steps` more steps are done.
    pub fn advance(&self, steps: u64) {
        self.bar.inc(steps);
        self.say();
    }

    /// Writes the messages that are due: that the work takes long, and, if there is no bar, a plain line of progress.
    fn say(&self) {
        let (done, total) = (self.bar.position(), self.bar.length().unwrap_or(0));
        let elapsed = self.bar.elapsed();
        // Without steps, no time is known.
        let left = Some(self.bar.eta()).filter(|left| !left.is_zero() && elapsed >= FIRST);
        // A panic elsewhere leaves this data valid.
        let mut said = self.said.lock().unwrap_or_else(PoisonError::into_inner);
        let is_news = left > Some(LONG) && !said.is_announced;
        said.is_announced |= is_news;
        let is_due = self.is_plain && elapsed >= said.line.map_or(FIRST, |line| line + EVERY);
        if is_due {
            said.line = Some(elapsed);
        }
        drop(said);
        let what = self.bar.message();
        if let Some(left) = left.filter(|_| is_news) {
            self.announce(&long_work(&what, left, self.quicker));
        }
        if is_due {
            // A failed write is ignored.
            writeln!(io::stderr().lock(), "{}", plain_line(&what, done, total, left)).ok();
        }
    }

    /// Writes a line above the bar, or a plain line if there is no bar.
    fn announce(&self, line: &str) {
        match self.is_plain {
            false => self.bar.println(line),
            true => drop(writeln!(io::stderr().lock(), "progress: {line}")),
        }
    }
}

/// Shows the bar, or hides it if no progress is shown; returns `true` if it is hidden.
fn begin(bar: &indicatif::ProgressBar) -> bool {
    let is_silent = SILENT.load(Ordering::Relaxed);
    if is_silent {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    is_silent
}

impl Drop for ProgressBar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[derive(Debug, Default)]
struct Said {
    is_announced: bool,
    /// Time of the last plain line, from the beginning of the work.
    line: Option<Duration>,
}

fn about(duration: Duration) -> String {
    match duration.as_secs() {
        seconds @ 0..90 => format!("about {} s", seconds.max(1)),
        seconds @ 90..5400 => format!("about {} min", (seconds + 30) / 60),
        seconds => format!("about {} h", count((seconds + 1800) / 3600)),
    }
}

fn long_work(what: &str, left: Duration, quicker: &str) -> String {
    let what = visible_line(what);
    let what = if what.is_empty() { "this" } else { &what };
    let quicker = if quicker.is_empty() { String::new() } else { format!("; quicker with {quicker}") };
    format!("{what} will take {} at this pace{quicker}", about(left))
}

fn plain_line(what: &str, done: u64, total: u64, left: Option<Duration>) -> String {
    let what = visible_line(what);
    let what = if what.is_empty() { "working" } else { &what };
    let left = left.map(|left| format!(", {} left", about(left))).unwrap_or_default();
    format!("progress: {what}, {} of {} done{left}", count(done.min(total)), count(total))
}
