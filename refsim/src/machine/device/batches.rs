//! Partition of a round's triangles into dispatches.

use crate::exec::TILE;
use crate::raster::TriangleSetup;
use crate::texture::Region;

/// A tile and its triangles, in order.
struct Bin {
    x: u32,
    y: u32,
    triangles: Vec<u32>,
}

/// A dispatch: the words of `tiles`, and the number of tiles. The words hold column, row, offset and length of the
/// triangle list for each tile; then the lists.
pub(super) struct TileBatch {
    pub(super) words: Vec<u32>,
    pub(super) tiles: usize,
}

/// Partitions a round into dispatches of at most `most_tiles` tiles and `most_triangles` triangles over all tiles. A
/// tile occurs at most once per dispatch, and its triangles stay in order across dispatches.
pub(super) fn dispatches(
    setups: &[TriangleSetup],
    region: Region,
    most_tiles: usize,
    most_triangles: usize,
) -> Vec<TileBatch> {
    let mut out = Vec::new();
    let mut parts: Vec<(u32, u32, &[u32])> = Vec::new();
    let mut total = 0;
    let bins = bins(setups, region);
    for bin in &bins {
        let mut rest = bin.triangles.as_slice();
        while !rest.is_empty() {
            if parts.len() >= most_tiles.max(1) || total >= most_triangles {
                out.push(dispatch(&parts));
                parts.clear();
                total = 0;
            }
            let (now, later) = rest.split_at(rest.len().min(most_triangles.max(1) - total));
            parts.push((bin.x, bin.y, now));
            total += now.len();
            rest = later;
        }
    }
    if !parts.is_empty() {
        out.push(dispatch(&parts));
    }
    out
}

fn dispatch(parts: &[(u32, u32, &[u32])]) -> TileBatch {
    let mut words = Vec::new();
    let mut first = 4 * parts.len();
    for (x, y, triangles) in parts {
        words.extend([*x, *y, first as u32, triangles.len() as u32]);
        first += triangles.len();
    }
    for (_, _, triangles) in parts {
        words.extend_from_slice(triangles);
    }
    TileBatch { words, tiles: parts.len() }
}

/// Triangle lists of the tiles that triangles touch, row by row.
fn bins(setups: &[TriangleSetup], region: Region) -> Vec<Bin> {
    let (right, bottom) = (region.x + region.width, region.y + region.height);
    let (columns, rows) = (right.div_ceil(TILE) as usize, bottom.div_ceil(TILE) as usize);
    let mut lists: Vec<Vec<u32>> = vec![Vec::new(); columns * rows];
    for (index, setup) in (0u32..).zip(setups) {
        let inside = setup.bounds.intersect(region);
        if inside.width == 0 || inside.height == 0 {
            continue;
        }
        for row in inside.y / TILE..=(inside.y + inside.height - 1) / TILE {
            for column in inside.x / TILE..=(inside.x + inside.width - 1) / TILE {
                let tile = Region { x: column * TILE, y: row * TILE, width: TILE, height: TILE };
                if !setup.misses(tile.intersect(region)) {
                    lists[row as usize * columns + column as usize].push(index);
                }
            }
        }
    }
    let place = |i: usize| ((i % columns) as u32 * TILE, (i / columns) as u32 * TILE);
    let filled = lists.into_iter().enumerate().filter(|(_, list)| !list.is_empty());
    filled.map(|(i, triangles)| Bin { x: place(i).0, y: place(i).1, triangles }).collect()
}
