//! Cost of a draw in a card's pipeline: busy clocks of each unit, in core clocks.
//!
//! All units work in parallel on different parts of the draw, so the draw takes as long as the busiest unit, plus the
//! time to fill and drain the pipeline. docs/timing.md has the formulas and a worked example.

mod fragment;
mod mipmaps;
mod traffic;

pub use fragment::{FragmentClocks, fragment_clocks};
pub(super) use mipmaps::mipmap_clocks;
pub use traffic::{CacheSize, Traffic, traffic};

use super::{Bottleneck, Clocks};
use crate::device::Rates;
use crate::event::DrawRecord;

/// Components per register: a scalar processor computes one per clock.
const COMPONENTS: u64 = 4;
/// Fragments per quad.
const QUAD: u64 = 4;

/// Busy clocks of each unit for a draw.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PipelineClocks {
    /// Vertex units.
    pub vertices: Clocks,
    /// Triangle set-up.
    pub setup: Clocks,
    /// Arithmetic of the pixel pipelines.
    pub arithmetic: Clocks,
    /// Texture units.
    pub textures: Clocks,
    /// `true` if arithmetic and textures alternate, so that their clocks add up.
    pub takes_turns: bool,
    /// Raster back end.
    pub output: Clocks,
    /// Memory.
    pub memory: Clocks,
    /// Command processor: a fixed cost that precedes all else.
    pub command: Clocks,
    /// Pipeline fill and drain: a fixed cost.
    pub fill: Clocks,
    /// Memory traffic.
    pub traffic: Traffic,
}

impl PipelineClocks {
    /// Command processor, vertex units and set-up.
    pub fn front_end(&self) -> Clocks {
        self.command + self.vertices.max(self.setup)
    }

    /// Pixel pipelines: arithmetic, textures and back end.
    pub fn shader(&self) -> Clocks {
        let pipes = if self.takes_turns { self.arithmetic + self.textures } else { self.arithmetic.max(self.textures) };
        pipes.max(self.output)
    }

    /// Clocks of the busiest unit.
    pub fn busiest(&self) -> Clocks {
        self.vertices.max(self.setup).max(self.shader()).max(self.memory)
    }

    /// Duration from the first clock to the last.
    pub fn total(&self) -> Clocks {
        self.command + self.busiest() + self.fill
    }

    /// The limiting factor.
    pub fn bottleneck(&self) -> Bottleneck {
        let busiest = self.busiest();
        if self.command + self.fill >= busiest {
            return Bottleneck::Overhead;
        }
        if busiest == self.memory {
            return Bottleneck::Memory;
        }
        if busiest == self.shader() {
            return match () {
                () if self.output == busiest => Bottleneck::Output,
                () if self.arithmetic >= self.textures => Bottleneck::Arithmetic,
                () => Bottleneck::Textures,
            };
        }
        if busiest == self.vertices { Bottleneck::Vertices } else { Bottleneck::Setup }
    }
}

/// Clocks of a draw, for given sizes of the texture cache and the post-transform vertex cache.
pub(super) fn pipeline_clocks(
    draw: &DrawRecord,
    rates: &Rates,
    (cache, vertex_cache): (CacheSize, CacheSize),
) -> PipelineClocks {
    let counts = &draw.counts;
    let fragment = fragment_clocks(&draw.pixel, &draw.samplers, rates);
    let lanes = wide(draw.quads) * wide(QUAD);
    let pipes = wide(rates.pixel_pipes.unwrap_or(1));
    let shaders = Shaders::of(rates);
    let texture_units = rates.texture_units.map_or(pipes, wide);
    let triangles = counts.primitives.assembled.max(counts.primitives.rasterised);
    let traffic = traffic(draw, rates, (cache, vertex_cache));
    PipelineClocks {
        vertices: vertices(draw, rates, (vertex_cache, &shaders)),
        setup: clocks(wide(triangles) * wide(rates.setup_clocks_per_triangle.unwrap_or_default()), 1),
        arithmetic: clocks(lanes * wide(fragment.arithmetic.0) * shaders.numerator, pipes * shaders.denominator),
        textures: clocks(lanes * wide(fragment.textures.0), texture_units),
        takes_turns: fragment.takes_turns,
        output: output(draw, rates),
        memory: memory(&traffic, rates),
        command: Clocks(counts.draws.saturating_mul(rates.draw_clocks.unwrap_or_default())),
        fill: Clocks(rates.pipeline_clocks.unwrap_or_default()),
        traffic,
    }
}

/// Duration of an instruction in a pipeline, in core clocks, as a fraction: 1 on cards with four-component pipelines,
/// four shader clocks on scalar processors.
struct Shaders {
    numerator: u128,
    denominator: u128,
}

impl Shaders {
    fn of(rates: &Rates) -> Self {
        match (rates.shader_clock_hz, rates.core_clock_hz) {
            (Some(shader), Some(core)) => {
                Self { numerator: wide(COMPONENTS) * wide(core), denominator: wide(shader).max(1) }
            }
            _ => Self { numerator: 1, denominator: 1 },
        }
    }
}

/// Vertex clocks: instructions of the processed vertices divided among the units, but at least the time at the stated
/// vertex rate.
fn vertices(draw: &DrawRecord, rates: &Rates, (cache, shaders): (CacheSize, &Shaders)) -> Clocks {
    let (run, each) = (wide(cache.of(draw.vertices_run)), wide(draw.counts.vertices).max(1));
    let instructions = (wide(draw.counts.vertex_instructions) * run).div_ceil(each);
    let slots = instructions * wide(rates.vertex_clocks_per_slot.unwrap_or(1));
    let executed = match rates.vertex_units {
        Some(units) => clocks(slots, wide(units)),
        // Unified processors run both vertex and pixel programs.
        None => clocks(slots * shaders.numerator, wide(rates.pixel_pipes.unwrap_or(1)) * shaders.denominator),
    };
    let fetched = match (rates.vertices_per_s, rates.core_clock_hz) {
        (Some(rate), Some(core)) => clocks(run * wide(core), wide(rate)),
        _ => Clocks(0),
    };
    executed.max(fetched)
}

/// Back-end clocks for all pixels that the program did not kill.
fn output(draw: &DrawRecord, rates: &Rates) -> Clocks {
    let fragments = &draw.counts.fragments;
    let pixels = fragments.generated.saturating_sub(fragments.killed);
    let colored = draw.targets.iter().filter(|t| t.written).count().max(1) as u64;
    let full = rates.raster_pixels_per_clock.unwrap_or(1);
    let rate = match rates.depth_only_pixels_per_clock {
        Some(rate) if draw.targets.iter().all(|t| !t.written) => rate,
        _ => full,
    };
    clocks(wide(pixels) * wide(colored), wide(rate))
}

fn memory(traffic: &Traffic, rates: &Rates) -> Clocks {
    let (peak, core) = (rates.memory_bytes_per_s.unwrap_or(1), rates.core_clock_hz.unwrap_or(1));
    let efficiency = rates.memory_efficiency_percent.unwrap_or(100);
    clocks(wide(traffic.total()) * wide(core) * 100, wide(peak) * wide(efficiency))
}

fn wide(n: u64) -> u128 {
    u128::from(n)
}

/// Divides and rounds up.
fn clocks(work: u128, rate: u128) -> Clocks {
    Clocks(u64::try_from(work.div_ceil(rate.max(1))).unwrap_or(u64::MAX))
}
