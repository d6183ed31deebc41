//! Directions and weights that integrate polynomials exactly.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::harmonics::{function_count, harmonics};
use crate::elementary;
use crate::linalg::{Lu, Matrix};
use crate::quadrature::{self, legendre_polynomials};

/// Maximum degree of a rule.
pub const MAX_DEGREE: usize = 1023;

/// Quadrature rule: directions and weights over the sphere, or over the hemisphere z >= 0, which integrate polynomials
/// in x, y, z up to a degree exactly. Weights sum to the solid angle, 4 pi or 2 pi.
///
/// The directions are Gauss-Legendre points in z times equidistant azimuths: floor(d / 2) + 1 rings of d + 1 directions
/// for degree d, rings in ascending order of z. Every second ring is rotated by half a step.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionRule {
    directions: Vec<DVec3>,
    weights: Vec<f64>,
    degree: usize,
    /// Number of directions of a ring.
    azimuths: usize,
}

impl DirectionRule {
    /// Creates a rule over the sphere. Degree 2n - 2 integrates products of two functions of order n.
    pub fn sphere(degree: usize) -> Self {
        Self::between(-1.0, degree)
    }

    /// Creates a rule over the hemisphere z >= 0. Panics if the degree exceeds [`MAX_DEGREE`].
    pub fn hemisphere(degree: usize) -> Self {
        Self::between(0.0, degree)
    }

    /// Creates a rule over the hemisphere z >= 0 with about as many directions as [`Self::hemisphere`] of degree
    /// `size`, at many different heights, and exact only up to degree `degree`. There are floor(size / 2) + 1 rings and
    /// the same number of pairs of opposite columns; no two pairs of columns share a height. So the height of an
    /// occluder that is equally high all around is resolved to a fraction of a ring. With fewer than degree + 3 rings,
    /// the rule is [`Self::hemisphere`]'s.
    ///
    /// Each column integrates polynomials in z exactly. The part of azimuthal frequency m of a polynomial in x, y and z
    /// is a polynomial in z if m is even, so that its sum over columns vanishes; if m is odd, opposite columns cancel.
    pub fn spread(size: usize, degree: usize) -> Self {
        assert!(size <= MAX_DEGREE, "a size of at most {MAX_DEGREE}, not {size}");
        let (rings, pairs) = (size / 2 + 1, size / 2 + 1);
        let phase = |pair: usize| ((pair * step(pairs) % pairs) as f64 + 0.5) / pairs as f64;
        let columns: Option<Vec<_>> = (0..pairs).map(|pair| column(rings, phase(pair), degree)).collect();
        let Some(columns) = columns.filter(|_| 2 * pairs > degree) else { return Self::hemisphere(size) };
        Self::built(degree, [rings, 2 * pairs], |ring, azimuth| (columns[azimuth % pairs][ring], 0.25))
    }

    fn between(least_z: f64, degree: usize) -> Self {
        assert!(degree <= MAX_DEGREE, "a degree of at most {MAX_DEGREE}, not {degree}");
        let rings = quadrature::gauss_legendre(degree / 2 + 1);
        Self::built(degree, [rings.len(), degree + 1], |ring, _| {
            let ((at, weight), height) = (rings[ring], 1.0 - least_z);
            ((least_z + height * at, height * weight), if ring % 2 == 0 { 0.25 } else { 0.75 })
        })
    }

    /// A rule from the height and weight of each direction, and the fraction of a step by which it is turned.
    fn built(degree: usize, [rings, azimuths]: [usize; 2], node: impl Fn(usize, usize) -> ((f64, f64), f64)) -> Self {
        let mut rule = Self { directions: Vec::new(), weights: Vec::new(), degree, azimuths };
        for (ring, azimuth) in (0..rings).flat_map(|ring| (0..azimuths).map(move |azimuth| (ring, azimuth))) {
            let ((z, weight), turn) = node(ring, azimuth);
            let [x, y] = elementary::on_circle((azimuth as f64 + turn) / azimuths as f64);
            let radius = ((1.0 - z) * (1.0 + z)).sqrt();
            rule.directions.push(DVec3::new(radius * x, radius * y, z));
            rule.weights.push(weight * TAU / azimuths as f64);
        }
        rule
    }

    /// Unit directions.
    pub fn directions(&self) -> &[DVec3] {
        &self.directions
    }

    /// Weight of each direction, in steradians.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Degree up to which polynomials are integrated exactly.
    pub const fn degree(&self) -> usize {
        self.degree
    }

    /// Number of directions.
    pub fn len(&self) -> usize {
        self.directions.len()
    }

    /// Returns `false`: a rule has at least one direction.
    pub fn is_empty(&self) -> bool {
        self.directions.is_empty()
    }

    fn rings(&self) -> impl Iterator<Item = impl Iterator<Item = (DVec3, f64)>> {
        let rings = self.directions.chunks(self.azimuths).zip(self.weights.chunks(self.azimuths));
        rings.map(|(directions, weights)| directions.iter().copied().zip(weights.iter().copied()))
    }

    /// Integrates a function, summed ring by ring.
    pub fn integral(&self, value: impl Fn(DVec3) -> f64) -> f64 {
        self.rings().map(|ring| ring.map(|(at, weight)| weight * value(at)).sum::<f64>()).sum()
    }

    /// Computes the integrals of a function times each of the n^2 harmonics of an order: over the sphere its
    /// coefficients, over the hemisphere its zero-hemisphere projection. Exact for a polynomial f of degree d if the
    /// rule's degree is at least d + n - 1. Panics if the order is not 1 to 10.
    pub fn project(&self, order: usize, value: impl Fn(DVec3) -> f64) -> Vec<f64> {
        let mut sums = vec![0.0; function_count(order)];
        let [mut of_ring, mut y] = [sums.clone(), sums.clone()];
        for ring in self.rings() {
            of_ring.fill(0.0);
            for (at, weight) in ring {
                harmonics(order, at, &mut y);
                let weighted = weight * value(at);
                of_ring.iter_mut().zip(&y).for_each(|(sum, y)| *sum += weighted * y);
            }
            sums.iter_mut().zip(&of_ring).for_each(|(sum, of_ring)| *sum += of_ring);
        }
        sums
    }
}

/// A number near 0.382 `count` (the golden section), coprime to `count`: its multiples put successive phases far apart.
fn step(count: usize) -> usize {
    let share = (count * 382).div_ceil(1000).max(1);
    let common = |mut a: usize, mut b: usize| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    (share..).find(|&step| common(step, count) == 1).unwrap_or(1)
}

/// Number of heights of a column beyond the degree plus one: enough for every weight to exceed 0.8 of the plain sum's
/// weight.
const SPARE: usize = 2;

/// Heights from 0 to 1 and their weights, which sum to 1 and integrate polynomials in z up to a degree exactly.
///
/// With z = (1 - cos a) / 2, the angles a are equidistant from 0 to pi, the first at the fraction `phase` of a step.
/// The plain sum over angles has the weights `sin(a) pi / (2 count)`. Here they are multiplied by 1 plus a polynomial
/// in z; of all exact weights these differ least from the plain sum's. `None` if there are too few heights.
fn column(count: usize, phase: f64, degree: usize) -> Option<Vec<(f64, f64)>> {
    if count < degree + 1 + SPARE {
        return None;
    }
    let angles = (0..count).map(|i| (i as f64 + phase) * PI / count as f64);
    // z = sin(a / 2)^2 keeps the digits of small heights.
    let plain: Vec<(f64, f64)> = angles
        .map(|angle| {
            let half = elementary::sin_cos(angle / 2.0).0;
            (half * half, elementary::sin_cos(angle).0 * PI / (2 * count) as f64)
        })
        .collect();
    let polynomials = |z: f64| legendre_polynomials(2.0 * z - 1.0).take(degree + 1).map(|[value, _]| value).collect();
    let values: Vec<Vec<f64>> = plain.iter().map(|&(z, _)| polynomials(z)).collect();
    let sum = |term: &dyn Fn(&[f64]) -> f64| -> f64 {
        plain.iter().zip(&values).map(|(&(_, weight), values)| weight * term(values)).sum()
    };
    let size = degree + 1;
    let products = (0..size * size).map(|at| sum(&|values| values[at / size] * values[at % size]));
    let products = Matrix::new([size; 2], products.collect()).ok()?;
    // The integral of the first polynomial is 1; the integrals of the others are 0.
    let missing: Vec<f64> = (0..size).map(|i| f64::from(u8::from(i == 0)) - sum(&|values| values[i])).collect();
    let factors = Lu::new(&products).ok()?.solve(&missing);
    let change = |values: &[f64]| -> f64 { values.iter().zip(&factors).map(|(value, factor)| value * factor).sum() };
    Some(plain.iter().zip(&values).map(|(&(z, weight), values)| (z, weight * (1.0 + change(values)))).collect())
}
