//! The item buffer: five faces of a hemicube, drawn by a card; each pixel is the number of the visible patch.

use std::sync::Arc;

use glam::DVec3;
use refsim::device::Profile;
use refsim::exec::{CheckedProgram, Constants};
use refsim::machine::{DrawCall, Executor, Machine, VertexSource};
use refsim::output::DepthFormat;
use refsim::raster::{Primitive, Vertex, Viewport};
use refsim::texture::{Region, TexelFormat};

use crate::card::{NearestTarget, Texels};
use crate::geom::vector::unit;
use crate::radiosity::draw::{DrawError, Projection, bits};
use crate::radiosity::kernels;
use crate::radiosity::{Patch, Patches};

/// Faces of a hemicube: the top, then the sides.
pub(super) const FACES: usize = 5;

/// A card with an item buffer. The top face lies at the upper left, the sides beside and under it: 2 by 3/2
/// resolutions.
#[derive(Debug)]
pub(super) struct ItemBuffer {
    machine: Machine,
    program: CheckedProgram,
    resolution: u32,
    target: NearestTarget,
}

impl ItemBuffer {
    pub(super) fn new(executor: &Executor, profile: &Arc<Profile>, resolution: u32) -> Result<Self, DrawError> {
        let mut machine = executor.machine(Arc::clone(profile))?;
        let program = kernels::ID.checked(profile)?;
        let target = NearestTarget::new(&mut machine, TexelFormat::R32f, DepthFormat::Unorm24, size(resolution))?;
        Ok(Self { machine, program, resolution, target })
    }

    /// Draws the faces of a hemicube. Pixels are patches' numbers from 1, negative for a back, 0 for none; rows from
    /// the top.
    pub(super) fn see(&mut self, patches: &Patches, hemicube: &HemicubeView) -> Result<[Vec<f32>; FACES], DrawError> {
        self.target.clear(&mut self.machine)?;
        for (face, projection) in hemicube.faces.iter().enumerate() {
            self.draw(patches, hemicube, projection, place(face, self.resolution))?;
        }
        let codes = Texels::read_back(&self.machine, self.target.color)?;
        Ok([0, 1, 2, 3, 4].map(|face| {
            let Region { x, y, width, height } = place(face, self.resolution);
            let rows = (y..y + height).flat_map(|y| &codes.row(y as usize)[x as usize..(x + width) as usize]);
            rows.map(|&[code, ..]| code).collect()
        }))
    }

    fn draw(
        &mut self,
        patches: &Patches,
        hemicube: &HemicubeView,
        projection: &Projection,
        face: Region,
    ) -> Result<(), DrawError> {
        let mut shapes = [(Primitive::QuadList, 4, Vec::new()), (Primitive::TriangleList, 3, Vec::new())];
        for &(patch, code) in hemicube.seen.iter() {
            let outline = &patches.list()[patch as usize];
            if projection.misses(outline) {
                continue;
            }
            for (_, sides, vertices) in &mut shapes {
                if *sides == outline.corners().len() {
                    vertices.extend(outline.corners().iter().map(|&corner| vertex(projection, corner, code)));
                }
            }
        }
        let constants = Constants::default();
        for (primitive, _, vertices) in shapes.iter().filter(|shape| !shape.2.is_empty()) {
            let source = VertexSource::Transformed(vertices);
            let mut call = DrawCall::new(source, *primitive, &self.program, &constants, self.target.color);
            let Region { x, y, width, height } = face;
            call.viewport = Some(Viewport { x: x.cast_signed(), y: y.cast_signed(), ..Viewport::new(width, height) });
            call.scissor = Some(face);
            self.target.keep_nearest(&mut call);
            self.machine.draw(&call)?;
        }
        Ok(())
    }
}

fn vertex(projection: &Projection, corner: DVec3, code: f64) -> Vertex {
    let mut vertex = projection.vertex(corner, [0.0; 2], crate::radiosity::draw::Side::Front);
    vertex.texcoords[3] = bits([0.0, 0.0, code, 0.0]);
    vertex
}

/// The size of an item buffer.
pub(super) fn size(resolution: u32) -> [u32; 2] {
    [2 * resolution, resolution + resolution / 2]
}

/// Region of a face in the item buffer.
fn place(face: usize, resolution: u32) -> Region {
    let half = resolution / 2;
    let [x, y, height] = match face {
        0 => [0, 0, resolution],
        1 => [resolution, 0, half],
        2 => [resolution, half, half],
        3 => [0, resolution, half],
        _ => [resolution, resolution, half],
    };
    Region { x, y, width: resolution, height }
}

/// The views of a hemicube: its five projections, and the patches that may be visible.
#[derive(Clone, Debug)]
pub(super) struct HemicubeView {
    pub(super) faces: [Projection; FACES],
    /// Patches that are not wholly behind the eye's plane, with their colors.
    pub(super) seen: Vec<(u32, f64)>,
}

/// Tolerance behind the eye's plane, relative to the patch's radius, within which corners count as on it.
const ON_PLANE: f64 = 1e-9;

impl HemicubeView {
    /// Creates a hemicube on a point of a patch.
    pub(super) fn new(patches: &Patches, patch: &Patch, point: DVec3) -> Self {
        let corners = patch.corners();
        let normal = patch.normal();
        let along = unit(corners[1] - corners[0]).unwrap_or(normal);
        let aside = normal.cross(along);
        let far = patches.extent();
        let top = Projection { eye: point, forward: normal, across: along, upwards: aside, far };
        // The lower edge of a side lies on the patch's plane, the upper one on the top face: y runs over twice the
        // height less w.
        let side = |forward: DVec3| Projection {
            eye: point,
            forward,
            across: forward.cross(normal),
            upwards: 2.0 * normal - forward,
            far,
        };
        let back = |v: DVec3| -1.0 * v;
        let faces = [top, side(along), side(aside), side(back(along)), side(back(aside))];
        let in_front = |other: &Patch| {
            other.face != patch.face && other.corners().iter().any(|&c| patch.height(c) > ON_PLANE * other.radius())
        };
        let code = |(i, other): (usize, &Patch)| Some((i as u32, top.side(other)?.code(i)));
        let seen = patches.list().iter().enumerate().filter(|(_, other)| in_front(other)).filter_map(code).collect();
        Self { faces, seen }
    }
}
