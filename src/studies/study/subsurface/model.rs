//! The model as an atlas: values per face and per vertex, and the model's lengths compared with the medium's.

use glam::DVec3;

use super::Parameters;
use crate::atlas::Atlas;
use crate::geom::Mesh;
use crate::subsurface::{Dipole, median_thickness};

/// Lengths of the model and of the medium, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ModelLengths {
    /// Side of a square with the mean area of texels.
    pub(super) texel: f64,
    /// Fraction of the surface area whose texels are longer than the shortest mean free path of a channel.
    pub(super) coarse: f64,
    pub(super) mean_free_path: f64,
    /// The longest diffusion length of a channel; infinite if a channel does not absorb.
    pub(super) diffusion_length: f64,
    pub(super) diagonal: f64,
    pub(super) shortest_side: f64,
    /// Median distance to the opposite surface along the inward normal; `None` for open models.
    pub(super) thickness: Option<f64>,
}

impl ModelLengths {
    pub(super) fn of(atlas: &Atlas, parameters: &Parameters, dipoles: &[Dipole; 3]) -> Self {
        let mm = parameters.options.mm_per_unit;
        let mean_free_path = dipoles.iter().map(Dipole::mean_free_path).fold(f64::INFINITY, f64::min);
        let areas = || atlas.texels().iter().map(|texel| texel.area);
        let coarse: f64 = areas().filter(|area| area.sqrt() * mm > mean_free_path).sum();
        let extent = parameters.mesh.bounds().map_or(DVec3::ZERO, |[low, high]| {
            (DVec3::from(high.map(f64::from)) - DVec3::from(low.map(f64::from))) * mm
        });
        Self {
            texel: atlas.mean_texel_area().sqrt() * mm,
            coarse: coarse / areas().sum::<f64>(),
            mean_free_path,
            diffusion_length: dipoles.iter().map(Dipole::diffusion_length).fold(0.0, f64::max),
            diagonal: extent.length(),
            shortest_side: extent.min_element(),
            thickness: median_thickness(&parameters.mesh).map(|thickness| thickness * mm),
        }
    }
}

/// Means over the texels of each face; a face's texels divide its area evenly.
pub(super) fn by_face(atlas: &Atlas, texels: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let side = atlas.side() as usize;
    let mean = |place: &crate::atlas::FacePlace| {
        let mut sum = DVec3::ZERO;
        for y in place.y..place.y + place.height {
            let row = y as usize * side;
            texels[row + place.x as usize..][..place.width as usize].iter().for_each(|&b| sum += DVec3::from(b));
        }
        (sum / f64::from(place.texels())).to_array()
    };
    atlas.places().iter().map(mean).collect()
}

/// Means of texel values at each vertex, over the texels at its corners of faces, weighted by face area. `None` for a
/// vertex without a face that has an area.
pub(super) fn by_vertex(atlas: &Atlas, mesh: &Mesh, texels: &[[f64; 3]]) -> Vec<Option<[f64; 3]>> {
    let mut sums = vec![(0.0, DVec3::ZERO); mesh.positions().len()];
    for (face, (vertices, place)) in (0..).zip(mesh.triangles().iter().zip(atlas.places())) {
        for (corner, &vertex) in vertices.iter().enumerate() {
            let mut weights = [0.0; 3];
            weights[corner] = 1.0;
            let [x0, y0, x1, y1] = place.bounds();
            let [x, y] = atlas.coordinates(face, weights);
            // The texel at this corner of the face.
            let [column, row] = [x.clamp(x0, x1), y.clamp(y0, y1)].map(|at| at as usize);
            let (sum, mean) = &mut sums[vertex as usize];
            *sum += mesh.area(face);
            *mean += mesh.area(face) * DVec3::from(texels[row * atlas.side() as usize + column]);
        }
    }
    sums.into_iter().map(|(area, sum)| (area > 0.0).then(|| (sum / area).to_array())).collect()
}
