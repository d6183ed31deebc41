//! The crossbar's resources on a card: rays in textures, triangles in vertex streams, ids and depths in targets.

use refsim::device::Profile;
use refsim::event::{DrawEvents, FenceId};
use refsim::exec::Constants;
use refsim::machine::{
    AttributeStream, DrawCall, Machine, MachineError, StepRate, TextureId, VertexSource, VertexStreams,
};
use refsim::num::Format;
use refsim::output::{AlphaTest, CompareFunction, DepthFormat, DepthSurface};
use refsim::raster::Primitive;
use refsim::texture::{Image, Region, SamplerState, TexelFormat};

use super::units::{Units, ray_textures};
use super::{EdgeRule, EngineError, Form, Kernel, RayBatch};
use crate::card::NearestTarget;
use crate::geom::{Hit, Mesh, Ray};

/// Resources of a bucket of rays: textures with the rays, a color target for ids and a depth buffer for t.
#[derive(Debug)]
pub(super) struct RayTextures {
    /// All ray textures created so far: sampler, size, texture. Origins need one texel for all rays, or one per ray.
    made: Vec<(usize, Region, TextureId)>,
    /// Samplers and textures of the rays loaded last.
    textures: Vec<(usize, TextureId)>,
    /// Render target: ids in color, t in depth.
    target: NearestTarget,
}

/// Hit as the card reports it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CardHit {
    pub(super) triangle: u32,
    /// Ray parameter in multiples of the ray's direction, not yet rounded to single precision.
    pub(super) t: f64,
}

/// The hits of rays, with t in single precision.
pub(super) fn rounded(hits: Vec<Option<CardHit>>) -> Vec<Option<Hit>> {
    hits.into_iter().map(|hit| hit.map(|CardHit { triangle, t }| Hit { triangle, t: t as f32 })).collect()
}

/// The hit of each ray, and the fence to wait for.
pub(super) type ReadHits = (Vec<Option<CardHit>>, Option<FenceId>);

impl RayTextures {
    pub(super) fn new(
        machine: &mut Machine,
        kernel: &Kernel,
        rays: &RayBatch,
        units: &Units,
    ) -> Result<Self, EngineError> {
        let mut made = Vec::new();
        let textures = upload(&mut made, machine, kernel, rays, units)?;
        let depth = depth_format(machine.profile(), kernel.form);
        let target = NearestTarget::new(machine, TexelFormat::Bgra8, depth, [rays.width(), rays.height()])?;
        Ok(Self { made, textures, target })
    }

    /// Replaces the rays by the same number of other rays.
    pub(super) fn load(
        &mut self,
        machine: &mut Machine,
        kernel: &Kernel,
        rays: &RayBatch,
        units: &Units,
    ) -> Result<(), EngineError> {
        self.textures = upload(&mut self.made, machine, kernel, rays, units)?;
        Ok(())
    }

    /// Clears the target: no id, and the depth of a miss.
    pub(super) fn clear(&self, machine: &mut Machine) -> Result<(), EngineError> {
        Ok(self.target.clear(machine)?)
    }

    /// Draws one screen-filling quad per triangle, all in one draw call. The depth buffer starts at 1 and keeps the
    /// nearest t. `bucket` are vertex constants from c3 on, which describe the rays to a culling vertex program.
    pub(super) fn draw(
        &self,
        machine: &mut Machine,
        kernel: &Kernel,
        units: &Units,
        bucket: &[[u32; 4]],
        streams: &Streams,
    ) -> Result<DrawEvents, EngineError> {
        let mut float = units.vertex_constants();
        float.extend_from_slice(bucket);
        let vertex_constants = Constants { float, ..Constants::default() };
        let pixel_constants = Constants { float: units.pixel_constants(), ..Constants::default() };
        let streams = bind(&streams.corners, &streams.triangles);
        let source = VertexSource::Program { program: &kernel.vertex, constants: &vertex_constants, streams };
        let mut call = DrawCall::new(source, Primitive::QuadList, &kernel.pixel, &pixel_constants, self.target.color);
        for (sampler, texture) in &self.textures {
            call = call.with_texture(*sampler, *texture, SamplerState::NEAREST_CLAMP);
        }
        // Section 4.2: alpha is 0 where the ray misses, which kills the fragment.
        call.alpha_test = Some(AlphaTest { function: CompareFunction::Greater, reference: 0 });
        self.target.keep_nearest(&mut call);
        if kernel.edges == EdgeRule::SharedEdges {
            // A hit may have depth 1 if its t was lost to rounding.
            call.depth.test = Some(CompareFunction::LessEqual);
        }
        Ok(machine.draw(&call)?)
    }

    /// Reads back the hit of each ray. If the host does not wait, the returned fence is passed when all data has
    /// arrived.
    pub(super) fn read_back(
        &self,
        machine: &Machine,
        rays: &RayBatch,
        units: &Units,
        wait: bool,
    ) -> Result<ReadHits, EngineError> {
        let (color, depth) = (self.target.color, self.target.depth);
        // The fence of the second transfer also follows the first transfer.
        let (fence, image, depth) = if wait {
            (None, machine.read_back(color)?, machine.read_depth(depth)?)
        } else {
            let (_, image) = machine.read_back_async(color)?;
            let (fence, depth) = machine.read_depth_async(depth)?;
            (Some(fence), image, depth)
        };
        Ok((hits(image, depth, rays, units), fence))
    }
}

pub(super) fn hits(image: &Image, depth: &DepthSurface, rays: &RayBatch, units: &Units) -> Vec<Option<CardHit>> {
    let width = rays.width() as usize;
    let pixel = |(i, ray): (usize, &Ray)| {
        let triangle = id_of_color(image.raw(0, 0, (i / width) as u32, (i % width) as u32) as u32)?;
        let stored = *depth.data().get(i)?;
        let t = units.t(f32::from_bits(depth.format().to_format(stored, Format::FP32)), ray);
        Some(CardHit { triangle, t })
    };
    rays.rays().iter().enumerate().map(pixel).collect()
}

/// Uploads rays into existing textures of their size or into new ones. Returns samplers with their textures.
fn upload(
    made: &mut Vec<(usize, Region, TextureId)>,
    machine: &mut Machine,
    kernel: &Kernel,
    rays: &RayBatch,
    units: &Units,
) -> Result<Vec<(usize, TextureId)>, EngineError> {
    let mut bound = Vec::new();
    for (sampler, image) in ray_textures(kernel, rays, units).map_err(MachineError::from)? {
        let size = image.region();
        let known = made.iter().find(|made| (made.0, made.1) == (sampler, size)).map(|made| made.2);
        let texture = if let Some(texture) = known {
            machine.update_texture(texture, &image)?;
            texture
        } else {
            let texture = machine.create_texture(image)?;
            made.push((sampler, size, texture));
            texture
        };
        bound.push((sampler, texture));
    }
    Ok(bound)
}

/// Depth format for a program: float if the program computes in float and the card has a float depth buffer, else 24
/// bits, as on the cards of the time.
fn depth_format(profile: &Profile, form: Form) -> DepthFormat {
    let float = form == Form::Float && profile.limits.depth_formats.contains(&DepthFormat::Float32);
    if float { DepthFormat::Float32 } else { DepthFormat::Unorm24 }
}

/// Vertex attributes of the crossbar, as fp32 bit patterns.
#[derive(Debug)]
pub(super) struct Streams {
    corners: [[u32; 4]; 4],
    triangles: [Vec<[u32; 4]>; 4],
}

impl Streams {
    /// Builds the streams of triangles, given in ascending order, for a program, colored by their ids.
    pub(super) fn new(mesh: &Mesh, kernel: &Kernel, units: &Units, ids: &[u32]) -> Self {
        // xy: clip space, +y up. zw: coordinates of the ray textures, row 0 on top.
        let corners = [[-1.0, 1.0, 0.0, 0.0], [1.0, 1.0, 1.0, 0.0], [1.0, -1.0, 1.0, 1.0], [-1.0, -1.0, 0.0, 1.0]];
        let triangles = match kernel.edges {
            EdgeRule::Paper => Self::as_given(mesh, units, ids),
            EdgeRule::SharedEdges => Self::sorted(mesh, units, ids),
        };
        Self { corners: corners.map(|c: [f32; 4]| c.map(f32::to_bits)), triangles }
    }

    /// Triangles in the order of `ids`. The fourth component of a is the position in the pass, the fourth of b is the
    /// edge scale, and the fourth of c is unused.
    fn as_given(mesh: &Mesh, units: &Units, ids: &[u32]) -> [Vec<[u32; 4]>; 4] {
        let mut triangles: [Vec<[u32; 4]>; 4] = std::array::from_fn(|_| Vec::with_capacity(ids.len()));
        for (place, id, corners) in ids.iter().enumerate().filter_map(|(i, id)| Some((i, *id, mesh.corners(*id)?))) {
            let fourth = [(place + 1) as f32, units.edge_scale(corners) as f32, 0.0];
            for ((stream, [x, y, z]), w) in triangles.iter_mut().zip(corners).zip(fourth) {
                stream.push([x, y, z, w].map(f32::to_bits));
            }
            triangles[3].push(color_of_id(id));
        }
        triangles
    }

    /// Triangles with sorted corners, largest id first: at equal depths the last draw wins, which has the smallest id.
    /// The fourth components of the corners are the edge scales. The fourth component of the color is the normal's
    /// scale with the sign of the sorting.
    fn sorted(mesh: &Mesh, units: &Units, ids: &[u32]) -> [Vec<[u32; 4]>; 4] {
        let mut triangles: [Vec<[u32; 4]>; 4] = std::array::from_fn(|_| Vec::with_capacity(ids.len()));
        for (id, corners) in ids.iter().rev().filter_map(|id| Some((*id, mesh.corners(*id)?))) {
            let ([p0, p1, p2], turn) = sorted_corners(corners);
            // Each edge goes from its smaller to its larger corner.
            let edges = [[p0, p1], [p0, p2], [p1, p2]];
            for ((stream, [x, y, z]), [p, q]) in triangles.iter_mut().zip([p0, p1, p2]).zip(edges) {
                stream.push([x, y, z, units.shared_edge_scale(p, q) as f32].map(f32::to_bits));
            }
            let [red, green, blue, _] = color_of_id(id);
            let normal = units.normal_scale(corners) * turn;
            triangles[3].push([red, green, blue, (normal as f32).to_bits()]);
        }
        triangles
    }
}

/// Corners sorted by x, then y, then z, so that a common edge has the same direction in both of its triangles, even if
/// they do not share vertices; and the sign of the permutation.
fn sorted_corners(mut corners: [[f32; 3]; 3]) -> ([[f32; 3]; 3], f64) {
    let mut turn = 1.0;
    for [first, second] in [[0, 1], [1, 2], [0, 1]] {
        // Corners are finite, so they always compare; equal corners are not exchanged.
        if corners[first] > corners[second] {
            corners.swap(first, second);
            turn = -turn;
        }
    }
    (corners, turn)
}

/// Binds the streams: corners step per vertex in register 0; per-triangle attributes step per instance in the registers
/// after it.
pub(super) fn bind<'a>(corners: &'a [[u32; 4]], triangles: &'a [Vec<[u32; 4]>]) -> VertexStreams<'a> {
    let each =
        (1..).zip(triangles).map(|(register, data)| AttributeStream { register, step: StepRate::Instance, data });
    let corner = AttributeStream { register: 0, step: StepRate::Vertex, data: corners };
    VertexStreams {
        vertex_count: corners.len(),
        instance_count: triangles.first().map_or(0, Vec::len),
        streams: std::iter::once(corner).chain(each).collect(),
    }
}

/// Encodes an id as a color: the lowest byte in red, alpha 1.
pub(super) fn color_of_id(id: u32) -> [u32; 4] {
    let part = |shift: u32| ((id >> shift & 0xff) as f32 / 255.0).to_bits();
    [part(0), part(8), part(16), 1.0_f32.to_bits()]
}

/// Decodes the id of an `A8R8G8B8` pixel; `None` for a miss.
const fn id_of_color(raw: u32) -> Option<u32> {
    if raw >> 24 == 0 {
        return None;
    }
    Some((raw >> 16 & 0xff) | (raw & 0xff00) | (raw & 0xff) << 16)
}
