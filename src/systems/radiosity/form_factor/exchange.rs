//! The exchange of two patches: area times form factor, which is symmetric.

use std::f64::consts::PI;

use super::{contour, polygon};
use crate::quadrature::{FIVE, GaussPoint, THREE};
use crate::radiosity::Patch;
use glam::DVec3;

/// Ratio of the distance between centres to the sum of radii above which three Gauss points per direction suffice.
const FAR: f64 = 8.0;
/// Ratio above which five Gauss points suffice; below it, the contour integral is used.
const NEAR: f64 = 3.0;
/// Distance behind a plane, relative to the patch's radius, up to which corners count as on the plane.
const ON_PLANE: f64 = 1e-9;

/// Patch with its far-field quadrature points.
#[derive(Clone, Debug)]
pub(super) struct QuadraturePatch<'a> {
    pub(super) patch: &'a Patch,
    three: Vec<WeightedPoint>,
    five: Vec<WeightedPoint>,
}

/// A quadrature point and its weight, an area.
type WeightedPoint = (DVec3, f64);

impl<'a> QuadraturePatch<'a> {
    pub(super) fn new(patch: &'a Patch) -> Self {
        Self { patch, three: points(patch, &THREE), five: points(patch, &FIVE) }
    }
}

fn points(patch: &Patch, rule: &[GaussPoint]) -> Vec<WeightedPoint> {
    let mut points = Vec::with_capacity(rule.len() * rule.len());
    for &(v, across) in rule {
        for &(u, along) in rule {
            let point = patch.at(u, v);
            points.push((point.at, point.density * across * along));
        }
    }
    points
}

/// Relative position of two patches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Facing {
    /// Each patch lies wholly in front of the other.
    Wholly,
    /// The plane of one patch cuts the other.
    Partly,
    /// One patch lies behind the other.
    Not,
}

fn facing(one: &Patch, other: &Patch) -> Facing {
    if one.face == other.face {
        return Facing::Not;
    }
    let mut found = Facing::Wholly;
    for (from, to) in [(one, other), (other, one)] {
        let tolerance = ON_PLANE * to.radius();
        let heights = to.corners().iter().map(|&corner| from.height(corner));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        if high <= tolerance {
            return Facing::Not;
        }
        if low < -tolerance {
            found = Facing::Partly;
        }
    }
    found
}

/// Area of one patch times its form factor to the other, without occluders.
pub(super) fn unoccluded(one: &QuadraturePatch<'_>, other: &QuadraturePatch<'_>) -> f64 {
    let (p, q) = (one.patch, other.patch);
    let facing = facing(p, q);
    if facing == Facing::Not {
        return 0.0;
    }
    if facing == Facing::Partly {
        let (p_part, q_part) = (polygon::in_front_of(p.corners(), q), polygon::in_front_of(q.corners(), p));
        return if p_part.len() < 3 || q_part.len() < 3 { 0.0 } else { contour::exchange(&p_part, &q_part).max(0.0) };
    }
    let apart = q.center() - p.center();
    let (square, radii) = (apart.dot(apart), p.radius() + q.radius());
    if square >= FAR * FAR * radii * radii {
        kernel_sum([p, q], &one.three, &other.three)
    } else if square >= NEAR * NEAR * radii * radii {
        kernel_sum([p, q], &one.five, &other.five)
    } else {
        contour::exchange(p.corners(), q.corners()).max(0.0)
    }
}

fn kernel_sum([p, q]: [&Patch; 2], from: &[WeightedPoint], to: &[WeightedPoint]) -> f64 {
    let mut sum = 0.0;
    for &(x, weight) in from {
        sum += weight * to.iter().map(|&(y, area)| area * kernel([p, q], x, y)).sum::<f64>();
    }
    sum
}

/// The exchange density of two points, per area squared; 0 if one point is behind the other's plane.
pub(super) fn kernel([p, q]: [&Patch; 2], x: DVec3, y: DVec3) -> f64 {
    let to = y - x;
    let (cosines, square) = (p.normal().dot(to).max(0.0) * (-q.normal().dot(to)).max(0.0), to.dot(to));
    if square > 0.0 { cosines / (PI * square * square) } else { 0.0 }
}
