//! A card at work for the crossbar: rays in textures, triangles in streams, ids and depths in targets.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::{DrawEvents, Event, FenceId};
use refsim::exec::Constants;
use refsim::machine::{
    AttributeStream, DepthId, DrawCall, Machine, MachineError, StepRate, TextureId, VertexSource, VertexStreams,
};
use refsim::num::Format;
use refsim::output::{AlphaTest, CompareFunction, DepthFormat, DepthState, DepthSurface};
use refsim::raster::{PixelCenter, Primitive};
use refsim::texture::{Image, Region, SamplerState, TexelFormat};

use super::crossbar::{color_of_id, id_of_color};
use super::units::{Units, ray_textures};
use super::{EngineError, Form, Hit, Kernel, RayBatch};
use crate::geom::{Mesh, Ray};

/// What a bucket of rays takes of a machine's memory: rays in textures, a colour target for ids and a depth buffer for t.
#[derive(Debug)]
pub(super) struct Sheet {
    /// All ray textures made so far: sampler, size, texture. Origins take one texel or one a ray.
    made: Vec<(usize, Region, TextureId)>,
    /// Those with the rays that were loaded last.
    textures: Vec<(usize, TextureId)>,
    ids: TextureId,
    depth: DepthId,
}

impl Sheet {
    /// Uploads rays, and makes targets of their size.
    pub(super) fn new(
        machine: &mut Machine,
        kernel: &Kernel,
        rays: &RayBatch,
        units: &Units,
    ) -> Result<Self, EngineError> {
        let mut made = Vec::new();
        let textures = upload(&mut made, machine, kernel, rays, units)?;
        let ids = machine.create_target(TexelFormat::Bgra8, rays.width(), rays.height())?;
        let format = depth_format(machine.profile(), kernel.form);
        let depth = machine.create_depth(format, rays.width(), rays.height())?;
        Ok(Self { made, textures, ids, depth })
    }

    /// Uploads other rays, as many.
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

    /// No ids, and the depth of no hit.
    pub(super) fn clear(&self, machine: &mut Machine) -> Result<(), EngineError> {
        machine.clear_target(self.ids, [0; 4])?;
        machine.clear_depth(self.depth, 1.0_f32.to_bits())?;
        Ok(())
    }

    /// One screen-filling quad a triangle, all in one call. The depth buffer starts at 1 and keeps the nearest t.
    pub(super) fn draw(
        &self,
        machine: &mut Machine,
        kernel: &Kernel,
        units: &Units,
        streams: &Streams,
    ) -> Result<DrawEvents, EngineError> {
        let vertex_constants = Constants { float: units.vertex_constants(), ..Constants::default() };
        let pixel_constants = Constants { float: units.pixel_constants(), ..Constants::default() };
        let source =
            VertexSource::Program { program: &kernel.vertex, constants: &vertex_constants, streams: streams.bind() };
        let mut call = DrawCall::new(source, Primitive::QuadList, &kernel.pixel, &pixel_constants, self.ids);
        for (sampler, texture) in &self.textures {
            call = call.with_texture(*sampler, *texture, SamplerState::NEAREST_CLAMP);
        }
        call.center = PixelCenter::OpenGl;
        // Section 4.2: alpha is 0 where the ray misses, and the fragment dies.
        call.alpha_test = Some(AlphaTest { function: CompareFunction::Greater, reference: 0 });
        call.depth = DepthState { test: Some(CompareFunction::Less), write: true };
        call.depth_buffer = Some(self.depth);
        Ok(machine.draw(&call)?)
    }

    /// What each of the rays hits. If the host does not wait for it, a fence is passed when all of it has come.
    pub(super) fn read_back(
        &self,
        machine: &Machine,
        rays: &RayBatch,
        units: &Units,
        wait: bool,
    ) -> Result<(Vec<Option<Hit>>, Option<FenceId>), EngineError> {
        if wait {
            let image = machine.read_back(self.ids)?;
            return Ok((hits(image, machine.read_depth(self.depth)?, rays, units), None));
        }
        let (_, image) = machine.read_back_async(self.ids)?;
        // Behind the last of the transfers, so one fence does for both.
        let (fence, depth) = machine.read_depth_async(self.depth)?;
        Ok((hits(image, depth, rays, units), Some(fence)))
    }
}

/// Rays into textures that were made before, where there are some of the size, else into new ones. Samplers with their textures.
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

/// Hits from ids and depths.
fn hits(image: &Image, depth: &DepthSurface, rays: &RayBatch, units: &Units) -> Vec<Option<Hit>> {
    let pixel = |(i, ray): (usize, &Ray)| {
        let (x, y) = (i as u32 % rays.width(), i as u32 / rays.width());
        let raw = image.raw(0, 0, y, x) as u32;
        (raw >> 24 != 0).then(|| {
            let stored = depth.data()[i];
            let depth = f32::from_bits(depth.format().to_format(stored, Format::FP32));
            Hit { triangle: id_of_color(raw), t: units.t(depth, ray) }
        })
    };
    rays.rays().iter().enumerate().map(pixel).collect()
}

/// A machine with one bucket of rays.
#[derive(Debug)]
pub(super) struct Card {
    machine: Machine,
    kernel: Arc<Kernel>,
    units: Units,
    sheet: Sheet,
}

impl Card {
    /// Uploads the rays, and makes targets of their size.
    pub(super) fn set_up(
        mut machine: Machine,
        kernel: Arc<Kernel>,
        rays: &RayBatch,
        units: Units,
    ) -> Result<Self, EngineError> {
        let sheet = Sheet::new(&mut machine, &kernel, rays, &units)?;
        Ok(Self { machine, kernel, units, sheet })
    }

    /// No ids, and the depth of no hit.
    pub(super) fn clear(&mut self) -> Result<(), EngineError> {
        self.sheet.clear(&mut self.machine)
    }

    /// What was asked of the machine, if it records.
    pub(super) fn take_log(&mut self) -> Vec<Event> {
        self.machine.take_log()
    }

    /// One screen-filling quad a triangle.
    pub(super) fn draw(&mut self, streams: &Streams) -> Result<DrawEvents, EngineError> {
        self.sheet.draw(&mut self.machine, &self.kernel, &self.units, streams)
    }

    /// What each of the rays hits.
    pub(super) fn read_back(&self, rays: &RayBatch) -> Result<Vec<Option<Hit>>, EngineError> {
        Ok(self.sheet.read_back(&self.machine, rays, &self.units, true)?.0)
    }
}

/// A float depth buffer where the program computes in float and the card has one; else 24 bits, as the cards had.
fn depth_format(profile: &Profile, form: Form) -> DepthFormat {
    let float = form == Form::Float && profile.limits.depth_formats.iter().any(|f| f == DepthFormat::Float32.name());
    if float { DepthFormat::Float32 } else { DepthFormat::Unorm24 }
}

/// The vertex attributes of the crossbar, fp32 patterns.
#[derive(Debug)]
pub(super) struct Streams {
    corners: [[u32; 4]; 4],
    triangles: [Vec<[u32; 4]>; 4],
}

impl Streams {
    pub(super) fn new(mesh: &Mesh, ids: &[u32]) -> Self {
        // xy: clip space, +y up. zw: coordinates of the ray textures, row 0 on top.
        let corners = [[-1.0, 1.0, 0.0, 0.0], [1.0, 1.0, 1.0, 0.0], [1.0, -1.0, 1.0, 1.0], [-1.0, -1.0, 0.0, 1.0]];
        let mut triangles: [Vec<[u32; 4]>; 4] = std::array::from_fn(|_| Vec::with_capacity(ids.len()));
        for (id, corners) in ids.iter().filter_map(|id| Some((*id, mesh.corners(*id)?))) {
            for (stream, [x, y, z]) in triangles.iter_mut().zip(corners) {
                stream.push([x, y, z, 1.0].map(f32::to_bits));
            }
            triangles[3].push(color_of_id(id));
        }
        Self { corners: corners.map(|c: [f32; 4]| c.map(f32::to_bits)), triangles }
    }

    fn bind(&self) -> VertexStreams<'_> {
        bind(&self.corners, &self.triangles)
    }
}

/// Corners that step by vertex in register 0; what belongs to a triangle steps by instance in the registers after it.
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
