//! Random geometry: ordinary and extreme inputs for the rasterizer.

use crate::random::Random;
use crate::scene::Scene;
use refsim::machine::StepRate;
use refsim::raster::{Primitive, Vertex};
use strum::{IntoStaticStr, VariantArray};

/// A kind of geometry.
#[derive(Clone, Copy, Debug, IntoStaticStr, PartialEq, Eq, VariantArray)]
#[strum(serialize_all = "snake_case")]
pub(crate) enum Shape {
    /// A few triangles in view.
    Ordinary,
    /// Quads over the whole target, with everything constant except the position.
    Flat,
    /// Many quads over one another, most of them over the whole target.
    Layers,
    /// Triangles that leave the view through every plane.
    Clipped,
    /// Coordinates far beyond the view.
    Huge,
    /// No or almost no area, or edges through pixel centers.
    Degenerate,
    /// Positions and values that are NaN or infinite.
    Special,
    /// Many triangles of a few pixels, side by side and overlapping.
    Fine,
}

/// Vertices, and the primitives that they form.
pub(crate) struct Geometry {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) indices: Option<Vec<u32>>,
    pub(crate) primitive: Primitive,
}

/// A shape for programs whose results must be visible: mostly ordinary.
pub(crate) fn ordinary(r: &mut Random) -> Shape {
    if r.one_in(3) { r.of(Shape::VARIANTS) } else { Shape::Ordinary }
}

/// Width and height of the targets: some fit in a tile, some span several, some have one row of quads.
pub(crate) fn size(shape: Shape, r: &mut Random) -> [u32; 2] {
    if r.one_in(12) {
        return [1 + r.below(530), 1 + r.below(2)];
    }
    let (w, h) = if shape == Shape::Layers { (20, 18) } else { (34, 30) };
    [1 + r.below(w) as u32, 1 + r.below(h) as u32]
}

pub(crate) const PRIMITIVES: [Primitive; 5] = [
    Primitive::TriangleList,
    Primitive::TriangleStrip,
    Primitive::TriangleFan,
    Primitive::QuadList,
    Primitive::QuadStrip,
];

const CORNERS: [(f32, f32); 4] = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];

/// Geometry of a shape for a target of `size`.
pub(crate) fn geometry(shape: Shape, size: [u32; 2], r: &mut Random) -> Geometry {
    let primitive = match shape {
        Shape::Flat | Shape::Layers => Primitive::QuadList,
        _ => r.of(&PRIMITIVES),
    };
    let each = match primitive {
        Primitive::TriangleList => 3,
        Primitive::TriangleStrip | Primitive::TriangleFan => 3 + r.below(2),
        _ => 4,
    };
    if shape == Shape::Fine {
        let vertices = fine(size, each, r);
        let indices = r.one_in(3).then(|| (0..vertices.len() as u32).rev().collect());
        return Geometry { vertices, indices, primitive };
    }
    let groups = match shape {
        Shape::Layers => 3 + r.below(10),
        Shape::Flat => 1 + r.below(2),
        _ => 1 + r.below(3),
    };
    let mut vertices = Vec::new();
    for _ in 0..groups {
        group(shape, size, each, r, &mut vertices);
    }
    let count = vertices.len();
    let indices = r.one_in(6).then(|| (0..count + r.below(4)).map(|i| ((i * 7 + r.below(2)) % count) as u32).collect());
    Geometry { vertices, indices, primitive }
}

/// Vertices of 10 to 120 primitives of a few pixels each, some far larger. Some reuse the constant components of the
/// previous primitive; some vary only their position.
fn fine(size: [u32; 2], each: usize, r: &mut Random) -> Vec<Vertex> {
    let (flat, plane) = (r.one_in(2), r.one_in(2));
    let mut shared = Vertex::default();
    let mut center = [0.0; 2];
    let mut out = Vec::new();
    for number in 0..10 + r.below(110) {
        if number == 0 || r.one_in(if flat { 12 } else { 3 }) {
            shared.texcoords = std::array::from_fn(|_| r.vector());
            shared.colors = [r.vector(), r.vector()];
            shared.fog = r.number();
        }
        if number == 0 || !r.one_in(4) {
            center = [0, 1].map(|_| r.below(2001) as f32 / 1000.0 - 1.0);
        }
        let reach = if r.one_in(16) { 40.0 } else { 1.0 + r.below(5) as f32 };
        for _ in 0..each {
            let mut v = shared;
            if !flat {
                v.texcoords[r.below(4)] = r.vector();
                v.colors[r.below(2)] = r.vector();
            }
            let w = if plane { 1.0f32 } else { 0.5 + r.below(100) as f32 / 50.0 };
            let near = |r: &mut Random, axis: usize| {
                let offset = (r.below(2001) as f32 / 1000.0 - 1.0) * reach / size[axis] as f32;
                ((center[axis] + offset) * w).to_bits()
            };
            let (x, y) = (near(r, 0), near(r, 1));
            v.position = [x, y, (r.below(1000) as f32 / 1000.0 * w).to_bits(), w.to_bits()];
            out.push(v);
        }
    }
    out
}

/// The vertices of one primitive, which share the components that do not vary.
fn group(shape: Shape, size: [u32; 2], each: usize, r: &mut Random, out: &mut Vec<Vertex>) {
    let whole = matches!(shape, Shape::Flat | Shape::Layers);
    let flat = if whole { !r.one_in(4) } else { r.one_in(3) };
    let plane = if whole { !r.one_in(6) } else { r.one_in(2) };
    let full = if whole { !r.one_in(4) } else { r.one_in(2) && plane };
    let shared = Vertex {
        texcoords: std::array::from_fn(|_| r.vector()),
        colors: [r.vector(), r.vector()],
        fog: r.number(),
        ..Vertex::default()
    };
    let start = out.len();
    for corner in 0..each {
        let mut v = shared;
        if !flat {
            for set in &mut v.texcoords {
                if !r.one_in(3) {
                    *set = r.vector();
                }
            }
            v.colors = [r.vector(), r.vector()];
        } else if whole && r.one_in(2) {
            // As in a crossbar: one coordinate set identifies the pixel, all others are constant.
            let (x, y) = CORNERS[corner % 4];
            v.texcoords[0] = [(x * 0.5 + 0.5).to_bits(), (y * -0.5 + 0.5).to_bits(), 0, 0x3f80_0000];
        }
        v.position = if full && matches!(shape, Shape::Ordinary | Shape::Flat | Shape::Layers) {
            let (x, y) = CORNERS[corner % 4];
            let z = if r.one_in(3) { r.below(1000) as f32 / 1000.0 } else { 0.5 };
            [x.to_bits(), y.to_bits(), z.to_bits(), 0x3f80_0000]
        } else {
            position(shape, size, plane, r)
        };
        if shape == Shape::Degenerate && out.len() > start && r.one_in(3) {
            v.position = out[start].position;
        }
        out.push(v);
    }
}

fn position(shape: Shape, size: [u32; 2], plane: bool, r: &mut Random) -> [u32; 4] {
    let thousandth = |r: &mut Random, range: usize| (r.below(2 * range + 1) as f32 - range as f32) / 1000.0;
    let w = if plane { 1.0f32 } else { 0.5 + r.below(100) as f32 / 50.0 };
    match shape {
        Shape::Clipped => {
            let w = if r.one_in(3) { thousandth(r, 2000) } else { w };
            [thousandth(r, 12_000), thousandth(r, 12_000), thousandth(r, 2000), w].map(f32::to_bits)
        }
        Shape::Huge => {
            let scale = |r: &mut Random| {
                let far = if r.one_in(4) { 120 } else { 24 };
                f32::from_bits((127 + r.below(far) as u32) << 23)
            };
            let (x, y) = (thousandth(r, 1500) * scale(r), thousandth(r, 1500) * scale(r));
            let w = if r.one_in(3) { scale(r) } else { w };
            [x, y, r.below(1000) as f32 / 1000.0 * w, w].map(f32::to_bits)
        }
        Shape::Degenerate => {
            // On the grid of half pixels, or within a tiny area.
            let tiny = r.one_in(4);
            let place = |r: &mut Random, n: u32| match tiny {
                true => thousandth(r, 10) * 0.01,
                false => (r.below(4 * n as usize + 1) as f32) / (2.0 * n as f32) - 1.0,
            };
            [place(r, size[0]), place(r, size[1]), 0.5, 1.0].map(f32::to_bits)
        }
        Shape::Special => {
            let ordinary = |r: &mut Random| thousandth(r, 1500).to_bits();
            let mut out = [ordinary(r), ordinary(r), r.number(), w.to_bits()];
            if r.one_in(4) {
                let place = r.below(4);
                out[place] = r.special();
            }
            out
        }
        _ => {
            let scaled = |x: f32| (x * w).to_bits();
            let z = (r.below(1000) as f32 / 1000.0 * w).to_bits();
            [scaled(thousandth(r, 1500)), scaled(thousandth(r, 1500)), z, w.to_bits()]
        }
    }
}

/// Attributes `v0` to `v7` for a vertex program: some per vertex, some per instance, some without a stream.
pub(crate) fn streams(scene: &mut Scene, r: &mut Random) {
    let count = scene.vertices.len();
    scene.vertex_count = count;
    let most = if r.one_in(8) { 40 } else { 5 };
    scene.instances = 1 + r.below(most);
    scene.streams.push((0, StepRate::Vertex, scene.vertices.iter().map(|v| v.position).collect()));
    for register in 1..8 {
        if r.one_in(5) {
            continue;
        }
        let step = r.of(&[StepRate::Vertex, StepRate::Vertex, StepRate::Instance]);
        let entries = if step == StepRate::Vertex { count } else { scene.instances };
        scene.streams.push((register, step, (0..entries).map(|_| r.vector()).collect()));
    }
}
