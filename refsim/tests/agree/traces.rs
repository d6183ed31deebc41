//! Traces against each other: for random programs and draws the batch executor's trace of every pixel is the scalar
//! executor's, step by step, and following a pixel tells the truth about what the draw leaves there.

use crate::random::Random;
use crate::scene::{self, FORMATS, Scene};
use crate::{PIXEL, cases, legal};
use refsim::exec::CheckedProgram;
use refsim::machine::{ExecutorKind, FragmentTrace};
use refsim::num::Flags;

/// Flags are the scalar executor's alone.
fn without_flags(mut traces: Vec<Vec<FragmentTrace>>) -> Vec<Vec<FragmentTrace>> {
    for step in traces.iter_mut().flatten().flat_map(|trace| &mut trace.shading.steps) {
        step.flags = Flags::empty();
    }
    traces
}

#[test]
fn the_batch_trace_is_the_scalar_trace() {
    let (mut steps, mut fragments) = (0, 0);
    for seed in cases(150) {
        let mut r = Random::new(seed ^ 0x7ace);
        let version = r.choose(&PIXEL);
        let profile = scene::profile(r.pick(FORMATS), &mut r);
        let scene = Scene::new(profile, version, &mut r);
        let (lines, program) = legal(version, &scene, &mut r);
        let text = lines.join("\n");
        let traces = |kind| without_flags(scene.traces(kind, &program, None).unwrap_or_else(|e| panic!("{e}")));
        let (scalar, batch) = (traces(ExecutorKind::Scalar), traces(ExecutorKind::Batch));
        for (pixel, (a, b)) in scalar.iter().zip(&batch).enumerate() {
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
        follows_the_draw(&scene, &program, &scalar, seed);
    }
    assert!(
        std::env::var_os("CROSSBAR_SEED").is_some() || (steps > 100_000 && fragments > 10_000),
        "{steps} {fragments}"
    );
}

/// What the last fragment of every pixel leaves is what the draw leaves, and fates are counted as the draw counts them.
fn follows_the_draw(scene: &Scene, program: &CheckedProgram, traces: &[Vec<FragmentTrace>], seed: u64) {
    let drawn = scene.draw(ExecutorKind::Scalar, 1, program, None).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(traces.iter().flatten().count() as u64, drawn.events.fragments.shaded, "seed {seed}");
    for (pixel, last) in traces.iter().enumerate().filter_map(|(pixel, t)| Some((pixel, t.last()?))) {
        for (bytes, color) in drawn.targets.iter().zip(last.after.colors) {
            let size = bytes.len() / traces.len();
            let left = color.unwrap_or_default().to_le_bytes();
            assert_eq!(bytes[pixel * size..(pixel + 1) * size], left[..size], "seed {seed}, pixel {pixel}");
        }
        assert_eq!(drawn.depth.get(pixel).copied(), last.after.depth, "seed {seed}, pixel {pixel}");
    }
}
