//! Pixels of the display by plain loops in f64 (equation 3).

use glam::DVec3;

use super::subject::TexturedMesh;
use crate::bi_scale::kernels::BlockEdges;
use crate::bi_scale::texture::ViewSamples;
use crate::card::SeenPixel;
use crate::geom::vector::wide;

/// Interpolates a repeating patch at u, v bilinearly between texel centers; without borders, blocks are clamped half a
/// texel inside.
pub fn patch_at(patch: &[[f32; 3]], size: usize, [u, v]: [f64; 2], edges: BlockEdges) -> [f64; 3] {
    let axis = |at: f64| {
        let mut texel = (at - at.floor()) * size as f64;
        if edges == BlockEdges::Touching {
            texel = texel.clamp(0.5, size as f64 - 0.5);
        }
        let low = (texel - 0.5).floor();
        let number = |texel: f64| (texel as isize).rem_euclid(size.cast_signed()) as usize;
        ([number(low), number(low + 1.0)], texel - 0.5 - low)
    };
    let ((columns, across), (rows, down)) = (axis(u), axis(v));
    let mut sum = [0.0; 3];
    for (row, of_row) in rows.into_iter().zip([1.0 - down, down]) {
        for (column, of_column) in columns.into_iter().zip([1.0 - across, across]) {
            for (sum, &sample) in sum.iter_mut().zip(&patch[row * size + column]) {
                *sum += of_row * of_column * f64::from(sample);
            }
        }
    }
    sum
}

/// Equation 3 at a pixel, with texture coordinates, local view and local light interpolated between three vertices.
pub fn pixel(
    mesh: &TexturedMesh<'_>,
    local: &[[f64; 3]],
    eye: [f32; 3],
    edges: BlockEdges,
    seen: &SeenPixel,
) -> [f64; 3] {
    let (texture, directions) = (mesh.texture(seen.triangle), mesh.directions());
    let (mut uv, mut view) = ([0.0; 2], DVec3::ZERO);
    let of_corner = mesh.coordinates[seen.triangle as usize];
    for ((corner, weight), coordinates) in seen.corners.into_iter().zip(seen.weights).zip(of_corner) {
        let towards = wide(eye) - wide(mesh.vertices.positions()[corner as usize]);
        view += weight * mesh.vertices.frames()[corner as usize].to_local(towards);
        (0..2).for_each(|axis| uv[axis] += weight * f64::from(coordinates[axis]));
    }
    let samples = ViewSamples::around(texture.view(), view.normalize_or_zero());
    let mut pixel = [0.0; 3];
    for direction in 0..directions {
        let mut response = [0.0; 3];
        for (number, weight) in samples.numbers.into_iter().zip(samples.weights) {
            let sample = patch_at(texture.patch(number, direction), texture.size(), uv, edges);
            (0..3).for_each(|channel| response[channel] += weight * sample[channel]);
        }
        for (corner, weight) in seen.corners.into_iter().zip(seen.weights) {
            let light = local[corner as usize * directions + direction];
            (0..3).for_each(|channel| pixel[channel] += weight * response[channel] * light[channel]);
        }
    }
    pixel
}
