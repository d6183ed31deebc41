//! Values of texels at the vertices of the model.

use glam::DVec3;

use super::{Parameters, SubsurfaceOutcome};
use crate::atlas::Atlas;
use crate::geom::Mesh;
use crate::report::{Cell, Table};

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

/// Table with a row per vertex of the model: its position, E, and B by every way of gathering.
pub(super) fn table(parameters: &Parameters, outcome: &SubsurfaceOutcome) -> Table {
    let at_vertices = |texels: &[[f64; 3]]| by_vertex(&outcome.atlas, &parameters.mesh, texels);
    let columns: Vec<_> = outcome.columns().map(|(label, texels)| (label, at_vertices(texels))).collect();
    let mut headings = ["vertex", "x", "y", "z"].map(str::to_owned).to_vec();
    headings.extend(columns.iter().flat_map(|(label, _)| ["r", "g", "b"].map(|c| format!("{label}_{c}"))));
    let mut table = Table::new("Vertices", &headings);
    for (vertex, place) in parameters.mesh.positions().iter().enumerate() {
        let head = [Cell::from(vertex)].into_iter().chain(place.map(Cell::from));
        let found = columns.iter().flat_map(|(_, values)| {
            values[vertex].map_or_else(|| [(); 3].map(|()| Cell::Empty), |value| value.map(Cell::from))
        });
        table.push(head.chain(found));
    }
    table
}
