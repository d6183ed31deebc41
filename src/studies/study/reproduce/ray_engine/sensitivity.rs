//! Sensitivity of Table 3 to each guess about host and queue.

use std::rc::Rc;

use refsim::timing::host::{HostOperation, HostWeights};
use refsim::timing::queue::QueueFigures;

use super::engine_run::{Commands, Run};
use super::speed_ups::SpeedUpRun;
use super::sweeps::rates;
use super::workload::HostOnly;
use super::{StudyError, speed_up};
use crate::report::{Cell, Table};

/// Names of the guesses that are doubled: of the host's operations, and of the queue's commands.
fn keys() -> Vec<String> {
    let host = HostOperation::ALL.iter().map(|operation| format!("host.{operation}"));
    let queue = QueueFigures::default().rows().into_iter().filter(|row| row.unit == "ps").map(|row| row.key);
    host.chain(queue).collect()
}

/// Table of the speed-ups of the lines with each guess doubled; guesses that change nothing are omitted. The host is
/// calibrated anew each time, so that its time alone is unchanged.
pub(super) fn table(alone: &HostOnly, lines: &[&SpeedUpRun]) -> Result<Table, StudyError> {
    let headings: Vec<String> = std::iter::once("guess".to_owned())
        .chain(lines.iter().map(|line| format!("{}_%", line.name.replace(' ', "_"))))
        .collect();
    let mut table = Table::new("Speed-ups of Table 3 with one guess doubled", &headings);
    let stated = speed_ups(alone, lines, HostWeights::default(), QueueFigures::default())?;
    push(&mut table, "as stated", &stated);
    let doubled = |key: String| {
        let (mut weights, mut queue) = (HostWeights::default(), QueueFigures::default());
        if let Some(figure) = weights.figure_mut(&key).or_else(|| queue.figure_mut(&key)) {
            *figure *= 2;
        }
        speed_ups(alone, lines, weights, queue).map(|found| (key, found))
    };
    let found: Vec<_> = keys().into_iter().map(doubled).collect::<Result<_, StudyError>>()?;
    for (key, found) in found.into_iter().filter(|(_, found)| *found != stated) {
        push(&mut table, &format!("{key} doubled"), &found);
    }
    Ok(table)
}

fn speed_ups(
    alone: &HostOnly,
    lines: &[&SpeedUpRun],
    weights: HostWeights,
    queue: QueueFigures,
) -> Result<Vec<f64>, StudyError> {
    let host = alone.calibrate(weights)?;
    let runs: Vec<Rc<Run>> = lines.iter().map(|line| Rc::clone(&line.run)).collect();
    Ok(rates(&runs, &host, Commands::Cost(queue))?.into_iter().map(speed_up).collect())
}

fn push(table: &mut Table, guess: &str, found: &[f64]) {
    let head: Cell = guess.into();
    table.push(std::iter::once(head).chain(found.iter().map(|value| Cell::percent(*value))));
}
