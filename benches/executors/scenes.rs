//! Draws with one bottleneck each.
//!
//! `texture reads: 8 dependent, linear` and `triangles: 2 pixels each, blended` model a glossy frame of 512 x 512
//! pixels on a mesh of 50,000 vertices. Figure to beat: 1 s for `crossbar cpca card` on two threads.

use std::fmt::Write as _;

use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{
    AttributeStream, DepthId, DrawCall, ExecutorKind, Machine, StepRate, TextureId, VertexSource, VertexStreams,
};
use refsim::output::{BlendFactor, BlendOp, BlendState, CompareFunction, DepthFormat, DepthState};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{Filter, Image, SamplerState, TexelFormat};

const ONE: u32 = 0x3f80_0000;

/// A draw in single precision.
pub(crate) struct Scene {
    /// Name in the table.
    pub(crate) name: &'static str,
    side: u32,
    pixel: CheckedProgram,
    geometry: Geometry,
    filter: Filter,
    /// `true` to blend fragments additively.
    blended: bool,
    /// `true` to count vertices instead of fragments.
    counts_vertices: bool,
}

enum Geometry {
    /// Transformed vertices of triangles.
    Triangles(Vec<Vertex>),
    /// Vertices of triangles, for a vertex program.
    Program(Box<CheckedProgram>, Vec<[u32; 4]>),
}

/// All scenes; they are smaller for the scalar executor, which needs milliseconds instead of microseconds.
pub(crate) fn all(kind: ExecutorKind) -> Vec<Scene> {
    let (side, vertices) = match kind {
        ExecutorKind::Scalar => (32, 3 * 1024),
        _ => (256, 3 * 65_536),
    };
    let of = |name, pixel: &str, geometry| Scene {
        name,
        side,
        pixel: program(pixel),
        geometry,
        filter: Filter::Nearest,
        blended: false,
        counts_vertices: false,
    };
    let shade = "ps_2_0\ndcl v0\nmov oC0, v0\n";
    vec![
        of("texture reads: 8 dependent", &dependent_reads(), Geometry::Triangles(screen())),
        Scene {
            filter: Filter::Linear,
            ..of("texture reads: 8 dependent, linear", &dependent_reads(), Geometry::Triangles(screen()))
        },
        of("1024 instructions", &long_program(), Geometry::Triangles(screen())),
        of("triangles: 10 pixels each", shade, Geometry::Triangles(carpet(side, 4.5))),
        Scene {
            blended: true,
            ..of("triangles: 2 pixels each, blended", shade, Geometry::Triangles(carpet(side, 2.0)))
        },
        Scene {
            counts_vertices: true,
            ..of(
                "vertex program: 30 instructions",
                shade,
                Geometry::Program(Box::new(program(&vertex_program())), corners(vertices)),
            )
        },
    ]
}

fn profile() -> Profile {
    Profile::named("ideal-fp32").expect("an ideal device of any format")
}

fn program(text: &str) -> CheckedProgram {
    check(assemble(text).expect("the program assembles"), &profile()).expect("an ideal device takes it")
}

/// A program in which each read's result is the coordinates of the next read.
fn dependent_reads() -> String {
    let mut text = "ps_2_a\ndcl t0.xy\ndcl_2d s0\ntexld r0, t0, s0\n".to_owned();
    for _ in 1..8 {
        text.push_str("texld r0, r0, s0\n");
    }
    text.push_str("mov oC0, r0\n");
    text
}

/// A program of 1024 instructions, each of which depends on the previous one.
fn long_program() -> String {
    let mut text =
        "ps_2_a\ndef c0, 0.5, -0.25, 0.125, 0.75\ndef c1, 0.25, 1, -0.5, 0.125\ndcl t0\nmov r1, t0\n".to_owned();
    for i in 0..1022 {
        let (to, from) = (i % 2, (i + 1) % 2);
        let _: Result<(), std::fmt::Error> = writeln!(text, "mad r{to}, r{from}, c0, c1");
    }
    text.push_str("mov oC0, r1\n");
    text
}

/// A vertex program that computes four vectors from a position.
fn vertex_program() -> String {
    let mut text = "vs_1_1\ndef c8, 0.5, 0.25, 0.125, 1\ndcl_position v0\n".to_owned();
    for i in 0..26 {
        let (to, from) = (i % 4, (i + 1) % 4);
        let _: Result<(), std::fmt::Error> = match i {
            0..4 => writeln!(text, "mul r{to}, v0, c8"),
            _ => writeln!(text, "mad r{to}, v0, c8, r{from}"),
        };
    }
    text.push_str("mov oPos, v0\nmov oD0, r0\nadd oT0, r1, r2\nmov oT1, r3\n");
    text
}

fn vertex(x: f32, y: f32, s: f32, t: f32) -> Vertex {
    let mut vertex = Vertex { position: [x.to_bits(), y.to_bits(), 0.5f32.to_bits(), ONE], ..Vertex::default() };
    vertex.texcoords[0] = [s.to_bits(), t.to_bits(), 0, ONE];
    vertex.colors[0] = [s.to_bits(), t.to_bits(), 0.5f32.to_bits(), ONE];
    vertex
}

/// Two triangles over the whole target.
fn screen() -> Vec<Vertex> {
    let [a, b, c, d] = [
        vertex(-1.0, 1.0, 0.0, 0.0),
        vertex(1.0, 1.0, 1.0, 0.0),
        vertex(1.0, -1.0, 1.0, 1.0),
        vertex(-1.0, -1.0, 0.0, 1.0),
    ];
    vec![a, b, c, a, c, d]
}

/// Triangles in squares of `pixels` pixels, two per square.
fn carpet(side: u32, pixels: f32) -> Vec<Vertex> {
    let count = (side as f32 / pixels) as u32;
    let at = |i: u32| 2.0 * i as f32 / count as f32 - 1.0;
    let mut vertices = Vec::new();
    for y in 0..count {
        for x in 0..count {
            let corner = |dx: u32, dy: u32| vertex(at(x + dx), -at(y + dy), dx as f32, dy as f32);
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            vertices.extend([a, b, c, a, c, d]);
        }
    }
    vertices
}

/// Triangles too small to cover a pixel.
fn corners(count: usize) -> Vec<[u32; 4]> {
    let corner = |i: usize| {
        let (x, y) = ((i / 3 % 256) as f32 / 128.0 - 1.0, (i / 768) as f32 / 128.0 - 1.0);
        let shift = [[0.0, 0.0], [0.001, 0.0], [0.0, 0.001]][i % 3];
        [(x + shift[0]).to_bits(), (y + shift[1]).to_bits(), 0.5f32.to_bits(), ONE]
    };
    (0..count).map(corner).collect()
}

/// A machine with the resources of a scene.
pub(crate) struct Card {
    machine: Machine,
    target: TextureId,
    depth: DepthId,
    texture: TextureId,
}

impl Card {
    pub(crate) fn new(scene: &Scene, kind: ExecutorKind) -> Self {
        let mut machine = Machine::new(profile(), kind);
        let target = machine.create_target(TexelFormat::Rgba8, scene.side, scene.side).expect("a target");
        let depth = machine.create_depth(DepthFormat::Unorm24, scene.side, scene.side).expect("a depth buffer");
        // Neighboring texels point to distant ones.
        let bytes = (0..256 * 256u32).flat_map(|i| i.wrapping_mul(0x9e37_79b9).to_le_bytes()).collect();
        let image = Image::from_bytes(TexelFormat::Rgba8, refsim::texture::TextureKind::D2, [256, 256, 1], 1, bytes)
            .expect("a texture of its size");
        let texture = machine.create_texture(image).expect("an ideal device has rgba8");
        Self { machine, target, depth, texture }
    }

    /// Draws, and returns the numbers of fragments and vertices.
    pub(crate) fn draw(&mut self, scene: &Scene) -> (u64, u64) {
        let constants = Constants::default();
        let streams = |data| VertexStreams {
            vertex_count: <[_]>::len(data),
            instance_count: 1,
            streams: vec![AttributeStream { register: 0, step: StepRate::Vertex, data }],
        };
        let vertices = match &scene.geometry {
            Geometry::Triangles(vertices) => VertexSource::Transformed(vertices),
            Geometry::Program(program, data) => {
                VertexSource::Program { program, constants: &constants, streams: streams(data) }
            }
        };
        let state = SamplerState { min: scene.filter, mag: scene.filter, ..SamplerState::NEAREST_CLAMP };
        let mut call = DrawCall::new(vertices, Primitive::TriangleList, &scene.pixel, &constants, self.target)
            .with_texture(0, self.texture, state);
        call.blend = scene.blended.then_some(BlendState::both(BlendFactor::One, BlendFactor::One, BlendOp::Add));
        call.center = PixelCenter::OpenGl;
        call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
        call.depth_buffer = Some(self.depth);
        let events = self.machine.draw(&call).expect("the machine draws");
        (events.fragments.shaded, events.vertices)
    }

    /// Elements of one draw.
    pub(crate) fn elements(&mut self, scene: &Scene) -> u64 {
        let (fragments, vertices) = self.draw(scene);
        if scene.counts_vertices { vertices } else { fragments }
    }
}
