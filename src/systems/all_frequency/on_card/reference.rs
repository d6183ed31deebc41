//! Step 4 of section 6 by plain loops in f64, for pixels from interpolated values of vertices.

use glam::DVec3;

use super::attributes::TransferredMesh;
use crate::all_frequency::Reflectance;
use crate::all_frequency::kernels::ViewNumbers;
use crate::geom::vector::wide;
use crate::sphere::ParabolicMap;

/// Interpolates vertex colors.
pub fn pixel_of_colors(colors: &[[f64; 3]], corners: [u32; 3], weights: [f64; 3]) -> [f64; 3] {
    let mut pixel = [0.0; 3];
    for (corner, weight) in corners.into_iter().zip(weights) {
        (0..3).for_each(|channel| pixel[channel] += weight * colors[corner as usize][channel]);
    }
    pixel
}

/// G(v) . T_p of a pixel. Transferred radiance times the surface's color, and the view in the representation `view`,
/// are interpolated between three vertices. Below the horizon, G is read from the map's texels beyond the horizon.
pub fn pixel_of_products(
    mesh: &TransferredMesh<'_>,
    view: ViewNumbers,
    eye: [f32; 3],
    corners: [u32; 3],
    weights: [f64; 3],
) -> [f64; 3] {
    let towards = |corner: u32| {
        let view = wide(eye) - wide(mesh.vertices.positions()[corner as usize]);
        mesh.vertices.frames()[corner as usize].to_local(view)
    };
    let direction = match view {
        ViewNumbers::Vector => {
            let mut sum = DVec3::ZERO;
            for (corner, weight) in corners.into_iter().zip(weights) {
                sum += weight * towards(corner);
            }
            sum.normalize_or_zero()
        }
        ViewNumbers::Coordinates => {
            let mut sum = [0.0; 2];
            for (corner, weight) in corners.into_iter().zip(weights) {
                let at = ParabolicMap::coordinates_of(towards(corner).normalize_or_zero());
                sum = [sum[0] + weight * at[0], sum[1] + weight * at[1]];
            }
            ParabolicMap::direction_at(sum)
        }
    };
    let mut g = vec![0.0; mesh.terms()];
    match mesh.reflectance {
        Reflectance::Factored(factors) => factors.view(direction, &mut g),
        Reflectance::Diffuse => mesh.reflectance.view(DVec3::Z, &mut g),
    }
    let mut pixel = [0.0; 3];
    for (corner, weight) in corners.into_iter().zip(weights) {
        let color = mesh.color(corner as usize);
        for (row, g) in mesh.transferred.of(corner as usize).iter().zip(&g) {
            (0..3).for_each(|channel| pixel[channel] += weight * g * f64::from(row[channel]) * color[channel]);
        }
    }
    pixel
}
