//! The transfer M_p of vertices, computed one segment of the light at a time (equations 6 and 10).
//!
//! The raw transfer of a vertex is a sum over its visible fine directions: component i for light texel j is the sum of
//! hat_j(s) F_i(R_p s) times the solid angle of s. A light with texel radiances l has the transferred radiance M l. An
//! orthonormal Haar transform of each segment, of the light and of the rows of M, does not change this product.
//!
//! *Cost.* A vertex costs one evaluation of F per segment and visible direction in it. Hat functions two texels wide
//! overlap the borders of segments: 68 x 68 directions instead of 64 x 64, 13 % more. *Memory*: visibility maps take 12
//! KiB per vertex, and one segment 1 KiB per vertex and row of F. For 50,000 vertices and 10 rows this is 614 MB and at
//! most 512 MB.

use std::fmt;
use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use super::Reflectance;
use crate::clustering::Signal;
use crate::error::InputError;
use crate::transfer::Vertices;
use crate::transfer::error::require;
use crate::transfer::grid::{FineDirections, Segmentation};
use crate::transfer::haar::Haar;
use crate::transfer::linear_basis::LinearBasis;
use crate::transfer::visibility::{VisibilityMaps, check};

/// Number of light texels, and of coefficients, in a segment.
const LEN: usize = Segmentation::Quarters.len();

/// Input of transfer: visibility, and the light's side of the factored BRDF.
#[derive(Clone, Copy)]
pub struct FactoredTransfer<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// Visibility maps of the vertices whose transfer is computed.
    pub maps: &'a VisibilityMaps,
    /// Hat functions of the light's texels.
    pub hats: &'a LinearBasis,
    /// m, the number of components of F: at least 1.
    pub rows: usize,
    /// F, of `rows` components.
    pub response: &'a dyn LightSide,
}

/// The light's side F of a factored BRDF. It is a trait object, so that the loops over directions are compiled once,
/// and not with each user.
pub trait LightSide: Sync {
    /// Writes all components for a local direction of length 1 with z > 0 (z along the normal, x along the tangent);
    /// they include the cosine z.
    fn write(&self, direction: DVec3, into: &mut [f64]);
}

impl LightSide for Reflectance {
    fn write(&self, direction: DVec3, into: &mut [f64]) {
        self.light(direction, into);
    }
}

impl<F: Fn(DVec3, &mut [f64]) + Sync> LightSide for F {
    fn write(&self, direction: DVec3, into: &mut [f64]) {
        self(direction, into);
    }
}

impl fmt::Debug for FactoredTransfer<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FactoredTransfer").field("maps", &self.maps.len()).field("rows", &self.rows).finish()
    }
}

/// The transfer of a reflectance; F is the reflectance's factor of light.
pub const fn transfer_of<'a>(
    vertices: &'a Vertices,
    maps: &'a VisibilityMaps,
    hats: &'a LinearBasis,
    reflectance: &'a Reflectance,
) -> FactoredTransfer<'a> {
    FactoredTransfer { vertices, maps, hats, rows: reflectance.terms(), response: reflectance }
}

/// The transfer of one segment of the light at the vertices that see part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferSegment {
    /// The segment, 0 to 23.
    pub segment: usize,
    /// The vertices, by their index in the mesh, in the order of the visibility maps.
    pub vertices: Vec<u32>,
    /// One point per vertex: row i and Haar coefficient c are component 256 i + c.
    pub signal: Signal,
}

/// Scratch memory of a thread.
struct Scratch {
    /// F for one direction.
    response: Vec<f64>,
    /// Raw transfer, texel by texel.
    raw: Vec<f64>,
    square: Vec<f64>,
    haar: Haar,
}

impl Scratch {
    fn new(rows: usize) -> Self {
        let side = Segmentation::Quarters.side();
        Self { response: vec![0.0; rows], raw: vec![0.0; LEN * rows], square: vec![0.0; LEN], haar: Haar::new(side) }
    }
}

impl FactoredTransfer<'_> {
    /// Iterates over the segments in order, except segments that no vertex sees. Each segment is computed when the
    /// iterator reaches it.
    pub fn segments(&self) -> impl Iterator<Item = Result<TransferSegment, InputError>> + '_ {
        (0..Segmentation::Quarters.count()).filter_map(|segment| self.segment(segment).transpose())
    }

    /// Computes a segment; `None` if no vertex sees part of it. The bits do not depend on the number of threads. Panics
    /// if there is no such segment.
    pub fn segment(&self, segment: usize) -> Result<Option<TransferSegment>, InputError> {
        require(self.rows > 0, "the number of rows", "at least 1", 0.0)?;
        check(self.vertices, self.maps.vertices())?;
        let hats = self.hats.segment(segment);
        let maps: Vec<usize> =
            (0..self.maps.len()).into_par_iter().filter(|&map| hats.sees(self.maps.bits(map))).collect();
        if maps.is_empty() {
            return Ok(None);
        }
        let dimension = self.rows * LEN;
        let mut values = vec![0.0_f32; maps.len() * dimension];
        values.par_chunks_exact_mut(dimension).zip(&maps).for_each_init(
            || Scratch::new(self.rows),
            |scratch, (into, &map)| {
                self.gather(segment, map, scratch);
                self.transform(scratch, into);
            },
        );
        let vertices = maps.into_iter().map(|map| self.maps.vertices()[map]).collect();
        Ok(Some(TransferSegment { segment, vertices, signal: Signal::new(dimension, values)? }))
    }

    /// The raw transfer of a map's vertex for a segment (equation 10): row i and light texel j of the segment are
    /// component 256 i + j. Panics if there is no such segment or map.
    pub fn raw(&self, segment: usize, map: usize) -> Vec<f64> {
        let mut scratch = Scratch::new(self.rows);
        self.gather(segment, map, &mut scratch);
        (0..self.rows * LEN).map(|at| scratch.raw[at % LEN * self.rows + at / LEN]).collect()
    }

    /// Sums raw transfer over the directions that a map's vertex sees, in the order of their indices.
    fn gather(&self, segment: usize, map: usize, scratch: &mut Scratch) {
        let frame = &self.vertices.frames()[self.maps.vertices()[map] as usize];
        let (directions, rows) = (FineDirections::get().directions(), self.rows);
        let Scratch { response, raw, .. } = scratch;
        raw.fill(0.0);
        self.hats.segment(segment).for_each_seen(self.maps.bits(map), |sample| {
            self.response.write(frame.to_local(directions[sample.fine as usize]), response);
            let count = usize::from(sample.count);
            for (&place, weight) in sample.places[..count].iter().zip(sample.weights) {
                let into = &mut raw[usize::from(place) * rows..][..rows];
                into.iter_mut().zip(&*response).for_each(|(sum, value)| *sum += weight * value);
            }
        });
    }

    /// Transforms raw transfer into Haar coefficients, row by row.
    fn transform(&self, scratch: &mut Scratch, into: &mut [f32]) {
        let Scratch { raw, square, haar, .. } = scratch;
        for (row, into) in into.chunks_exact_mut(LEN).enumerate() {
            square.iter_mut().zip(raw[row..].iter().step_by(self.rows)).for_each(|(to, from)| *to = *from);
            haar.forward(square);
            into.iter_mut().zip(&*square).for_each(|(to, from)| *to = *from as f32);
        }
    }
}

impl TransferSegment {
    /// Indices of a row's components within a point of the signal.
    pub const fn row(row: usize) -> Range<usize> {
        row * LEN..(row + 1) * LEN
    }
}
