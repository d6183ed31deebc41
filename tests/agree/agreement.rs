//! The body of all agreement tests: draw a case with every executor, compare, shrink a difference, print how to
//! reproduce it.

use crate::environment::seeds;
use crate::executors::{EXECUTORS, Executor, REFERENCE};
use crate::scene::{Case, Outcome, Programs};
use crate::shrink;
use crate::suite::{Kind, Suite};
use std::fmt::Write as _;
use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A difference between the reference and another executor.
#[derive(Clone, Debug)]
pub(crate) struct Difference {
    /// Index into [`EXECUTORS`].
    pub(crate) executor: usize,
    /// The first difference, in words.
    pub(crate) what: String,
}

/// Draws a case; a panic becomes an error.
fn draw(case: &Case, programs: &Programs, executor: &Executor) -> Result<Outcome, String> {
    match catch_unwind(AssertUnwindSafe(|| case.scene.draw(executor, programs))) {
        Ok(drawn) => drawn.map_err(|e| e.to_string()),
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            Err(format!("panic: {}", text.or(panic.downcast_ref::<&str>().copied()).unwrap_or_default()))
        }
    }
}

/// The reference's outcome, and the differences of all executors that draw this case.
pub(crate) fn compare(case: &Case, turn: u64) -> Result<(Outcome, Vec<Difference>), String> {
    let programs = case.build()?;
    let expected = draw(case, &programs, &REFERENCE)?;
    let mut differences = Vec::new();
    for (executor, other) in EXECUTORS.iter().enumerate() {
        if other.draws(turn)
            && let Some(what) = differs(&expected, draw(case, &programs, other), other)
        {
            differences.push(Difference { executor, what });
        }
    }
    Ok((expected, differences))
}

/// The difference of one result from the expected one, in words.
fn differs(expected: &Outcome, found: Result<Outcome, String>, executor: &Executor) -> Option<String> {
    match found {
        Ok(found) => expected.difference(&found, &executor.name),
        Err(error) => Some(format!("scalar draws, {}: {error}", executor.name)),
    }
}

/// The difference of one executor from the reference on a case; `None` also if the case is not legal.
pub(crate) fn difference(case: &Case, executor: &Executor) -> Option<String> {
    let programs = case.build().ok()?;
    let expected = draw(case, &programs, &REFERENCE).ok()?;
    differs(&expected, draw(case, &programs, executor), executor)
}

/// The seeds of a run, and further seeds to draw if these cover nothing. By default, a suite draws one of three parts of
/// its seeds, depending on its name; a suite of the project's files draws all. `CROSSBAR_FULL=1` draws ten times as many
/// seeds.
fn seeds_of(suite: &Suite) -> [Range<u64>; 2] {
    let all = seeds(suite.seeds, 10);
    if all != (0..suite.seeds) || matches!(suite.kind, Kind::Kernels | Kind::Shaders) {
        return [all, 0..0];
    }
    let part = suite.seeds.div_ceil(3);
    let first = (suite.turn(0) % 3 * part).min(suite.seeds - part);
    [first..first + part, all]
}

/// Runs a suite; draws further seeds if the first ones cover nothing.
pub(crate) fn run(suite: &Suite) {
    let [seeds, others] = seeds_of(suite);
    let one = seeds.clone().count() == 1;
    let fragments = |seed| {
        // A case requested by its seed is drawn by all executors.
        let turn = if one { 0 } else { suite.turn(seed) };
        match compare(&suite.case(seed), turn) {
            Ok((drawn, differences)) if differences.is_empty() => drawn.fragments(),
            Ok((_, differences)) => panic!("{}", report(suite, seed, &differences[0])),
            Err(error) => panic!("seed {seed} of {} is no legal case: {error}", suite.name),
        }
    };
    let covers = |seeds: Range<u64>| seeds.map(fragments).sum::<u64>() > 0;
    assert!(covers(seeds) || covers(others) || one, "the scenes of {} cover nothing", suite.name);
}

/// A report of a difference: how to reproduce it, and the smallest case that shows it.
pub(crate) fn report(suite: &Suite, seed: u64, difference: &Difference) -> String {
    let case = suite.case(seed);
    let executor = &EXECUTORS[difference.executor];
    let small = shrink::shrink(&case, |smaller| self::difference(smaller, executor).is_some());
    let mut text = format!(
        "scalar and {} differ; to see it again:\n  CROSSBAR_SEED={seed} cargo test --test agree -- --exact {}\n",
        executor.name, suite.name
    );
    let _ = writeln!(text, "first difference: {}", difference.what);
    let _ = writeln!(text, "cut down: {}", self::difference(&small, executor).unwrap_or_default());
    let _ = writeln!(text, "{}", small.pixel.join("\n"));
    if let Some(vertex) = &small.vertex {
        let _ = writeln!(text, "{}", vertex.join("\n"));
    }
    let _ = write!(text, "{}", shrink::describe(&small.scene));
    text
}
