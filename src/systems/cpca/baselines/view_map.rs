//! Functions of the view direction in a parabolic map, read per vertex on the host.

use glam::DVec3;
use rayon::prelude::*;

use super::ExitCoefficients;
use crate::error::{InputError, ensure};
use crate::geom::vector::wide;
use crate::linalg::Matrix;
use crate::sphere::ParabolicMap;
use crate::transfer::Vertices;
use crate::transfer::brdf::ExitBasis;

/// Functions of the view direction, in local coordinates, by the texels of a parabolic map; read with linear filters.
/// Beyond the rim they continue below the horizon.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewMap {
    map: ParabolicMap,
    functions: usize,
    /// Texel by texel, row by row: all functions.
    values: Vec<f32>,
}

impl ViewMap {
    /// y(v): for exit radiance.
    pub fn of_basis(basis: &ExitBasis, map: ParabolicMap) -> Self {
        Self::from_fn(map, basis.len(), |direction, into| basis.values(direction, into))
    }

    /// y(v) B: for transferred incident radiance. `brdf` has a row per function of exit radiance, a column per function
    /// of incident radiance.
    ///
    /// # Errors
    /// [`InputError`] if it has other rows.
    pub fn of_brdf(basis: &ExitBasis, brdf: &Matrix, map: ParabolicMap) -> Result<Self, InputError> {
        let (expected, found) = (basis.len(), brdf.row_count());
        ensure!(
            expected == found,
            "expected a matrix of {expected} rows, one per function of exit radiance, found {found}"
        );
        let mut y = vec![0.0; expected];
        Ok(Self::from_fn(map, brdf.column_count(), |direction, into| {
            basis.values(direction, &mut y);
            into.fill(0.0);
            for (y, row) in y.iter().zip(brdf.rows()) {
                into.iter_mut().zip(row).for_each(|(sum, b)| *sum += y * b);
            }
        }))
    }

    fn from_fn(map: ParabolicMap, functions: usize, mut at: impl FnMut(DVec3, &mut [f64])) -> Self {
        let (mut values, mut texel) = (Vec::with_capacity(map.side() * map.side() * functions), vec![0.0; functions]);
        for (row, column) in (0..map.side()).flat_map(|row| (0..map.side()).map(move |column| (row, column))) {
            at(map.direction(column, row), &mut texel);
            values.extend(texel.iter().map(|&value| value as f32));
        }
        Self { map, functions, values }
    }

    /// Number of functions.
    pub fn function_count(&self) -> usize {
        self.functions
    }

    /// Radiance of every vertex towards an eye: the functions at the view direction times the vertex's coefficients.
    ///
    /// # Errors
    /// [`InputError`] for coefficients of other functions or vertices.
    pub fn radiance(
        &self,
        vertices: &Vertices,
        coefficients: &ExitCoefficients,
        eye: DVec3,
    ) -> Result<Vec<[f32; 3]>, InputError> {
        let (expected, found) = (self.functions, coefficients.row_count());
        ensure!(expected == found, "expected {expected} coefficients per vertex, one per map, found {found}");
        let (expected, found) = (vertices.len(), coefficients.vertex_count());
        ensure!(expected == found, "expected coefficients of {expected} vertices, found those of {found}");
        let towards = |vertex: usize| {
            let view = (eye - wide(vertices.positions()[vertex])).normalize_or_zero();
            let corners = self.corners(vertices.frames()[vertex].to_local(view));
            let mut sum = [0.0; 3];
            for (function, coefficient) in coefficients.of(vertex).iter().enumerate() {
                let value: f32 = corners.iter().map(|&(texel, weight)| weight * self.values[texel + function]).sum();
                sum.iter_mut().zip(coefficient).for_each(|(sum, coefficient)| *sum += value * coefficient);
            }
            sum
        };
        Ok((0..vertices.len()).into_par_iter().map(towards).collect())
    }

    /// The start of the functions of the four texels around a direction, with the weights of a bilinear filter.
    /// Coordinates are clamped to the map, NaN to its first texel.
    fn corners(&self, direction: DVec3) -> [(usize, f32); 4] {
        let last = self.map.side() - 1;
        let along = self.map.coordinates(direction).map(|coordinate| {
            let at = (coordinate * self.map.side() as f64 - 0.5).clamp(0.0, last as f64);
            let first = at as usize;
            ([first, last.min(first + 1)], (at - first as f64).max(0.0) as f32)
        });
        let [(columns, u), (rows, v)] = along;
        [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| {
            let weight = [1.0 - u, u][i] * [1.0 - v, v][j];
            ((rows[j] * self.map.side() + columns[i]) * self.functions, weight)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At a texel's center the filter reads it alone; beyond the map it is clamped.
    #[test]
    fn the_filter_reads_texels() {
        let map = ParabolicMap::new(8);
        let view = ViewMap::from_fn(map, 1, |direction, into| into[0] = direction.x);
        let read = |direction| view.corners(direction).iter().map(|&(at, w)| w * view.values[at]).sum::<f32>();
        for (column, row) in [(0, 0), (3, 5), (7, 7)] {
            let direction = map.direction(column, row);
            assert!((f64::from(read(direction)) - direction.x).abs() < 1e-6, "{direction}");
        }
        assert_eq!(read(DVec3::NEG_Z), view.values[0], "no direction of the map");
        assert!(read(DVec3::new(0.9, 0.0, -0.4)).is_finite());
    }
}
