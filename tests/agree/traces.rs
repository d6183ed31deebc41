//! Traces: for random programs and draws, the last fragment of the trace of every pixel is what every executor draws.

use crate::environment::seeds;
use crate::executors::{EXECUTORS, Executor, REFERENCE};
use crate::scene::{Case, Programs};
use crate::suite;
use refsim::machine::FragmentTrace;

pub(crate) fn the_trace_is_what_the_executors_draw() {
    let (mut steps, mut fragments) = (0, 0);
    let seeds = seeds(75, 60);
    for seed in seeds.clone() {
        let is_pixel = |name: &str| name.starts_with("programs::") && !name.starts_with("programs::vs_");
        let case = suite::small_case(is_pixel, seed, 1000, 17);
        let programs = case.build().unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let traces = case.scene.traces(&REFERENCE, &programs).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        for executor in EXECUTORS.iter().filter(|executor| executor.draws(seed)) {
            follows_the_draw(&case, executor, &programs, &traces, seed);
        }
        steps += traces.iter().flatten().map(|trace| trace.shading.steps.len()).sum::<usize>();
        fragments += traces.iter().flatten().count();
    }
    assert!(seeds.count() == 1 || (steps > 50_000 && fragments > 5_000), "{steps} {fragments}");
}

/// Checks that the last fragment of every pixel leaves the targets as the draw does, and that the numbers of fragments
/// agree.
fn follows_the_draw(case: &Case, executor: &Executor, programs: &Programs, traces: &[Vec<FragmentTrace>], seed: u64) {
    let drawn = case.scene.draw(executor, programs).unwrap_or_else(|e| panic!("{e}"));
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
