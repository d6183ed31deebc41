//! Errors of invalid draws.

use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{
    AttributeStream, BoundTexture, DrawCall, ExecutorKind, Machine, StepRate, VertexSource, VertexStreams,
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

    let mut refuses = |what: &str, edit: &dyn Fn(&mut DrawCall<'_>)| {
        let mut call = call();
        edit(&mut call);
        let message = machine.draw(&call).expect_err(what).to_string();
        assert!(message.contains(what), "expected `{what}` in `{message}`");
    };
    refuses("does not hold", &|c| c.targets = vec![foreign]);
    refuses("(limits.render_targets)", &|c| c.targets = vec![target, target]);
    refuses("no target", &|c| c.targets.clear());
    refuses("no depth buffer", &|c| c.depth.test = Some(CompareFunction::Less));
    refuses("4x4", &|c| c.depth_buffer = Some(small));
    refuses("LineList", &|c| c.primitive = Primitive::LineList);
    refuses("viewport", &|c| c.viewport = Some(Viewport::new(0, 8)));
    refuses("index 2 is 9", &|c| c.indices = Some(&[0, 1, 9]));
    let bound = BoundTexture { texture: foreign, state: SamplerState::default() };
    refuses("does not hold", &|c| c.samplers[3] = Some(bound));
    let swapped = quads(&vertices, &vertex_program, &host, target);
    assert!(machine.draw(&swapped).is_err(), "a vertex program for pixels");

    assert!(machine.create_target(TexelFormat::Rgba32f, 8, 8).is_err(), "formats.target");
    let mut fits = |image: Image| machine.create_texture(image).is_ok();
    assert!(!fits(Image::new_2d(TexelFormat::Rgba16, 8, 8).unwrap()), "formats.texture");
    assert!(!fits(Image::new_2d(TexelFormat::Rgba8, 4096, 1).unwrap()), "limits.max_texture_size");
    // Each side of a volume has a separate limit: 256 on this card, versus 2048 for other textures.
    let limit = profile.limits.max_volume_size.unwrap();
    for side in 0..3 {
        for (length, is_allowed) in [(limit, true), (limit + 1, false)] {
            let mut extents = [1; 3];
            extents[side] = length;
            let volume = Image::new(TexelFormat::Rgba8, TextureKind::Volume, extents, 1).unwrap();
            assert_eq!(fits(volume), is_allowed, "limits.max_volume_size: {extents:?}");
        }
    }
    let data = [[0; 4]; 3];
    let one = |register, step| AttributeStream { register, step, data: &data };
    let both = vec![one(1, StepRate::Instance), one(1, StepRate::Instance)];
    for (streams, vertex_count, instance_count, expected) in [
        (vec![one(0, StepRate::Vertex)], 4, 2, "has 3 entries, the draw needs 4 (one per vertex)"),
        (vec![one(16, StepRate::Instance)], 4, 2, "found v16"),
        (both, 4, 2, "two streams feed v1"),
        (Vec::new(), 0, usize::MAX, "instances, a draw can have 16777216"),
    ] {
        let streams = VertexStreams { vertex_count, instance_count, streams };
        let source = VertexSource::Program { program: &vertex_program, constants: &host, streams };
        let call = DrawCall::new(source, Primitive::QuadList, &program, &host, target);
        let message = machine.draw(&call).unwrap_err().to_string();
        assert!(message.contains(expected), "expected `{expected}` in `{message}`");
    }
    assert_eq!(machine.read_back(target).unwrap().bytes(), [0; 256], "nothing was drawn");
}
