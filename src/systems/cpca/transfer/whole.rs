//! The transfer matrices of all vertices.

use glam::DVec3;
use rayon::prelude::*;

use super::gather::TransferGather;
use super::rays::TracedRays;
use super::response::Response;
use crate::error::{InputError, ensure, input_error};
use crate::sphere::{MAX_ORDER, function_count};
use crate::transfer::Vertices;
use crate::transfer::brdf::ExitBasis;
use crate::transfer::error::require;

/// Vertices per chunk of a sum over all vertices; it fixes the order of the additions.
const CHUNK: usize = 1024;

/// The transfer of every vertex: a matrix from light in global coordinates to exit radiance in an exit basis in local
/// coordinates.
#[derive(Clone, Debug)]
pub struct Transfer {
    basis: ExitBasis,
    columns: usize,
    values: Vec<f32>,
    /// The contribution of each bounce relative to the direct transfer (root mean square over all numbers).
    pub bounces: Vec<f64>,
}

impl Transfer {
    /// Computes the transfer of all vertices for light of an order. There must be one response per material, all in the
    /// same exit basis. `bounces` is the number of interreflections, not counting the reflection towards the eye; with
    /// 0, only direct light with shadows is computed. The rays must have been traced from these vertices, with hits
    /// kept if `bounces` is not 0.
    pub fn new(
        vertices: &Vertices,
        rays: &TracedRays,
        responses: &[Response],
        light_order: usize,
        bounces: u32,
    ) -> Result<Self, InputError> {
        check_bounces(vertices, rays, bounces)?;
        if let Some((triangle, material)) = unknown_material(vertices, responses) {
            return Err(input_error!("crossbar::prt::precompute" =>
                    "triangle {triangle} has material {material}, expected one below {} (counted from 0)",
                    responses.len()));
        }
        check(rays, responses, light_order)?;
        let (basis, columns) = (responses[0].basis().clone(), function_count(light_order));
        let size = basis.len() * columns;
        let gather = TransferGather::new(vertices, rays, responses, light_order);
        let direct = gather.direct();
        if bounces == 0 {
            return Ok(Self { basis, columns, values: direct, bounces: Vec::new() });
        }
        let whole = squares(&direct, size);
        let (mut last, mut total, mut added) = (direct.clone(), direct, Vec::new());
        for _ in 0..bounces {
            last = gather.bounce(&last, &basis);
            total.par_iter_mut().zip(&last).for_each(|(total, more)| *total += more);
            let now = squares(&last, size);
            added.push(if whole > 0.0 { (now / whole).sqrt() } else { 0.0 });
            if now <= 0.0 {
                break;
            }
        }
        Ok(Self { basis, columns, values: total, bounces: added })
    }

    /// The number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.values.len() / (self.row_count() * self.columns)
    }

    /// Number of rows of each matrix: functions of the exit basis.
    pub fn row_count(&self) -> usize {
        self.basis.len()
    }

    /// Number of columns of each matrix: functions of the light.
    pub fn column_count(&self) -> usize {
        self.columns
    }

    /// The basis of the rows.
    pub fn basis(&self) -> &ExitBasis {
        &self.basis
    }

    /// The matrix of a vertex, row by row. Panics if there is no such vertex.
    pub fn of(&self, vertex: usize) -> &[f32] {
        let size = self.row_count() * self.columns;
        &self.values[vertex * size..(vertex + 1) * size]
    }

    /// The matrices of all vertices, concatenated, row by row: the values of a signal with rows times columns numbers
    /// per point.
    pub fn into_values(self) -> Vec<f32> {
        self.values
    }

    pub(super) fn with_values(&self, values: Vec<f32>) -> Self {
        Self { basis: self.basis.clone(), columns: self.columns, values, bounces: Vec::new() }
    }

    /// The radiance that a vertex sends in a local direction under a light with these coefficients: y(v) M_p l. Panics
    /// if there is no such vertex, or the light does not have one coefficient per column.
    pub fn radiance(&self, vertex: usize, view: DVec3, light: &[f64]) -> f64 {
        assert_eq!(light.len(), self.columns, "a coefficient per column");
        let mut y = vec![0.0; self.row_count()];
        self.basis().values(view, &mut y);
        let rows = self.of(vertex).chunks_exact(self.columns);
        let exit = |row: &[f32]| row.iter().zip(light).map(|(&m, l)| f64::from(m) * l).sum::<f64>();
        y.iter().zip(rows).map(|(y, row)| y * exit(row)).sum()
    }

    /// Adds a transfer of the same vertices in another exit basis. A diffuse part in [`ExitBasis::Radiance`] is added
    /// to the coefficient of y_0 (Figure 9).
    pub fn add(&mut self, other: &Self) -> Result<(), InputError> {
        differ("columns", [self.columns, other.columns])?;
        differ("vertices", [self.vertex_count(), other.vertex_count()])?;
        let places = places(&self.basis, &other.basis)?;
        let (rows, columns, other_rows) = (self.row_count(), self.columns, other.row_count());
        let into = self.values.par_chunks_exact_mut(rows * columns);
        into.zip(other.values.par_chunks_exact(other_rows * columns)).for_each(|(into, from)| {
            for (&(row, scale), from) in places.iter().zip(from.chunks_exact(columns)) {
                let into = &mut into[row * columns..(row + 1) * columns];
                into.iter_mut().zip(from).for_each(|(into, from)| *into += (scale * f64::from(*from)) as f32);
            }
        });
        Ok(())
    }
}

/// For each row of basis `from`, the index of its row in `into`, and a factor.
fn places(into: &ExitBasis, from: &ExitBasis) -> Result<Vec<(usize, f64)>, InputError> {
    let missing = exit_bases_error([into.len(), from.len()]);
    match (into, from) {
        (ExitBasis::Radiance, ExitBasis::Radiance) => Ok(vec![(0, 1.0)]),
        (ExitBasis::Radiance, ExitBasis::Harmonics(_)) => Err(missing),
        // y_0 is 1 / sqrt(4 pi).
        (ExitBasis::Harmonics(_), ExitBasis::Radiance) if into.functions().first() == Some(&0) => {
            Ok(vec![(0, (4.0 * std::f64::consts::PI).sqrt())])
        }
        _ => {
            let place = |index| into.functions().iter().position(|own| own == index).map(|row| (row, 1.0));
            from.functions().iter().map(place).collect::<Option<_>>().ok_or(missing)
        }
    }
}

fn check(rays: &TracedRays, responses: &[Response], light_order: usize) -> Result<(), InputError> {
    let fits = (1..=MAX_ORDER).contains(&light_order);
    require(fits, "the order of the light", "an order from 1 to 10", light_order as f64)?;
    for response in responses {
        differ("directions", [rays.rule().len(), response.direction_count()])?;
        if responses[0].basis().functions() != response.basis().functions() {
            let found = [responses[0].basis().len(), response.basis().len()];
            return Err(exit_bases_error(found));
        }
    }
    Ok(())
}

/// Checks that rays of all vertices were traced, with hits if there are bounces.
fn check_bounces(vertices: &Vertices, rays: &TracedRays, bounces: u32) -> Result<(), InputError> {
    differ("vertices of rays", [vertices.len(), rays.vertex_count()])?;
    ensure!(bounces == 0 || rays.keeps_hits(), "crossbar::prt::precompute" =>
        "the rays were traced without keeping hits, which bounces need; trace them with `keep_hits`");
    Ok(())
}

/// The first triangle whose material has no response, and the material.
fn unknown_material(vertices: &Vertices, responses: &[Response]) -> Option<(usize, u32)> {
    let material = |corners: &[u32; 3]| vertices.materials()[corners[0] as usize];
    let mut materials = vertices.triangles().iter().map(material).enumerate();
    materials.find(|&(_, material)| material as usize >= responses.len())
}

/// The sum of squares over all vertices, summed in a fixed order.
fn squares(values: &[f32], size: usize) -> f64 {
    let chunk = |values: &[f32]| values.iter().map(|&value| f64::from(value) * f64::from(value)).sum::<f64>();
    values.par_chunks(CHUNK * size).map(chunk).collect::<Vec<_>>().into_iter().sum()
}

pub(super) fn differ(what: &str, [a, b]: [usize; 2]) -> Result<(), InputError> {
    ensure!(a == b, "crossbar::prt::precompute" => "expected equal numbers of {what}, found {a} and {b}");
    Ok(())
}

fn exit_bases_error([a, b]: [usize; 2]) -> InputError {
    input_error!("crossbar::prt::precompute" =>
        "expected one exit basis for all materials, or one that holds the other's functions, found bases of {a} and \
         {b} functions")
}
