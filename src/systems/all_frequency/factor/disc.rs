//! Errors of approximations by products of factors and by spherical harmonics, over texels above the horizon.

use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use super::factors::ProductFactors;
use super::product::ProductFunction;
use super::table::ProductTable;
use crate::all_frequency::factor::factors::of_svd;
use crate::elementary::on_circle;
use crate::error::InputError;
use crate::linalg::{LeadingSvd, Matrix, dot};
use crate::sphere::{ParabolicMap, function_count, harmonics};

/// The error of an approximation of f, over pairs of view and light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProductErrors {
    /// Root mean square difference.
    pub rms: f64,
    /// Largest difference.
    pub max: f64,
    /// The sum of squared differences divided by the sum of squares of f.
    pub relative_squared_error: f64,
    /// The minimum of the approximation; truncated sums may be negative although f is not.
    pub least: f64,
    /// The fraction of pairs for which the approximation is negative.
    pub negative: f64,
}

/// Sums and extremes over one row of pairs.
#[derive(Clone, Copy, Default)]
struct RowErrors {
    squared: f64,
    energy: f64,
    max: f64,
    least: f64,
    negative: usize,
}

impl ProductErrors {
    /// Errors over `rows` views and `columns` lights; `row` writes f and the approximation for a view at all lights.
    /// Rows are summed in order.
    fn over([rows, columns]: [usize; 2], row: impl Fn(usize, &mut [f64], &mut [f64]) + Sync) -> Self {
        let of_row = |at: usize| {
            let [mut f, mut found] = [vec![0.0; columns], vec![0.0; columns]];
            row(at, &mut f, &mut found);
            let mut errors = RowErrors { least: f64::INFINITY, ..RowErrors::default() };
            for (f, found) in f.iter().zip(&found) {
                let difference = found - f;
                errors.squared += difference * difference;
                errors.energy += f * f;
                errors.max = errors.max.max(difference.abs());
                errors.least = errors.least.min(*found);
                errors.negative += usize::from(*found < 0.0);
            }
            errors
        };
        let of_rows: Vec<RowErrors> = (0..rows).into_par_iter().map(of_row).collect();
        let sum = |of: fn(&RowErrors) -> f64| of_rows.iter().map(of).sum::<f64>();
        let [squared, energy] = [sum(|row| row.squared), sum(|row| row.energy)];
        let pairs = (rows * columns) as f64;
        Self {
            rms: (squared / pairs).sqrt(),
            max: of_rows.iter().fold(0.0, |most, row| most.max(row.max)),
            relative_squared_error: if squared > 0.0 { squared / energy } else { 0.0 },
            least: of_rows.iter().fold(f64::INFINITY, |least, row| least.min(row.least)),
            negative: of_rows.iter().map(|row| row.negative).sum::<usize>() as f64 / pairs,
        }
    }

    /// 1,024 directions with equal solid angles above the horizon, along a spiral: "1024 samples in both light
    /// direction and view direction sampled over the hemisphere"; the paper does not specify them.
    pub fn directions() -> Vec<DVec3> {
        const COUNT: usize = 1024;
        /// The golden ratio minus 1.
        const TURN: f64 = 0.618_033_988_749_894_9;
        let direction = |at: usize| {
            let z = (at as f64 + 0.5) / COUNT as f64;
            let ([x, y], radius) = (on_circle(at as f64 * TURN), ((1.0 - z) * (1.0 + z)).sqrt());
            DVec3::new(radius * x, radius * y, z)
        };
        (0..COUNT).map(direction).collect()
    }
}

/// f at pairs of directions above the horizon, each representing a solid angle.
#[derive(Clone, Debug, PartialEq)]
pub struct HemisphereSamples {
    /// Directions of the views and of the lights.
    pub directions: [Vec<DVec3>; 2],
    /// Solid angles of these directions, in steradians.
    pub solid_angles: [Vec<f64>; 2],
    /// f, one row per view, one column per light.
    pub values: Matrix,
}

impl HemisphereSamples {
    /// f, clamped to `limit`, at [`ProductErrors::directions`] for both view and light: one sample per pair.
    pub fn of_equal_angles(product: &dyn ProductFunction, limit: f64) -> Self {
        let directions = ProductErrors::directions();
        let angle = 2.0 * PI / directions.len() as f64;
        let row = |view: &DVec3| -> Vec<f64> {
            directions.iter().map(|light| product.value(*view, *light).clamp(-limit, limit)).collect()
        };
        let rows: Vec<Vec<f64>> = directions.par_iter().map(row).collect();
        let values = Matrix::new([directions.len(); 2], rows.concat()).expect("a value per pair");
        let solid_angles = [vec![angle; directions.len()], vec![angle; directions.len()]];
        Self { directions: [directions.clone(), directions], solid_angles, values }
    }

    /// Errors of the approximation by the `terms` largest singular values of these samples, or by all if there are
    /// fewer.
    pub fn term_errors(&self, terms: usize) -> Result<ProductErrors, InputError> {
        let svd = LeadingSvd::new(&self.values, terms.max(1)).map_err(of_svd)?;
        let lights: Vec<Vec<f64>> = (0..self.values.column_count()).map(|at| column(&svd.right, at)).collect();
        Ok(ProductErrors::over(self.counts(), |at, f, found| {
            f.copy_from_slice(self.values.row(at));
            let view: Vec<f64> = column(&svd.left, at).iter().zip(&svd.values).map(|(u, value)| u * value).collect();
            found.iter_mut().zip(&lights).for_each(|(found, light)| *found = dot(&view, light));
        }))
    }

    fn counts(&self) -> [usize; 2] {
        [self.values.row_count(), self.values.column_count()]
    }
}

fn column(matrix: &Matrix, at: usize) -> Vec<f64> {
    (0..matrix.row_count()).map(|row| matrix.row(row)[at]).collect()
}

/// The part of a table whose texels have their centers above the horizon: 812 of 1,024 for maps of 32 x 32.
#[derive(Clone, Debug, PartialEq)]
pub struct DiscSamples {
    view: Vec<usize>,
    light: Vec<usize>,
    samples: HemisphereSamples,
}

impl DiscSamples {
    /// The samples of a table.
    pub fn new(table: &ProductTable) -> Self {
        let maps = [table.view(), table.light()];
        let [view, light] = maps.map(inside);
        let rows = view.iter().flat_map(|&row| light.iter().map(move |&column| table.values().row(row)[column]));
        let values = Matrix::new([view.len(), light.len()], rows.collect()).expect("no larger than the table");
        let directions =
            [(maps[0], &view), (maps[1], &light)].map(|(map, texels)| each(map, texels, ParabolicMap::direction));
        let solid_angles =
            [(maps[0], &view), (maps[1], &light)].map(|(map, texels)| each(map, texels, ParabolicMap::solid_angle));
        Self { view, light, samples: HemisphereSamples { directions, solid_angles, values } }
    }

    /// Number of texels of the view's and of the light's map.
    pub fn counts(&self) -> [usize; 2] {
        self.samples.counts()
    }

    /// The texels' directions, with f at them.
    pub const fn samples(&self) -> &HemisphereSamples {
        &self.samples
    }

    /// Errors of factors at these texels.
    pub fn errors(&self, factors: &ProductFactors) -> ProductErrors {
        ProductErrors::over(self.counts(), |at, f, found| {
            f.copy_from_slice(self.samples.values.row(at));
            let g = factors.view_texel(self.view[at]);
            for (value, &light) in found.iter_mut().zip(&self.light) {
                *value = dot(g, factors.light_texel(light));
            }
        })
    }
}

/// Evaluates a function of column and row at each of the given texels.
fn each<T>(map: ParabolicMap, texels: &[usize], of: impl Fn(ParabolicMap, usize, usize) -> T) -> Vec<T> {
    texels.iter().map(|texel| of(map, texel % map.side(), texel / map.side())).collect()
}

/// Texels with centers above the horizon.
fn inside(map: ParabolicMap) -> Vec<usize> {
    (0..map.texels()).filter(|texel| map.direction(texel % map.side(), texel / map.side()).z > 0.0).collect()
}

/// Errors, at the samples, of an approximation by harmonics of the same order for view and light. Coefficients are
/// integrals of f times the harmonics, with f = 0 below the horizon: sums over these samples, weighted by solid angles.
/// Fails with [`InputError`] if a matrix is too large. Panics if the order is not 1 to [`crate::sphere::MAX_ORDER`].
pub fn harmonic_errors(samples: &HemisphereSamples, order: usize) -> Result<ProductErrors, InputError> {
    let expanded = || {
        let [[view, of_view], [light, of_light]] = [functions(samples, 0, order)?, functions(samples, 1, order)?];
        let columns = samples.values.product(&of_light)?.product(&light.transposed())?;
        view.product(&of_view.transposed().product(&columns)?)
    };
    let values = expanded().map_err(of_svd)?;
    Ok(ProductErrors::over(samples.counts(), |at, f, found| {
        f.copy_from_slice(samples.values.row(at));
        found.copy_from_slice(values.row(at));
    }))
}

/// The harmonics at the directions of a side, one row each, and the same times the solid angles.
fn functions(samples: &HemisphereSamples, side: usize, order: usize) -> Result<[Matrix; 2], InputError> {
    let (directions, angles) = (&samples.directions[side], &samples.solid_angles[side]);
    let mut y = Matrix::zeros([directions.len(), function_count(order)])?;
    for (row, &direction) in directions.iter().enumerate() {
        harmonics(order, direction, y.row_mut(row));
    }
    let mut weighted = y.clone();
    for (row, &angle) in angles.iter().enumerate() {
        weighted.row_mut(row).iter_mut().for_each(|value| *value *= angle);
    }
    Ok([y, weighted])
}
