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
use super::range::Range;
use super::units::Units;
use super::{Form, RayBatch, kernels};
use crate::geom::{Hit, Mesh, Ray};
use crate::tracer::scale::normalize_range;
use crate::tracer::triangle_test::{scaled, scaled_corners};

/// Corners of a triangle around a pixel's centre, in pixels.
const AROUND: [[f32; 2]; 3] = [[0.0, 0.4], [0.4, -0.3], [-0.4, -0.3]];

/// A card that intersects rays with triangles in its vertex units: a draw per ray, three vertices per test.
///
/// The paper's own program is not printed. This one is the shortest that we found for triangles whose normal and edges
/// lie ready in vertex memory: 20 instructions.
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
        let units = Units::choose(Form::Float, Range::of(&self.profile.rules.vertex_format), mesh, rays);
        let streams = Streams::new(mesh, rays, units.scale());
        let mut events = DrawEvents::default();
        for (i, ray) in rays.rays().iter().enumerate() {
            let at = |i: usize, count: u32| (2 * i + 1) as f32 / count as f32 - 1.0;
            let width = rays.width() as usize;
            let center = [at(i % width, rays.width()), -at(i / width, rays.height())];
            let [ox, oy, oz] = scaled(ray.origin(), units.scale()).into();
            let [dx, dy, dz] = normalize_range(ray.direction()).0.as_vec3().into();
            let float = [
                [0.0, 1.0, 4.0, -1.0],
                [center[0], center[1], (1.0 / units.t_max()) as f32, 1.0],
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
        let hits = read_back(machine, (ids, depth), rays, &units)?;
        Ok(Answer { hits, events, kernel: kernels::VERTEX_TEST.name, log: Vec::new() })
    }
}

fn read_back(
    machine: &Machine,
    (ids, depth): (TextureId, DepthId),
    rays: &RayBatch,
    units: &Units,
) -> Result<Vec<Option<Hit>>, MachineError> {
    let (image, depth) = (machine.read_back(ids)?, machine.read_depth(depth)?);
    let width = depth.width() as usize;
    let hit = |(i, ray): (usize, &Ray)| {
        let raw = image.raw(0, 0, (i / width) as u32, (i % width) as u32) as u32;
        (raw >> 24 != 0).then(|| {
            let t = units.t(f32::from_bits(depth.format().to_format(depth.data()[i], Format::FP32)), ray);
            Hit { triangle: id_of_color(raw), t: t as f32 }
        })
    };
    Ok(rays.rays().iter().enumerate().map(hit).collect())
}

/// Vertex attributes: the pixel's triangle, and what the program needs of each triangle of the mesh.
struct Streams {
    corners: [[u32; 4]; 3],
    triangles: [Vec<[u32; 4]>; 5],
}

impl Streams {
    fn new(mesh: &Mesh, rays: &RayBatch, scale: f64) -> Self {
        let pixel = [2.0 / rays.width() as f32, 2.0 / rays.height() as f32];
        let corners = AROUND.map(|[x, y]| [x * pixel[0], y * pixel[1], 0.0, 0.0].map(f32::to_bits));
        let mut triangles: [Vec<[u32; 4]>; 5] = Default::default();
        for (id, [a, b, c]) in (0..mesh.len() as u32).filter_map(|id| Some((id, mesh.corners(id)?))) {
            let [a, b, c] = scaled_corners([a, b, c], scale);
            let (ab, ac) = (b - a, c - a);
            for (stream, v) in triangles.iter_mut().zip([a, ab.cross(ac), ab, ac]) {
                stream.push([v.x, v.y, v.z, 1.0].map(f32::to_bits));
            }
            triangles[4].push(color_of_id(id));
        }
        Self { corners, triangles }
    }

    fn bind(&self) -> VertexStreams<'_> {
        bind(&self.corners, &self.triangles)
    }
}
