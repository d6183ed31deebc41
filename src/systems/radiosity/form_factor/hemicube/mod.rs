//! Form factors by hemicubes (Cohen and Greenberg, 1985), drawn by a card: from a point of each patch five faces of
//! half a cube into an item buffer, and for each pixel its delta form factor to the visible patch.

mod crack;
mod delta;
mod item;

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;
use refsim::device::Profile;
use refsim::machine::Executor;

use crate::error::{InputError, input_error};
use crate::linalg::Matrix;
use crate::radiosity::draw::{DrawError, patch_of};
use crate::radiosity::{Patch, Patches};
use delta::Deltas;
use item::{HemicubeView, ItemBuffer, size};

/// Hemicubes drawn between two reports of progress.
const BUNDLE: usize = 64;
/// Alternative eye points if a patch's centre sees nothing: the centres of thirds of both sides.
const ELSEWHERE: [f64; 3] = [1.0 / 6.0, 0.5, 5.0 / 6.0];

/// Parameters of hemicubes.
#[derive(Clone, Debug)]
pub struct Hemicube {
    /// Pixels along a side of the top face: even, at least 2.
    pub resolution: u32,
    /// Profile of the card, which must run fragment programs (`!!FP1.0`).
    pub device: Arc<Profile>,
}

impl Hemicube {
    /// Creates hemicubes with this many pixels along a side of the top face, on a GeForce FX 5900 Ultra.
    ///
    /// # Panics
    /// Never: the device is a built-in one.
    pub fn new(resolution: u32) -> Self {
        Self { resolution, device: Arc::new(Profile::named("nv35").expect("a built-in device")) }
    }

    /// Checks that the card can draw the hemicube.
    fn check(&self) -> Result<(), InputError> {
        let limit = self.device.limits.max_target_size.unwrap_or(16_384);
        let most = limit / 4 * 2;
        let [width, height] = size(self.resolution.min(limit));
        if self.resolution < 2 || self.resolution % 2 == 1 || width.max(height) > limit {
            let device = self.device.name.clone();
            return Err(input_error!("radiosity::form_factors" =>
                    "expected an even number of pixels from 2 to {most} along a side of a hemicube, found {}; its \
                     five faces lie in one target, which {device} allows {limit} pixels a side", self.resolution));
        }
        Ok(())
    }
}

impl Default for Hemicube {
    /// 64 pixels on nv35.
    fn default() -> Self {
        Self::new(64)
    }
}

/// Rows of the form factors of some patches.
pub(super) fn matrix(
    patches: &Patches,
    hemicube: &Hemicube,
    executor: &Executor,
    is_wanted: &(dyn Fn(usize) -> bool + Sync),
    done: &mut dyn FnMut(usize, usize),
) -> Result<Matrix, InputError> {
    hemicube.check()?;
    let matrix = Matrix::zeros([patches.list().len(); 2]);
    let mut matrix = matrix.map_err(|error| error.coded("radiosity::form_factors"))?;
    let work = HemicubeRows { patches, hemicube, executor, deltas: Deltas::new(hemicube.resolution) };
    let mut rows: Vec<(usize, &mut [f64])> =
        matrix.par_rows_mut().enumerate().filter(|(patch, _)| is_wanted(*patch)).collect();
    let (all, mut drawn) = (rows.len(), 0);
    for rows in rows.chunks_mut(BUNDLE) {
        // One card per worker; the result does not depend on the assignment.
        let each = rows.len().div_ceil(rayon::current_num_threads()).max(1);
        let filled = rows.par_chunks_mut(each).try_for_each(|rows| work.fill(rows));
        filled.map_err(|error| InputError::of("radiosity::form_factors", error))?;
        drawn += rows.len();
        done(drawn, all);
    }
    Ok(matrix)
}

/// Inputs of the computation of rows.
struct HemicubeRows<'a> {
    patches: &'a Patches,
    hemicube: &'a Hemicube,
    executor: &'a Executor,
    deltas: Deltas,
}

impl HemicubeRows<'_> {
    /// Computes rows of patches.
    fn fill(&self, rows: &mut [(usize, &mut [f64])]) -> Result<(), DrawError> {
        let mut buffer = ItemBuffer::new(self.executor, &self.hemicube.device, self.hemicube.resolution)?;
        for (patch, row) in rows {
            // The largest open part, the first of equals; a patch that is wholly open is its own.
            let larger = |one: &&Patch, other: &&Patch| one.area().total_cmp(&other.area());
            let Some(part) = self.patches.open_parts(*patch).iter().rev().max_by(larger) else { continue };
            if !self.look(&mut buffer, part, part.center(), row)? {
                self.look_elsewhere(&mut buffer, part, row)?;
            }
        }
        Ok(())
    }

    fn look_elsewhere(&self, buffer: &mut ItemBuffer, patch: &Patch, row: &mut [f64]) -> Result<(), DrawError> {
        for v in ELSEWHERE {
            for u in ELSEWHERE {
                if self.look(buffer, patch, patch.at(u, v).at, row)? {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// Adds the delta form factors of a hemicube to a row; returns `false` if it sees nothing.
    fn look(&self, buffer: &mut ItemBuffer, patch: &Patch, point: DVec3, row: &mut [f64]) -> Result<bool, DrawError> {
        let eye = HemicubeView::new(self.patches, patch, point);
        let mut any = false;
        for (face, mut codes) in buffer.see(self.patches, &eye)?.into_iter().enumerate() {
            crack::fill(self.patches, &eye, &eye.faces[face], self.hemicube.resolution as usize, &mut codes);
            let deltas = if face == 0 { &self.deltas.top } else { &self.deltas.side };
            for (&code, delta) in codes.iter().zip(deltas) {
                if let Some(seen) = patch_of(code) {
                    row[seen as usize] += delta;
                    any = true;
                }
            }
        }
        Ok(any)
    }
}
