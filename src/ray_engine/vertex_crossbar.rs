//! The road that the paper did not take: intersection in the vertex units (section 3.4).

use refsim::device::Profile;
use refsim::event::DrawEvents;
use refsim::exec::Constants;
use refsim::machine::{DepthId, DrawCall, Executor, Machine, MachineError, TextureId, VertexSource, VertexStreams};
use refsim::num::Format;
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::{PixelCenter, Primitive};
use refsim::texture::TexelFormat;

use super::card::bind;
use super::crossbar::{Answer, EngineError, color_of_id, id_of_color};
use super::kernel::checked;
use super::{RayBatch, kernels};
use crate::geom::Hit;
use crate::geom::Mesh;

/// Corners of a triangle around a pixel's centre, in pixels.
const AROUND: [[f32; 2]; 3] = [[0.0, 0.4], [0.4, -0.3], [-0.4, -0.3]];

/// A card that intersects rays with triangles in its vertex units: a draw a ray, three vertices a test.
///
/// The paper's own program is not printed. This one is the shortest that we found for triangles whose normal and edges lie
/// ready in vertex memory: 20 instructions.
#[derive(Clone, Debug)]
pub struct VertexCrossbar {
    profile: Profile,
    executor: Executor,
}

impl VertexCrossbar {
    /// A card of this profile.
    pub fn new(profile: Profile, executor: impl Into<Executor>) -> Self {
        Self { profile, executor: executor.into() }
    }

    /// Every ray against the front of every triangle.
    ///
    /// # Errors
    /// [`EngineError`] if the card refuses a program or the work.
    pub fn intersect(&self, mesh: &Mesh, rays: &RayBatch) -> Result<Answer, EngineError> {
        let mut machine = self.executor.machine(self.profile.clone())?;
        self.intersect_on(&mut machine, mesh, rays)
    }

    /// The same on a machine of the caller's, which may be recording.
    ///
    /// # Errors
    /// As [`VertexCrossbar::intersect`].
    pub fn intersect_on(&self, machine: &mut Machine, mesh: &Mesh, rays: &RayBatch) -> Result<Answer, EngineError> {
        let (vertex, pixel) = (checked(&self.profile, kernels::VERTEX_TEST)?, checked(&self.profile, kernels::ID)?);
        let ids = machine.create_target(TexelFormat::Bgra8, rays.width(), rays.height())?;
        let depth = machine.create_depth(DepthFormat::Unorm24, rays.width(), rays.height())?;
        let (streams, t_max) = (Streams::new(mesh, rays), t_max(mesh, rays));
        let mut events = DrawEvents::default();
        for (i, ray) in rays.rays().iter().enumerate() {
            let at = |i: usize, count: u32| (2 * i + 1) as f32 / count as f32 - 1.0;
            let width = rays.width() as usize;
            let center = [at(i % width, rays.width()), -at(i / width, rays.height())];
            let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin(), ray.direction());
            let float = [
                [0.0, 1.0, 4.0, -1.0],
                [center[0], center[1], t_max.recip(), 1.0],
                [ox, oy, oz, 0.0],
                [dx, dy, dz, 0.0],
            ];
            let constants = Constants { float: float.map(|c| c.map(f32::to_bits)).to_vec(), ..Constants::default() };
            let source = VertexSource::Program { program: &vertex, constants: &constants, streams: streams.bind() };
            let none = Constants::default();
            let mut call = DrawCall::new(source, Primitive::TriangleList, &pixel, &none, ids);
            call.center = PixelCenter::OpenGl;
            call.depth = DepthState { test: Some(CompareFunction::Less), write: true };
            call.depth_buffer = Some(depth);
            events += machine.draw(&call)?;
        }
        let hits = read_back(machine, (ids, depth), rays.rays().len(), t_max)?;
        Ok(Answer { hits, events, kernel: kernels::VERTEX_TEST.name, log: Vec::new() })
    }
}

/// A t that no hit exceeds: twice the scene's reach over the shortest direction, to a power of two.
fn t_max(mesh: &Mesh, rays: &RayBatch) -> f32 {
    let corners = mesh.bounds().unwrap_or_default();
    let mut most = 1.0f32;
    for ray in rays.rays() {
        let offset = |axis: usize| corners.iter().map(|c| (c[axis] - ray.origin()[axis]).abs()).fold(0.0, f32::max);
        let reach: f32 = (0..3).map(offset).sum();
        let longest = ray.direction().iter().fold(0.0f32, |m, d| m.max(d.abs()));
        most = most.max(reach / longest);
    }
    let mut power = 1.0;
    while power < most && power < f32::MAX / 2.0 {
        power *= 2.0;
    }
    power
}

fn read_back(
    machine: &Machine,
    (ids, depth): (TextureId, DepthId),
    rays: usize,
    t_max: f32,
) -> Result<Vec<Option<Hit>>, MachineError> {
    let (image, depth) = (machine.read_back(ids)?, machine.read_depth(depth)?);
    let width = depth.width() as usize;
    let hit = |i: usize| {
        let raw = image.raw(0, 0, (i / width) as u32, (i % width) as u32) as u32;
        (raw >> 24 != 0).then(|| {
            let t = f32::from_bits(depth.format().to_format(depth.data()[i], Format::FP32)) * t_max;
            Hit { triangle: id_of_color(raw), t }
        })
    };
    Ok((0..rays).map(hit).collect())
}

/// Vertex attributes: the pixel's triangle, and what the program needs of each triangle of the mesh.
struct Streams {
    corners: [[u32; 4]; 3],
    triangles: [Vec<[u32; 4]>; 5],
}

impl Streams {
    fn new(mesh: &Mesh, rays: &RayBatch) -> Self {
        let pixel = [2.0 / rays.width() as f32, 2.0 / rays.height() as f32];
        let corners = AROUND.map(|[x, y]| [x * pixel[0], y * pixel[1], 0.0, 0.0].map(f32::to_bits));
        let mut triangles: [Vec<[u32; 4]>; 5] = Default::default();
        for (id, [a, b, c]) in (0..mesh.len() as u32).filter_map(|id| Some((id, mesh.corners(id)?))) {
            let minus = |p: [f32; 3], q: [f32; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
            let (ab, ac) = (minus(b, a), minus(c, a));
            let normal = [ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]];
            for (stream, [x, y, z]) in triangles.iter_mut().zip([a, normal, ab, ac]) {
                stream.push([x, y, z, 1.0].map(f32::to_bits));
            }
            triangles[4].push(color_of_id(id));
        }
        Self { corners, triangles }
    }

    fn bind(&self) -> VertexStreams<'_> {
        bind(&self.corners, &self.triangles)
    }
}
