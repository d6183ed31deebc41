//! A mesh drawn from a camera, for all systems that display one. Only front faces are drawn, because the host's rays
//! hit only front faces.

use refsim::device::Profile;
use refsim::event::Event;
use refsim::exec::CheckedProgram;
use refsim::machine::{DrawCall, Machine, VertexSource};
use refsim::output::{BlendFactor, BlendOp, BlendState, CompareFunction, DepthState, WriteMask};
use refsim::raster::{Cull, Primitive};
use refsim::texture::TexelFormat;

use super::kernels::{DEPTH, SHADE_COLOR};
use super::{
    Attribute, CardError, KernelError, NearestTarget, ReadTexture, Texels, ViewTarget, attribute, constants,
    vertex_streams,
};
use crate::geom::UnitFrame;
use crate::geom::vector::wide;
use crate::scene::Camera;

/// Camera, exposure and format of a picture of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshView {
    /// The camera.
    pub camera: Camera,
    /// Factor of all radiances in the picture: 0 to 1e30.
    pub exposure: f64,
    /// Format of the picture. Fixed-point formats clamp each pass to [0, 1]. Floating-point formats need a device that
    /// can draw into them, and that can blend in them if passes are added.
    pub format: TexelFormat,
}

impl From<Camera> for MeshView {
    fn from(camera: Camera) -> Self {
        Self { camera, exposure: 1.0, format: TexelFormat::Rgba32f }
    }
}

impl MeshView {
    fn check(&self) -> Result<(), CardError> {
        let found = self.exposure;
        if (0.0..=1e30).contains(&found) { Ok(()) } else { Err(CardError::figure("an exposure of 0 to 1e30", found)) }
    }
}

/// The fragments that a draw writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeptFragments {
    /// The nearest fragments, by the depth test; the draw also fills the depth buffer.
    Nearest,
    /// Fragments at the depths left by earlier draws; they replace the target's contents.
    Visible,
    /// Fragments at the depths left by earlier draws; they are added to the target's contents.
    Added,
}

/// A draw of a mesh or of a part of it.
#[derive(Clone, Debug)]
pub struct MeshDraw<'a> {
    /// The vertex program and its constants.
    pub vertex: (&'a CheckedProgram, Vec<[f32; 4]>),
    /// Attributes, from register 0 up.
    pub attributes: Vec<&'a Attribute>,
    /// Three vertices per triangle; `None`: all vertices in order.
    pub indices: Option<&'a [u32]>,
    /// The pixel program and its constants.
    pub pixel: (&'a CheckedProgram, Vec<[f32; 4]>),
    /// The textures of samplers 0, 1 and so on.
    pub textures: Vec<ReadTexture>,
    /// The fragments that are written.
    pub fragments: KeptFragments,
    /// The components that are written.
    pub mask: WriteMask,
}

/// The programs that fill only the depth buffer.
#[derive(Clone, Debug)]
pub struct DepthPrograms {
    vertex: CheckedProgram,
    pixel: CheckedProgram,
}

impl DepthPrograms {
    /// The programs, checked for a device.
    pub fn new(profile: &Profile) -> Result<Self, KernelError> {
        Ok(Self { vertex: DEPTH.checked(profile)?, pixel: SHADE_COLOR.checked(profile)? })
    }
}

/// A card that displays a mesh. Positions are in units of the mesh's size, so that the scene's unit of length has no
/// effect.
#[derive(Debug)]
pub struct MeshDisplay {
    machine: Machine,
    frame: UnitFrame,
    positions: Attribute,
    target: ViewTarget,
}

impl MeshDisplay {
    /// A mesh whose vertices have these positions, on a machine.
    pub fn new(machine: Machine, positions: impl IntoIterator<Item = [f32; 3], IntoIter: Clone>) -> Self {
        let positions = positions.into_iter().map(wide);
        let frame = UnitFrame::new(positions.clone());
        let positions = positions.map(|position| attribute(frame.of_scene(position).to_array(), 1.0)).collect();
        Self::in_frame(machine, frame, positions)
    }

    /// A mesh whose positions are already in `frame`, with w = 1.
    pub fn in_frame(machine: Machine, frame: UnitFrame, positions: Attribute) -> Self {
        Self { machine, frame, positions, target: ViewTarget::default() }
    }

    /// The emulated card.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The emulated card, for work other than display.
    pub fn machine_mut(&mut self) -> &mut Machine {
        &mut self.machine
    }

    /// The frame of the positions.
    pub fn frame(&self) -> &UnitFrame {
        &self.frame
    }

    /// Positions in the frame, with w = 1.
    pub fn positions(&self) -> &Attribute {
        &self.positions
    }

    /// Returns the target after `draw` and, if `is_logged`, the log of the draws without the read-back. The target is 0
    /// where nothing is drawn.
    pub fn show(
        &mut self,
        view: &MeshView,
        is_logged: bool,
        draw: impl FnOnce(&mut MeshPass<'_>) -> Result<(), CardError>,
    ) -> Result<(Texels, Vec<Event>), CardError> {
        view.check()?;
        if is_logged {
            self.machine.record(true);
        }
        let drawn = self.drawn(view, draw);
        let mut log = Vec::new();
        if is_logged {
            self.machine.record(false);
            log = self.machine.take_log();
        }
        Ok((Texels::read_back(&self.machine, drawn?.color)?, log))
    }

    fn drawn(
        &mut self,
        view: &MeshView,
        draw: impl FnOnce(&mut MeshPass<'_>) -> Result<(), CardError>,
    ) -> Result<NearestTarget, CardError> {
        let (machine, camera) = (&mut self.machine, view.camera);
        let target = self.target.of(machine, view.format, [camera.width(), camera.height()])?;
        target.clear(machine)?;
        draw(&mut MeshPass { machine, frame: &self.frame, positions: &self.positions, camera, target })?;
        Ok(target)
    }
}

/// A draw of a mesh into a target, under one camera.
#[derive(Debug)]
pub struct MeshPass<'a> {
    machine: &'a mut Machine,
    frame: &'a UnitFrame,
    positions: &'a Attribute,
    camera: Camera,
    target: NearestTarget,
}

impl<'a> MeshPass<'a> {
    /// Positions in the mesh's frame, with w = 1.
    pub fn positions(&self) -> &'a Attribute {
        self.positions
    }

    /// Rows of the projection matrix for the mesh's frame.
    pub fn rows(&self) -> [[f32; 4]; 4] {
        self.camera.clip_rows(self.frame)
    }

    /// The eye in the mesh's frame, with `w` as the fourth component.
    pub fn eye(&self, w: f32) -> [f32; 4] {
        attribute(self.frame.of_scene(wide(self.camera.eye())).to_array(), w).map(f32::from_bits)
    }

    /// The first constants of vertex programs: rows of the projection, then the eye with w = 1.
    pub fn head(&self) -> Vec<[f32; 4]> {
        self.rows().into_iter().chain([self.eye(1.0)]).collect()
    }

    /// Draws the whole mesh, only into the depth buffer. Fails with [`CardError::Draw`].
    pub fn draw_depth(&mut self, programs: &DepthPrograms, indices: &[u32]) -> Result<(), CardError> {
        self.draw(MeshDraw {
            vertex: (&programs.vertex, self.rows().to_vec()),
            attributes: vec![self.positions],
            indices: Some(indices),
            pixel: (&programs.pixel, Vec::new()),
            textures: Vec::new(),
            fragments: KeptFragments::Nearest,
            mask: WriteMask::NONE,
        })
    }

    /// Draws front faces: triangles whose corners appear counter-clockwise. Fails with [`CardError::Draw`].
    pub fn draw(&mut self, draw: MeshDraw<'_>) -> Result<(), CardError> {
        let MeshDraw { vertex: (program, vertex_constants), pixel: (pixel, pixel_constants), .. } = draw;
        let (vertex_constants, pixel_constants) = (constants(vertex_constants), constants(pixel_constants));
        let streams = vertex_streams(draw.attributes);
        let source = VertexSource::Program { program, constants: &vertex_constants, streams };
        let mut call = DrawCall::new(source, Primitive::TriangleList, pixel, &pixel_constants, self.target.color);
        self.target.keep_nearest(&mut call);
        call.cull = Cull::Clockwise;
        if draw.fragments != KeptFragments::Nearest {
            call.depth = DepthState { test: Some(CompareFunction::Equal), write: false };
        }
        if draw.fragments == KeptFragments::Added {
            call.blend = Some(BlendState::both(BlendFactor::One, BlendFactor::One, BlendOp::Add));
        }
        call.indices = draw.indices;
        call.masks[0] = draw.mask;
        for (sampler, (texture, state)) in draw.textures.into_iter().enumerate() {
            call = call.with_texture(sampler, texture, state);
        }
        self.machine.draw(&call)?;
        Ok(())
    }
}
