//! A mesh with transferred radiance on an emulated card.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::{DrawCall, Executor, Machine, VertexSource};
use refsim::output::{CompareFunction, DepthState, WriteMask};
use refsim::raster::Primitive;
use refsim::texture::{SamplerState, TexelFormat};

use super::counts::FactoredCounts;
use super::error::FactoredCardError;
use super::maps::FactorMaps;
use super::options::ProductPlace;
use super::programs::{Drawing, Programs};
use super::streams::{ColorStream, RadianceStream};
use super::subject::TransferredMesh;
use super::time;
use crate::all_frequency::Reflectance;
use crate::all_frequency::kernels::MapFilter;
use crate::all_frequency::shade::Multiplies;
use crate::card::{Attribute, BILINEAR, NearestTarget, Texels, ViewTarget, attribute, constants, vertex_streams};
use crate::cpca::on_card::{PrtView, positions};
use crate::geom::UnitFrame;
use crate::geom::vector::wide;

/// The write masks of passes of one channel; alpha marks what is covered.
const CHANNELS: [WriteMask; 3] = [WriteMask(1 | 8), WriteMask(2), WriteMask(4)];

/// A mesh with transferred radiance on a card.
#[derive(Debug)]
pub struct FactoredCard<'a> {
    machine: Machine,
    mesh: TransferredMesh<'a>,
    place: ProductPlace,
    frame: UnitFrame,
    positions: Attribute,
    /// Tangents and normals, where the vertex program makes the view.
    axes: Vec<Attribute>,
    indices: Vec<u32>,
    programs: Programs,
    maps: Option<FactorMaps>,
    target: ViewTarget,
}

/// What a frame sends, pass by pass.
struct FrameStreams {
    /// Attributes between positions and axes.
    passes: Vec<Vec<Attribute>>,
    counts: FactoredCounts,
}

impl<'a> FactoredCard<'a> {
    /// Uploads a mesh, and maps of G.
    ///
    /// # Errors
    /// [`FactoredCardError`] if the device lacks programs, coordinates, samplers or a way to filter, or the parts of
    /// the mesh do not go together.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        mesh: TransferredMesh<'a>,
        place: ProductPlace,
    ) -> Result<Self, FactoredCardError> {
        let profile = profile.into();
        mesh.check()?;
        let programs = Programs::new(&profile, &mesh, &place)?;
        let mut machine = executor.into().machine(profile)?;
        let maps = match (&place, mesh.reflectance) {
            (ProductPlace::Pixels(options), Reflectance::Factored(factors)) => {
                Some(FactorMaps::new(&mut machine, factors, options)?)
            }
            _ => None,
        };
        let frame = UnitFrame::new(mesh.vertices.positions().iter().copied().map(wide));
        let frames = || mesh.vertices.frames().iter();
        let axes = if programs.makes_view() {
            let tangents = frames().map(|frame| attribute(frame.tangent().to_array(), 0.0)).collect();
            vec![tangents, frames().map(|frame| attribute(frame.normal().to_array(), 0.0)).collect()]
        } else {
            Vec::new()
        };
        Ok(Self {
            machine,
            mesh,
            place,
            positions: positions(mesh.vertices, &frame),
            frame,
            axes,
            indices: mesh.vertices.triangles().as_flattened().to_vec(),
            programs,
            maps,
            target: ViewTarget::default(),
        })
    }

    /// The emulated card.
    pub fn machine_mut(&mut self) -> &mut Machine {
        &mut self.machine
    }

    /// Texture reads and arithmetic slots of the pixel program.
    pub(super) fn pixel_slots(&self) -> [u32; 2] {
        let slots = &self.programs.pixel.facts().slots;
        [slots.iter().map(|phase| phase.texture).sum(), slots.iter().map(|phase| phase.arithmetic).sum()]
    }

    /// A frame as the target holds it. Pixels that show nothing are 0, alpha is 1 elsewhere.
    ///
    /// # Errors
    /// [`FactoredCardError`] for an exposure out of range, radiance that its format does not hold, and draws that the
    /// card refuses.
    pub fn view_texels(&mut self, view: &PrtView) -> Result<Texels, FactoredCardError> {
        let streams = self.streams(view)?;
        let target = self.draw(view, &streams)?;
        Ok(Texels::read_back(&self.machine, target.color)?)
    }

    /// The same, with what the frame asks of host and card, for [`time`]: steps 2 and 3 multiply what `host` says.
    ///
    /// # Errors
    /// As [`Self::view_texels`].
    pub fn logged_view(
        &mut self,
        view: &PrtView,
        host: Multiplies,
    ) -> Result<(Texels, FactoredCounts, Vec<Event>), FactoredCardError> {
        let streams = self.streams(view)?;
        let mut log = time::host_log(&self.mesh, &self.place, host);
        self.machine.record(true);
        let drawn = self.draw(view, &streams);
        self.machine.record(false);
        log.extend(self.machine.take_log());
        Ok((Texels::read_back(&self.machine, drawn?.color)?, streams.counts, log))
    }

    /// What the host sends.
    fn streams(&self, view: &PrtView) -> Result<FrameStreams, FactoredCardError> {
        let found = view.exposure;
        if !(0.0..=1e30).contains(&found) {
            return Err(FactoredCardError::Figure { what: "an exposure of 0 to 1e30", found });
        }
        if let (ProductPlace::Pixels(options), Some(maps)) = (&self.place, &self.maps) {
            let stream = RadianceStream { mesh: self.mesh, options, scales: &maps.scales, frame: &self.frame };
            let passes = if options.is_pass_per_channel { 3 } else { 1 };
            let sets = |pass| stream.sets(&view.camera, view.exposure, pass);
            let passes = (0..passes).map(sets).collect::<Result<_, _>>()?;
            return Ok(FrameStreams { passes, counts: FactoredCounts::default() });
        }
        let stream = match self.place {
            ProductPlace::Vertices(format) => ColorStream::new(&self.mesh, (&view.camera, view.exposure), format)?,
            ProductPlace::Pixels(_) => ColorStream::diffuse(&self.mesh, view.exposure)?,
        };
        let ColorStream { colors, below_zero, above_one } = stream;
        let counts = FactoredCounts {
            vertices_below_zero: Some(below_zero),
            vertices_above_one: Some(above_one),
            ..FactoredCounts::default()
        };
        Ok(FrameStreams { passes: vec![vec![colors]], counts })
    }

    fn draw(&mut self, view: &PrtView, streams: &FrameStreams) -> Result<NearestTarget, FactoredCardError> {
        let size = [view.camera.width(), view.camera.height()];
        let target = self.target.of(&mut self.machine, view.format, size)?;
        target.clear(&mut self.machine)?;
        let mut head = view.camera.clip_rows(&self.frame).to_vec();
        let [x, y, z] = self.frame.of_scene(wide(view.camera.eye())).to_array().map(|value| value as f32);
        head.push([x, y, z, 1.0]);
        head.truncate(if self.programs.makes_view() { 5 } else { 4 });
        let (vertex_constants, pixel_constants) = (constants(head), constants([]));
        for (pass, sets) in streams.passes.iter().enumerate() {
            let attributes = std::iter::once(&self.positions).chain(sets).chain(&self.axes);
            let source = VertexSource::Program {
                program: &self.programs.vertex,
                constants: &vertex_constants,
                streams: vertex_streams(attributes),
            };
            let pixel = &self.programs.pixel;
            let mut call = DrawCall::new(source, Primitive::TriangleList, pixel, &pixel_constants, target.color);
            target.keep_nearest(&mut call);
            if pass > 0 {
                call.depth = DepthState { test: Some(CompareFunction::Equal), write: false };
            }
            call.indices = Some(&self.indices);
            call.masks[0] = if streams.passes.len() == 1 { WriteMask::ALL } else { CHANNELS[pass] };
            for (sampler, &texture) in self.maps.iter().flat_map(|maps| &maps.textures).enumerate() {
                call = call.with_texture(sampler, texture, self.sampler());
            }
            self.machine.draw(&call)?;
        }
        Ok(target)
    }

    fn sampler(&self) -> SamplerState {
        match &self.programs.drawing {
            Drawing::Products(kernel) if kernel.filter == MapFilter::Program => SamplerState::NEAREST_CLAMP,
            _ => BILINEAR,
        }
    }

    /// A target of floats that the device has, to see what others clamp.
    pub(super) fn float_target(&self) -> Option<TexelFormat> {
        let has = |format: &TexelFormat| {
            self.machine.profile().limits.target_formats.iter().any(|name| name == format.name())
        };
        [TexelFormat::Rgba32f, TexelFormat::Rgba16f].into_iter().find(has)
    }
}
