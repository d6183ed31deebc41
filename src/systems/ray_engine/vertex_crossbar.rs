//! Intersection in the vertex units, which the paper considers and rejects (section 3.4).

use refsim::event::DrawEvents;
use refsim::exec::Constants;
use refsim::machine::{DrawCall, Machine, VertexSource};
use refsim::output::DepthFormat;
use refsim::raster::Primitive;
use refsim::texture::TexelFormat;

use super::answer::{Answer, EngineError};
use super::card::{bind, color_of_id, hits, rounded};
use super::range::Range;
use super::units::Units;
use super::{Form, RayBatch, kernels};
use crate::card::NearestTarget;
use crate::geom::Mesh;
use crate::tracer::scale::normalize_range;
use crate::tracer::triangle_test::{scaled, scaled_corners};

/// Corners of a triangle around a pixel's centre, in pixels.
const AROUND: [[f32; 2]; 3] = [[0.0, 0.4], [0.4, -0.3], [-0.4, -0.3]];

/// Intersects every ray with the front of every triangle in the vertex units of a machine, which may be recording: one
/// draw per ray, three vertices per test.
///
/// The paper's own program is not printed. This program is the shortest that we found for triangles with precomputed
/// normal and edges in vertex memory: 20 instructions.
pub fn intersect_in_vertices(machine: &mut Machine, mesh: &Mesh, rays: &RayBatch) -> Result<Answer, EngineError> {
    let profile = machine.profile().clone();
    let (vertex, pixel) = (kernels::VERTEX_TEST.checked(&profile)?, kernels::ID.checked(&profile)?);
    let size = [rays.width(), rays.height()];
    let target = NearestTarget::new(machine, TexelFormat::Bgra8, DepthFormat::Unorm24, size)?;
    let units = Units::choose((Form::Float, Range::of(&profile.rules.vertex_format)), mesh, rays);
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
        let source = VertexSource::Program {
            program: &vertex,
            constants: &constants,
            streams: bind(&streams.corners, &streams.triangles),
        };
        let none = Constants::default();
        let mut call = DrawCall::new(source, Primitive::TriangleList, &pixel, &none, target.color);
        target.keep_nearest(&mut call);
        events += machine.draw(&call)?;
    }
    let hits = hits(machine.read_back(target.color)?, machine.read_depth(target.depth)?, rays, &units);
    Ok(Answer { hits: rounded(hits), events, kernel: kernels::VERTEX_TEST.name, log: Vec::new() })
}

/// Vertex attributes: the small triangle around a pixel, and the attributes of each triangle of the mesh.
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
}
