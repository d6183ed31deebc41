//! Tiled drawing: tiles in parallel, the triangles of a tile in order.

use super::memory::Memory;
use super::tiles::Tiles;
use super::validate::{Plan, ROUND};
use super::vertices::{VertexStage, set_up};
use super::{DrawCall, ExecutorKind, MachineError};
use crate::device::Profile;
use crate::event::{ByteCounts, DrawEvents, FragmentCounts};
use crate::exec::batch::{BatchExecutor, Instances, Surfaces};
use crate::exec::{Overrun, TILE, program};
use crate::isa::Stage;
use crate::output::TargetTile;
use crate::raster::{ComponentMask, RasterRules, TriangleSetup};
use crate::texture::Region;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

pub(super) struct DrawResult {
    /// Tiles touched by triangles, to be copied into memory.
    pub(super) tiles: Vec<TargetTile>,
    pub(super) events: DrawEvents,
}

/// A tile with its counters. Its contents are loaded when the first triangle touches it.
struct TileWork {
    region: Region,
    tile: Option<TargetTile>,
    counts: FragmentCounts,
}

pub(super) fn draw(
    memory: &Memory,
    profile: &Profile,
    call: &DrawCall<'_>,
    plan: &Plan,
    kind: (ExecutorKind, &BatchExecutor),
    executor: &Tiles<'_>,
) -> Result<DrawResult, MachineError> {
    let needed = match executor {
        Tiles::Scalar(_) => ComponentMask::ALL,
        Tiles::Batch(tiles) => tiles.inputs(),
    };
    let stage = VertexStage::new(call, profile, kind, needed);
    let mut events = DrawEvents { draws: 1, instances: plan.instance_count as u64, ..DrawEvents::default() };
    let shape = match executor {
        Tiles::Scalar(_) => TileShapes::Square,
        Tiles::Batch(tiles) if tiles.fragments_apart() => TileShapes::Any,
        Tiles::Batch(_) => TileShapes::Flat,
    };
    let mut work = tiles(plan.raster.scissor, shape);
    for instances in plan.rounds() {
        let (first, count) = (instances.start, instances.len());
        match executor {
            Tiles::Scalar(tiles) => {
                let batch = stage.run(first, count, plan)?;
                events.vertices += batch.vertices.len() as u64;
                events.vertex_instructions += batch.slots;
                let (setups, primitives) = set_up(&batch.vertices, count, plan, profile);
                events.primitives += primitives;
                for part in setups.chunks(ROUND) {
                    let run = |order: &[u32], tile: &mut TargetTile| tiles.run_tile(part, order, tile);
                    shade((memory, profile), call, &|i| part.get(i), part.len(), &run, &mut work)?;
                }
            }
            Tiles::Batch(tiles) => {
                events.vertices += (count * plan.vertex_count) as u64;
                let (surfaces, primitives, executed) = if plan.provoking.is_some() {
                    // Flat-shaded triangles have their own corners, so triangles can't share vertices.
                    let batch = stage.run(first, count, plan)?;
                    let (setups, primitives) = set_up(&batch.vertices, count, plan, profile);
                    (Surfaces::from_setups(&setups, needed), primitives, batch.slots)
                } else {
                    let rows = stage.rows(first, count, plan, needed)?;
                    let instances = Instances { rows: &rows, count, triangles: &plan.triangles };
                    let rules = RasterRules::from(&profile.rules);
                    let (surfaces, primitives) =
                        Surfaces::build(&instances, &plan.raster, &rules, needed, tiles.simd());
                    (surfaces, primitives, rows.executed)
                };
                events.vertex_instructions += executed;
                events.primitives += primitives;
                let round = tiles.round(&surfaces);
                // With fewer tiles than workers, several workers share a tile.
                let workers = rayon::current_num_threads().div_ceil(work.len().max(1));
                let run = |order: &[u32], tile: &mut TargetTile| tiles.draw(&round, order, tile, workers);
                shade((memory, profile), call, &|i| surfaces.geometry(i), surfaces.len(), &run, &mut work)?;
            }
        }
    }
    for tile in &work {
        events.fragments += tile.counts;
    }
    events.bytes = bytes(memory, call, &stage, &events);
    Ok(DrawResult { tiles: work.into_iter().filter_map(|w| w.tile).collect(), events })
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TileShapes {
    /// [`TILE`] columns and rows.
    Square,
    /// Also tiles of two rows with the same number of pixels, for regions that are one quad high.
    Flat,
    /// Also tiles of one row with the same number of pixels, for regions of one row.
    Any,
}

/// Tiles of a region, row by row; their positions are multiples of their size.
fn tiles(region: Region, shapes: TileShapes) -> Vec<TileWork> {
    let mut out = Vec::new();
    if region.width == 0 || region.height == 0 {
        return out;
    }
    let (last_x, last_y) = (region.x + region.width - 1, region.y + region.height - 1);
    let [width, height] = match shapes {
        TileShapes::Any if region.y == last_y => [TILE * TILE, 1],
        TileShapes::Any | TileShapes::Flat if region.y / 2 == last_y / 2 => [TILE * TILE / 2, 2],
        _ => [TILE; 2],
    };
    for y in region.y / height..=last_y / height {
        for x in region.x / width..=last_x / width {
            let whole = Region { x: x * width, y: y * height, width, height };
            out.push(TileWork { region: whole.intersect(region), tile: None, counts: FragmentCounts::default() });
        }
    }
    out
}

/// The first fragment over all tiles, in the order of [`Overrun`], that exceeded its step budget; independent of the
/// order in which tiles are drawn. Tiles that cannot contain an earlier overrun are skipped.
#[derive(Default)]
struct FirstOverrun(Mutex<Option<Overrun>>);

impl FirstOverrun {
    fn get(&self) -> Option<Overrun> {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn note(&self, overrun: Overrun) {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *first = Some(first.map_or(overrun, |known| known.min(overrun)));
    }
}

/// Draws `count` triangles, whose set-ups `geometry` returns, into all tiles.
fn shade<'s>(
    (memory, profile): (&Memory, &Profile),
    call: &DrawCall<'_>,
    geometry: &(impl Fn(usize) -> Option<&'s TriangleSetup> + Sync),
    count: usize,
    run: &(impl Fn(&[u32], &mut TargetTile) -> Result<FragmentCounts, Overrun> + Sync),
    work: &mut [TileWork],
) -> Result<(), MachineError> {
    let rows = row_bins(geometry, count, work);
    let first = FirstOverrun::default();
    let drawn = work.par_iter_mut().try_for_each(|work| {
        let Some(row) = rows.get((work.region.y / TILE) as usize) else {
            return Ok(());
        };
        let touches = |i: &u32| geometry(*i as usize).is_some_and(|s| !s.misses(work.region));
        // Triangles after a known overrun can't be reported, so they need not be drawn.
        let known = first.get();
        let (y, x) = (work.region.y, work.region.x);
        let matters = |&triangle: &u32| known.is_none_or(|known| Overrun { triangle, y, x, instruction: 0 } < known);
        let order: Vec<u32> = row.iter().copied().take_while(matters).filter(touches).collect();
        if order.is_empty() {
            return Ok(());
        }
        let tile = match &mut work.tile {
            Some(tile) => tile,
            empty => empty.insert(load(memory, call, work.region)?),
        };
        match run(&order, tile) {
            Ok(counts) => work.counts += counts,
            Err(overrun) => first.note(overrun),
        }
        Ok(())
    });
    match first.get() {
        Some(overrun) => {
            let budget = profile.limits.step_budget(Stage::Pixel);
            Err(MachineError::overrun(overrun, program(call.pixel_program), budget))
        }
        None => drawn,
    }
}

/// For each row of tiles, the triangles whose bounding box intersects the row, in order.
fn row_bins<'s>(
    geometry: &impl Fn(usize) -> Option<&'s TriangleSetup>,
    triangles: usize,
    work: &[TileWork],
) -> Vec<Vec<u32>> {
    let count = work.last().map_or(0, |w| w.region.y / TILE + 1);
    let mut rows = vec![Vec::new(); count as usize];
    for index in 0..triangles {
        let Some(setup) = geometry(index) else { continue };
        let first = setup.bounds.y / TILE;
        let last = (setup.bounds.y + setup.bounds.height.max(1) - 1) / TILE;
        for row in rows.iter_mut().take(last as usize + 1).skip(first as usize) {
            row.push(index as u32);
        }
    }
    rows
}

pub(super) fn load(memory: &Memory, call: &DrawCall<'_>, region: Region) -> Result<TargetTile, MachineError> {
    let mut colors = Vec::with_capacity(call.targets.len());
    for &id in &call.targets {
        colors.push(Some(memory.current(id)?));
    }
    let depth = call.depth_buffer.map(|id| memory.current_depth(id)).transpose()?;
    Ok(TargetTile::load(&colors, depth, region)?)
}

/// Memory traffic, derived from the counts.
pub(super) fn bytes(memory: &Memory, call: &DrawCall<'_>, stage: &VertexStage<'_>, events: &DrawEvents) -> ByteCounts {
    let f = &events.fragments;
    let (per_vertex, per_instance) = stage.bytes();
    let mut out = ByteCounts {
        vertices: per_vertex * events.vertices + per_instance * events.instances,
        ..ByteCounts::default()
    };
    for (bound, fetches) in call.samplers.iter().zip(f.fetches) {
        let image = bound.and_then(|b| memory.texture(b.texture).ok());
        out.textures += fetches * image.map_or(0, |i| i.format().bytes() as u64);
    }
    let depth_size = match call.depth_buffer.and_then(|id| memory.depth(id).ok()) {
        Some(surface) => surface.format().bytes(),
        None => 0,
    };
    if call.depth.test.is_some() {
        out.depth_read = depth_size * (f.depth_failed + f.passed);
        out.depth_written = if call.depth.write { depth_size * f.passed } else { 0 };
    }
    let written = crate::exec::colors_written(program(call.pixel_program));
    for (i, (&id, mask)) in call.targets.iter().zip(call.masks).enumerate() {
        let Ok(image) = memory.texture(id) else { continue };
        let stored = image.format().record().stored();
        let wanted = stored.iter().filter(|c| mask.has(c.stored_from)).count();
        if written >> i & 1 == 0 || wanted == 0 {
            continue;
        }
        let size = image.format().bytes() as u64 * f.passed;
        out.color_written += size;
        if call.blend.is_some() || wanted < stored.len() {
            out.color_read += size;
        }
    }
    out
}
