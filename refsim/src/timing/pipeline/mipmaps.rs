//! Cost of generating mip levels: each level is drawn as a quad whose fragments make one bilinear read of the previous
//! level (a trilinear read for volumes).

use super::fragment::PLAIN_TEXEL;
use super::{PipelineClocks, QUAD, Traffic, clocks, memory, wide};
use crate::device::Rates;
use crate::event::{MipmapLevel, MipmapRecord};
use crate::timing::Clocks;

const TRIANGLES: u64 = 2;
/// Texels per bilinear read.
const BILINEAR: u64 = 4;

/// Clocks of each level; a level starts when the previous level is finished.
pub(in crate::timing) fn mipmap_clocks(record: &MipmapRecord, rates: &Rates) -> Vec<PipelineClocks> {
    record.levels.iter().map(|level| level_clocks(level, record.texel_bytes.into(), rates)).collect()
}

fn level_clocks(level: &MipmapLevel, texel_bytes: u64, rates: &Rates) -> PipelineClocks {
    let [width, height, slices] = level.extents.map(u64::from);
    let quads = wide(width.div_ceil(2)) * wide(height.div_ceil(2)) * wide(slices);
    let pipes = wide(rates.pixel_pipes.unwrap_or(1));
    let texture_units = rates.texture_units.map_or(pipes, wide);
    let written = level.texels_written();
    let traffic = Traffic {
        textures: level.texels_read.saturating_mul(texel_bytes),
        color: written.saturating_mul(texel_bytes),
        ..Traffic::default()
    };
    PipelineClocks {
        setup: Clocks(
            TRIANGLES.saturating_mul(slices).saturating_mul(rates.setup_clocks_per_triangle.unwrap_or_default()),
        ),
        textures: clocks(quads * wide(QUAD) * wide(read_clocks(level, texel_bytes, rates)), texture_units),
        output: clocks(wide(written), wide(rates.raster_pixels_per_clock.unwrap_or(1))),
        memory: memory(&traffic, rates),
        command: Clocks(rates.draw_clocks.unwrap_or_default()),
        fill: Clocks(rates.pipeline_clocks.unwrap_or_default()),
        traffic,
        ..PipelineClocks::default()
    }
}

/// Texture clocks per fragment: an integer, at least 1.
fn read_clocks(level: &MipmapLevel, texel_bytes: u64, rates: &Rates) -> u64 {
    let reads = level.texels_read.div_ceil(level.texels_written().max(1)).div_ceil(BILINEAR).max(1);
    let bytes = rates.texel_bytes_per_clock.unwrap_or(PLAIN_TEXEL).max(1);
    let per_clock = rates.texture_reads_per_clock.unwrap_or(1).max(1);
    reads.saturating_mul(texel_bytes.div_ceil(bytes)).div_ceil(per_clock).max(1)
}
