//! Sensitivity of the total time to each guess.

use miette::IntoDiagnostic as _;
use refsim::event::Event;
use refsim::timing::replay::{Options, replay};
use refsim::timing::{Level, Model, Picoseconds};

use crate::cli::ProgressBar;

/// A guessed figure, and the total time with half and with twice its value.
pub(super) struct Sensitivity {
    pub(super) key: String,
    pub(super) value: String,
    pub(super) halved: Picoseconds,
    pub(super) doubled: Picoseconds,
}

/// Varies every guess that the model reads, in its order, then the queue's guesses. Halving rounds down, but not to 0.
pub(super) fn sensitivity(model: &Model, log: &[Event], options: &Options<'_>) -> miette::Result<Vec<Sensitivity>> {
    let time = |model: &Model, options: &Options<'_>| -> miette::Result<Picoseconds> {
        Ok(replay(log, model, options)?.timeline.makespan())
    };
    let constants = model.constants();
    // In the rates model, commands cost nothing, so these figures have no effect.
    let queue = if model.level() == Level::Pipeline { options.queue.rows() } else { Vec::new() };
    let guesses = model.guesses();
    let bar = ProgressBar::new("halving and doubling", (guesses.len() + queue.len()) as u64);
    let mut rows = Vec::new();
    for key in guesses {
        let halved = time(&model.with_scaled(&key, 1, 2).into_diagnostic()?, options)?;
        let doubled = time(&model.with_scaled(&key, 2, 1).into_diagnostic()?, options)?;
        let value = constants.iter().find(|row| row.key == key);
        let value = value.map(|row| format!("{} {}", row.value, row.unit).trim_end().to_owned()).unwrap_or_default();
        rows.push(Sensitivity { key, value, halved, doubled });
        bar.advance(1);
    }
    for row in queue {
        let scaled = |scale: fn(u64) -> u64| {
            let mut options = *options;
            if let Some(figure) = options.queue.figure_mut(&row.key) {
                *figure = scale(*figure);
            }
            time(model, &options)
        };
        let (halved, doubled) = (scaled(|n| (n / 2).max(n.min(1)))?, scaled(|n| n.saturating_mul(2))?);
        rows.push(Sensitivity { value: format!("{} {}", row.value, row.unit), key: row.key, halved, doubled });
        bar.advance(1);
    }
    Ok(rows)
}
