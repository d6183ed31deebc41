//! Tests step budgets: programs that would run for years end with an error that names the location; programs within the
//! budget are unaffected.

use crate::machine::screen;
use crate::running::{bits, checked, constants, ideal};
use refsim::device::{DEFAULT_STEP_BUDGET, Profile};
use refsim::event::{FlowConstants, ProgramWork};
use refsim::exec::Constants;
use refsim::machine::{
    AttributeStream, DrawCall, ExecutorKind, Machine, MachineError, ProgramPlace, StepRate, VertexSource, VertexStreams,
};
use refsim::raster::{Primitive, Vertex};
use refsim::texture::TexelFormat;

/// Width and height of the targets: more than one tile.
const SIDE: u32 = 18;

/// The executors that run programs with flow control.
const EXECUTORS: [ExecutorKind; 2] = [ExecutorKind::Scalar, ExecutorKind::Batch];

/// A quad over the whole target whose t0 counts columns and rows.
fn corners() -> Vec<Vertex> {
    let mut corners = screen(SIDE);
    for vertex in &mut corners {
        let [u, v, ..] = vertex.texcoords[0].map(f32::from_bits);
        vertex.texcoords[0] = bits([SIDE as f32 * u, SIDE as f32 * v, 0.0, 1.0]);
    }
    corners
}

/// Draws the quad into a target cleared to 0.25; returns the target's bytes.
fn draw(text: &str, host: &Constants, budget: u32, kind: ExecutorKind) -> (Result<(), MachineError>, Vec<u8>) {
    let mut profile = ideal("fp32");
    profile.limits.set_step_budget(budget);
    let program = checked(text, &profile);
    let mut machine = Machine::new(profile.clone(), kind);
    let target = machine.create_target(TexelFormat::Rgba8, SIDE, SIDE).unwrap();
    machine.clear_target(target, bits([0.25; 4])).unwrap();
    let vertices = corners();
    let call = DrawCall::new(VertexSource::Transformed(&vertices), Primitive::QuadList, &program, host, target);
    let traced = machine.trace(&call, (7, 3));
    let drawn = machine.draw(&call).map(|_| ());
    if drawn.is_ok() {
        assert!(traced.is_ok(), "{kind:?}: {text}");
    }
    (drawn, machine.read_back(target).unwrap().bytes().to_vec())
}

/// `i0` is 255.
fn host() -> Constants {
    Constants { int: vec![[255, 0, 0, 0], [3, 0, 0, 0], [0; 4]], boolean: vec![true, false], ..constants(&[[1.0; 4]]) }
}

/// `deep` nested loops of 255 iterations.
fn nested(deep: usize) -> String {
    let (open, close) = ("rep i0\n".repeat(deep), "endrep\n".repeat(deep));
    format!("ps_2_a\nmov r0, c0\n{open}add r0, r0, c0\n{close}mov oC0, r0")
}

/// Fifteen subroutines: each calls the next four times, and the main program calls the first: 4^15 calls.
fn call_tree() -> String {
    let mut text = String::from("ps_2_a\nmov r0, c0\ncall l0\nmov oC0, r0\nret\n");
    for label in 0..16 {
        text += &format!("label l{label}\nadd r0, r0, c0\n");
        if label < 15 {
            text += &format!("call l{}\n", label + 1).repeat(4);
        }
        text += "ret\n";
    }
    text
}

fn place(error: &MachineError) -> (ProgramPlace, usize, u32) {
    match error {
        MachineError::StepBudget { place, instruction, budget, .. } => (*place, *instruction, *budget),
        other => panic!("{other}"),
    }
}

#[test]
fn what_would_never_end_is_an_error_with_its_place() {
    for text in [nested(4), nested(20), call_tree()] {
        let mut first: Option<MachineError> = None;
        for kind in EXECUTORS {
            let (drawn, bytes) = draw(&text, &host(), 300, kind);
            let error = drawn.expect_err("years");
            assert!(bytes.iter().all(|&b| b == 64), "{kind:?}: nothing is drawn");
            assert_eq!(place(&error).0, ProgramPlace::Pixel { x: 0, y: 0 }, "{kind:?}");
            assert_eq!(*first.get_or_insert(error.clone()), error, "{kind:?}");
        }
    }
    let error = draw(&nested(4), &host(), 1000, ExecutorKind::Batch).0.unwrap_err();
    insta::assert_snapshot!(error.to_string(), @"pixel (0, 0): the ps_2_a program did not end within its budget of 1000 steps; the next was instruction 7, `endrep`");
    assert_eq!(ideal("fp32").limits.step_budget(refsim::isa::Stage::Pixel), DEFAULT_STEP_BUDGET);
}

/// Steps counted by hand.
#[test]
fn a_budget_that_is_reached_is_enough_and_one_less_is_not() {
    // `mov`; outer `rep`; three times: inner `rep`, three passes of `add` and `endrep`, outer `endrep`; then `mov`.
    let steps = 1 + (1 + 3 * ((1 + 3 * 2) + 1)) + 1;
    let branches = "ps_2_a\nmov r0, c0\nif b0\nadd r0, r0, c0\nadd r0, r0, c0\nelse\nadd r0, r0, c0\nendif\nif b1\nadd \
                    r0, r0, c0\nelse\nadd r0, r0, c0\nendif\nmov oC0, r0";
    let calls = "ps_2_a\nmov r0, c0\nrep i1\ncall l0\nendrep\nrep i2\ncall l0\nendrep\nmov oC0, r0\nret\nlabel l0\nadd r0, \
                 r0, c0\ncallnz l1, b1\nret\nlabel l1\nadd r0, r0, c0\nret";
    let straight = "ps_1_4\ntexcrd r0.rgb, t0\nphase\nmov r0, c0\nmul r0.rgb, r0, c0\n+mov r0.a, c0\nmov r0, r0";
    let cases = [
        (nested(2).replace("i0", "i1"), steps),
        // With `b0` true: `if`, two `add`, `else`; with `b1` false: `if`, `add`, `endif`.
        (branches.to_owned(), 1 + 4 + 3 + 1),
        // Three passes of `call`, `add`, `callnz`, `ret`, `endrep`; the loop without passes is one step.
        (calls.to_owned(), 1 + 1 + 3 * 5 + 1 + 1 + 1),
        // A co-issued pair is one step; `phase` is not a step.
        (straight.to_owned(), 4),
    ];
    for (text, steps) in cases {
        let count = text.lines().count();
        for kind in EXECUTORS {
            let (drawn, bytes) = draw(&text, &host(), steps, kind);
            drawn.unwrap_or_else(|e| panic!("{kind:?}, {steps}: {e}\n{text}"));
            assert!(bytes.iter().any(|&b| b != 64), "{kind:?}: something is drawn");
            let (found, _, budget) = place(&draw(&text, &host(), steps - 1, kind).0.expect_err(&text));
            assert_eq!((found, budget), (ProgramPlace::Pixel { x: 0, y: 0 }, steps - 1), "{kind:?}, {count} lines");
        }
    }
}

/// Fragments further down and to the right need more steps: the first one that exceeds the budget is reported, in
/// whatever order the executor reaches them.
#[test]
fn the_first_fragment_that_needs_too_much_is_named() {
    let text = "ps_2_a\ndef c1, 1, 0, 0, 0\ndef c2, 6, 11, 0, 0\ndcl t0\nmov r0, c1.y\nrep i0\nif_gt t0.x, c2.x\nif_gt \
                t0.y, c2.y\nadd r0, r0, c1.x\nendif\nendif\nbreak_gt r0.x, t0.y\nif_lt t0.y, c2.y\nbreak\nendif\nendrep\nmov \
                oC0, r0";
    let mut found = Vec::new();
    for kind in EXECUTORS {
        let (drawn, _) = draw(text, &host(), 30, kind);
        found.push(drawn.expect_err("those that never add"));
    }
    assert!(found.iter().all(|error| *error == found[0]), "{found:?}");
    let (ProgramPlace::Pixel { x, y }, instruction, _) = place(&found[0]) else { panic!("{found:?}") };
    // From row 11 on, no lane breaks early. The first triangle is the upper right half, including the diagonal. The
    // budget is two steps, three iterations of eight, and four more.
    assert_eq!((x, y, instruction), (11, 11, 6));
}

#[test]
fn vertices_have_a_budget_too() {
    let text = "vs_2_0\ndcl_position v0\nmov r0, v0\nrep i0\nadd r0, r0, c0\nendrep\nmov oPos, r0";
    for kind in EXECUTORS {
        let mut profile = ideal("fp32");
        let run = |profile: &Profile| {
            let (vertex, pixel) = (checked(text, profile), checked("ps_2_0\ndef c0, 1, 1, 1, 1\nmov oC0, c0", profile));
            let mut machine = Machine::new(profile.clone(), kind);
            let target = machine.create_target(TexelFormat::Rgba8, 4, 4).unwrap();
            let data: Vec<[u32; 4]> = corners().iter().map(|v| v.position).collect();
            let streams = VertexStreams {
                vertex_count: 4,
                instance_count: 3,
                streams: vec![AttributeStream { register: 0, step: StepRate::Vertex, data: &data }],
            };
            let (host, none) = (host(), Constants::default());
            let source = VertexSource::Program { program: &vertex, constants: &host, streams };
            let call = DrawCall::new(source, Primitive::QuadList, &pixel, &none, target);
            let drawn = machine.draw(&call).map(|_| ());
            assert_eq!(machine.corners(&call, 0, 0).map(|_| ()), drawn, "{kind:?}");
            drawn
        };
        profile.limits.vertex_step_budget = Some(2 + 2 * 255 + 1);
        assert_eq!(run(&profile), Ok(()), "{kind:?}");
        profile.limits.vertex_step_budget = Some(2 + 2 * 255);
        let error = run(&profile).expect_err("one less");
        assert_eq!(place(&error), (ProgramPlace::Vertex { instance: 0, vertex: 0 }, 4, 512), "{kind:?}");
    }
}

/// The work of a card's program is counted without executing it.
#[test]
fn counting_the_work_of_a_program_is_one_pass() {
    let host = host();
    let flow = FlowConstants { int: &host.int, boolean: &host.boolean };
    let profile = ideal("fp32");
    let tree = ProgramWork::new(&checked(&call_tree(), &profile), flow);
    let adds: u64 = (0..16).map(|level| 4u64.pow(level)).sum();
    assert_eq!(tree.arithmetic_slots(), adds + 2, "every call counts");
    assert_eq!(ProgramWork::new(&checked(&nested(4), &profile), flow).arithmetic_slots(), 255u64.pow(4) + 2);
    assert_eq!(ProgramWork::new(&checked(&nested(20), &profile), flow).arithmetic_slots(), u64::MAX, "more than fit");
    assert_eq!(ProgramWork::new(&checked(&nested(10_000), &profile), flow).arithmetic_slots(), u64::MAX);
    for kind in [ExecutorKind::Scalar, ExecutorKind::Batch] {
        let (drawn, _) = draw(&nested(500), &host, 400, kind);
        assert_eq!(place(&drawn.unwrap_err()).1, 400, "{kind:?}: before the innermost loop");
    }
}
