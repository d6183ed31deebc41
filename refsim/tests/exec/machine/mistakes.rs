//! Errors of invalid draws.

use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{
    AttributeStream, BoundTexture, DrawCall, ExecutorKind, Machine, MachineError, StepRate, VertexSource, VertexStreams,
};
use refsim::output::{CompareFunction, DepthFormat};
use refsim::raster::{Primitive, Viewport};
use refsim::texture::{Image, SamplerState, TexelFormat, TextureKind};

use super::{COLOR, quads, screen};
use crate::running::{checked, ideal};

#[test]
fn every_mistake_has_its_error() {
    let profile = Profile::named("r200").unwrap();
    let program = checked(COLOR, &profile);
    let vertex_program = checked("vs_1_1\ndcl_position v0\nmov oPos, v0", &profile);
    let mut machine = Machine::new(profile.clone(), ExecutorKind::Scalar);
    let mut other = Machine::new(ideal("e8m23"), ExecutorKind::Scalar);
    let target = machine.create_target(TexelFormat::Bgra8, 8, 8).unwrap();
    let small = machine.create_depth(DepthFormat::Unorm16, 4, 4).unwrap();
    let vertices = screen(8);
    let host = Constants::default();
    let call = || quads(&vertices, &program, &host, target);
    let foreign = (0..9).map(|_| other.create_target(TexelFormat::Rgba32f, 8, 8).unwrap()).last().unwrap();

    let mut check = |edit: &dyn Fn(&mut DrawCall<'_>), expected: &str| {
        let mut call = call();
        edit(&mut call);
        let message = machine.draw(&call).expect_err(expected).to_string();
        assert!(message.contains(expected), "expected `{expected}` in `{message}`");
    };
    check(&|c| c.targets = vec![foreign], "does not hold");
    check(&|c| c.targets = vec![target, target], "allows 1 (limits.render_targets)");
    check(&|c| c.targets.clear(), "no target");
    check(&|c| c.depth.test = Some(CompareFunction::Less), "no depth buffer");
    check(&|c| c.depth_buffer = Some(small), "4x4");
    check(&|c| c.primitive = Primitive::LineList, "LineList");
    check(&|c| c.viewport = Some(Viewport::new(0, 8)), "viewport");
    check(&|c| c.indices = Some(&[0, 1, 9]), "index 2 is 9");
    let bound = BoundTexture { texture: foreign, state: SamplerState::default() };
    check(&|c| c.samplers[3] = Some(bound), "does not hold");

    let bad = |e: MachineError| e.to_string();
    assert!(bad(machine.create_target(TexelFormat::Rgba32f, 8, 8).unwrap_err()).contains("(formats.target)"));
    assert!(
        bad(machine.create_texture(Image::new_2d(TexelFormat::Rgba16, 8, 8).unwrap()).unwrap_err())
            .contains("(formats.texture)")
    );
    assert!(
        bad(machine.create_texture(Image::new_2d(TexelFormat::Rgba8, 4096, 1).unwrap()).unwrap_err())
            .contains("max_texture_size")
    );
    // Each side of a volume has a separate limit: 256 on this card, versus 2048 for other textures.
    let limit = machine.profile().limits.max_volume_size.unwrap();
    for side in 0..3 {
        let mut extents = [1; 3];
        extents[side] = limit;
        let volume = |extents| Image::new(TexelFormat::Rgba8, TextureKind::Volume, extents, 1).unwrap();
        machine.create_texture(volume(extents)).unwrap();
        extents[side] += 1;
        let expected = format!(
            "volume texture is {}x{}x{}, `{}` allows {limit} per side (limits.max_volume_size)",
            extents[0],
            extents[1],
            extents[2],
            machine.profile().name
        );
        assert_eq!(bad(machine.create_texture(volume(extents)).unwrap_err()), expected);
    }
    let swapped = quads(&vertices, &vertex_program, &host, target);
    assert!(bad(machine.draw(&swapped).unwrap_err()).contains("expected a Pixel program, found `vs_1_1`"));
    let data = [[0; 4]; 3];
    for (streams, expected) in [
        (vec![(0, StepRate::Vertex)], "has 3 entries, the draw needs 4 (one per vertex)"),
        (vec![(16, StepRate::Instance)], "found v16"),
        (vec![(1, StepRate::Instance), (1, StepRate::Instance)], "two streams feed v1"),
    ] {
        let streams =
            streams.into_iter().map(|(register, step)| AttributeStream { register, step, data: &data }).collect();
        let streams = VertexStreams { vertex_count: 4, instance_count: 2, streams };
        let source = VertexSource::Program { program: &vertex_program, constants: &host, streams };
        let message =
            bad(machine.draw(&DrawCall::new(source, Primitive::QuadList, &program, &host, target)).unwrap_err());
        assert!(message.contains(expected), "expected `{expected}` in `{message}`");
    }
    let streams = VertexStreams { vertex_count: 0, instance_count: usize::MAX, streams: Vec::new() };
    let source = VertexSource::Program { program: &vertex_program, constants: &host, streams };
    let message = bad(machine.draw(&DrawCall::new(source, Primitive::QuadList, &program, &host, target)).unwrap_err());
    assert!(message.contains("instances, a draw can have 16777216"), "{message}");
    assert_eq!(machine.read_back(target).unwrap().bytes(), [0; 256], "nothing was drawn");
}
