//! Tables of the study.

use super::outcome::RadiosityOutcome;
use super::{Parameters, SolutionError, SolveMethod, StopReason};
use crate::report::{Cell, Table};

pub(super) fn room(parameters: &Parameters, outcome: &RadiosityOutcome) -> Table {
    let columns =
        "patches form_factors least_row_sum largest_row_sum light_escaping partly_covered blind_patches enforced";
    let mut table = Table::of("The room; row sums of the form factors, before they were scaled to 1", columns);
    let sums = &outcome.found_sums;
    table.push([
        outcome.patches.list().len().into(),
        parameters.options.factors.to_string().into(),
        Cell::decimals(sums.least, 7),
        Cell::decimals(sums.most, 7),
        Cell::error(sums.escaping),
        outcome.patches.covered()[0].into(),
        sums.blind.into(),
        if parameters.options.enforce_closure { "closure" } else { "nothing" }.into(),
    ]);
    table
}

pub(super) fn methods(outcome: &RadiosityOutcome) -> Table {
    let columns = "way iterations stopped_by residual light_unaccounted largest_error largest_relative mean_relative";
    let mut table = Table::of(
        "Methods, and their errors against the direct solution: the largest relative to the brightest patch, the \
         largest relative to each patch, and the signed mean of the relative errors",
        columns,
    );
    for row in &outcome.rows {
        let error = |of: fn(SolutionError) -> f64| row.error.map_or(Cell::Empty, |error| Cell::error(of(error)));
        table.push([
            row.label.as_str().into(),
            if row.method == SolveMethod::DIRECT { Cell::Empty } else { row.iterations().into() },
            row.stopped.to_string().into(),
            Cell::error(row.residual),
            Cell::error(row.energy_balance_error),
            error(|error| error.largest),
            error(|error| error.relative),
            error(|error| error.bias),
        ]);
    }
    table
}

/// Table of the iterations on a card that do not reach the tolerance: their fixed point, or cycle of repeating states.
pub(super) fn ends(parameters: &Parameters, outcome: &RadiosityOutcome) -> Table {
    let columns = "way ends entered_after period values_changing of_values largest_change_%";
    let mut table = Table::of("How iterations on the card end; changes from one iteration to the next", columns);
    let values = 3 * outcome.patches.list().len();
    for row in outcome.rows.iter().filter(|row| row.card.is_some()) {
        let ends = match row.stopped {
            StopReason::Tolerance => "within the tolerance".to_owned(),
            StopReason::Cycle(cycle) if cycle.is_fixed_point() => "at a fixed point".to_owned(),
            StopReason::Cycle(_) => "in a cycle".to_owned(),
            StopReason::Iterations | StopReason::Direct => {
                format!("no cycle within {} iterations", parameters.options.stopping().most_iterations)
            }
        };
        let cycle = if let StopReason::Cycle(cycle) = row.stopped { Some(cycle) } else { None };
        table.push([
            row.label.as_str().into(),
            ends.into(),
            cycle.map(|c| c.entered).into(),
            cycle.map(|c| c.period).into(),
            cycle.map(|c| c.changing).into(),
            cycle.map(|_| values).into(),
            cycle.map_or(Cell::Empty, |c| Cell::percent(100.0 * c.largest_change)),
        ]);
    }
    table
}

pub(super) fn sweep(outcome: &RadiosityOutcome) -> Table {
    let columns = "patches way setting iterations stopped_by largest_error mean_relative predicted_mean";
    let mut table = Table::of(
        "Other numbers of patches, and each open switch of the card changed separately; errors as above",
        columns,
    );
    for row in &outcome.sweep {
        table.push([
            row.patches.into(),
            row.method.as_str().into(),
            row.setting().into(),
            row.iterations.into(),
            row.stopped.to_string().into(),
            Cell::error(row.error.largest),
            Cell::error(row.error.bias),
            row.predicted.map_or(Cell::Empty, Cell::error),
        ]);
    }
    table
}

pub(super) fn card(outcome: &RadiosityOutcome) -> Table {
    let columns = "way passes texels_a_pass instructions matrix_MB iteration_us iterations_per_s MFLOP_per_s bound_by \
         bandwidth_used_%";
    let mut table = Table::of("An iteration of all three channels on the card, by the pipeline model", columns);
    for (row, facts) in outcome.rows.iter().filter_map(|row| Some((row, row.card.as_ref()?))) {
        let head: [Cell; 5] = [
            row.label.as_str().into(),
            facts.passes.into(),
            facts.block.into(),
            facts.instructions.into(),
            Cell::measured(facts.matrix_bytes / 1e6),
        ];
        let time = facts.time.map_or_else(
            || [const { Cell::Empty }; 5],
            |time| {
                [
                    Cell::measured(time.seconds * 1e6),
                    Cell::measured(1.0 / time.seconds),
                    Cell::measured(time.mflops),
                    time.bound_by.to_string().into(),
                    Cell::percent(100.0 * time.bandwidth),
                ]
            },
        );
        table.push(head.into_iter().chain(time));
    }
    table
}
