//! Tests small triangles, whose fragments the batch executor packs into the lanes of a batch, against the scalar
//! executor's bits and counts, for all kinds of programs and output state.

use crate::environment::by_form;
use crate::random::Random;
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::event::DrawEvents;
use refsim::exec::Constants;
use refsim::machine::{DrawCall, ExecutorKind, Machine, MachineError, VertexSource};
use refsim::num::Format;
use refsim::output::{
    AlphaTest, BlendFactor, BlendOp, BlendState, CompareFunction, DepthFormat, DepthState, WriteMask,
};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{Filter, Image, SamplerState, TargetRounding, TexelFormat, TextureKind};

impl Random {
    /// Within [-1, 1].
    fn spread(&mut self) -> f32 {
        self.below(2001) as f32 / 1000.0 - 1.0
    }
}

/// Programs without and with differences, with kill, depth output, and branches.
const PROGRAMS: [&str; 7] = [
    "ps_2_0\ndcl t0\ndcl t1\ndcl_2d s0\ntexld r0, t0, s0\nmad r0, r0, t1, t0\nmov oC0, r0\n",
    "!!FP1.0\nTEX R0, f[TEX0], TEX0, 2D;\nDDX R1, f[TEX1];\nDDY R2, f[TEX1];\nMADR R0, R1, R2, R0;\n\
     MADR R0, f[WPOS], {0.01}.x, R0;\nMOVR o[COLR], R0;\nEND",
    "ps_2_0\ndcl t0\ndcl t1\ndcl_2d s0\ntexld r0, t0, s0\nsub r1, r0, t1\ntexkill r1\nmov oC0, r0\n",
    "ps_2_0\ndcl t0\nmov r0, t0\nmov oC0, r0\nmov oDepth, r0.x\n",
    "!!FP1.0\nMADR R0, f[WPOS], {0.03}.x, f[TEX0];\nMOVR o[COLR], R0;\nEND",
    "ps_2_a\ndef c0, 0, 0.5, 1, 0\ndefi i0, 3, 0, 0, 0\ndcl t0\ndcl t1\nmov r0, t0\nrep i0\nadd r0, r0, t1\n\
     break_gt r0.x, c0.z\nendrep\nif_lt r0.y, c0.x\nmov r0, t1\nendif\nmov oC0, r0\n",
    "ps_2_a\ndef c0, 0, 0.5, 1, 0\ndcl t0\ndcl t1\ndsx r1, t0\nmov r0, t1\nif_lt r0.y, c0.x\nadd r0, r0, r1\nelse\n\
     texkill t0\nendif\nmov oC0, r0\n",
];

/// A draw of many small triangles, and some larger ones.
struct SmallTriangles {
    size: [u32; 2],
    program: &'static str,
    vertices: Vec<Vertex>,
    target: TexelFormat,
    blend: Option<BlendState>,
    depth: DepthState,
    depth_format: DepthFormat,
    alpha: Option<AlphaTest>,
    mask: WriteMask,
    iterators: &'static str,
    register: &'static str,
}

impl SmallTriangles {
    fn new(r: &mut Random) -> Self {
        let size = r.of(&[[16, 16], [40, 33], [17, 30], [300, 1], [290, 2], [7, 5], [1, 1]]);
        let ops = [BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max];
        let factors = BlendFactor::ALL;
        let blend = BlendState::both(r.of(factors), r.of(factors), r.of(&ops));
        let add = BlendState::both(BlendFactor::One, BlendFactor::One, BlendOp::Add);
        let test = (r.below(5) > 0).then(|| r.of(CompareFunction::ALL));
        let function = r.of(CompareFunction::ALL);
        Self {
            size,
            program: r.of(&PROGRAMS),
            vertices: triangles(size, r),
            target: r.of(&[TexelFormat::Bgra8, TexelFormat::Rgba32f, TexelFormat::Rgba16f, TexelFormat::Rg16]),
            blend: r.of(&[None, Some(add), Some(blend)]),
            depth: DepthState { test, write: r.coin() },
            depth_format: r.of(DepthFormat::ALL),
            alpha: (r.below(4) == 0).then_some(AlphaTest { function, reference: 0x3e80_0000 }),
            mask: WriteMask(if r.below(3) == 0 { r.below(16) } else { 15 }),
            iterators: r.of(&["fp32", "fp32", "fp32", "fp16", "s7.16"]),
            register: r.of(&["fp32", "fp24", "s3.12", "n3.8:rna", "fp16:rtz"]),
        }
    }
}

fn triangles(size: [u32; 2], r: &mut Random) -> Vec<Vertex> {
    let (flat, plane) = (r.below(3) == 0, r.coin());
    let mut out = Vec::new();
    let mut shared = Vertex::default();
    let mut center = [0.0, 0.0];
    for number in 0..20 + r.below(180) {
        if number == 0 || r.below(20) == 0 {
            shared.texcoords = std::array::from_fn(|_| [(); 4].map(|()| r.spread().to_bits()));
        }
        if r.below(3) > 0 {
            center = [r.spread(), r.spread()];
        }
        let reach = if r.below(25) == 0 { 40.0 } else { 0.5 + r.below(6) as f32 };
        for _ in 0..3 {
            let mut v = shared;
            if !flat {
                v.texcoords[0] = [(); 4].map(|()| r.spread().to_bits());
                v.texcoords[1][r.below(4)] = r.spread().to_bits();
            }
            let w = if plane { 1.0 } else { 1.5 + r.spread() };
            let [x, y] = [0, 1].map(|axis| (center[axis] + r.spread() * reach / size[axis] as f32) * w);
            v.position = [x, y, (0.5 + 0.5 * r.spread()) * w, w].map(f32::to_bits);
            out.push(v);
        }
    }
    out
}

type Drawn = Result<(Vec<u8>, Vec<u32>, DrawEvents), MachineError>;

fn drawn(fine: &SmallTriangles, kind: ExecutorKind, threads: usize, budget: Option<u32>) -> Drawn {
    let mut profile = Profile::named("ideal-fp32").unwrap();
    profile.set_format(fine.register.parse::<Format>().unwrap()).unwrap();
    profile.rules.iterator_format = fine.iterators.parse().unwrap();
    if let Some(steps) = budget {
        profile.limits.set_step_budget(steps);
    }
    let program = check(assemble(fine.program).unwrap(), &profile).unwrap();
    let mut machine = Machine::with_threads(profile, kind, threads).unwrap();
    let [width, height] = fine.size;
    let target = machine.create_target(fine.target, width, height).unwrap();
    let depth = machine.create_depth(fine.depth_format, width, height).unwrap();
    machine.clear_depth(depth, 0x3f00_0000).unwrap();
    let texels: Vec<[u32; 4]> =
        (0..15u32).map(|i| [i, 3 * i, 7 * i, i * i].map(|x| (x as f32 / 64.0).to_bits())).collect();
    let image = Image::from_values(
        TexelFormat::Rgba16,
        TextureKind::D2,
        [3, 5, 1],
        Format::FP32,
        &texels,
        TargetRounding::Nearest,
    );
    let texture = machine.create_texture(image.unwrap()).unwrap();
    let constants = Constants::default();
    let source = VertexSource::Transformed(&fine.vertices);
    let linear = SamplerState { min: Filter::Linear, mag: Filter::Linear, ..SamplerState::NEAREST_CLAMP };
    let mut call =
        DrawCall::new(source, Primitive::TriangleList, &program, &constants, target).with_texture(0, texture, linear);
    call.center = PixelCenter::OpenGl;
    call.depth = fine.depth;
    call.depth_buffer = Some(depth);
    call.blend = fine.blend;
    call.alpha_test = fine.alpha;
    call.masks[0] = fine.mask;
    let events = machine.draw(&call)?;
    let depths = machine.read_depth(depth).unwrap().data().to_vec();
    Ok((machine.read_back(target).unwrap().bytes().to_vec(), depths, events))
}

#[test]
fn fine_triangles_are_drawn_alike() {
    let cases = by_form(500, 20_000);
    let (mut r, mut passed) = (Random::new(1), 0);
    for case in 0..cases {
        let fine = SmallTriangles::new(&mut r);
        let what = || {
            let SmallTriangles {
                size,
                program,
                target,
                blend,
                depth,
                depth_format,
                alpha,
                mask,
                iterators,
                register,
                ..
            } = &fine;
            format!(
                "case {case}, {size:?} {target}, {blend:?}, {depth:?} {depth_format:?}, {alpha:?}, {mask:?}, \
                 {iterators}, {register}\n{program}"
            )
        };
        let expected = drawn(&fine, ExecutorKind::Scalar, 1, None).unwrap();
        for threads in [1, 3] {
            let found = drawn(&fine, ExecutorKind::Batch, threads, None).unwrap();
            assert_eq!(found.2, expected.2, "{}: counts", what());
            assert!(found.1 == expected.1, "{}: depths", what());
            let differing = found.0.iter().zip(&expected.0).position(|(a, b)| a != b);
            assert_eq!(differing, None, "{}: the first byte that differs", what());
        }
        passed += expected.2.fragments.passed;
    }
    assert!(passed > 50 * cases, "{passed} fragments reach a target");
}

/// The first fragment of many small triangles that exceeds the step budget is the one reported.
#[test]
fn overruns_in_fine_triangles_are_reported_alike() {
    let mut r = Random::new(7);
    let mut overruns = 0;
    for case in 0..60 {
        let fine = SmallTriangles { program: PROGRAMS[5], ..SmallTriangles::new(&mut r) };
        for budget in [9, 12, 14, 15] {
            let expected = drawn(&fine, ExecutorKind::Scalar, 1, Some(budget)).map_err(|e| e.to_string());
            let found = drawn(&fine, ExecutorKind::Batch, 3, Some(budget)).map_err(|e| e.to_string());
            assert!(found == expected, "case {case}, budget {budget}: {:?}, {:?}", found.err(), expected.err());
            overruns += usize::from(expected.is_err());
        }
    }
    assert!((1..240).contains(&overruns), "{overruns} of 240 draws overrun");
}
