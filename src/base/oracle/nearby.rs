//! Rays within a few ULPs of a given one, and the vertices and edges that such rays pass.
//!
//! Intersectors round. The test of Woop, Benthin and Wald, for example, is exact for a scene whose vertices, relative
//! to the ray's origin, are each displaced by at most five roundings of f32. So its result near a silhouette is correct
//! for a ray close to the given one, and not an error. A **nearby** ray has the same origin, and the two smaller
//! components of its direction differ by some ULPs of the largest component. For a hit near the ray's start, a nearby
//! ray has the same direction, and its origin is moved along it by some ULPs of the largest coordinate. Nearby rays are
//! tested one by one in exact arithmetic, so the ray that is found proves the verdict.

use glam::{DVec2, DVec3};

use crate::geom::vector::{narrow, wide};
use crate::geom::{Contact, Mesh, Ray};

/// Step from the f32 of this magnitude to the next smaller or larger one, whichever is longer.
fn ulp(magnitude: f32) -> f64 {
    let up = magnitude.next_up();
    let (low, high) = if up.is_finite() { (magnitude, up) } else { (magnitude.next_down(), magnitude) };
    f64::from(high) - f64::from(low)
}

/// Half sides of the squares that nearby rays lie on: 1, 2, 4 and so on, and `ulps` itself.
fn rings(ulps: u32) -> impl Iterator<Item = u32> {
    let powers = std::iter::successors(Some(1_u32), |ring| ring.checked_mul(2));
    powers.take_while(move |&ring| ring < ulps).chain((ulps > 0).then_some(ulps))
}

/// Image plane of a ray, perpendicular to the axis of its largest direction component.
struct ImagePlane {
    origin: DVec3,
    direction: DVec3,
    /// Axis of the largest component.
    depth: usize,
    /// The other two axes.
    across: [usize; 2],
    /// One ULP of the largest component.
    unit: f64,
}

impl ImagePlane {
    fn of(ray: &Ray) -> Self {
        let (origin, direction) = (wide(ray.origin()), wide(ray.direction()));
        let depth = direction.abs().max_position();
        let across = [(depth + 1) % 3, (depth + 2) % 3];
        let unit = ulp(ray.direction()[depth].abs());
        Self { origin, direction, depth, across, unit }
    }

    /// Difference between the ray's direction and the direction to a point, in `unit`s; `None` for a point that is not
    /// in front.
    fn offset(&self, point: [f32; 3]) -> Option<DVec2> {
        let to = wide(point) - self.origin;
        let scale = self.direction[self.depth] / to[self.depth];
        let off = |axis: usize| (to[axis] * scale - self.direction[axis]) / self.unit;
        (scale > 0.0 && scale.is_finite()).then(|| DVec2::from(self.across.map(off)))
    }
}

/// Iterates over nearby rays from the same origin, nearest first: on each ring the corners, the midpoints of the sides,
/// then the other points.
pub(super) fn turned(ray: &Ray, ulps: u32) -> impl Iterator<Item = Ray> {
    let (plane, origin) = (ImagePlane::of(ray), ray.origin());
    rings(ulps)
        .flat_map(move |ring| {
            let half = if ring == 1 { 1.0 } else { f64::from(ring.div_ceil(2)) };
            let whole = f64::from(ring);
            let steps = if ring == 1 { vec![-1.0, 0.0, 1.0] } else { vec![-whole, -half, 0.0, half, whole] };
            let pairs = steps.iter().flat_map(|&x| steps.iter().map(move |&y| [x, y])).collect::<Vec<_>>();
            let outer = pairs.into_iter().filter(move |pair| pair.iter().any(|step| step.abs() == whole));
            outer.collect::<Vec<_>>()
        })
        .filter_map(move |offsets| {
            let mut direction = plane.direction;
            for (axis, steps) in plane.across.into_iter().zip(offsets) {
                direction[axis] += steps * plane.unit;
            }
            Ray::new(origin, narrow(direction)).ok()
        })
}

/// Iterates over nearby rays with the same direction, nearest origin first; empty if they cannot reach a hit at `t`.
/// The step between origins is one ULP of the largest coordinate of the ray's origin and `points`.
pub(super) fn moved(
    ray: &Ray,
    points: impl IntoIterator<Item = [f32; 3]>,
    t: f64,
    ulps: u32,
) -> impl Iterator<Item = Ray> {
    let largest = points.into_iter().flatten().chain(ray.origin()).fold(0.0_f32, |most, x| most.max(x.abs()));
    let (origin, direction) = (wide(ray.origin()), ray.direction());
    let length = wide(direction).abs().max_element();
    let unit = ulp(largest);
    let in_reach = t.abs() * length <= f64::from(ulps) * unit;
    let steps = rings(ulps).filter(move |_| in_reach).flat_map(|ring| [f64::from(ring), -f64::from(ring)]);
    let along = wide(direction) / length * unit;
    steps.filter_map(move |step| Ray::new(narrow(origin + step * along), direction).ok())
}

/// Returns `true` if a ray passes within `ulps` ULPs of the common corner or edge of two triangles.
pub(super) fn passes_contact(mesh: &Mesh, ray: &Ray, [a, b]: [u32; 2], ulps: u32) -> bool {
    let (Some(of_a), Some(of_b)) = (mesh.corners(a), mesh.corners(b)) else { return false };
    let shared: Vec<_> = of_a.into_iter().filter(|corner| of_b.contains(corner)).collect();
    let plane = ImagePlane::of(ray);
    let reach = f64::from(ulps) * std::f64::consts::SQRT_2;
    let near = |from: [f32; 3], to: [f32; 3]| match (plane.offset(from), plane.offset(to)) {
        (Some(from), Some(to)) => distance_to_segment(from, to) <= reach,
        // The edge reaches behind the ray's origin.
        (Some(_), None) | (None, Some(_)) => true,
        (None, None) => false,
    };
    mesh.contact(a, b) != Contact::None && shared.iter().any(|&from| shared.iter().any(|&to| near(from, to)))
}

/// Returns `true` if a ray passes within `ulps` ULPs of a triangle's corner whose t is within `ulps` ULPs of `t`.
pub(super) fn passes_corner_at(mesh: &Mesh, ray: &Ray, triangle: u32, t: f64, ulps: u32) -> bool {
    let plane = ImagePlane::of(ray);
    let (reach, step) = (f64::from(ulps) * std::f64::consts::SQRT_2, f64::from(ulps) * ulp(t.abs() as f32));
    let distance =
        |corner: [f32; 3]| (wide(corner)[plane.depth] - plane.origin[plane.depth]) / plane.direction[plane.depth];
    let near = |corner: [f32; 3]| plane.offset(corner).is_some_and(|off| off.length() <= reach);
    mesh.corners(triangle).into_iter().flatten().any(|corner| near(corner) && (distance(corner) - t).abs() <= step)
}

fn distance_to_segment(from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let length = along.length_squared();
    let share = if length > 0.0 { (-from.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (from + share * along).length()
}
