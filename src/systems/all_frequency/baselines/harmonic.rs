//! Transfer matrices whose rows and columns are spherical harmonics of the same order.

use glam::DVec3;
use rayon::prelude::*;

use super::BaselineSubject;
use crate::sphere::{DirectionRule, function_count, harmonics};
use crate::transfer::grid::{FINE_DIRECTIONS, FineDirections, LIGHT_TEXELS};
use crate::transfer::linear_basis::BasisWeights;

/// Degree of the quadrature rule by which reflectance is projected.
const DEGREE: usize = 44;

/// \[SKS02\]: matrices map light of n x n harmonics to n x n harmonics of incident radiance. The exit radiance is
/// computed as in \[KSS02\], from the coefficients of reflectance times cosine for the exact direction of the eye, so
/// the truncation to n x n harmonics is the only approximation.
///
/// All harmonics are in the global frame, because rotating both sides of a sum over whole bands does not change it.
#[derive(Debug)]
pub struct HarmonicTransfer<'a> {
    subject: BaselineSubject<'a>,
    order: usize,
    /// Values of the harmonics at each fine direction.
    functions: Vec<f64>,
}

impl<'a> HarmonicTransfer<'a> {
    /// Creates the baseline of an order; the paper uses 5. Panics if the order is not 1 to
    /// [`crate::sphere::MAX_ORDER`].
    pub fn new(subject: BaselineSubject<'a>, order: usize) -> Self {
        let count = function_count(order);
        let mut functions = vec![0.0; FINE_DIRECTIONS * count];
        let directions = FineDirections::get().directions();
        functions.par_chunks_exact_mut(count).zip(directions).for_each(|(y, &at)| harmonics(order, at, y));
        Self { subject, order, functions }
    }

    fn functions(&self, fine: usize) -> &[f64] {
        let count = function_count(self.order);
        &self.functions[fine * count..(fine + 1) * count]
    }

    /// Projects a light to coefficients; its texels' radiances are interpolated by hat functions. Panics if the light
    /// does not have 6,144 texels.
    pub fn light(&self, texels: &[[f64; 3]]) -> Vec<[f64; 3]> {
        assert_eq!(texels.len(), LIGHT_TEXELS, "texels of a light");
        let mut coefficients = vec![[0.0; 3]; function_count(self.order)];
        for (fine, &angle) in FineDirections::get().solid_angles().iter().enumerate() {
            let mut radiance = [0.0; 3];
            for (texel, weight) in BasisWeights::of(self.subject.hats.width(), fine).iter() {
                (0..3).for_each(|channel| radiance[channel] += weight * texels[texel][channel]);
            }
            for (sum, y) in coefficients.iter_mut().zip(self.functions(fine)) {
                (0..3).for_each(|channel| sum[channel] += y * radiance[channel] * angle);
            }
        }
        coefficients
    }

    /// Radiance of each map's vertex towards an eye under a light given by coefficients; 0 if the eye is below the
    /// horizon. Panics unless there is one coefficient per function.
    pub fn radiance(&self, eye: DVec3, light: &[[f64; 3]]) -> Vec<[f64; 3]> {
        assert_eq!(light.len(), function_count(self.order), "a coefficient per function");
        let incident = |fine: usize| {
            let mut sum = [0.0; 3];
            for (y, light) in self.functions(fine).iter().zip(light) {
                (0..3).for_each(|channel| sum[channel] += y * light[channel]);
            }
            sum.map(|value| value * FineDirections::get().solid_angles()[fine])
        };
        let incident: Vec<[f64; 3]> = (0..FINE_DIRECTIONS).into_par_iter().map(incident).collect();
        let rule = DirectionRule::hemisphere(DEGREE);
        let of_map = |map: usize| {
            let Some(view) = self.subject.view(map, eye) else { return [0.0; 3] };
            let (arriving, reflectance) = (self.arriving(map, &incident), self.reflectance(map, view, &rule));
            let mut sum = [0.0; 3];
            for (arriving, f) in arriving.iter().zip(&reflectance) {
                (0..3).for_each(|channel| sum[channel] += f * arriving[channel]);
            }
            sum
        };
        (0..self.subject.maps.len()).into_par_iter().map(of_map).collect()
    }

    /// Coefficients of the radiance that reaches a map's vertex: its transfer matrix times the light.
    fn arriving(&self, map: usize, incident: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut coefficients = vec![[0.0; 3]; function_count(self.order)];
        for (block, &word) in self.subject.maps.bits(map).iter().enumerate() {
            let mut left = word;
            while left != 0 {
                let fine = 64 * block + left.trailing_zeros() as usize;
                left &= left - 1;
                for (sum, y) in coefficients.iter_mut().zip(self.functions(fine)) {
                    (0..3).for_each(|channel| sum[channel] += y * incident[fine][channel]);
                }
            }
        }
        coefficients
    }

    /// Coefficients of f(v, s) over the hemisphere of lights.
    fn reflectance(&self, map: usize, view: DVec3, rule: &DirectionRule) -> Vec<f64> {
        let frame = &self.subject.vertices.frames()[self.subject.maps.vertices()[map] as usize];
        let count = function_count(self.order);
        let (mut sum, mut y) = (vec![0.0; count], vec![0.0; count]);
        for (&light, weight) in rule.directions().iter().zip(rule.weights()) {
            harmonics(self.order, frame.to_global(light), &mut y);
            let f = weight * self.subject.product.value(view, light);
            sum.iter_mut().zip(&y).for_each(|(sum, y)| *sum += f * y);
        }
        sum
    }
}
