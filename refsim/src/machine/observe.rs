//! Draws in the hardware's order, so that observers see texel reads in that order.
//!
//! The scalar executor computes the same bits as in other draws. Only the order of fragments differs: by primitive over
//! the whole target, then by tile, then by quad, on one thread.

use super::recorder::Recorder;
use super::tiles::tile_draw;
use super::validate::Plan;
use super::vertices::{VertexStage, set_up};
use super::walk::{bytes, load};
use super::{DrawCall, ExecutorKind, Machine, MachineError};
use crate::event::{DrawEvents, FragmentCounts, SAMPLERS, SamplerTraffic, TexelObserver, TexelTouch};
use crate::exec::scalar::ScalarTiles;
use crate::exec::{Observer, Overrun, SamplerBinding, Step, TILE, TextureRead, program};
use crate::output::TargetTile;
use crate::raster::{ComponentMask, TriangleSetup};
use crate::texture::{Layout, Region, SampleRules, TexelMap, touched};

/// A bound texture and its address in the card's memory.
struct PlacedTexture<'a> {
    binding: SamplerBinding<'a>,
    map: TexelMap,
    first: u64,
}

/// Reports the texels read by a program to an observer, with their addresses.
struct TexelReporter<'a> {
    bound: [Option<PlacedTexture<'a>>; SAMPLERS],
    rules: SampleRules,
    observer: &'a mut dyn TexelObserver,
}

impl Observer for TexelReporter<'_> {
    const ACTIVE: bool = false;
    const READS: bool = true;

    fn executed(&mut self, _: &Step) {}

    fn reads(&mut self, read: &TextureRead) {
        let Some(Some(bound)) = self.bound.get(read.sampler) else { return };
        let PlacedTexture { binding, map, first } = bound;
        let (sampler, bytes) = (read.sampler as u8, map.texel_bytes());
        touched(binding.image, &binding.state, &self.rules, read.coordinates, read.lod, |level, slice, y, x| {
            let address = first + map.offset(level, slice, y, x);
            self.observer.touch(&TexelTouch { sampler, address, bytes });
        });
    }
}

impl Machine {
    /// Sets an observer of texel reads. Until it is removed by `None`, draws run in hardware order on the scalar
    /// executor, and the observer's traffic counts are stored in the draw's record in the log ([`Machine::record`]).
    /// The bits stay the same, but drawing is slower.
    pub fn observe_textures(&mut self, observer: Option<Box<dyn TexelObserver>>) {
        self.recorder.observer = observer;
    }

    /// Executes a validated call with an observer.
    pub(super) fn shade_observed(
        &mut self,
        call: &DrawCall<'_>,
        plan: &Plan,
    ) -> Result<(DrawEvents, [SamplerTraffic; SAMPLERS]), MachineError> {
        #[cfg(feature = "wgpu")]
        self.memory.download_newer(&call.targets, call.depth_buffer)?;
        let (memory, profile) = (&self.memory, &self.profile);
        let layout = if profile.rates.textures_tiled == Some(1) { Layout::Tiles } else { Layout::Rows };
        let draw = tile_draw(profile, memory, call);
        let Recorder { observer: Some(observer), addresses, .. } = &mut self.recorder else {
            return Ok((self.shade(call, plan)?, [SamplerTraffic::default(); SAMPLERS]));
        };
        let mut bound = [const { None }; SAMPLERS];
        for ((slot, binding), texture) in bound.iter_mut().zip(&draw.bindings.samplers).zip(&call.samplers) {
            if let (Some(binding), Some(texture)) = (binding, texture) {
                let map = TexelMap::new(layout, binding.image);
                *slot =
                    Some(PlacedTexture { binding: *binding, first: addresses.of(texture.texture, map.bytes()), map });
            }
        }
        observer.begin();
        let mut reporter = TexelReporter { bound, rules: (&profile.rules).into(), observer: observer.as_mut() };
        let tiles = ScalarTiles::new(&draw);
        // Vertex programs read no textures, so the batch executor can run them.
        let stage = VertexStage::new(call, profile, (ExecutorKind::Batch, &self.batch), ComponentMask::ALL);
        let mut events = DrawEvents { draws: 1, instances: plan.instance_count as u64, ..DrawEvents::default() };
        let region = plan.raster.scissor;
        let empty = region.width == 0 || region.height == 0;
        // The whole region is one tile here, because the hardware finishes a primitive before it starts the next.
        let mut target = if empty { None } else { Some(load(memory, call, region)?) };
        for round in plan.rounds() {
            let batch = stage.run(round.start, round.len(), plan)?;
            events.vertices += batch.vertices.len() as u64;
            events.vertex_instructions += batch.slots;
            let (setups, primitives) = set_up(&batch.vertices, round.len(), plan, profile);
            events.primitives += primitives;
            if let Some(target) = &mut target {
                for setup in &setups {
                    let drawn = over_tiles(&tiles, setup, target, &mut reporter);
                    events.fragments += drawn.map_err(|overrun| {
                        MachineError::overrun(overrun, program(call.pixel_program), draw.step_budget)
                    })?;
                }
            }
        }
        events.bytes = bytes(memory, call, &stage, &events);
        let traffic = reporter.observer.end();
        if let Some(target) = target {
            self.memory.store(&target, &call.targets, call.depth_buffer)?;
        }
        Ok((events, traffic))
    }
}

/// Draws one triangle over the target, tile by tile.
fn over_tiles(
    tiles: &ScalarTiles<'_>,
    setup: &TriangleSetup,
    target: &mut TargetTile,
    reporter: &mut TexelReporter<'_>,
) -> Result<FragmentCounts, Overrun> {
    let (mut counts, mut first) = (FragmentCounts::default(), None::<Overrun>);
    let within = setup.bounds.intersect(target.region);
    let step = TILE as usize;
    for y in (within.y - within.y % TILE..within.y + within.height).step_by(step) {
        for x in (within.x - within.x % TILE..within.x + within.width).step_by(step) {
            let tile = Region { x, y, width: TILE, height: TILE }.intersect(within);
            match tiles.run_region(setup, tile, target, reporter) {
                Ok(more) => counts += more,
                Err(overrun) => first = Some(first.map_or(overrun, |known| known.min(overrun))),
            }
        }
    }
    first.map_or(Ok(counts), Err)
}
