//! Traces of pixels through a draw. The scalar executor makes all traces; a draw on any executor gives the same values.

use super::tiles::tile_draw;
use super::validate::{Plan, ROUND};
use super::vertices::VertexStage;
use super::walk::load;
use super::{DrawCall, ExecutorKind, Machine, MachineError, PixelState, validate};
use crate::exec::batch::BatchExecutor;
use crate::exec::scalar::ScalarTiles;
use crate::exec::{Overrun, Shading, program};
use crate::isa::Stage;
use crate::output::TargetTile;
use crate::raster::{ComponentMask, RasterRules, TriangleSetup, Vertex, setup};
use crate::texture::Region;
use rayon::prelude::*;

/// A fragment of a traced pixel: its triangle, the execution of the program, and the targets before and after.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FragmentTrace {
    /// The instance, from 0.
    pub instance: usize,
    /// The triangle within the instance, from 0, in order of assembly.
    pub triangle: usize,
    /// The part of the triangle, from 0; a triangle clipped to more than three corners has several parts.
    pub part: usize,
    /// Contents of the targets at the pixel before the fragment.
    pub before: PixelState,
    /// Execution of the program.
    pub shading: Shading,
    /// Contents of the targets at the pixel after the fragment.
    pub after: PixelState,
}

impl Machine {
    /// Traces one pixel through a draw without modifying memory. Returns the fragments of all triangles that cover the
    /// pixel, in order of submission; each starts with the target contents that the previous fragment left.
    ///
    /// # Errors
    /// As [`Machine::draw`], and [`MachineError::NoSuchPixel`].
    pub fn trace(&self, call: &DrawCall<'_>, pixel: (u32, u32)) -> Result<Vec<FragmentTrace>, MachineError> {
        Ok(self.trace_pixels(call, &[pixel])?.into_iter().flatten().collect())
    }

    /// [`Machine::trace`] for several pixels, which processes the vertices only once.
    ///
    /// # Errors
    /// As [`Machine::trace`].
    pub fn trace_pixels(
        &self,
        call: &DrawCall<'_>,
        pixels: &[(u32, u32)],
    ) -> Result<Vec<Vec<FragmentTrace>>, MachineError> {
        let plan = validate::plan(&self.profile, &self.memory, call)?;
        let mut traced = pixels.iter().map(|&pixel| self.start(call, pixel)).collect::<Result<Vec<_>, _>>()?;
        let mut work = || self.trace_on_host(call, &plan, &mut traced);
        match &self.pool {
            Some(pool) => pool.install(work),
            None => work(),
        }?;
        Ok(traced.into_iter().map(|pixel| pixel.fragments).collect())
    }

    /// Corners of a triangle of an instance, as output by the vertex stage; `None` if the call has no such triangle.
    ///
    /// # Errors
    /// As [`Machine::draw`].
    pub fn corners(
        &self,
        call: &DrawCall<'_>,
        instance: usize,
        triangle: usize,
    ) -> Result<Option<[Vertex; 3]>, MachineError> {
        let plan = validate::plan(&self.profile, &self.memory, call)?;
        let Some(corners) = plan.triangles.get(triangle).filter(|_| instance < plan.instance_count) else {
            return Ok(None);
        };
        let stage = VertexStage::new(call, &self.profile, self.vertex_executor(), ComponentMask::ALL);
        let vertices = stage.run(instance, 1, &plan)?.vertices;
        let [a, b, c] = corners.map(|corner| vertices.get(corner).copied());
        Ok(a.zip(b).zip(c).map(|((a, b), c)| [a, b, c]))
    }

    /// Width and height of a call's targets, or of its depth buffer if it has no colour targets; 0 if there is neither.
    ///
    /// # Errors
    /// If a handle is invalid.
    pub fn target_size(&self, call: &DrawCall<'_>) -> Result<[u32; 2], MachineError> {
        match (call.targets.first(), call.depth_buffer) {
            (Some(&id), _) => self.memory.texture(id).map(|image| [image.width(), image.height()]),
            (None, Some(id)) => self.memory.depth(id).map(|surface| [surface.width(), surface.height()]),
            (None, None) => Ok([0; 2]),
        }
    }

    pub(super) fn start(&self, call: &DrawCall<'_>, (x, y): (u32, u32)) -> Result<TracedPixel, MachineError> {
        let tile = load(&self.memory, call, Region { x, y, width: 1, height: 1 })?;
        if tile.index(x, y).is_none() {
            let [width, height] = self.target_size(call)?;
            return Err(MachineError::NoSuchPixel { x, y, width, height });
        }
        Ok(TracedPixel { tile, fragments: Vec::new() })
    }

    /// Traces all pixels through all triangles of a call, in the same rounds as a draw.
    fn trace_on_host(&self, call: &DrawCall<'_>, plan: &Plan, traced: &mut [TracedPixel]) -> Result<(), MachineError> {
        let tracer = ScalarTiles::new(&tile_draw(&self.profile, &self.memory, call));
        self.rounds(call, plan, |setups| {
            let passed: Vec<_> = traced.par_iter_mut().map(|pixel| pixel.pass(setups, &tracer)).collect();
            let budget = self.profile.limits.step_budget(Stage::Pixel);
            match passed.into_iter().filter_map(Result::err).min() {
                Some(overrun) => Err(MachineError::overrun(overrun, program(call.pixel_program), budget)),
                None => Ok(()),
            }
        })
    }

    /// Runs the vertex stage and the triangle set-up of a call, in the same rounds as a draw.
    pub(super) fn rounds(
        &self,
        call: &DrawCall<'_>,
        plan: &Plan,
        mut pass: impl FnMut(&[PlacedSetup]) -> Result<(), MachineError>,
    ) -> Result<(), MachineError> {
        let stage = VertexStage::new(call, &self.profile, self.vertex_executor(), ComponentMask::ALL);
        let rules = RasterRules::from(&self.profile.rules);
        for instances in plan.rounds() {
            let (first, count) = (instances.start, instances.len());
            let vertices = stage.run(first, count, plan)?.vertices;
            for triangles in (0..count * plan.triangles.len()).collect::<Vec<_>>().chunks(ROUND) {
                pass(&set_up(&vertices, triangles, first, plan, &rules))?;
            }
        }
        Ok(())
    }

    /// The executor that runs vertex programs; GPU machines use the batch executor.
    fn vertex_executor(&self) -> (ExecutorKind, &BatchExecutor) {
        match self.executor {
            #[cfg(feature = "wgpu")]
            ExecutorKind::Wgpu => (ExecutorKind::Batch, &self.batch),
            kind => (kind, &self.batch),
        }
    }
}

/// A set-up with the indices of its instance, triangle and part.
pub(super) type PlacedSetup = (usize, usize, usize, TriangleSetup);

/// Sets up triangles of a round whose first instance is `first`.
fn set_up(
    vertices: &[Vertex],
    triangles: &[usize],
    first: usize,
    plan: &Plan,
    rules: &RasterRules,
) -> Vec<PlacedSetup> {
    let each = plan.triangles.len().max(1);
    let mut placed = Vec::new();
    let mut parts = Vec::new();
    for &i in triangles {
        let (instance, triangle) = (i / each, i % each);
        let Some(corners) = plan.corners(vertices, instance * plan.vertex_count, triangle) else { continue };
        setup(corners.each_ref(), &plan.raster, rules, &mut parts);
        placed.extend(parts.drain(..).enumerate().map(|(part, setup)| (first + instance, triangle, part, setup)));
    }
    placed
}

pub(super) struct TracedPixel {
    pub(super) tile: TargetTile,
    fragments: Vec<FragmentTrace>,
}

impl TracedPixel {
    fn pass(&mut self, setups: &[PlacedSetup], tracer: &ScalarTiles<'_>) -> Result<(), Overrun> {
        let pixel = self.tile.region;
        for (number, (instance, triangle, part, setup)) in (0..).zip(setups) {
            let inside = setup.bounds.intersect(pixel);
            if inside.width == 0 || inside.height == 0 || !setup.coverage(pixel.x, pixel.y) {
                continue;
            }
            let before = PixelState::of(&self.tile);
            let shading = tracer.follow(setup, &mut self.tile);
            let shading = shading.map_err(|overrun| Overrun { triangle: number, ..overrun })?;
            let after = PixelState::of(&self.tile);
            let (instance, triangle, part) = (*instance, *triangle, *part);
            self.fragments.push(FragmentTrace { instance, triangle, part, before, shading, after });
        }
        Ok(())
    }
}
