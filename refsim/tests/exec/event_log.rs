//! Tests the event log of a machine: its contents, and that nothing is recorded unless it is enabled.

use crate::running::{bits, checked};
use refsim::asm::assemble;
use refsim::device::Profile;
use refsim::event::{DepthRecord, Event, FenceId, FlowConstants, ProgramWork, ReadBackMode, ResourceId, TargetRecord};
use refsim::exec::Constants;
use refsim::isa::Opcode;
use refsim::machine::{DrawCall, DrawWatcher, Executor, ExecutorKind, Machine, MachineError, VertexSource};
use refsim::output::{AlphaTest, CompareFunction, DepthFormat, DepthState, WriteMask};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{Image, SamplerState, TexelFormat};
use std::sync::Arc;

fn triangle() -> [Vertex; 3] {
    [[-1.0, 1.0], [1.0, 1.0], [-1.0, -1.0]]
        .map(|[x, y]| Vertex { position: bits([x, y, 0.5, 1.0]), ..Vertex::default() })
}

#[test]
fn a_machine_that_was_not_asked_writes_nothing() {
    let mut machine = Machine::new(Profile::named("r200").unwrap(), ExecutorKind::Scalar);
    let target = machine.create_target(TexelFormat::Bgra8, 8, 8).unwrap();
    machine.read_back(target).unwrap();
    let (fence, _) = machine.read_back_async(target).unwrap();
    machine.finish_fence(fence);
    assert_eq!(machine.take_log(), []);
}

/// Reads the target back before and after each draw, and traces one of its pixels.
#[derive(Debug)]
struct Looks;

impl DrawWatcher for Looks {
    fn before(&self, machine: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        machine.trace(call, (0, 0)).map(|fragments| assert_eq!(fragments.len(), 1))
    }

    fn after(&self, machine: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        machine.read_back(call.targets[0]).map(|image| assert_eq!(image.width(), 8))
    }
}

#[test]
fn what_a_watcher_reads_is_not_written_down() {
    let logs = [Executor::from(ExecutorKind::Batch), Executor::from(ExecutorKind::Batch).watched(Arc::new(Looks))];
    let [without, with] = logs.map(|executor| {
        let profile = Profile::named("r200").unwrap();
        let program = checked("ps_1_4\nmov r0, c0", &profile);
        let mut machine = executor.machine(profile).unwrap();
        machine.record(true);
        let target = machine.create_target(TexelFormat::Bgra8, 8, 8).unwrap();
        let (vertices, host) = (triangle(), Constants::default());
        let triangles = VertexSource::Transformed(&vertices);
        let call = DrawCall::new(triangles, Primitive::TriangleList, &program, &host, target);
        machine.draw(&call).unwrap();
        machine.draw(&call).unwrap();
        machine.take_log()
    });
    assert_eq!(with, without);
    assert!(with.iter().any(|event| matches!(event, Event::Draw(_))), "still recording");
}

#[test]
fn everything_is_written_down_in_order() {
    let profile = Profile::named("r200").unwrap();
    let program = checked("ps_1_4\ntexld r0, t0\nmov r0, r0", &profile);
    let mut machine = Machine::new(profile, ExecutorKind::Batch);
    machine.record(true);
    let texture = machine.create_texture(Image::new_2d(TexelFormat::Bgr565, 8, 8).unwrap()).unwrap();
    let target = machine.create_target(TexelFormat::Bgra8, 16, 16).unwrap();
    let depth = machine.create_depth(DepthFormat::Unorm16, 16, 16).unwrap();
    machine.clear_target(target, [0; 4]).unwrap();
    machine.clear_depth(depth, 0x3f80_0000).unwrap();
    let (vertices, host) = (triangle(), Constants::default());
    let mut call =
        DrawCall::new(VertexSource::Transformed(&vertices), Primitive::TriangleList, &program, &host, target)
            .with_texture(0, texture, SamplerState::NEAREST_CLAMP);
    call.center = PixelCenter::OpenGl;
    call.depth = DepthState { test: Some(CompareFunction::Less), write: true };
    call.depth_buffer = Some(depth);
    machine.draw(&call).unwrap();
    machine.draw(&call).unwrap();
    call.alpha_test = Some(AlphaTest { function: CompareFunction::Always, reference: 0 });
    call.masks[0] = WriteMask(0b0111);
    machine.draw(&call).unwrap();
    machine.update_texture(texture, &Image::new_2d(TexelFormat::Bgr565, 8, 8).unwrap()).unwrap();
    let (fence, image) = machine.read_back_async(target).unwrap();
    assert_eq!(image.bytes().len(), 1024);
    machine.finish_fence(fence);
    machine.read_depth(depth).unwrap();

    let log = machine.take_log();
    let (texture, target, depth) = (ResourceId::Texture(0), ResourceId::Texture(1), ResourceId::Depth(0));
    let mut records = Vec::new();
    let without: Vec<Event> = log
        .into_iter()
        .filter(|e| {
            if let Event::Draw(d) = e {
                records.push((**d).clone());
                false
            } else {
                true
            }
        })
        .collect();
    let upload = Event::Upload { resource: texture, bytes: 128 };
    let mode = ReadBackMode::Asynchronous;
    assert_eq!(
        without,
        [
            upload.clone(),
            Event::Clear { resource: target, bytes: 1024 },
            Event::Clear { resource: depth, bytes: 512 },
            // The first draw sets all state; the second changes nothing; the third changes alpha test and masks.
            Event::StateChange { changes: 29, constants: 0 },
            Event::StateChange { changes: 2, constants: 0 },
            upload,
            Event::ReadBack { resource: target, bytes: 1024, mode, fence: Some(FenceId(1)) },
            Event::FinishFence(FenceId(1)),
            Event::ReadBack { resource: depth, bytes: 512, mode: ReadBackMode::Synchronous, fence: None },
        ]
    );
    let [first, _, third] = &records[..] else { panic!("three draws") };
    // Upper left half of 8 x 8 quads, including those on the diagonal; pixels on the diagonal belong to the other half.
    assert_eq!((first.quads, first.counts.fragments.generated), (36, 120));
    assert_eq!(first.targets, [TargetRecord { target, pixel_bytes: 4, written: true, read: false }]);
    let buffer = DepthRecord { buffer: depth, pixel_bytes: 2, test: true, write: true, replaced: false };
    assert_eq!(first.depth, Some(buffer));
    assert_eq!((first.reads(), first.writes()), (vec![texture, depth], vec![target, depth]));
    assert!(third.alpha_test && third.targets[0].read && !first.alpha_test);
    let bound = &first.samplers[0];
    assert_eq!((bound.texel_bytes, bound.texture_bytes, bound.trilinear), (2, 128, false));
}

fn work(text: &str, int: &[[i32; 4]], boolean: &[bool]) -> ProgramWork {
    ProgramWork::new(&assemble(text).unwrap(), FlowConstants { int, boolean })
}

#[test]
fn pairs_phases_and_dependent_reads_are_told_apart() {
    let two = work(
        "ps_1_4\ntexld r0, t0\ntexcrd r1.rgb, t1\nmul r0.rgb, r0, r1\n+mov r0.a, r0.a\nadd r1, r0, r0\nphase\n\
         texld r2, r1\ntexdepth r5\nmul r0, r0, r2",
        &[],
        &[],
    );
    let [first, second] = &two.phases[..] else { panic!("two phases") };
    assert_eq!((first.arithmetic.len(), first.textures.len()), (2, 2));
    assert_eq!((first.arithmetic[0].opcode, first.arithmetic[0].partner), (Opcode::Mul, Some(Opcode::Mov)));
    assert!(!first.textures[0].dependent && second.textures[0].dependent);
    assert_eq!(
        [first.textures[1].sampler, second.textures[0].sampler, second.textures[1].sampler],
        [None, Some(2), None]
    );
    assert_eq!((two.arithmetic_slots(), two.texture_slots()), (3, 4));
}

#[test]
fn loops_calls_and_branches_count_as_often_as_they_run() {
    let text = "ps_2_a\ndcl t0\nmov r0, t0\nrep i0\nadd r0, r0, r0\nrep i1\nmul r0, r0, r0\nendrep\nendrep\n\
                if b0\nrcp r0, r0.x\nelse\nrsq r0, r0.x\nrsq r0, r0.x\nendif\ncall l0\ncall l0\nmov oC0, r0\nret\n\
                label l0\nmax r0, r0, r0\nret";
    let slots = |boolean| work(text, &[[3, 0, 0, 0], [5, 0, 0, 0]], &[boolean]).arithmetic_slots();
    // mov, 3 add, 15 mul, the branch, 2 max, mov.
    assert_eq!((slots(true), slots(false)), (1 + 3 + 15 + 1 + 2 + 1, 1 + 3 + 15 + 2 + 2 + 1));
    assert_eq!(
        work("ps_2_a\ndefi i0, 7, 0, 0, 0\nrep i0\nadd r0, r0, r0\nendrep", &[[3; 4]], &[]).arithmetic_slots(),
        7
    );
}

#[test]
fn registers_are_live_from_their_write_to_their_last_read() {
    let live = |text: &str| work(text, &[], &[]).live_halves;
    assert_eq!(live("ps_2_0\ndcl t0\nmov r0, t0\nmov oC0, r0"), 2);
    assert_eq!(live("ps_2_0\ndcl t0\nmov_pp r0, t0\nmov_pp oC0, r0"), 1);
    // r1 replaces r0; r2 and r3 are live together.
    assert_eq!(live("ps_2_0\ndcl t0\nmov r0, t0\nmov r1, r0\nmov r2, r1\nmov r3, r2\nadd r2, r2, r3\nmov oC0, r2"), 4);
    // Components that are never read do not keep a register live.
    assert_eq!(live("ps_2_0\ndcl t0\nmov r0.xyz, t0\nmov r1.xyz, t0\ndp3 r0.w, r0, r1\nmov oC0, r0.w"), 4);
}

#[test]
fn registers_of_opengl_programs_weigh_two_halves_or_one() {
    let live = |lines: &str| work(&format!("!!FP1.0\n{lines}\nEND"), &[], &[]).live_halves;
    assert_eq!(live("MOVR R0, f[TEX0];\nMOVR o[COLR], R0;"), 2);
    assert_eq!(live("MOVR H0, f[TEX0];\nMOVR o[COLH], H0;"), 1, "the register counts, not the suffix");
    assert_eq!(live("MOVR R0, f[TEX0];\nMOVH H0, p[0];\nADDR R1, R0, H0;\nMOVR o[COLR], R1;"), 3);
    // R2 is never written, but it can be read and is zero.
    assert_eq!(live("MOVR R0, f[TEX0];\nADDR o[COLR], R0, R2;"), 4);
    // A conditional write also reads the register's old value.
    assert_eq!(live("MOVR R1, p[0];\nMOVRC R0, f[TEX0];\nMOVR R1 (GT), R0;\nMOVR o[COLR], R1;"), 4);
    let arb = |lines: &str| work(&format!("!!ARBfp1.0\nTEMP a, b;\n{lines}\nEND"), &[], &[]).live_halves;
    assert_eq!(arb("MOV a, fragment.color;\nSWZ b, a, 0, 1, 0, 1;\nMOV result.color, b;"), 2, "SWZ reads nothing here");
}

#[test]
fn fixed_point_is_told_apart() {
    let program =
        work("!!FP1.0\nMULX H0, f[COL0], p[0];\nMULX H1, f[TEX0], p[0];\nADDH o[COLH], H0, H1;\nEND", &[], &[]);
    let fixed: Vec<bool> = program.phases[0].arithmetic.iter().map(|slot| slot.fixed).collect();
    // Reading coordinates forces full precision, whatever the suffix.
    assert_eq!(fixed, [true, false, false]);
}
