//! A mesh with transferred radiance on an emulated card, and its picture, with counts of the colors that are out of
//! range.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::{Executor, Machine};
use refsim::output::WriteMask;
use refsim::texture::TexelFormat;

use super::attributes::{FactoredCounts, TransferredMesh, colors, diffuse_radiance, radiance_sets};
use super::options::{ProductPlace, VertexColors};
use super::programs::{FactorMaps, Programs};
use super::time;
use crate::all_frequency::Reflectance;
use crate::all_frequency::shade::Multiplies;
use crate::card::{
    Attribute, CardError, KeptFragments, MeshDisplay, MeshDraw, MeshPass, MeshView, Texels, by_register, slots,
};

/// Write masks of the passes of one channel each; alpha marks covered pixels.
const CHANNELS: [WriteMask; 3] = [WriteMask(1 | 8), WriteMask(2), WriteMask(4)];

/// A picture, its counts and its log.
#[derive(Clone, Debug)]
pub struct FactoredDrawing {
    /// The texels of the target.
    pub texels: Texels,
    /// The texels in floating point, which shows negative pixels; `None` if the device has no such target.
    pub signed: Option<Texels>,
    /// Counts of clamped colors.
    pub counts: FactoredCounts,
    /// Texture reads and arithmetic slots of the first mesh's pixel program.
    pub pixel_slots: [u32; 2],
    /// The log of host and card, for [`frame_time`](crate::card::frame_time::frame_time).
    pub log: Vec<Event>,
}

/// Meshes with transferred radiance on a card.
#[derive(Debug)]
pub struct FactoredCard<'a> {
    display: MeshDisplay,
    meshes: Vec<MeshOnCard<'a>>,
    place: ProductPlace,
}

/// A mesh with its programs and streams.
#[derive(Debug)]
struct MeshOnCard<'a> {
    transferred: TransferredMesh<'a>,
    positions: Attribute,
    /// Tangents and normals, if the vertex program computes the view.
    axes: Vec<Attribute>,
    programs: Programs,
    maps: Option<FactorMaps>,
}

impl<'a> MeshOnCard<'a> {
    fn new(
        machine: &mut Machine,
        mesh: TransferredMesh<'a>,
        positions: &[[u32; 4]],
        place: &ProductPlace,
    ) -> Result<Self, CardError> {
        mesh.check()?;
        let programs = Programs::new(machine.profile(), &mesh, place)?;
        let maps = match (place, mesh.reflectance) {
            (ProductPlace::Pixels(options), Reflectance::Factored(factors)) => {
                Some(FactorMaps::new(machine, factors, options)?)
            }
            _ => None,
        };
        let axes = |vertex: usize| mesh.vertices.frames()[vertex].attributes().to_vec();
        let axes = if programs.makes_view { by_register(2, mesh.vertices.len(), axes) } else { Vec::new() };
        Ok(Self { transferred: mesh, positions: positions.to_vec(), axes, programs, maps })
    }

    fn draw(
        &self,
        pass: &mut MeshPass<'_>,
        place: &ProductPlace,
        view: &MeshView,
    ) -> Result<FactoredCounts, CardError> {
        let Self { transferred, positions, axes, programs, maps } = self;
        let textures = maps.iter().flat_map(|maps| &maps.textures);
        let textures: Vec<_> = textures.map(|&texture| (texture, programs.sampler)).collect();
        let (passes, counts) = attributes(transferred, place, maps.as_ref(), view)?;
        let mut head = pass.head();
        head.truncate(if programs.makes_view { 5 } else { 4 });
        for (number, sets) in passes.iter().enumerate() {
            pass.draw(MeshDraw {
                vertex: (&programs.vertex, head.clone()),
                attributes: [positions].into_iter().chain(sets).chain(axes).collect(),
                indices: Some(transferred.vertices.triangles().as_flattened()),
                pixel: (&programs.pixel, Vec::new()),
                textures: textures.clone(),
                // The first pass fills the depth buffer; the others write their channel at the same depths.
                fragments: if number == 0 { KeptFragments::Nearest } else { KeptFragments::Visible },
                mask: if passes.len() == 1 { WriteMask::ALL } else { CHANNELS[number] },
            })?;
        }
        Ok(counts)
    }
}

impl<'a> FactoredCard<'a> {
    /// Uploads meshes, such as a model and the ground below it, and their maps of G. They share a camera and a depth
    /// buffer, and are drawn in order.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        meshes: &[TransferredMesh<'a>],
        place: ProductPlace,
    ) -> Result<Self, CardError> {
        let machine = executor.into().machine(profile.into())?;
        let positions = meshes.iter().flat_map(|mesh| mesh.vertices.positions().iter().copied());
        let mut display = MeshDisplay::new(machine, positions);
        let all = display.positions().clone();
        let mut rest = &all[..];
        let mut on_card = |&mesh: &TransferredMesh<'a>| {
            let (positions, others) = rest.split_at(mesh.vertices.len());
            rest = others;
            MeshOnCard::new(display.machine_mut(), mesh, positions, &place)
        };
        let meshes = meshes.iter().map(&mut on_card).collect::<Result<_, _>>()?;
        Ok(Self { display, meshes, place })
    }

    /// Draws a frame and returns its render target. Background pixels are 0, alpha is 1 elsewhere.
    pub fn view_texels(&mut self, view: &MeshView) -> Result<Texels, CardError> {
        Ok(self.show(view, false)?.0)
    }

    /// Like [`Self::view_texels`], with the log of host and card for [`time`]; `host` are the multiplications of steps
    /// 2 and 3 for all meshes.
    pub fn logged_view(
        &mut self,
        view: &MeshView,
        host: Multiplies,
    ) -> Result<(Texels, FactoredCounts, Vec<Event>), CardError> {
        let (texels, counts, drawn) = self.show(view, true)?;
        let mut log = time::host_log(self.meshes.iter().map(|mesh| &mesh.transferred), &self.place, host);
        log.extend(drawn);
        Ok((texels, counts, log))
    }

    fn show(&mut self, view: &MeshView, is_logged: bool) -> Result<(Texels, FactoredCounts, Vec<Event>), CardError> {
        let Self { display, meshes, place } = self;
        let mut counts = FactoredCounts::default();
        let (texels, log) = display.show(view, is_logged, |pass| {
            meshes.iter().try_for_each(|mesh| {
                counts.add_vertices(mesh.draw(pass, place, view)?);
                Ok(())
            })
        })?;
        Ok((texels, counts, log))
    }
}

/// Draws meshes on a device, in order. `host` are the multiplications of steps 2 and 3 for all of them. Panics if there
/// is no mesh.
pub fn draw(
    profile: impl Into<Arc<Profile>>,
    executor: impl Into<Executor>,
    meshes: &[TransferredMesh<'_>],
    place: ProductPlace,
    view: &MeshView,
    host: Multiplies,
) -> Result<FactoredDrawing, CardError> {
    let mut card = FactoredCard::new(profile, executor, meshes, place)?;
    let (texels, mut counts, log) = card.logged_view(view, host)?;
    // A floating-point target shows values that other targets clamp.
    let formats = &card.display.machine().profile().limits.target_formats;
    let float = [TexelFormat::Rgba32f, TexelFormat::Rgba16f].into_iter().find(|format| formats.contains(format));
    let signed = match float {
        Some(format) if format == view.format => Some(texels.clone()),
        Some(format) => Some(card.view_texels(&MeshView { format, ..*view })?),
        None => None,
    };
    if let Some(signed) = &signed {
        let covered = || signed.texels.iter().filter(|texel| texel[3] != 0.0);
        counts.covered = Some(covered().count() as u64);
        let is_negative = |texel: &&[f32; 4]| texel[..3].iter().any(|&value| value < 0.0);
        counts.below_zero = Some(covered().filter(is_negative).count() as u64);
    }
    Ok(FactoredDrawing { texels, signed, counts, pixel_slots: slots(&card.meshes[0].programs.pixel), log })
}

/// The attributes that the host sends per view, pass by pass, and counts of colors. In registers they follow positions.
fn attributes(
    mesh: &TransferredMesh<'_>,
    place: &ProductPlace,
    maps: Option<&FactorMaps>,
    view: &MeshView,
) -> Result<(Vec<Vec<Attribute>>, FactoredCounts), CardError> {
    if let (ProductPlace::Pixels(options), Some(maps)) = (place, maps) {
        let passes = if options.is_pass_per_channel { 3 } else { 1 };
        let sets = |pass| radiance_sets(mesh, options, &maps.scales, view.exposure, pass);
        let passes = (0..passes).map(sets).collect::<Result<_, _>>()?;
        return Ok((passes, FactoredCounts::default()));
    }
    let (colors, counts) = match *place {
        ProductPlace::Vertices(format) => colors(&mesh.radiance(view.camera.eye()), view.exposure, format)?,
        // A diffuse surface has one term, whose G does not depend on the view. Floats clamp no colors.
        ProductPlace::Pixels(_) => {
            let (colors, _) = colors(&diffuse_radiance(mesh), view.exposure, VertexColors::Floats)?;
            (colors, FactoredCounts::default())
        }
    };
    Ok((vec![vec![colors]], counts))
}
