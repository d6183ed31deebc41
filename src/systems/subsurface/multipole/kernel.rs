//! R_d tabulated over the squared distance, and its means over pairs of far pieces of surface.
//!
//! A source at depth z contributes `alpha' z / (4 pi) psi_1(d)` with d^2 = r^2 + z^2 and `psi_1 = (sigma_tr + 1/d)
//! e^(-sigma_tr d) / d^2`. With psi_0 = e^(-sigma_tr d) / d and `psi_(n+1) = ((2 n + 1) psi_n + sigma_tr^2 psi_(n-1)) /
//! d^2`, the derivative of psi_n by d^2 is -psi_(n+1) / 2. So R_d is completely monotone in r^2: its derivatives
//! alternate in sign and decrease in magnitude, and the error of a cubic Hermite polynomial on an interval of length h
//! is between 0 and h^4 / 384 times the fourth derivative at the interval's left end.

use std::f64::consts::PI;

use glam::DVec3;

use super::expansion::{Expansion, Taylor};
use super::moments::{BALL, Covariance, Moments};
use crate::elementary::{cbrt, exp};
use crate::subsurface::Dipole;

/// The largest relative error of the table within [`MATTERS`].
const MAX_INTERPOLATION_ERROR: f64 = 1e-6;
/// Number of diffusion lengths beyond which the relative error does not matter: e^-25 is 1e-11.
const MATTERS: f64 = 25.0;
/// Range of the base-2 logarithm of the number of intervals per octave of 1 + (r / z)^2.
const RESOLUTION: std::ops::RangeInclusive<u32> = 5..=9;
/// The logarithmic derivative of R_d is at most `SLOPE` / d + sigma_tr.
const SLOPE: f64 = 3.0;
/// At a tolerance of 1 %, two pieces are far if the root of the sum of their squared sizes, times the logarithmic
/// derivative, is at most this. It was measured; see tests/laws/subsurface/links_factors.rs.
const FAR: f64 = 0.5;
/// Factor of the squared size of a group of receivers: a receiver at the group's rim, where third-order terms do not
/// cancel, must keep the tolerance too. It was measured; see tests/laws/subsurface/links_blocks.rs.
pub(super) const SPREAD: f64 = 6.0;
/// Factor by which squared sizes may exceed the reach for pieces that cannot be divided further.
const LOOSE: f64 = 2.0;
/// Light is negligible if R_d times the area of the whole surface, relative to the total over the plane, is below the
/// tolerance times this.
pub(super) const FLOOR: f64 = 1e-5;

/// R_d of N channels on intervals of the squared distance.
#[derive(Clone, Debug)]
pub(super) struct DistanceTable<const N: usize> {
    pub(super) dipoles: [Dipole; N],
    /// The least depth of a source, squared, and its reciprocal.
    unit: f64,
    per_unit: f64,
    /// Number of low bits of v to drop for the index of its interval.
    shift: u32,
    intervals: Vec<Interval<N>>,
    /// A bound on the relative error of the tabulated R_d within [`MATTERS`] diffusion lengths.
    interpolation_error: f64,
    pub(super) tolerance: f64,
    /// Radius in mm around the entry of light within which all light but the fraction `tolerance` leaves.
    pub(super) layer: f64,
}

/// One interval of v = 1 + r^2 / unit.
#[derive(Clone, Copy, Debug)]
struct Interval<const N: usize> {
    /// For each channel, coefficients of powers of v minus the interval's left end.
    cubic: [[f64; 4]; N],
    /// For each channel, the integral of R_d over the disc with the radius at the interval's left end.
    disc: [f64; N],
    /// For each channel, the largest sum of squared sizes at which two pieces are far.
    reach: [f64; N],
    /// For each channel, the largest sum of squared sizes at which two pieces are negligible. Channels are separate,
    /// because otherwise a channel that falls off fast would divide pieces as far as a slow channel reaches.
    negligible: [f64; N],
}

struct Derivatives {
    value: f64,
    first: f64,
    fourth: f64,
}

impl<const N: usize> DistanceTable<N> {
    /// Creates the table for pieces at most `diameter` apart of a surface with an area, in mm and mm^2.
    pub(super) fn new(dipoles: [Dipole; N], diameter: f64, area: f64, tolerance: f64) -> Self {
        let depth = dipoles.iter().map(Dipole::z_r).fold(f64::INFINITY, f64::min);
        let unit = depth * depth;
        let mut kernel = Self {
            dipoles,
            unit,
            per_unit: 1.0 / unit,
            shift: 0,
            intervals: Vec::new(),
            interpolation_error: f64::INFINITY,
            tolerance,
            layer: dipoles.iter().map(|dipole| dipole.radius_of(1.0 - tolerance)).fold(0.0, f64::max),
        };
        let end = 1.0 + diameter * diameter / unit;
        for bits in RESOLUTION {
            kernel.tabulate(52 - bits, end);
            if kernel.interpolation_error <= MAX_INTERPOLATION_ERROR {
                break;
            }
        }
        kernel.set_reaches(area, tolerance);
        kernel
    }

    fn tabulate(&mut self, shift: u32, end: f64) {
        self.shift = shift;
        self.intervals.clear();
        self.interpolation_error = 0.0;
        let mut disc = [0.0; N];
        let mut left = self.dipoles.map(|dipole| derivatives(&dipole, self.unit, 1.0));
        loop {
            let [from, to] = [self.left_end(self.intervals.len()), self.left_end(self.intervals.len() + 1)];
            let right = self.dipoles.map(|dipole| derivatives(&dipole, self.unit, to));
            let width = to - from;
            let mut interval = Interval { cubic: [[0.0; 4]; N], disc, reach: [0.0; N], negligible: [0.0; N] };
            for (channel, cubic) in interval.cubic.iter_mut().enumerate() {
                let (l, r) = (&left[channel], &right[channel]);
                let slope = (r.value - l.value) / width;
                let second = (3.0 * slope - 2.0 * l.first - r.first) / width;
                let third = (l.first + r.first - 2.0 * slope) / (width * width);
                *cubic = [l.value, l.first, second, third];
                let distance = ((to - 1.0) * self.unit).sqrt();
                if self.dipoles[channel].sigma_tr() * distance <= MATTERS && r.value > 0.0 {
                    let bound = l.fourth * width * width * width * width / 384.0 / r.value;
                    self.interpolation_error = self.interpolation_error.max(bound);
                }
            }
            let ring = |channel: usize| PI * self.unit * primitive_at(interval.cubic[channel], width);
            disc = std::array::from_fn(|channel| disc[channel] + ring(channel));
            self.intervals.push(interval);
            if to > end {
                return;
            }
            left = right;
        }
    }

    /// Largest size of pieces at each distance.
    fn set_reaches(&mut self, area: f64, tolerance: f64) {
        // The error of the second-order mean grows with the third power of the size.
        let far = FAR * cbrt(tolerance / 0.01);
        let left_ends: Vec<f64> = (0..self.intervals.len()).map(|k| self.left_end(k)).collect();
        let distance = |k: usize| ((left_ends[k] - 1.0) * self.unit).sqrt();
        for (channel, dipole) in self.dipoles.iter().enumerate() {
            let light = |interval: &Interval<N>| interval.cubic[channel][0] * area / dipole.total();
            let dark = self.intervals.iter().position(|interval| light(interval) <= tolerance * FLOOR);
            let dark_from = dark.map_or(f64::INFINITY, distance);
            for (k, interval) in self.intervals.iter_mut().enumerate() {
                let r = distance(k);
                let d = (r * r + dipole.z_r() * dipole.z_r()).sqrt();
                let reach = far * d / (SLOPE + dipole.sigma_tr() * d);
                interval.reach[channel] = reach * reach;
                // Points of both pieces are at least r minus the balls' radii apart; (a + b)^2 <= 2 (a^2 + b^2).
                let spare = (r - dark_from).max(0.0);
                interval.negligible[channel] = 0.5 * spare * spare / BALL;
            }
        }
    }

    fn left_end(&self, interval: usize) -> f64 {
        f64::from_bits(((1.0_f64.to_bits() >> self.shift) + interval as u64) << self.shift)
    }

    /// The interval of a squared distance, and the offset of v in the interval.
    #[inline]
    fn find(&self, squared: f64) -> (&Interval<N>, f64) {
        let v = 1.0 + squared * self.per_unit;
        let bits = v.to_bits() >> self.shift;
        let interval = (bits - (1.0_f64.to_bits() >> self.shift)) as usize;
        (&self.intervals[interval.min(self.intervals.len() - 1)], v - f64::from_bits(bits << self.shift))
    }

    /// The mean of R_d over pairs of points of two pieces; `None` if they are too near. To second order it is g + g'
    /// trace(C) + 2 g'' x^T C x, with g(r^2) = R_d, x the difference of the mean points and C the sum of the
    /// covariances.
    #[inline]
    pub(super) fn mean(&self, one: &Moments, other: &Moments) -> Option<[f64; N]> {
        let apart = other.point - one.point;
        let (interval, t) = self.find(apart.length_squared());
        let size_squared = one.size_squared + other.size_squared;
        let fits = |channel: usize| size_squared <= interval.reach[channel].max(interval.negligible[channel]);
        (0..N).all(fits).then(|| self.second_order(one, other, apart, interval, t, 1.0))
    }

    /// Like [`Self::mean`], for pieces that cannot be divided further; R_d between mean points if they are too near.
    pub(super) fn mean_of_last(&self, one: &Moments, other: &Moments) -> [f64; N] {
        let apart = other.point - one.point;
        let (interval, t) = self.find(apart.length_squared());
        self.second_order(one, other, apart, interval, t, LOOSE)
    }

    /// The mean to second order if the squared sizes are within the reach times `loose`; else R_d between mean points.
    #[inline]
    fn second_order(
        &self,
        one: &Moments,
        other: &Moments,
        apart: DVec3,
        interval: &Interval<N>,
        t: f64,
        loose: f64,
    ) -> [f64; N] {
        let size_squared = one.size_squared + other.size_squared;
        let covariance = one.covariance.plus(&other.covariance);
        let across = covariance.trace() * self.per_unit;
        let along = 2.0 * covariance.along(apart) * self.per_unit * self.per_unit;
        std::array::from_fn(|channel| {
            let [value, first, second] = derivatives_at(interval.cubic[channel], t);
            let is_far = size_squared <= loose * interval.reach[channel];
            if is_far { value + first * across + second * along } else { value }
        })
    }

    /// The light of a cluster by a receiver's offset from the group's mean point. `None` if the two are too near.
    pub(super) fn expansion(&self, receivers: &Moments, cluster: &Moments) -> Option<Expansion<N>> {
        let apart = cluster.point - receivers.point;
        let squared = apart.length_squared();
        let (interval, t) = self.find(squared);
        let is_far = |channel: usize| SPREAD * receivers.size_squared + cluster.size_squared <= interval.reach[channel];
        let size_squared = receivers.size_squared + cluster.size_squared;
        let fits = |channel: usize| is_far(channel) || size_squared <= interval.negligible[channel];
        (0..N).all(fits).then(|| {
            let across = cluster.covariance.trace() * self.per_unit;
            let along = 2.0 * cluster.covariance.along(apart) * self.per_unit * self.per_unit;
            let channels = std::array::from_fn(|channel| {
                let [value, first, second] = derivatives_at(interval.cubic[channel], t);
                if !is_far(channel) {
                    return Taylor { value: cluster.area * value, ..Taylor::default() };
                }
                // Derivatives of g(|apart - offset|^2) by the offset: -2 g' apart, and 2 g' 1 + 4 g'' apart apart^T.
                let slope = 2.0 * cluster.area * first * self.per_unit;
                let bend = 4.0 * cluster.area * second * self.per_unit * self.per_unit;
                let mut matrix = Covariance::of([(bend, apart)]);
                matrix.0[..3].iter_mut().for_each(|diagonal| *diagonal += slope);
                let value = cluster.area * (value + first * across + second * along);
                Taylor { value, gradient: -slope * apart, second: matrix }
            });
            Expansion { channels }
        })
    }

    /// The integral of the tabulated R_d over a disc, by its squared radius.
    pub(super) fn disc(&self, squared: f64) -> [f64; N] {
        let (interval, t) = self.find(squared);
        let ring = |channel: usize| PI * self.unit * primitive_at(interval.cubic[channel], t);
        std::array::from_fn(|channel| interval.disc[channel] + ring(channel))
    }

    /// The least depth of a source: the shortest mean free path, in mm.
    pub(super) fn depth(&self) -> f64 {
        self.unit.sqrt()
    }

    /// Number of halvings of two pieces after which their parts are far from each other.
    pub(super) fn halvings(&self, one: &Moments, other: &Moments) -> u32 {
        let balls = [one, other].map(|piece| (BALL * piece.size_squared).sqrt());
        let apart = (one.point.distance(other.point) - balls[0] - balls[1]).max(0.0);
        let reach = self.find(apart * apart).0.reach.into_iter().fold(f64::INFINITY, f64::min);
        let mut count = 0;
        let mut left = one.size_squared + other.size_squared;
        while left > reach && count < u32::BITS {
            left *= 0.25;
            count += 1;
        }
        count
    }
}

/// A cubic polynomial, its derivative and its second derivative at t.
fn derivatives_at([c0, c1, c2, c3]: [f64; 4], t: f64) -> [f64; 3] {
    [c0 + t * (c1 + t * (c2 + t * c3)), c1 + t * (2.0 * c2 + 3.0 * t * c3), 2.0 * c2 + 6.0 * t * c3]
}

/// The integral of a cubic polynomial from 0 to t.
fn primitive_at([c0, c1, c2, c3]: [f64; 4], t: f64) -> f64 {
    t * (c0 + t * (c1 / 2.0 + t * (c2 / 3.0 + t * (c3 / 4.0))))
}

/// Adds terms channel by channel.
pub(super) fn add<const N: usize>(sum: &mut [f64; N], terms: &[f64; N]) {
    sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
}

/// The derivatives of R_d by v = 1 + r^2 / unit.
fn derivatives(dipole: &Dipole, unit: f64, v: f64) -> Derivatives {
    // Lengths are in units of the square root of `unit`.
    let length = unit.sqrt();
    let sigma = dipole.sigma_tr() * length;
    let scale = dipole.alpha_prime() / (4.0 * PI) / unit;
    let mut sum = Derivatives { value: 0.0, first: 0.0, fourth: 0.0 };
    for z in [dipole.z_r(), dipole.z_v()].map(|z| z / length) {
        let squared = (v - 1.0) + z * z;
        let d = squared.sqrt();
        let mut psi = [exp(-sigma * d) / d; 6];
        psi[1] = (sigma * d + 1.0) * psi[0] / squared;
        for n in 1..5 {
            psi[n + 1] = ((2 * n + 1) as f64 * psi[n] + sigma * sigma * psi[n - 1]) / squared;
        }
        sum.value += scale * z * psi[1];
        sum.first -= scale * z * psi[2] / 2.0;
        sum.fourth += scale * z * psi[5] / 16.0;
    }
    sum
}
