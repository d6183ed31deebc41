//! Traces: for random programs and draws, a GPU's trace of every pixel equals the scalar executor's, step by step, and
//! the last fragment of a trace is what every executor draws.

use crate::environment::seeds;
use crate::executors::{EXECUTORS, Executor, REFERENCE};
use crate::scene::{Case, Programs};
use crate::suite;
use refsim::machine::FragmentTrace;
use refsim::num::Flags;

/// Removes flags, which a GPU does not compute.
fn without_flags(mut traces: Vec<Vec<FragmentTrace>>) -> Vec<Vec<FragmentTrace>> {
    for step in traces.iter_mut().flatten().flat_map(|trace| &mut trace.shading.steps) {
        step.flags = Flags::empty();
    }
    traces
}

/// Case number `n`: the suites of random pixel programs in turn, each case drawn once.
fn case(n: u64) -> Case {
    let suites = suite::all();
    let is_pixel = |name: &str| name.starts_with("programs::") && !name.starts_with("programs::vs_");
    let pixel: Vec<_> = suites.iter().filter(|s| is_pixel(&s.name)).collect();
    let mut case = pixel[(n as usize * 61) % pixel.len()].case(1000 + n);
    (case.scene.draws, case.scene.second_pass) = (1, false);
    case.scene.size = case.scene.size.map(|side| side.min(17));
    case
}

/// Compares the traces of one case; returns the numbers of steps and fragments.
fn same(seed: u64, case: &Case, other: &Executor) -> (usize, usize) {
    let (mut steps, mut fragments) = (0, 0);
    let text = case.pixel.join("\n");
    let programs = case.build().unwrap_or_else(|e| panic!("seed {seed}: {e}"));
    let traces = |executor: &Executor| {
        let traced = case.scene.traces(executor, &programs);
        without_flags(traced.unwrap_or_else(|e| panic!("seed {seed}, {}: {e}", executor.name)))
    };
    let (a, b) = (traces(&REFERENCE), traces(other));
    for (pixel, (a, b)) in a.iter().zip(&b).enumerate() {
        let place = format!("seed {seed}, {}, pixel {pixel}", other.name);
        assert_eq!(a.len(), b.len(), "{place}: triangles\n{text}");
        for (a, b) in a.iter().zip(b) {
            for (k, (a, b)) in a.shading.steps.iter().zip(&b.shading.steps).enumerate() {
                assert_eq!(a, b, "{place}, step {k}\n{text}");
            }
            assert_eq!(a, b, "{place}\n{text}");
            steps += a.shading.steps.len();
            fragments += 1;
        }
    }
    follows_the_draw(case, other, &programs, &a, seed);
    (steps, fragments)
}

pub(crate) fn the_trace_is_what_the_batch_executor_draws() {
    let (mut steps, mut fragments) = (0, 0);
    let batch = EXECUTORS.iter().find(|e| e.name.starts_with("batch")).unwrap_or_else(|| panic!("a batch executor"));
    let seeds = seeds(75, 60);
    for seed in seeds.clone() {
        let found = same(seed, &case(seed), batch);
        steps += found.0;
        fragments += found.1;
    }
    assert!(seeds.count() == 1 || (steps > 50_000 && fragments > 5_000), "{steps} {fragments}");
}

#[cfg(feature = "wgpu")]
pub(crate) fn the_gpu_trace_is_the_scalar_trace() {
    for executor in EXECUTORS.iter().filter(|e| e.name.starts_with("wgpu")) {
        let (mut steps, mut fragments) = (0, 0);
        let seeds = seeds(8, 60);
        for seed in seeds.clone() {
            let mut case = case(seed);
            case.scene.size = case.scene.size.map(|side| side.min(9));
            let found = same(seed, &case, executor);
            steps += found.0;
            fragments += found.1;
        }
        assert!(seeds.count() == 1 || (steps > 1_000 && fragments > 100), "{steps} {fragments}");
    }
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
