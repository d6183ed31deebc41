//! Local light of vertices as sets of texture coordinates.

use super::options::LocalFormat;
use super::subject::CardVertices;
use crate::bi_scale::kernels::LocalLayout;
use crate::card::{Attribute, CardError, by_register, check_finite};

/// Local light of a frame, and its format for the card.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalStream<'a> {
    pub(super) vertices: &'a CardVertices,
    pub(super) layout: LocalLayout,
    /// M times red, green and blue for each vertex.
    pub(super) local: &'a [[f32; 3]],
    pub(super) directions: usize,
    /// Exposure, and what texels are to be multiplied by.
    pub(super) factor: f64,
    /// The largest number times that.
    pub(super) largest: f64,
    pub(super) format: LocalFormat,
}

impl LocalStream<'_> {
    /// The sets of a pass but the last, which is begun by the first direction of the pass.
    pub(super) fn sets(&self, first: usize, count: usize) -> Result<Vec<Attribute>, CardError> {
        let of_vertex = |at: usize| {
            let vertex = self.vertices.vertices[at] as usize;
            let mut sets = vec![[0_u32; 4]; self.layout.last()];
            let light = &self.local[vertex * self.directions..][..self.directions];
            for (direction, rgb) in light[first..first + count].iter().enumerate() {
                for (channel, &value) in rgb.iter().enumerate() {
                    let (set, component) = self.layout.place(direction, channel);
                    let value = self.format.rounded(self.factor * f64::from(value), self.largest);
                    sets[set][component] = value.to_bits();
                }
            }
            sets
        };
        let sets = by_register(self.layout.last(), self.vertices.vertices.len(), of_vertex);
        check_finite("local light that its format holds", &sets)?;
        Ok(sets)
    }
}

/// The largest number of local light times a factor.
///
/// # Errors
/// [`CardError::Input`] if single precision does not hold it.
pub(super) fn largest(local: &[[f32; 3]], factor: f64) -> Result<f64, CardError> {
    let numbers = local.as_flattened().iter();
    let found = numbers.fold(0.0_f64, |most, &value| most.max((factor * f64::from(value)).abs()));
    if found.is_finite() && found <= f64::from(f32::MAX) {
        return Ok(found);
    }
    Err(CardError::figure("local light times exposure that single precision holds", found))
}
