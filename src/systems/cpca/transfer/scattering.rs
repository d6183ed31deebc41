//! Subsurface scattering after Jensen and Buhler 2002: irradiance at the vertices is gathered by a hierarchy, with a
//! reflectance that depends only on distance (section 3.1, last paragraph).

use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use super::whole::{Transfer, differ};
use crate::error::InputError;
use crate::geom::vector::wide;
use crate::quadrature::graded_integral;
use crate::transfer::Vertices;
use crate::transfer::error::require;

/// Maximum number of vertices of a leaf.
const LEAF: usize = 8;
/// Intervals of the quadrature over a vertex's own area.
const PANELS: u32 = 12;

/// Options of subsurface scattering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteringOptions {
    /// Millimetres per unit of the mesh; above 0.
    pub mm_per_unit: f64,
    /// The solid angle, in steradians, below which a cluster of vertices counts as one point; a cluster's solid angle
    /// is its area divided by its squared distance. With 0, every vertex is summed separately.
    pub solid_angle: f64,
}

/// A cluster of vertices: a range of [`Hierarchy`]'s order, the children, and sums.
struct Cluster {
    first: usize,
    count: usize,
    /// The second child; the first follows its parent. `None` for a leaf.
    second: Option<usize>,
    area: f64,
    /// Mean position, weighted by area.
    middle: DVec3,
    /// The largest distance of a vertex from the mean position.
    radius: f64,
}

/// The hierarchy over the vertices of a mesh, in mm.
struct Hierarchy {
    clusters: Vec<Cluster>,
    order: Vec<u32>,
    places: Vec<DVec3>,
    areas: Vec<f64>,
}

impl Transfer {
    /// The subsurface part of transfer: the radiance, equal in all directions, that leaves each vertex after
    /// scattering.
    ///
    /// `entering` is the irradiance that enters the medium at each vertex, in one row
    /// ([`Response::entering`](super::Response::entering)). `reflectance`, such as a dipole's, maps a distance in mm to
    /// the exitance per flux entering there, per mm^2; over a vertex's own area it is integrated as over a disk. The
    /// triangles should be smaller than the mean free path.
    pub fn scattered(
        vertices: &Vertices,
        entering: &Self,
        reflectance: impl Fn(f64) -> f64 + Sync,
        options: ScatteringOptions,
    ) -> Result<Self, InputError> {
        let ScatteringOptions { mm_per_unit, solid_angle } = options;
        let is_length = mm_per_unit > 0.0 && mm_per_unit.is_finite();
        require(is_length, "mm per unit", "a finite number above 0", mm_per_unit)?;
        let is_angle = (0.0..f64::INFINITY).contains(&solid_angle);
        require(is_angle, "the solid angle", "a finite number of at least 0", solid_angle)?;
        differ("vertices", [vertices.len(), entering.vertex_count()])?;
        differ("rows", [1, entering.row_count()])?;
        let hierarchy = Hierarchy::new(vertices, mm_per_unit);
        let columns = entering.column_count();
        let fluxes = hierarchy.fluxes(entering);
        let mut values = vec![0.0; vertices.len() * columns];
        values.par_chunks_exact_mut(columns).enumerate().for_each(|(vertex, into)| {
            let sums = hierarchy.gather(vertex, entering, &fluxes, &reflectance, solid_angle);
            into.iter_mut().zip(sums).for_each(|(into, sum)| *into = (sum / PI) as f32);
        });
        Ok(entering.with_values(values))
    }
}

impl Hierarchy {
    fn new(vertices: &Vertices, mm_per_unit: f64) -> Self {
        let places: Vec<DVec3> = vertices.positions().iter().map(|&at| mm_per_unit * wide(at)).collect();
        // Each corner gets a third of its triangles' areas.
        let mut areas = vec![0.0; places.len()];
        for corners in vertices.triangles() {
            let [a, b, c] = corners.map(|corner| places[corner as usize]);
            let third = (b - a).cross(c - a).length() / 6.0;
            corners.iter().for_each(|&corner| areas[corner as usize] += third);
        }
        let order = (0..places.len() as u32).collect();
        let mut hierarchy = Self { clusters: Vec::new(), order, places, areas };
        hierarchy.divide(0, vertices.len());
        hierarchy
    }

    fn divide(&mut self, first: usize, count: usize) {
        let (places, areas) = (&self.places, &self.areas);
        let members = &mut self.order[first..first + count];
        let of = members.iter().map(|&vertex| (places[vertex as usize], areas[vertex as usize]));
        let area: f64 = of.clone().map(|(_, area)| area).sum();
        let weighted: DVec3 = of.clone().map(|(at, area)| at * area).sum();
        let middle = if area > 0.0 { weighted / area } else { places[members[0] as usize] };
        let radius = of.clone().map(|(at, _)| at.distance(middle)).fold(0.0, f64::max);
        let (low, high) =
            of.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), (at, _)| (low.min(at), high.max(at)));
        let place = self.clusters.len();
        self.clusters.push(Cluster { first, count, second: None, area, middle, radius });
        if count <= LEAF {
            return;
        }
        let side = high - low;
        let axis = if side.x >= side.y && side.x >= side.z {
            0
        } else if side.y >= side.z {
            1
        } else {
            2
        };
        let along = |vertex: u32| places[vertex as usize][axis];
        members.select_nth_unstable_by(count / 2, |&a, &b| along(a).total_cmp(&along(b)).then(a.cmp(&b)));
        // The median determines the halves; within a half, vertices are sorted by index.
        let (lower, upper) = members.split_at_mut(count / 2);
        lower.sort_unstable();
        upper.sort_unstable();
        self.divide(first, count / 2);
        self.clusters[place].second = Some(self.clusters.len());
        self.divide(first + count / 2, count - count / 2);
    }

    /// Area times irradiance of each cluster, per light function.
    fn fluxes(&self, entering: &Transfer) -> Vec<f64> {
        let columns = entering.column_count();
        let mut fluxes = vec![0.0; self.clusters.len() * columns];
        for (place, cluster) in self.clusters.iter().enumerate().rev() {
            let (before, after) = fluxes.split_at_mut((place + 1) * columns);
            let into = &mut before[place * columns..];
            match cluster.second {
                // Children follow their parent in the list.
                Some(second) => {
                    let child = |at: usize| &after[(at - place - 1) * columns..(at - place) * columns];
                    let both = child(place + 1).iter().zip(child(second));
                    into.iter_mut().zip(both).for_each(|(into, (one, other))| *into = one + other);
                }
                None => {
                    for &vertex in &self.order[cluster.first..cluster.first + cluster.count] {
                        let (area, row) = (self.areas[vertex as usize], entering.of(vertex as usize));
                        into.iter_mut().zip(row).for_each(|(into, &value)| *into += area * f64::from(value));
                    }
                }
            }
        }
        fluxes
    }

    /// The exitance of a vertex, per light function.
    fn gather(
        &self,
        vertex: usize,
        entering: &Transfer,
        fluxes: &[f64],
        reflectance: &impl Fn(f64) -> f64,
        solid_angle: f64,
    ) -> Vec<f64> {
        let columns = entering.column_count();
        let (at, mut sums, mut waiting) = (self.places[vertex], vec![0.0; columns], vec![0]);
        while let Some(place) = waiting.pop() {
            let cluster = &self.clusters[place];
            let distance = at.distance(cluster.middle);
            if distance > cluster.radius && cluster.area < solid_angle * distance * distance {
                let factor = reflectance(distance);
                let flux = &fluxes[place * columns..(place + 1) * columns];
                sums.iter_mut().zip(flux).for_each(|(sum, flux)| *sum += factor * flux);
            } else if let Some(second) = cluster.second {
                waiting.extend([second, place + 1]);
            } else {
                for &other in &self.order[cluster.first..cluster.first + cluster.count] {
                    let other = other as usize;
                    let area = self.areas[other];
                    let factor = if other == vertex {
                        graded_integral((area / PI).sqrt(), PANELS, |r| 2.0 * PI * r * reflectance(r))
                    } else {
                        area * reflectance(at.distance(self.places[other]))
                    };
                    let row = entering.of(other);
                    sums.iter_mut().zip(row).for_each(|(sum, &value)| *sum += factor * f64::from(value));
                }
            }
        }
        sums
    }
}
