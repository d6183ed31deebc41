//! Ray origins of vertices, offset from all triangles on which a vertex lies (as a corner or inside); the rays and
//! their hits.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::skyline::{Occluders, SkyPart};
use super::vertices::Vertices;
use crate::geom::vector::{narrow, unit, wide};
use crate::geom::{Hit, Ray};
use crate::sphere::DirectionRule;
use crate::tracer::offset::{SINGLE, SurfacePoint};

/// Maximum number of rounds in which an origin is moved; after that it may not be clear of all triangles.
const MAX_ROUNDS: usize = 16;
/// Largest distance at which a vertex counts as lying on a triangle, relative to the triangle's size or the vertex's
/// coordinates: several rounding errors.
const SHARE: f64 = 1e-5;

/// The origin of a vertex's rays, and the triangles on which the vertex lies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RayOrigin {
    /// The origin, in single precision like rays.
    pub(crate) at: [f32; 3],
    /// Unit normals of the triangles.
    pub(crate) planes: Vec<DVec3>,
    /// True if the origin is in front of all triangles, at the required distance.
    pub(crate) is_clear: bool,
}

impl RayOrigin {
    /// True if a direction lies below the geometric horizon: behind every triangle on which the vertex lies.
    pub(crate) fn is_below_horizon(&self, direction: DVec3) -> bool {
        self.planes.iter().all(|plane| plane.dot(direction) < 0.0)
    }
}

pub(crate) fn origins(vertices: &Vertices, occluders: &Occluders) -> Vec<RayOrigin> {
    vertices.positions().par_iter().map(|&at| origin(wide(at), occluders)).collect()
}

/// Moves the origin repeatedly along the normal of each triangle from which it is not yet clear.
fn origin(place: DVec3, occluders: &Occluders) -> RayOrigin {
    let mut planes: Vec<(DVec3, f64)> = Vec::new();
    occluders.around(place, SHARE, |corners| planes.extend(plane(corners, place)));
    // Planes are sorted, so that the result does not depend on the order of the triangles.
    planes.sort_by(|(one, _), (other, _)| {
        let keys = one.to_array().into_iter().zip(other.to_array());
        keys.fold(std::cmp::Ordering::Equal, |order, (one, other)| order.then(one.total_cmp(&other)))
    });
    let mut at = place;
    let clear = |at: DVec3| planes.iter().all(|&(normal, clearance)| normal.dot(wide(narrow(at)) - place) >= clearance);
    for _ in 0..MAX_ROUNDS {
        if clear(at) {
            break;
        }
        for &(normal, clearance) in &planes {
            // Twice the clearance, which leaves room for rounding to single precision.
            let missing = 2.0 * clearance - normal.dot(at - place);
            if missing > 0.0 {
                at += missing * normal;
            }
        }
    }
    let is_clear = clear(at);
    RayOrigin { at: narrow(at), planes: planes.into_iter().map(|(normal, _)| normal).collect(), is_clear }
}

/// The normal of a triangle on which `place` lies, and the distance from the triangle at which rays must start; `None`
/// if `place` is not on the triangle.
fn plane(corners: [DVec3; 3], place: DVec3) -> Option<(DVec3, f64)> {
    let [a, b, c] = corners;
    let weights = DVec3::from([a, b, c].map(|corner| f64::from(u8::from(corner == place))));
    let point = SurfacePoint::of(corners, weights, SINGLE)?;
    let (normal, clearance) = (point.normal, point.clearance(place.distance(a)));
    // The tolerance covers a few rounding errors of the coordinates.
    let largest = corners.iter().fold(place.abs().max_element(), |most, corner| most.max(corner.abs().max_element()));
    let reach = 8.0 * SINGLE * largest;
    let inside = |from: DVec3, to: DVec3| (to - from).cross(place - from).dot(normal) >= -reach * from.distance(to);
    let on = normal.dot(place - a).abs() <= reach && inside(a, b) && inside(b, c) && inside(c, a);
    on.then_some((normal, clearance))
}

/// The largest length of a ray, 2^126; the range of single precision ends at 2^128.
const MAX_REACH: f64 = (1_u128 << 126) as f64;

/// The end of a blocked ray on the front of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct FrontHit {
    /// The ray's direction, by its index in the rule.
    pub(crate) direction: u32,
    pub(crate) triangle: u32,
    /// Barycentric weights of the second and third corner.
    weights: [f32; 2],
}

impl FrontHit {
    /// Barycentric weights of the corners; they sum to 1.
    pub(crate) fn weights(&self) -> [f64; 3] {
        let [b, c] = self.weights.map(f64::from);
        [1.0 - b - c, b, c]
    }
}

/// The rays of a vertex that the caster must trace.
pub(crate) struct VertexRays {
    pub(crate) directions: Vec<u32>,
    pub(crate) rays: Vec<Ray>,
    pub(crate) below_horizon: u64,
}

/// Generator of the rays.
pub(crate) struct Shooter<'a> {
    pub(crate) vertices: &'a Vertices,
    rule: DirectionRule,
    origins: &'a [RayOrigin],
    occluders: &'a Occluders,
    /// The part of the sky that contains each direction of the rule.
    parts: Vec<SkyPart>,
    /// Length of rays.
    reach: f64,
}

impl<'a> Shooter<'a> {
    pub(crate) fn new(
        vertices: &'a Vertices,
        rule: &DirectionRule,
        origins: &'a [RayOrigin],
        occluders: &'a Occluders,
    ) -> Self {
        let parts = rule.directions().iter().map(|&direction| SkyPart::of(direction)).collect();
        Self { vertices, rule: rule.clone(), origins, occluders, parts, reach: ray_length(vertices) }
    }

    fn ray(&self, vertex: usize, direction: DVec3) -> Option<Ray> {
        Ray::new(self.origins[vertex].at, narrow(self.reach * direction)).ok()
    }

    /// Returns the rays that the skyline does not exclude, which the caster must trace. Sets the `bits` of directions
    /// below the geometric horizon, which are certainly blocked.
    pub(crate) fn shadow_rays(&self, vertex: usize, waiting: &mut Vec<u32>, bits: &mut [u64]) -> VertexRays {
        let (frame, origin) = (&self.vertices.frames()[vertex], &self.origins[vertex]);
        let skyline = self.occluders.skyline(wide(origin.at), frame, waiting);
        let mut asked = VertexRays { directions: Vec::new(), rays: Vec::new(), below_horizon: 0 };
        for (at, (&local, &part)) in self.rule.directions().iter().zip(&self.parts).enumerate() {
            let direction = frame.to_global(local);
            if origin.is_below_horizon(direction) {
                asked.below_horizon += 1;
                bits[at / 64] |= 1 << (at % 64);
            } else if skyline.is_marked(part)
                && let Some(ray) = self.ray(vertex, direction)
            {
                asked.directions.push(at as u32);
                asked.rays.push(ray);
            }
        }
        asked
    }

    /// The rays of a vertex in some directions, except directions below the geometric horizon.
    pub(crate) fn rays(&self, vertex: usize, directions: impl Iterator<Item = usize>) -> (Vec<u32>, Vec<Ray>) {
        let (frame, origin) = (&self.vertices.frames()[vertex], &self.origins[vertex]);
        let ray = |at: usize| {
            let direction = frame.to_global(self.rule.directions()[at]);
            let ray = self.ray(vertex, direction).filter(|_| !origin.is_below_horizon(direction))?;
            Some((at as u32, ray))
        };
        directions.filter_map(ray).unzip()
    }

    /// The hits on front faces, and the number of hits on back faces.
    pub(crate) fn front_hits(&self, directions: &[u32], rays: &[Ray], hits: &[Option<Hit>]) -> (Vec<FrontHit>, u64) {
        let (mut front, mut behind) = (Vec::new(), 0);
        for ((&direction, ray), hit) in directions.iter().zip(rays).zip(hits) {
            let Some(hit) = hit else { continue };
            let [a, b, c] = self.vertices.corners(hit.triangle);
            let Some(normal) = unit((b - a).cross(c - a)) else { continue };
            if normal.dot(wide(ray.direction())) >= 0.0 {
                behind += 1;
                continue;
            }
            let at = wide(ray.origin()) + f64::from(hit.t) * wide(ray.direction());
            front.push(FrontHit { direction, triangle: hit.triangle, weights: barycentric([a, b, c], normal, at) });
        }
        (front, behind)
    }
}

/// A length of rays that reaches from every vertex beyond the mesh: a power of two, so that scaling does not round
/// directions.
pub fn ray_length(vertices: &Vertices) -> f64 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &position in vertices.positions() {
        (low, high) = (low.min(wide(position)), high.max(wide(position)));
    }
    let diagonal = (high - low).length();
    let mut reach = 1.0;
    while reach < 2.0 * diagonal && reach < MAX_REACH {
        reach *= 2.0;
    }
    reach
}

/// The weights of the second and third corner at a point on or near a triangle, clamped to the triangle.
fn barycentric([a, b, c]: [DVec3; 3], normal: DVec3, at: DVec3) -> [f32; 2] {
    let part = |from: DVec3, to: DVec3| (from - at).cross(to - at).dot(normal).max(0.0);
    let parts = [part(b, c), part(c, a), part(a, b)];
    let sum: f64 = parts.iter().sum();
    if sum > 0.0 { [(parts[1] / sum) as f32, (parts[2] / sum) as f32] } else { [0.0; 2] }
}
