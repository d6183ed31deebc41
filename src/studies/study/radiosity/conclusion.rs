//! Conclusion of the study, in sentences.

use super::outcome::{MethodRow, RadiosityOutcome};
use super::{SolveMethod, StopReason, SweepRow};
use crate::report::words::{counted, percent};
use crate::report::{Findings, Tone};

/// Adds accuracy, speed, the sweep's range and the tally to the findings.
pub(super) fn conclude(found: &mut Findings, outcome: &RadiosityOutcome) {
    let sentences = [accuracy(&outcome.rows), speed(&outcome.rows), sweep(outcome)];
    sentences.into_iter().flatten().for_each(|sentence| found.conclusion(sentence));
    let mut tally = |of: fn(StopReason) -> bool, what: &str, tone| {
        let iterative = outcome.rows.iter().filter(|row| row.method != SolveMethod::DIRECT);
        let count = iterative.filter(|row| of(row.stopped)).count() as u64;
        found.tally(count, [&format!("method {what}"), &format!("methods {what}")], tone);
    };
    tally(|stopped| stopped == StopReason::Tolerance, "met the tolerance", Tone::Good);
    tally(|stopped| matches!(stopped, StopReason::Cycle(_)), "ended in a cycle", Tone::Bad);
    tally(|stopped| stopped == StopReason::Iterations, "ran out of iterations", Tone::Neutral);
}

/// The row with the largest mean error; of rows with equal mean errors, the one with the largest relative error. `None`
/// without a direct solution to compare with.
pub(super) fn least_accurate(rows: &[MethodRow]) -> Option<&MethodRow> {
    let size = |row: &&MethodRow| row.error.map(|error| [error.bias.abs(), error.relative]);
    let rows = rows.iter().filter(|row| row.error.is_some() && row.method != SolveMethod::DIRECT);
    rows.max_by(|a, b| size(a).partial_cmp(&size(b)).unwrap_or(std::cmp::Ordering::Equal))
}

fn accuracy(rows: &[MethodRow]) -> Option<String> {
    let worst = least_accurate(rows)?;
    let error = worst.error?;
    Some(match error.not_finite {
        // For example because every patch emits.
        0 if error.relative_unlit == 0.0 => {
            format!("{} is the least accurate: its largest relative error is {}.", worst.label, percent(error.relative))
        }
        0 => format!(
            "{} is the least accurate: non-emitting patches are {} on average, unweighted by area; their largest relative error is {}.",
            worst.label,
            shade(error.bias),
            percent(error.relative_unlit),
        ),
        count => {
            let count = counted(count, "radiosity is", "radiosities are");
            format!("{} is the least accurate: {count} not finite.", worst.label)
        }
    })
}

fn shade(bias: f64) -> String {
    let which = if bias < 0.0 { "dark" } else { "bright" };
    format!("{} too {which}", percent(bias.abs()))
}

fn speed(rows: &[MethodRow]) -> Option<String> {
    let within = || rows.iter().filter(|row| row.stopped == StopReason::Tolerance);
    let (first, last) = (within().min_by_key(|row| row.iterations())?, within().max_by_key(|row| row.iterations())?);
    let needs = |row: &MethodRow| counted(row.iterations() as u64, "iteration", "iterations");
    Some(if first.iterations() == last.iterations() {
        format!("{} meets the tolerance after {}.", first.label, needs(first))
    } else {
        let (fast, slow) = (needs(first), needs(last));
        format!("{} meets the tolerance first, after {fast}, and {} last, after {slow}.", first.label, last.label)
    })
}

/// Sentences about the range of the sweep's mean errors, and about rows that are not finite; `None` without a sweep.
fn sweep(outcome: &RadiosityOutcome) -> Option<String> {
    let (finite, others): (Vec<_>, Vec<_>) = outcome.sweep.iter().partition(|row| row.error.not_finite == 0);
    let by_bias = |a: &&&SweepRow, b: &&&SweepRow| a.error.bias.total_cmp(&b.error.bias);
    let place = |row: &SweepRow| {
        let switch = row.switch.as_ref().map_or_else(String::new, |_| format!(", {}", row.setting()));
        format!("{} ({}{switch})", counted(row.patches as u64, "patch", "patches"), row.method)
    };
    let said = |row: &SweepRow| format!("{} at {}", shade(row.error.bias), place(row));
    let ends = finite.iter().min_by(by_bias).zip(finite.iter().max_by(by_bias));
    let range = ends
        .map(|(least, most)| format!("Over the sweep, the mean error ranges from {} to {}.", said(least), said(most)));
    let lost = others.first().map(|first| {
        let rows = counted(others.len() as u64, "row of the sweep has", "rows of the sweep have");
        format!("{rows} radiosities that are not finite, the first at {}.", place(first))
    });
    let sentences: Vec<String> = range.into_iter().chain(lost).collect();
    (!sentences.is_empty()).then(|| sentences.join(" "))
}
