//! "Targets and depth": outputs of ps_1_x, clears, depth in OpenGL.

use super::running::{checked, constants};
use super::texels::table;
use super::{Random, probes};
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::{ClipSpace, Primitive, Vertex, Viewport};
use refsim::texture::{TargetRounding, TexelFormat};

/// An ideal device of the format; stores to targets truncate or round to nearest.
fn profile(format: &str, truncate: bool) -> Profile {
    let mut profile = Profile::named(&format!("ideal-{format}")).unwrap();
    profile.rules.target_rounding = if truncate { TargetRounding::Truncate } else { TargetRounding::Nearest };
    profile
}

#[test]
fn clears_go_from_singles_into_the_target() {
    let mut r = Random::new(7);
    for (format, _, channels) in table() {
        for truncate in [false, true] {
            let mut machine = Machine::new(profile("s3.12", truncate), ExecutorKind::Scalar);
            let target = machine.create_target(format, 1, 1).unwrap();
            for _ in 0..probes(40) {
                let color = [0; 4].map(|_| r.single());
                machine.clear_target(target, color.map(super::clean)).unwrap();
                let stored = channels.iter().map(|c| c.place(c.store(color[c.component()], truncate)));
                let expected = stored.fold(0, |raw, more| raw | more);
                assert_eq!(machine.read_back(target).unwrap().raw(0, 0, 0, 0), expected, "{format}: {color:?}");
            }
        }
    }
}

/// A triangle over a one-pixel target at one clip-space depth.
fn triangle(z: f32, w: f32) -> [Vertex; 3] {
    [[-3.0, -3.0], [3.0, -3.0], [0.0, 6.0]]
        .map(|[x, y]: [f32; 2]| Vertex { position: [x * w, y * w, z, w].map(f32::to_bits), ..Vertex::default() })
}

/// Draws the triangle; returns the first texel of the target and of the depth buffer.
fn draw(machine: &mut Machine, text: &str, host: &Constants, vertices: &[Vertex], viewport: Viewport) -> (u128, u32) {
    let program = checked(text, machine.profile());
    let target = machine.create_target(TexelFormat::Rgba32f, 1, 1).unwrap();
    let depth = machine.create_depth(DepthFormat::Float32, 1, 1).unwrap();
    let source = VertexSource::Transformed(vertices);
    let call = DrawCall {
        clip_space: ClipSpace::OpenGl,
        viewport: Some(viewport),
        depth: DepthState { test: Some(CompareFunction::Always), write: true },
        depth_buffer: Some(depth),
        ..DrawCall::new(source, Primitive::TriangleList, &program, host, target)
    };
    assert_eq!(machine.draw(&call).unwrap().fragments.passed, 1);
    (machine.read_back(target).unwrap().raw(0, 0, 0, 0), machine.read_depth(depth).unwrap().data()[0])
}

#[test]
fn ps_1_x_is_clamped_for_float_targets_too() {
    let mut machine = Machine::new(profile("s3.12", false), ExecutorKind::Scalar);
    let host = constants(&[[1.0, -1.0, 0.5, 0.25]]);
    let text = "ps_1_4\nadd r0, c0, c0";
    let (raw, _) = draw(&mut machine, text, &host, &triangle(0.0, 1.0), Viewport::new(1, 1));
    let channel = |i: u32| f32::from_bits((raw >> (32 * i)) as u32);
    assert_eq!([0, 1, 2, 3].map(channel), [1.0, 0.0, 1.0, 0.5], "2, -2, 1, 0.5");
    let later = "ps_2_0\nadd r0, c0, c0\nmov oC0, r0";
    let (raw, _) = draw(&mut machine, later, &host, &triangle(0.0, 1.0), Viewport::new(1, 1));
    assert_eq!(f32::from_bits((raw >> 32) as u32), -2.0);
}

#[test]
fn depth_of_opengl() {
    let mut r = Random::new(8);
    let mut machine = Machine::new(profile("fp32", false), ExecutorKind::Scalar);
    for _ in 0..probes(200) {
        let (w, near, far) = (r.between(0.1, 5.0), r.between(0.0, 0.5), r.between(0.5, 1.0));
        let z = r.between(-w, w);
        let viewport = Viewport { min_depth: near.to_bits(), max_depth: far.to_bits(), ..Viewport::new(1, 1) };
        let host = Constants::default();
        let text = "ps_2_0\ndef c0, 0, 0, 0, 0\nmov oC0, c0";
        let (_, found) = draw(&mut machine, text, &host, &triangle(z, w), viewport);
        let expected = (z / w * 0.5 + 0.5) * (far - near) + near;
        assert_eq!(f32::from_bits(found), expected, "{z} / {w}, {near} to {far}");
    }
}
