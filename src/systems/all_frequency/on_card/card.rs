//! A mesh with transferred radiance on an emulated card.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::{Executor, Machine};
use refsim::output::WriteMask;
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
use crate::card::{Attribute, BILINEAR, KeptFragments, MeshDraw, MeshOnCard, MeshView, Texels, attribute, slots};
use crate::geom::UnitFrame;

/// Write masks of the passes of one channel each; alpha marks covered pixels.
const CHANNELS: [WriteMask; 3] = [WriteMask(1 | 8), WriteMask(2), WriteMask(4)];

/// A mesh with transferred radiance on a card.
#[derive(Debug)]
pub struct FactoredCard<'a> {
    machine: Machine,
    transferred: TransferredMesh<'a>,
    place: ProductPlace,
    mesh: MeshOnCard,
    /// Tangents and normals, if the vertex program computes the view.
    axes: Vec<Attribute>,
    indices: Vec<u32>,
    programs: Programs,
    maps: Option<FactorMaps>,
}

/// The vertex streams of a frame, pass by pass.
struct FrameStreams {
    /// Per pass the attributes between positions and tangents.
    passes: Vec<Vec<Attribute>>,
    counts: FactoredCounts,
}

impl<'a> FactoredCard<'a> {
    /// Uploads a mesh, and the maps of G.
    ///
    /// # Errors
    /// [`FactoredCardError`] if the device lacks programs, coordinate sets, samplers or filtering of the format, or the
    /// parts of the mesh have contradictory sizes.
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
        let frames = || mesh.vertices.frames().iter();
        let axes = if programs.makes_view() {
            let tangents = frames().map(|frame| attribute(frame.tangent().to_array(), 0.0)).collect();
            vec![tangents, frames().map(|frame| attribute(frame.normal().to_array(), 0.0)).collect()]
        } else {
            Vec::new()
        };
        Ok(Self {
            machine,
            transferred: mesh,
            place,
            mesh: MeshOnCard::new(mesh.vertices.positions().iter().copied()),
            axes,
            indices: mesh.vertices.triangles().as_flattened().to_vec(),
            programs,
            maps,
        })
    }

    /// The emulated card.
    pub fn machine_mut(&mut self) -> &mut Machine {
        &mut self.machine
    }

    /// Texture reads and arithmetic slots of the pixel program.
    pub(super) fn pixel_slots(&self) -> [u32; 2] {
        slots(&self.programs.pixel)
    }

    /// The target of a frame. Background pixels are 0, alpha is 1 elsewhere.
    ///
    /// # Errors
    /// [`FactoredCardError`] for an exposure out of range, radiance outside its format's range, and draws that the card
    /// refuses.
    pub fn view_texels(&mut self, view: &MeshView) -> Result<Texels, FactoredCardError> {
        Ok(self.show((view, false))?.0)
    }

    /// As [`Self::view_texels`], with the log of host and card for [`time`]; `host` are the multiplications of steps 2
    /// and 3.
    ///
    /// # Errors
    /// As [`Self::view_texels`].
    pub fn logged_view(
        &mut self,
        view: &MeshView,
        host: Multiplies,
    ) -> Result<(Texels, FactoredCounts, Vec<Event>), FactoredCardError> {
        let (texels, counts, drawn) = self.show((view, true))?;
        let mut log = time::host_log(&self.transferred, &self.place, host);
        log.extend(drawn);
        Ok((texels, counts, log))
    }

    fn show(&mut self, view: (&MeshView, bool)) -> Result<(Texels, FactoredCounts, Vec<Event>), FactoredCardError> {
        let frame = *self.mesh.frame();
        let Self { transferred, place, axes, programs, maps, .. } = self;
        let sampler = sampler(&programs.drawing);
        let textures: Vec<_> = maps.iter().flat_map(|maps| &maps.textures).map(|&texture| (texture, sampler)).collect();
        let mut counts = FactoredCounts::default();
        let (texels, log) = self.mesh.show(&mut self.machine, view, |pass| {
            let streams = streams((transferred, place, maps.as_ref()), view.0, &frame)?;
            counts = streams.counts;
            let mut head = pass.head();
            head.truncate(if programs.makes_view() { 5 } else { 4 });
            for (number, sets) in streams.passes.iter().enumerate() {
                pass.draw(MeshDraw {
                    vertex: (&programs.vertex, head.clone()),
                    attributes: [pass.positions()].into_iter().chain(sets).chain(axes.iter()).collect(),
                    indices: Some(&self.indices),
                    pixel: (&programs.pixel, Vec::new()),
                    textures: textures.clone(),
                    // The first pass fills the depth buffer; the others write their channel at the same depths.
                    fragments: if number == 0 { KeptFragments::Nearest } else { KeptFragments::Visible },
                    mask: if streams.passes.len() == 1 { WriteMask::ALL } else { CHANNELS[number] },
                })?;
            }
            Ok::<_, FactoredCardError>(())
        })?;
        Ok((texels, counts, log))
    }

    /// A floating-point target format of the device, which shows values that other targets clamp.
    pub(super) fn float_target(&self) -> Option<TexelFormat> {
        let has = |format: &TexelFormat| self.machine.profile().limits.target_formats.contains(format);
        [TexelFormat::Rgba32f, TexelFormat::Rgba16f].into_iter().find(has)
    }
}

/// The vertex streams that the host sends for a view.
fn streams(
    (mesh, place, maps): (&TransferredMesh<'_>, &ProductPlace, Option<&FactorMaps>),
    view: &MeshView,
    frame: &UnitFrame,
) -> Result<FrameStreams, FactoredCardError> {
    if let (ProductPlace::Pixels(options), Some(maps)) = (place, maps) {
        let stream = RadianceStream { mesh: *mesh, options, scales: &maps.scales, frame };
        let passes = if options.is_pass_per_channel { 3 } else { 1 };
        let sets = |pass| stream.sets(&view.camera, view.exposure, pass);
        let passes = (0..passes).map(sets).collect::<Result<_, _>>()?;
        return Ok(FrameStreams { passes, counts: FactoredCounts::default() });
    }
    let stream = match *place {
        ProductPlace::Vertices(format) => ColorStream::new(mesh, (&view.camera, view.exposure), format)?,
        ProductPlace::Pixels(_) => ColorStream::diffuse(mesh, view.exposure)?,
    };
    let ColorStream { colors, below_zero, above_one } = stream;
    let counts = FactoredCounts {
        vertices_below_zero: Some(below_zero),
        vertices_above_one: Some(above_one),
        ..FactoredCounts::default()
    };
    Ok(FrameStreams { passes: vec![vec![colors]], counts })
}

fn sampler(drawing: &Drawing) -> SamplerState {
    match drawing {
        Drawing::Products(kernel) if kernel.filter == MapFilter::Program => SamplerState::NEAREST_CLAMP,
        _ => BILINEAR,
    }
}
