//! What was found, as tables.

use serde_json::{Value, json};

use super::{Difference, Outcome, Parameters, Row, Way};
use crate::report::{Cell, Table};

/// The tables of a study.
#[derive(Clone, Debug)]
pub struct Tables {
    /// The room, and what its form factors obey.
    pub room: Table,
    /// A row a way of solving.
    pub ways: Table,
    /// A row a way on a card; empty without.
    pub card: Table,
    /// A row a way, after the changes; empty without.
    pub relit: Table,
}

impl Tables {
    /// Those that have rows, in the order in which they are read.
    pub fn all(&self) -> impl Iterator<Item = &Table> {
        [&self.room, &self.ways, &self.card, &self.relit].into_iter().filter(|table| !table.rows().is_empty())
    }

    /// All of them as one document.
    pub fn json(&self) -> Value {
        json!({
            "room": self.room.json(), "ways": self.ways.json(), "card": self.card.json(), "relit": self.relit.json(),
        })
    }
}

/// The tables.
pub fn tables(parameters: &Parameters, outcome: &Outcome) -> Tables {
    Tables { room: room(parameters, outcome), ways: ways(outcome), card: card(outcome), relit: relit(outcome) }
}

/// So many digits that count, for people.
pub(super) fn digits(x: f64, count: usize) -> Cell {
    if x == 0.0 || !x.is_finite() {
        return x.into();
    }
    // The shortest decimal of the rounded value.
    format!("{x:.*e}", count.saturating_sub(1)).parse::<f64>().unwrap_or(x).into()
}

fn room(parameters: &Parameters, outcome: &Outcome) -> Table {
    let headings = [
        "patches",
        "form_factors",
        "least_row_sum",
        "largest_row_sum",
        "light_escaping",
        "blind_patches",
        "reciprocity_error",
        "enforced",
    ];
    let mut table = Table::new("The room; sums and errors as found, before anything was enforced", &headings);
    let wishes = &parameters.factors;
    let enforced = match (wishes.enforce_closure, wishes.enforce_reciprocity) {
        (true, _) => "closure, reciprocity",
        (false, true) => "reciprocity",
        (false, false) => "nothing",
    };
    let sums = &outcome.found_sums;
    table.push([
        outcome.patches.list().len().into(),
        wishes.from.to_string().into(),
        digits(sums.least, 7),
        digits(sums.most, 7),
        digits(sums.escaping, 3),
        sums.blind.into(),
        digits(outcome.reciprocity_error, 3),
        enforced.into(),
    ]);
    table
}

fn ways(outcome: &Outcome) -> Table {
    let headings = [
        "way",
        "iterations",
        "stopped_by",
        "residual",
        "light_unaccounted",
        "largest_error",
        "largest_relative",
        "mean_relative",
    ];
    let mut table = Table::new(
        "Ways of solving; errors against the direct solution: of the brightest patch, of each patch, and with its sign in the mean",
        &headings,
    );
    for row in &outcome.rows {
        let off = |of: fn(Difference) -> f64| row.off.map_or(Cell::Empty, |off| digits(of(off), 3));
        table.push([
            row.label.as_str().into(),
            if row.way == Way::DIRECT { Cell::Empty } else { row.iterations().into() },
            row.stopped.to_string().into(),
            digits(row.residual, 3),
            digits(row.imbalance, 3),
            off(|off| off.largest),
            off(|off| off.relative),
            off(|off| off.bias),
        ]);
    }
    table
}

fn card(outcome: &Outcome) -> Table {
    let headings = [
        "way",
        "passes",
        "texels_a_pass",
        "instructions",
        "matrix_MB",
        "iteration_us",
        "iterations_per_s",
        "MFLOP_per_s",
        "bound_by",
        "bandwidth_used_%",
    ];
    let mut table =
        Table::new("An iteration of all three channels on the card, as the pipeline model has it", &headings);
    for (row, facts) in outcome.rows.iter().filter_map(|row| Some((row, row.card.as_ref()?))) {
        let head: [Cell; 5] = [
            row.label.as_str().into(),
            facts.passes.into(),
            facts.block.into(),
            facts.instructions.into(),
            digits(facts.matrix_bytes / 1e6, 4),
        ];
        let time = facts.time.map_or_else(
            || [const { Cell::Empty }; 5],
            |time| {
                [
                    digits(time.seconds * 1e6, 4),
                    digits(1.0 / time.seconds, 3),
                    digits(time.mflops, 3),
                    format!("{:?}", time.bound_by).to_lowercase().into(),
                    digits(100.0 * time.bandwidth, 2),
                ]
            },
        );
        table.push(head.into_iter().chain(time));
    }
    table
}

fn relit(outcome: &Outcome) -> Table {
    let mut table = Table::new(
        "After the changes: iterations from the solution before, and from nothing",
        &["way", "from_the_last", "from_nothing", "saved_%"],
    );
    for (row, relit) in outcome.rows.iter().filter_map(|row| Some((row, row.relit.as_ref()?))) {
        let count = |n: Option<usize>| n.map_or_else(|| Cell::from("not reached"), Cell::from);
        let saved = match (relit.from_last, relit.from_nothing) {
            (Some(last), Some(nothing)) if nothing > 0 => {
                digits(100.0 * (nothing as f64 - last as f64) / nothing as f64, 3)
            }
            _ => Cell::Empty,
        };
        if row.way != Way::DIRECT {
            table.push([row.label.as_str().into(), count(relit.from_last), count(relit.from_nothing), saved]);
        }
    }
    table
}

impl Row {
    /// How many iterations it took.
    pub fn iterations(&self) -> usize {
        self.history.len().saturating_sub(1)
    }
}
