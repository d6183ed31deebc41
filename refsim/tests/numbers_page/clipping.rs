//! Tests of "Clipping", "Window" and "The fan": triangle set-up reimplemented in host singles.

use super::{Random, probes};
use refsim::device::{SubpixelGrid, SubpixelRounding};
use refsim::num::Format;
use refsim::raster::{ClipSpace, Cull, FOG_COMPONENT, PixelCenter, RasterRules, RasterState, Vertex, Viewport, setup};
use refsim::texture::Region;

/// A corner: position, one component, and `true` if the following edge belongs to the original triangle.
#[derive(Clone, Copy, Debug)]
struct Corner {
    position: [f32; 4],
    fog: f32,
    own_edge: bool,
}

/// A corner in window space: snapped column and row, depth, 1 / w.
type Snapped = (i64, i64, f32, f32);

/// Grid lines per pixel of window positions, and their rounding.
type Grid = (u32, SubpixelRounding);

fn distances([x, y, z, w]: [f32; 4], opengl: bool) -> [f32; 7] {
    let band = 8.0 * w;
    let near = if opengl { z + w } else { z };
    [w - f32::from_bits((127 - 64) << 23), near, w - z, band + x, band - x, band + y, band - y]
}

fn is_inside(distance: f32) -> bool {
    distance >= 0.0
}

fn crossing(inside: &Corner, outside: &Corner, [d_in, d_out]: [f32; 2], own_edge: bool) -> Corner {
    let t = d_in / (d_in - d_out);
    let at = |a: f32, b: f32| if a.to_bits() == b.to_bits() { a } else { a + t * (b - a) };
    let position = [0, 1, 2, 3].map(|i| at(inside.position[i], outside.position[i]));
    Corner { position, fog: at(inside.fog, outside.fog), own_edge }
}

fn clip(triangle: [Corner; 3], opengl: bool) -> Vec<Corner> {
    let mut polygon = triangle.to_vec();
    for plane in 0..7 {
        let mut kept = Vec::new();
        for (i, corner) in polygon.iter().enumerate() {
            let next = &polygon[(i + 1) % polygon.len()];
            let [d, d_next] = [corner, next].map(|c| distances(c.position, opengl)[plane]);
            if is_inside(d) {
                kept.push(*corner);
            }
            match (is_inside(d), is_inside(d_next)) {
                (true, false) => kept.push(crossing(corner, next, [d, d_next], false)),
                (false, true) => kept.push(crossing(next, corner, [d_next, d], corner.own_edge)),
                _ => {}
            }
        }
        polygon = kept;
    }
    polygon
}

fn to_window(position: [f32; 4], state: &RasterState, (lines, rounding): Grid) -> Option<Snapped> {
    let [x, y, z, w] = position;
    let (v, opengl) = (&state.viewport, state.clip_space == ClipSpace::OpenGl);
    let [half_width, half_height] = [v.width, v.height].map(|n| n as f32 / 2.0);
    let (middle_x, middle_y) = (v.x as f32 + half_width, v.y as f32 + half_height);
    let column = x / w * half_width + middle_x;
    let row = if opengl { middle_y + y / w * half_height } else { middle_y - y / w * half_height };
    let d = if opengl { z / w * 0.5 + 0.5 } else { z / w };
    let (least, most) = (f32::from_bits(v.min_depth), f32::from_bits(v.max_depth));
    let depth = d * (most - least) + least;
    let reciprocal = 1.0 / w;
    let all = [column, row, depth, reciprocal];
    let scale = f64::from(lines);
    let corner = if state.center == PixelCenter::Direct3d { -0.5 } else { 0.0 };
    let line = |c: f64| match rounding {
        SubpixelRounding::Nearest => (c * scale + 0.5).floor(),
        SubpixelRounding::Cut if c < corner => (c * scale).ceil(),
        SubpixelRounding::Cut => (c * scale).floor(),
    };
    let snap = |c: f32| line(f64::from(c)).clamp(-131_072.0 * scale, 131_072.0 * scale) as i64;
    all.iter().all(|c| c.is_finite()).then(|| (snap(column), snap(row), depth, reciprocal))
}

fn area([a, b, c]: [Snapped; 3]) -> i64 {
    (b.0 - a.0) * (c.1 - a.1) - (c.0 - a.0) * (b.1 - a.1)
}

/// Returns `true` if the bounding box of a part contains a pixel center of the viewport, which is the whole target.
fn has_pixels(part: [Snapped; 3], state: &RasterState, lines: u32) -> bool {
    let center = if state.center == PixelCenter::OpenGl { 0.5 } else { 0.0 };
    let span = |values: [i64; 3], size: u32| {
        let scaled = values.map(|n| n as f64 / f64::from(lines) - center);
        let (low, high) = (scaled.into_iter().fold(f64::MAX, f64::min), scaled.into_iter().fold(f64::MIN, f64::max));
        low.ceil().max(0.0) <= high.floor().min(f64::from(size) - 1.0)
    };
    let v = &state.viewport;
    span(part.map(|c| c.0), v.width) && span(part.map(|c| c.1), v.height)
}

/// The parts of a triangle: the snapped corners of each part, and the component at each corner.
fn parts(triangle: [Corner; 3], state: &RasterState, grid: Grid) -> Vec<[(Snapped, f32); 3]> {
    let opengl = state.clip_space == ClipSpace::OpenGl;
    if triangle.iter().flat_map(|c| c.position).any(|p| !p.is_finite()) {
        return Vec::new();
    }
    let is_whole = triangle.iter().all(|c| distances(c.position, opengl).into_iter().all(is_inside));
    let polygon = if is_whole { triangle.to_vec() } else { clip(triangle, opengl) };
    let Some(snapped) = polygon.iter().map(|c| to_window(c.position, state, grid)).collect::<Option<Vec<_>>>() else {
        return Vec::new();
    };
    let n = snapped.len();
    let winding = (0..n).map(|i| area([snapped[0], snapped[i], snapped[(i + 1) % n]])).sum::<i64>().signum();
    let own: Vec<usize> = (0..n).filter(|&i| polygon[i].own_edge).collect();
    let is_within = |p: Snapped| own.iter().all(|&i| area([snapped[i], snapped[(i + 1) % n], p]) * winding >= 0);
    let left: Vec<(Snapped, f32)> =
        (0..n).filter(|&i| is_whole || is_within(snapped[i])).map(|i| (snapped[i], polygon[i].fog)).collect();
    let fan = left.get(1..).unwrap_or_default().windows(2).map(|pair| [left[0], pair[0], pair[1]]);
    fan.filter(|part| {
        let corners = part.map(|(corner, _)| corner);
        area(corners) != 0 && area(corners).signum() == winding && has_pixels(corners, state, grid.0)
    })
    .collect()
}

#[test]
fn clipped_triangles_are_the_fans_of_the_page() {
    let mut r = Random::new(6);
    let (mut cut, mut dropped) = (0, 0);
    for _ in 0..probes(6_000) {
        let grid = r.of(&[SubpixelGrid::Bits(4), SubpixelGrid::Bits(8), SubpixelGrid::Twelfths]);
        let (lines, rounding) = (grid.lines(), r.of(SubpixelRounding::ALL));
        let (width, height) = r.of(&[(640, 480), (64, 64), (7, 33)]);
        let viewport = Viewport { min_depth: 0.25f32.to_bits(), ..Viewport::new(width, height) };
        let state = RasterState {
            viewport,
            center: r.of(&[PixelCenter::Direct3d, PixelCenter::OpenGl]),
            clip_space: r.of(&[ClipSpace::Direct3d, ClipSpace::OpenGl]),
            cull: Cull::None,
            scissor: Region { x: 0, y: 0, width, height },
        };
        let reach = r.of(&[1.0, 4.0, 40.0]);
        let triangle = [0; 3].map(|_| {
            let mut position = [0; 2].map(|_| r.between(-reach, reach)).to_vec();
            position.extend([r.between(-1.0, 2.0), r.between(-0.5, 3.0)]);
            let mut position: [f32; 4] = position.try_into().expect("four");
            if r.below(40) == 0 {
                position[r.below(4)] = r.single();
            }
            Corner { position, fog: r.between(0.0, 1.0), own_edge: true }
        });
        let vertices = triangle.map(|c| Vertex {
            position: c.position.map(f32::to_bits),
            fog: c.fog.to_bits(),
            ..Vertex::default()
        });
        let rules = RasterRules { subpixel_grid: grid, subpixel_rounding: rounding, iterator_format: Format::FP32 };
        let mut found = Vec::new();
        setup(vertices.each_ref(), &state, &rules, &mut found);
        let expected = parts(triangle, &state, (lines, rounding));
        let place = format!("{triangle:?}, {state:?}, {grid:?}, {rounding:?}");
        assert_eq!(found.len(), expected.len(), "{place}");
        for (found, part) in found.iter().zip(&expected) {
            let corners = part.map(|(corner, _)| corner);
            assert_eq!(found.reciprocal_w, corners.map(|c| c.3.to_bits()), "{place}: 1 / w");
            assert_eq!(found.depth.base, corners[0].2.to_bits(), "{place}: depth");
            assert_eq!(found.planes[FOG_COMPONENT].base, part[0].1.to_bits(), "{place}: component");
            let slopes = |i: usize, j: usize| (corners[i].1 - corners[j].1, corners[j].0 - corners[i].0);
            let turn = area(corners).signum() * i64::from(lines);
            let edges = [slopes(1, 2), slopes(2, 0), slopes(0, 1)].map(|(a, b)| (a * turn, b * turn));
            assert_eq!(found.edges.map(|e| (e.a, e.b)), edges, "{place}: edges");
        }
        cut += usize::from(expected.len() > 1);
        dropped += usize::from(expected.is_empty());
    }
    assert!(cut > 500 && dropped > 500, "{cut} cut, {dropped} dropped");
}
