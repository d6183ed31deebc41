//! The display of bi-scale transfer by an emulated card (section V): passes over the mesh, each with as many directions
//! as its interpolated numbers hold, added up by blending. The depth buffer is filled first, so that a pass adds what
//! is nearest and nothing else.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::{DrawCall, Executor, Machine, VertexSource};
use refsim::output::{BlendFactor, BlendOp, BlendState, CompareFunction, DepthState, WriteMask};
use refsim::raster::{PixelCenter, Primitive};

use super::error::BiScaleCardError;
use super::gather::version;
use super::options::DisplayOptions;
use super::parts::{CardPart, parts};
use super::streams::{LocalStream, largest};
use super::subject::{CardVertices, TexturedMesh};
use crate::bi_scale::kernels::{FIRST_ORIGIN, LocalLayout, LocalVertexKernel};
use crate::card::{Attribute, BILINEAR, NearestTarget, Texels, ViewTarget, attribute, constants, vertex_streams};
use crate::cpca::kernels::{DEPTH, SHADE_COLOR};
use crate::cpca::on_card::{PrtCardError, PrtView, positions};
use crate::geom::UnitFrame;
use crate::geom::vector::wide;

/// Adds what a pass draws to the target.
const ADD: BlendState = BlendState::both(BlendFactor::One, BlendFactor::One, BlendOp::Add);
/// Red, green and blue: passes after the first leave alpha, which marks what is covered.
const COLORS: WriteMask = WriteMask(7);
/// Sets of coordinates of ps_2_x, and the fewest that hold a direction.
const SETS: usize = 8;
const LEAST_SETS: usize = 3;

/// What a frame takes, whatever is in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DisplayCounts {
    /// Draws, beside that into the depth buffer: passes for each texture.
    pub draws: usize,
    /// Passes for a texture.
    pub passes: usize,
    /// Directions of a whole pass.
    pub directions_per_pass: usize,
    /// Texture reads and arithmetic slots of a whole pass's pixel program.
    pub pixel_slots: [u32; 2],
    /// Slots of the vertex program, and attributes of a vertex.
    pub vertex: [usize; 2],
    /// Bytes of the volumes.
    pub volume_bytes: u64,
    /// Vertices of the card: corners of different texture coordinates are apart.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
}

/// A mesh with bidirectional textures on a card.
#[derive(Debug)]
pub struct BiScaleCard<'a> {
    machine: Machine,
    mesh: TexturedMesh<'a>,
    options: DisplayOptions,
    layout: LocalLayout,
    vertices: CardVertices,
    frame: UnitFrame,
    positions: Attribute,
    /// Texture coordinates, tangents, normals.
    beside: [Attribute; 3],
    /// Of each texture that triangles name.
    parts: Vec<CardPart>,
    depth: [CheckedProgram; 2],
    vertex: CheckedProgram,
    vertex_counts: [usize; 2],
    target: ViewTarget,
}

impl<'a> BiScaleCard<'a> {
    /// Uploads a mesh and its textures.
    ///
    /// # Errors
    /// [`BiScaleCardError`] if the device lacks programs, coordinates, volumes of the size or their format, or the
    /// parts of the mesh do not go together.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        mesh: TexturedMesh<'a>,
        options: DisplayOptions,
    ) -> Result<Self, BiScaleCardError> {
        let profile = profile.into();
        mesh.check()?;
        let ps = version(&profile, "the display")?;
        let sets = profile.limits.texture_coordinates.map_or(SETS, |limit| limit as usize).min(SETS);
        if sets < LEAST_SETS {
            return Err(BiScaleCardError::Coordinates { device: profile.name.clone(), found: sets });
        }
        let layout = LocalLayout { sets };
        let has_vs_2_0 = profile.limits.versions.contains(&Version::Vs2_0);
        let vs = if has_vs_2_0 { Version::Vs2_0 } else { Version::Vs1_1 };
        PrtCardError::check_version(&profile, vs, "the vertex stage")?;
        let kernel = LocalVertexKernel { layout, version: vs };
        let (vertex, vertex_counts) = (kernel.checked(&profile)?, [kernel.slots(), kernel.attributes()]);
        let depth = [DEPTH.checked(&profile)?, SHADE_COLOR.checked(&profile)?];
        let mut machine = executor.into().machine(profile.clone())?;
        let vertices = CardVertices::new(&mesh);
        let parts = parts(&mut machine, (&mesh, &vertices), options, (layout, ps))?;
        let frame = UnitFrame::new(mesh.vertices.positions().iter().copied().map(wide));
        let of_mesh = positions(mesh.vertices, &frame);
        let frames = || vertices.vertices.iter().map(|&vertex| &mesh.vertices.frames()[vertex as usize]);
        let beside = [
            vertices.coordinates.iter().map(|&[u, v]| [u, v, 0.0, 0.0].map(f32::to_bits)).collect(),
            frames().map(|frame| attribute(frame.tangent().to_array(), 0.0)).collect(),
            frames().map(|frame| attribute(frame.normal().to_array(), 0.0)).collect(),
        ];
        Ok(Self {
            machine,
            mesh,
            options,
            layout,
            positions: vertices.vertices.iter().map(|&vertex| of_mesh[vertex as usize]).collect(),
            vertices,
            frame,
            beside,
            parts,
            depth,
            vertex,
            vertex_counts,
            target: ViewTarget::default(),
        })
    }

    /// The emulated card.
    pub fn machine_mut(&mut self) -> &mut Machine {
        &mut self.machine
    }

    /// Width, height and depth of each texture's volume in texels.
    pub fn volumes(&self) -> impl Iterator<Item = [usize; 3]> {
        self.parts.iter().map(|part| part.volume.grid.extents())
    }

    /// What a frame takes.
    pub fn counts(&self) -> DisplayCounts {
        let whole = self.parts.first().and_then(|part| part.pixels.first());
        let slots = whole.map_or(&[][..], |whole| &whole.program.facts().slots);
        let passes = self.layout.passes(self.mesh.directions());
        let texels: usize = self.volumes().map(|extents| extents.iter().product::<usize>()).sum();
        DisplayCounts {
            draws: passes * self.parts.len(),
            passes,
            directions_per_pass: whole.map_or(0, |whole| whole.directions),
            pixel_slots: [
                slots.iter().map(|phase| phase.texture).sum(),
                slots.iter().map(|phase| phase.arithmetic).sum(),
            ],
            vertex: self.vertex_counts,
            volume_bytes: texels as u64 * self.options.texture.bytes() as u64,
            vertices: self.vertices.vertices.len(),
            triangles: self.mesh.vertices.triangles().len(),
        }
    }

    /// A frame as the target holds it, from local light: of each vertex M times red, green, blue. Pixels that show
    /// nothing are 0, alpha is 1 elsewhere.
    ///
    /// # Errors
    /// [`BiScaleCardError`] for an exposure out of range, light of another size or that its format does not hold, and
    /// draws that the card refuses.
    pub fn view_texels(&mut self, local: &[[f32; 3]], view: &PrtView) -> Result<Texels, BiScaleCardError> {
        let target = self.draw(local, view)?;
        Ok(Texels::read_back(&self.machine, target.color)?)
    }

    /// The same, with what the frame asks of the card: no read-back, and no numbers on their way, as local light is on
    /// the card.
    ///
    /// # Errors
    /// As [`Self::view_texels`].
    pub fn logged_view(
        &mut self,
        local: &[[f32; 3]],
        view: &PrtView,
    ) -> Result<(Texels, Vec<Event>), BiScaleCardError> {
        self.machine.record(true);
        let drawn = self.draw(local, view);
        self.machine.record(false);
        let log = self.machine.take_log();
        Ok((Texels::read_back(&self.machine, drawn?.color)?, log))
    }

    fn draw(&mut self, local: &[[f32; 3]], view: &PrtView) -> Result<NearestTarget, BiScaleCardError> {
        let found = view.exposure;
        if !(0.0..=1e30).contains(&found) {
            return Err(BiScaleCardError::Figure { what: "an exposure of 0 to 1e30", found });
        }
        let directions = self.mesh.directions();
        let (expected, found) = (directions * self.mesh.vertices.len(), local.len());
        if expected != found {
            return Err(BiScaleCardError::Size { what: "numbers of local light", expected, found });
        }
        let size = [view.camera.width(), view.camera.height()];
        let target = self.target.of(&mut self.machine, view.format, size)?;
        target.clear(&mut self.machine)?;
        let mut head = view.camera.clip_rows(&self.frame).to_vec();
        self.draw_depth(target, &head)?;
        let [x, y, z] = self.frame.of_scene(wide(view.camera.eye())).to_array().map(|value| value as f32);
        head.push([x, y, z, 1.0]);
        for part in 0..self.parts.len() {
            let factor = view.exposure * self.parts[part].volume.scale;
            let largest = largest(local, factor)?;
            for first in (0..directions).step_by(self.layout.directions()) {
                let count = self.layout.directions().min(directions - first);
                let stream = LocalStream {
                    vertices: &self.vertices,
                    layout: self.layout,
                    local,
                    directions,
                    factor,
                    largest,
                    format: self.options.local,
                };
                let sets = stream.sets(first, count)?;
                self.draw_pass((target, part), &head, (&sets, first, count))?;
            }
        }
        Ok(target)
    }

    /// The whole mesh into the depth buffer alone.
    fn draw_depth(&mut self, target: NearestTarget, head: &[[f32; 4]]) -> Result<(), BiScaleCardError> {
        let (vertex_constants, pixel_constants) = (constants(head.iter().copied()), constants([]));
        let [program, pixel] = &self.depth;
        let streams = vertex_streams([&self.positions]);
        let source = VertexSource::Program { program, constants: &vertex_constants, streams };
        let mut call = DrawCall::new(source, Primitive::TriangleList, pixel, &pixel_constants, target.color);
        target.keep_nearest(&mut call);
        call.indices = Some(&self.vertices.indices);
        call.masks[0] = WriteMask::NONE;
        self.machine.draw(&call)?;
        Ok(())
    }

    /// The directions of a pass, where a texture's triangles are what the depth buffer shows, added to the target.
    fn draw_pass(
        &mut self,
        (target, part): (NearestTarget, usize),
        head: &[[f32; 4]],
        (sets, first, count): (&[Attribute], usize, usize),
    ) -> Result<(), BiScaleCardError> {
        let part = &self.parts[part];
        let grid = &part.volume.grid;
        let [width, height, _] = grid.extents().map(|side| side as f64);
        let origin = |direction: usize| {
            let [x, y] = grid.origin(direction);
            [(x as f64 / width) as f32, (y as f64 / height) as f32, 0.0, 0.0]
        };
        let before = std::iter::repeat_n([0.0; 4], FIRST_ORIGIN);
        let pixel_constants = constants(before.chain((first..first + count).map(origin)));
        let vertex_constants = constants(head.iter().copied());
        let attributes = std::iter::once(&self.positions).chain(sets).chain(&self.beside);
        let source = VertexSource::Program {
            program: &self.vertex,
            constants: &vertex_constants,
            streams: vertex_streams(attributes),
        };
        let known = part.pixels.iter().find(|known| known.directions == count);
        let pixel = &known.expect("a program for each number of directions").program;
        let mut call = DrawCall::new(source, Primitive::TriangleList, pixel, &pixel_constants, target.color);
        call.center = PixelCenter::OpenGl;
        call.depth = DepthState { test: Some(CompareFunction::Equal), write: false };
        call.depth_buffer = Some(target.depth);
        call.indices = Some(&part.indices);
        call.blend = Some(ADD);
        call.masks[0] = if first == 0 { WriteMask::ALL } else { COLORS };
        call = call.with_texture(0, part.volume.id, BILINEAR);
        self.machine.draw(&call)?;
        Ok(())
    }
}
