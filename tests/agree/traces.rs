//! Traces against each other: for random programs and draws the batch executor's trace of every pixel is the scalar
//! executor's, step by step, and following a pixel tells the truth about what the draw leaves there.

use crate::executors::{EXECUTORS, Executor, REFERENCE};
use crate::scene::{Case, Programs};
use crate::suite;
use refsim::machine::FragmentTrace;
use refsim::num::Flags;

/// Flags are the scalar executor's alone.
fn without_flags(mut traces: Vec<Vec<FragmentTrace>>) -> Vec<Vec<FragmentTrace>> {
    for step in traces.iter_mut().flatten().flat_map(|trace| &mut trace.shading.steps) {
        step.flags = Flags::empty();
    }
    traces
}

/// Case number `n`: the suites of random pixel programs one after the other, drawn once, all pixels followed.
fn case(n: u64) -> Case {
    let suites = suite::all();
    let pixel: Vec<_> = suites.iter().filter(|s| s.name.starts_with("programs::ps_")).collect();
    let mut case = pixel[(n as usize * 5) % pixel.len()].case(1000 + n);
    (case.scene.draws, case.scene.second_pass) = (1, false);
    case.scene.size = case.scene.size.map(|side| side.min(17));
    case
}

#[test]
fn the_batch_trace_is_the_scalar_trace() {
    let (mut steps, mut fragments) = (0, 0);
    let one = std::env::var("CROSSBAR_SEED").ok().and_then(|s| s.parse().ok());
    let all = if std::env::var_os("CROSSBAR_FULL").is_some() { 4500 } else { 150 };
    let batch = EXECUTORS.iter().find(|e| e.name.starts_with("batch")).unwrap_or_else(|| panic!("a batch executor"));
    for seed in one.map_or(0..all, |seed: u64| seed..seed + 1) {
        let case = case(seed);
        let text = case.pixel.join("\n");
        let programs = case.build().unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let traces = |executor: &Executor| {
            without_flags(case.scene.traces(executor, &programs).unwrap_or_else(|e| panic!("seed {seed}: {e}")))
        };
        let (a, b) = (traces(&REFERENCE), traces(batch));
        for (pixel, (a, b)) in a.iter().zip(&b).enumerate() {
            assert_eq!(a.len(), b.len(), "seed {seed}, pixel {pixel}: triangles\n{text}");
            for (a, b) in a.iter().zip(b) {
                for (k, (a, b)) in a.shading.steps.iter().zip(&b.shading.steps).enumerate() {
                    assert_eq!(a, b, "seed {seed}, pixel {pixel}, step {k}\n{text}");
                }
                assert_eq!(a, b, "seed {seed}, pixel {pixel}\n{text}");
                steps += a.shading.steps.len();
                fragments += 1;
            }
        }
        follows_the_draw(&case, &programs, &a, seed);
    }
    assert!(one.is_some() || (steps > 100_000 && fragments > 10_000), "{steps} {fragments}");
}

/// What the last fragment of every pixel leaves is what the draw leaves, and fates are counted as the draw counts them.
fn follows_the_draw(case: &Case, programs: &Programs, traces: &[Vec<FragmentTrace>], seed: u64) {
    let drawn = case.scene.draw(&REFERENCE, programs).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(traces.iter().flatten().count() as u64, drawn.fragments(), "seed {seed}");
    for (pixel, last) in traces.iter().enumerate().filter_map(|(pixel, t)| Some((pixel, t.last()?))) {
        for ((format, _, bytes), color) in drawn.targets.iter().zip(last.after.colors) {
            let size = format.bytes();
            let left = color.unwrap_or_default().to_le_bytes();
            assert_eq!(bytes[pixel * size..(pixel + 1) * size], left[..size], "seed {seed}, pixel {pixel}");
        }
        assert_eq!(drawn.depth.get(pixel).copied(), last.after.depth, "seed {seed}, pixel {pixel}");
    }
}
