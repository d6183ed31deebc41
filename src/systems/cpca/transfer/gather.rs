//! Sums over the rays of each vertex: direct light, and light from other surfaces.

use glam::DVec3;
use rayon::prelude::*;

use super::rays::TracedRays;
use super::response::Response;
use crate::geom::vector::unit;
use crate::sphere::{HarmonicRotation, MAX_ORDER, function_count, harmonics};
use crate::transfer::brdf::ExitBasis;
use crate::transfer::{FrontHit, LocalFrame, Vertices};

/// The data that all vertices share.
pub(super) struct TransferGather<'a> {
    vertices: &'a Vertices,
    rays: &'a TracedRays,
    rows: usize,
    light_order: usize,
    columns: usize,
    /// Light functions at each local direction.
    light: Vec<f64>,
    materials: Vec<WeightedResponse>,
}

/// A response with the rule's weights multiplied in.
struct WeightedResponse {
    /// One column per direction.
    weighted: Vec<f64>,
    /// The matrix of a vertex that sees the whole hemisphere, in local coordinates.
    whole: Vec<f64>,
}

impl<'a> TransferGather<'a> {
    pub(super) fn new(
        vertices: &'a Vertices,
        rays: &'a TracedRays,
        responses: &[Response],
        light_order: usize,
    ) -> Self {
        let columns = function_count(light_order);
        let mut light = vec![0.0; columns * rays.rule().len()];
        for (&s, into) in rays.rule().directions().iter().zip(light.chunks_exact_mut(columns)) {
            harmonics(light_order, s, into);
        }
        let rows = responses[0].basis().len();
        let materials = responses.iter().map(|response| {
            let weights = rays.rule().weights();
            let weighted: Vec<f64> = response
                .columns()
                .zip(weights)
                .flat_map(|(column, weight)| column.iter().map(move |c| weight * c))
                .collect();
            let mut whole = vec![0.0; rows * columns];
            for (column, light) in weighted.chunks_exact(rows).zip(light.chunks_exact(columns)) {
                add_product(&mut whole, column, light);
            }
            WeightedResponse { weighted, whole }
        });
        let materials = materials.collect();
        Self { vertices, rays, rows, light_order, columns, light, materials }
    }

    /// Numbers per vertex.
    pub(super) fn size(&self) -> usize {
        self.rows * self.columns
    }

    /// The response of a vertex's material; a single response is shared by all materials.
    fn material(&self, vertex: usize) -> &WeightedResponse {
        &self.materials[(self.vertices.materials()[vertex] as usize).min(self.materials.len() - 1)]
    }

    /// Direct light with shadows.
    pub(super) fn direct(&self) -> Vec<f32> {
        self.each(|vertex, into| {
            let local = self.local_direct(vertex);
            let rotation = rotation(self.light_order, &self.vertices.frames()[vertex]);
            let mut row = vec![0.0; self.columns];
            for (local, into) in local.chunks_exact(self.columns).zip(into.chunks_exact_mut(self.columns)) {
                rotation.apply(local, &mut row);
                into.iter_mut().zip(&row).for_each(|(into, value)| *into = *value as f32);
            }
        })
    }

    /// The matrix of direct light, with the light in local coordinates: the sum over unblocked directions, or the sum
    /// over all directions minus the sum over blocked ones, whichever is shorter.
    fn local_direct(&self, vertex: usize) -> Vec<f64> {
        let material = self.material(vertex);
        let directions = self.rays.rule().len();
        let blocked: Vec<usize> = self.rays.blocked_directions(vertex).collect();
        let mut sums = vec![0.0; self.size()];
        let mut add = |direction: usize| {
            let column = &material.weighted[direction * self.rows..(direction + 1) * self.rows];
            add_product(&mut sums, column, &self.light[direction * self.columns..(direction + 1) * self.columns]);
        };
        if 2 * blocked.len() <= directions {
            blocked.iter().for_each(|&direction| add(direction));
            sums.iter_mut().zip(&material.whole).for_each(|(sum, whole)| *sum = whole - *sum);
        } else {
            (0..directions).filter(|&direction| !self.rays.is_blocked(vertex, direction)).for_each(add);
        }
        sums
    }

    /// One more reflection: light from the front faces that a vertex sees, where `last` is their exit radiance in
    /// `basis`.
    pub(super) fn bounce(&self, last: &[f32], basis: &ExitBasis) -> Vec<f32> {
        self.each(|vertex, into| {
            let (material, frame) = (self.material(vertex), &self.vertices.frames()[vertex]);
            let (mut sums, mut radiance) = (vec![0.0; self.size()], vec![0.0; self.columns]);
            for hit in self.rays.front_hits(vertex) {
                let direction = hit.direction as usize;
                let towards = frame.to_global(self.rays.rule().directions()[direction]);
                self.radiance(hit, -towards, (last, basis), &mut radiance);
                let column = &material.weighted[direction * self.rows..(direction + 1) * self.rows];
                add_product(&mut sums, column, &radiance);
            }
            into.iter_mut().zip(&sums).for_each(|(into, sum)| *into = *sum as f32);
        })
    }

    /// The exit radiance of a triangle per light function, interpolated between its corners. A direction below the
    /// horizon of a corner's normal is moved to the horizon, because the exit basis is undefined below it.
    fn radiance(&self, hit: &FrontHit, view: DVec3, (last, basis): (&[f32], &ExitBasis), into: &mut [f64]) {
        into.fill(0.0);
        let mut y = [0.0; MAX_ORDER * MAX_ORDER];
        let (y, size) = (&mut y[..basis.len()], basis.len() * self.columns);
        for (vertex, weight) in self.vertices.triangles()[hit.triangle as usize].into_iter().zip(hit.weights()) {
            let vertex = vertex as usize;
            let local = above_horizon(self.vertices.frames()[vertex].to_local(view));
            basis.values(local, y);
            let matrix = &last[vertex * size..(vertex + 1) * size];
            for (y, row) in y.iter().zip(matrix.chunks_exact(self.columns)) {
                let factor = weight * y;
                into.iter_mut().zip(row).for_each(|(sum, &value)| *sum += factor * f64::from(value));
            }
        }
    }

    /// Computes the matrix of each vertex, independently of the others.
    fn each(&self, compute: impl Fn(usize, &mut [f32]) + Sync) -> Vec<f32> {
        let mut values = vec![0.0; self.vertices.len() * self.size()];
        let of_vertices = values.par_chunks_exact_mut(self.size()).enumerate();
        of_vertices.for_each(|(vertex, into)| compute(vertex, into));
        values
    }
}

/// The rotation of coefficients from a local frame to global coordinates.
fn rotation(order: usize, frame: &LocalFrame) -> HarmonicRotation {
    HarmonicRotation::new(order, &frame.matrix()).expect("frames are orthonormal and right-handed")
}

fn above_horizon(local: DVec3) -> DVec3 {
    if local.z >= 0.0 {
        return local;
    }
    unit(local.with_z(0.0)).unwrap_or(DVec3::Z)
}

fn add_product(sums: &mut [f64], column: &[f64], row: &[f64]) {
    for (sums, factor) in sums.chunks_exact_mut(row.len()).zip(column) {
        sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += factor * value);
    }
}
