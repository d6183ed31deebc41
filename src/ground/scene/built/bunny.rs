//! The Stanford bunny: as scanned, and closed with the vertex counts that papers print.

use glam::DVec3;

use super::resample::ClosedSurface;

/// The scan `bun_zipper`, y up, in metres, as a binary little-endian file: three floats per vertex; per triangle a
/// byte, then three 16-bit vertex indices. Source and terms of use: `src/ground/LICENSE-BUNNY`.
const FILE: &[u8] = include_bytes!("bunny.ply");
/// Numbers of vertices and triangles of the scan.
const COUNTS: [usize; 2] = [35_947, 69_451];
const BYTES: [usize; 2] = [12, 7];
/// Longest edge of the bunny's bounding box after scaling.
const SIZE: f64 = 2.5;

/// The bunny with `vertices` vertices around the origin: its five holes are filled, then it is refined or coarsened.
pub(super) fn bunny(vertices: usize) -> ClosedSurface {
    placed(read().closed().resampled(vertices))
}

/// The scan around the origin, with its holes, without unused vertices.
pub(super) fn scanned() -> ClosedSurface {
    placed(read())
}

fn placed(surface: ClosedSurface) -> ClosedSurface {
    let fold =
        |start: f64, best: fn(DVec3, DVec3) -> DVec3| surface.positions.iter().copied().fold(DVec3::splat(start), best);
    let [low, high] = [fold(f64::INFINITY, DVec3::min), fold(f64::NEG_INFINITY, DVec3::max)];
    let scale = SIZE / (high - low).max_element();
    let positions = surface.positions.iter().map(|&at| scale * (at - 0.5 * (low + high))).collect();
    ClosedSurface { positions, ..surface }
}

fn read() -> ClosedSurface {
    let body = FILE.len() - COUNTS[0] * BYTES[0] - COUNTS[1] * BYTES[1];
    let (vertices, triangles) = FILE[body..].split_at(COUNTS[0] * BYTES[0]);
    let number = |bytes: &[u8], at: usize| f64::from(f32::from_le_bytes([0, 1, 2, 3].map(|byte| bytes[at + byte])));
    let vertex = |bytes: &[u8]| DVec3::new(number(bytes, 0), -number(bytes, 8), number(bytes, 4));
    let triangle = |bytes: &[u8]| [1, 3, 5].map(|at| u32::from(u16::from_le_bytes([bytes[at], bytes[at + 1]])));
    let positions: Vec<DVec3> = vertices.chunks_exact(BYTES[0]).map(vertex).collect();
    ClosedSurface::renumbered(&positions, triangles.chunks_exact(BYTES[1]).map(triangle))
}
