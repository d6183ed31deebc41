//! Display of bi-scale transfer by an emulated card (section V): passes over the mesh, each with as many directions as
//! the interpolated coordinates can hold, summed by blending. The depth buffer is filled first, so that passes add only
//! the nearest surface.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::exec::CheckedProgram;
use refsim::machine::Executor;
use refsim::output::WriteMask;

use super::gather::version;
use super::options::DisplayOptions;
use super::parts::{CardPart, LocalStream, largest, parts};
use super::subject::{CardVertices, TexturedMesh};
use crate::bi_scale::kernels::{LocalLayout, LocalVertexKernel};
use crate::card::{
    Attribute, BILINEAR, CardError, DepthPrograms, KeptFragments, MeshDisplay, MeshDraw, MeshView, Texels,
    WrittenKernel, by_register, slots, vertex_version,
};

/// Red, green and blue: later passes leave alpha, which marks covered pixels.
const COLORS: WriteMask = WriteMask(7);
/// Number of texture coordinate sets of ps_2_x, and the least number that can hold a direction.
const SETS: usize = 8;
const LEAST_SETS: usize = 3;

/// Counts of a frame, which do not depend on light and view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DisplayCounts {
    /// Number of draws, without the draw into the depth buffer: the passes of all textures.
    pub draws: usize,
    /// Number of passes per texture.
    pub passes: usize,
    /// Number of directions in a full pass.
    pub directions_per_pass: usize,
    /// Texture reads and arithmetic slots of a full pass's pixel program.
    pub pixel_slots: [u32; 2],
    /// Slots of the vertex program, and attributes per vertex.
    pub vertex: [usize; 2],
    /// Bytes of the volumes.
    pub volume_bytes: u64,
    /// Vertices on the card: corners with different texture coordinates are separate.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
}

/// A mesh with bidirectional textures on a card.
#[derive(Debug)]
pub struct BiScaleCard<'a> {
    display: MeshDisplay,
    textured: TexturedMesh<'a>,
    options: DisplayOptions,
    layout: LocalLayout,
    vertices: CardVertices,
    /// Texture coordinates, tangents, normals.
    beside: Vec<Attribute>,
    parts: Vec<CardPart>,
    depth: DepthPrograms,
    vertex: CheckedProgram,
    vertex_counts: [usize; 2],
}

impl<'a> BiScaleCard<'a> {
    /// Uploads a mesh and its textures.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        mesh: TexturedMesh<'a>,
        options: DisplayOptions,
    ) -> Result<Self, CardError> {
        let profile = profile.into();
        mesh.check()?;
        let ps = version(&profile, "the display")?;
        let sets = profile.limits.texture_coordinates.map_or(SETS, |limit| limit as usize).min(SETS);
        if sets < LEAST_SETS {
            return Err(CardError::input(format!(
                "a direction of light, texture coordinates and the view need 3 sets of texture coordinates; `{}` has \
                 {sets} (limits.texture_coordinates)",
                profile.name
            )));
        }
        let layout = LocalLayout { sets };
        let kernel = LocalVertexKernel { layout, version: vertex_version(&profile)? };
        let (vertex, vertex_counts) = (kernel.checked(&profile)?, [kernel.slots(), kernel.attributes()]);
        let depth = DepthPrograms::new(&profile)?;
        let mut machine = executor.into().machine(profile.clone())?;
        let vertices = CardVertices::new(&mesh);
        let parts = parts(&mut machine, &mesh, &vertices, options, layout, ps)?;
        let place = |&vertex: &u32| mesh.vertices.positions()[vertex as usize];
        let beside = by_register(3, vertices.vertices.len(), |at| {
            let [tangent, normal] = mesh.vertices.frames()[vertices.vertices[at] as usize].attributes();
            let [u, v] = vertices.coordinates[at];
            vec![[u, v, 0.0, 0.0].map(f32::to_bits), tangent, normal]
        });
        Ok(Self {
            display: MeshDisplay::new(machine, vertices.vertices.iter().map(place)),
            textured: mesh,
            options,
            layout,
            vertices,
            beside,
            parts,
            depth,
            vertex,
            vertex_counts,
        })
    }

    /// Width, height and depth of each texture's volume, in texels.
    pub fn volumes(&self) -> impl Iterator<Item = [usize; 3]> {
        self.parts.iter().map(|part| part.volume.grid.extents())
    }

    /// Counts of a frame.
    pub fn counts(&self) -> DisplayCounts {
        let whole = self.parts.first().and_then(|part| part.pixels.last_key_value());
        let passes = self.layout.passes(self.textured.directions());
        let texels: usize = self.volumes().map(|extents| extents.iter().product::<usize>()).sum();
        DisplayCounts {
            draws: passes * self.parts.len(),
            passes,
            directions_per_pass: whole.map_or(0, |(&directions, _)| directions),
            pixel_slots: whole.map_or([0; 2], |(_, program)| slots(program)),
            vertex: self.vertex_counts,
            volume_bytes: texels as u64 * self.options.texture.bytes() as u64,
            vertices: self.vertices.vertices.len(),
            triangles: self.textured.vertices.triangles().len(),
        }
    }

    /// Draws a frame from local light, M colors (red, green, blue) per vertex, and returns the target. Background
    /// pixels are 0, alpha is 1 elsewhere.
    pub fn view_texels(&mut self, local: &[[f32; 3]], view: &MeshView) -> Result<Texels, CardError> {
        Ok(self.show(local, view, false)?.0)
    }

    /// Like [`Self::view_texels`], with the log of the frame's work, without read-back, and without upload of local
    /// light, which the paper keeps on the card.
    pub fn logged_view(&mut self, local: &[[f32; 3]], view: &MeshView) -> Result<(Texels, Vec<Event>), CardError> {
        self.show(local, view, true)
    }

    fn show(
        &mut self,
        local: &[[f32; 3]],
        view: &MeshView,
        is_logged: bool,
    ) -> Result<(Texels, Vec<Event>), CardError> {
        let Self { vertices, layout, options, .. } = self;
        let directions = self.textured.directions();
        let expected = directions * self.textured.vertices.len();
        self.display.show(view, is_logged, |pass| {
            CardError::check_size("numbers of local light", expected, local.len())?;
            pass.draw_depth(&self.depth, &vertices.indices)?;
            for part in &self.parts {
                let factor = view.exposure * part.volume.scale;
                let largest = largest(local, factor)?;
                for first in (0..directions).step_by(layout.directions()) {
                    let count = layout.directions().min(directions - first);
                    let (layout, format) = (*layout, options.local);
                    let stream = LocalStream { vertices, layout, local, directions, factor, largest, format };
                    let sets = stream.sets(first, count)?;
                    pass.draw(MeshDraw {
                        vertex: (&self.vertex, pass.head()),
                        attributes: [pass.positions()].into_iter().chain(&sets).chain(&self.beside).collect(),
                        indices: Some(&part.indices),
                        pixel: (&part.pixels[&count], part.constants(first..first + count)),
                        textures: vec![(part.volume.id, BILINEAR)],
                        fragments: KeptFragments::Added,
                        mask: if first == 0 { WriteMask::ALL } else { COLORS },
                    })?;
                }
            }
            Ok(())
        })
    }
}
