//! Meshes that the cards of systems 3 to 6 draw.

mod front_faces;

use crossbar::card::SeenPixel;
use crossbar::clustering::Clustering;
use crossbar::geom::vector::wide;
use crossbar::sphere::HarmonicLight;
use crossbar::transfer::Vertices;
use crossbar::transfer::brdf::ExitBasis;

/// Exit radiance coefficients of all vertices for light of order 3 at half its radiance: red, green and blue rows.
pub(crate) fn exits(clustering: &Clustering, light: &HarmonicLight) -> Vec<[Vec<f64>; 3]> {
    let mut matrix = vec![0.0; clustering.dimension()];
    let mut of_vertex = |vertex| {
        clustering.approximation(vertex, &mut matrix);
        let product = |row: &[f64], light: &[f64]| row.iter().zip(light).map(|(m, l)| 0.5 * m * l).sum::<f64>();
        light.channels().each_ref().map(|light| matrix.chunks(9).map(|row| product(row, light)).collect())
    };
    (0..clustering.of_point().len()).map(&mut of_vertex).collect()
}

/// The radiance that a pixel shows towards an eye, from coefficients and view vectors interpolated in f64; `None` for
/// grazing views of glossy surfaces, because maps end at the horizon.
pub(crate) fn interpolated(
    vertices: &Vertices,
    basis: &ExitBasis,
    exits: &[[Vec<f64>; 3]],
    eye: [f32; 3],
    seen: &SeenPixel,
) -> Option<[f64; 3]> {
    let parts = || seen.corners.into_iter().map(|v| v as usize).zip(seen.weights);
    let local = |v: usize| vertices.frames()[v].to_local(wide(eye) - wide(vertices.positions()[v]));
    let view = parts().map(|(v, weight)| weight * local(v)).sum::<glam::DVec3>().normalize();
    if basis.len() > 1 && view.z < 0.05 {
        return None;
    }
    let mut y = vec![0.0; basis.len()];
    basis.values(view, &mut y);
    let mix = |c: usize, row: usize| parts().map(|(v, weight)| weight * exits[v][c][row]).sum::<f64>();
    Some([0, 1, 2].map(|c| y.iter().enumerate().map(|(row, y)| y * mix(c, row)).sum()))
}
