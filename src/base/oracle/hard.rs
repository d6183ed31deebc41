//! Generation of hard rays, on which intersectors tend to disagree.

use std::fmt;

use glam::DVec3;

use crate::geom::aimed::{Aimed, aimed_at_edges, aimed_at_vertices};
use crate::geom::random::CounterRng;
use crate::geom::vector::{narrow, wide};
use crate::geom::{Mesh, Ray};

/// Aim of a hard ray.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Aim {
    /// From outside at a point of a shared edge.
    Edge,
    /// From outside at a vertex.
    Vertex,
    /// Along an axis through a vertex or the middle of a triangle; the other two components are +0 or -0.
    Axis,
    /// In the plane of a triangle, up to the rounding of f32: it misses that triangle and hits the others.
    Plane,
    /// From a point of a surface (a vertex, or a point inside a triangle up to rounding), in any direction.
    Surface,
    /// From far away (a thousand to a million times the mesh's size), at a point of an edge.
    Far,
}

impl Aim {
    /// All aims.
    pub const ALL: [Self; 6] = [Self::Edge, Self::Vertex, Self::Axis, Self::Plane, Self::Surface, Self::Far];

    /// Name: `edge`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Edge => "edge",
            Self::Vertex => "vertex",
            Self::Axis => "axis",
            Self::Plane => "plane",
            Self::Surface => "surface",
            Self::Far => "far",
        }
    }

    /// Phrase for reports: `aimed at a vertex`.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Edge => "aimed at an edge",
            Self::Vertex => "aimed at a vertex",
            Self::Axis => "along an axis",
            Self::Plane => "in the plane of a triangle",
            Self::Surface => "from a surface",
            Self::Far => "from far away at an edge",
        }
    }
}

impl fmt::Display for Aim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Hard ray with its aim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HardRay {
    /// The ray.
    pub ray: Ray,
    /// Aim of the ray.
    pub aim: Aim,
}

impl AsRef<Ray> for HardRay {
    fn as_ref(&self) -> &Ray {
        &self.ray
    }
}

/// Ray that an oracle can judge: a [`Ray`], a [`HardRay`], or a type of your own with an aim.
pub trait JudgedRay: AsRef<Ray> {
    /// The aim, if known.
    fn aim(&self) -> Option<Aim> {
        None
    }
}

impl JudgedRay for Ray {}

impl JudgedRay for HardRay {
    fn aim(&self) -> Option<Aim> {
        Some(self.aim)
    }
}

impl<R: JudgedRay> JudgedRay for &R {
    fn aim(&self) -> Option<Aim> {
        (*self).aim()
    }
}

/// Generates at most `each` rays of each of the six [`Aim`]s for a mesh of any size, spread over it: at most 6 times
/// `each` in all, fewer if the mesh has too few edges, vertices or triangles to aim at. The same seed gives the same
/// rays; an empty mesh gives none. A thousand rays of each aim at 1,000 triangles take 0.13 s in a debug build.
pub fn hard_rays(mesh: &Mesh, each: usize, seed: u64) -> Vec<HardRay> {
    let Some(place) = MeshExtent::of(mesh) else { return Vec::new() };
    let rng = CounterRng::new(seed);
    let mut rays = Vec::new();
    for (key, aim) in (0..).zip(Aim::ALL) {
        let found: Vec<Ray> = match aim {
            Aim::Edge => spread(each, |eye, n| some(aimed_at_edges(mesh, place.eye(rng, eye, 2.0), 1, seed ^ eye), n)),
            Aim::Vertex => spread(each, |eye, n| some(aimed_at_vertices(mesh, place.eye(rng, eye, 2.0)), n)),
            Aim::Far => {
                let far = |eye: u64| [1e3, 1e4, 1e5, 1e6][eye as usize % 4];
                spread(each, |eye, n| some(aimed_at_edges(mesh, place.eye(rng, eye, far(eye)), 1, seed ^ eye), n))
            }
            Aim::Axis | Aim::Plane | Aim::Surface => {
                let one = |i: u64| {
                    let at = AimedTriangle::choose(mesh, rng, key, i)?;
                    match aim {
                        Aim::Axis => at.axis_ray(&place, i),
                        Aim::Plane => at.plane_ray(rng, i),
                        _ => at.surface_ray(rng, i),
                    }
                };
                (0..each as u64).filter_map(one).collect()
            }
        };
        rays.extend(found.into_iter().map(|ray| HardRay { ray, aim }));
    }
    rays
}

/// Number of eyes over which the rays of an aim are distributed.
const EYES: usize = 8;

/// Distributes at most `each` rays over several eyes, as evenly as possible.
fn spread(each: usize, rays: impl Fn(u64, usize) -> Vec<Ray>) -> Vec<Ray> {
    (0..EYES).flat_map(|eye| rays(eye as u64, (each + eye) / EYES)).collect()
}

fn some(aimed: Vec<Aimed>, most: usize) -> Vec<Ray> {
    let step = aimed.len().div_ceil(most.max(1)).max(1);
    aimed.into_iter().step_by(step).take(most).map(|aimed| aimed.ray).collect()
}

struct MeshExtent {
    middle: DVec3,
    size: f64,
}

impl MeshExtent {
    fn of(mesh: &Mesh) -> Option<Self> {
        let [low, high] = mesh.bounds()?.map(wide);
        let size = (high - low).max_element();
        Some(Self { middle: (low + high) / 2.0, size: if size > 0.0 { size } else { 1.0 } })
    }

    /// Point at about `sizes` times the mesh's size from its center, kept within the range of f32.
    fn eye(&self, rng: CounterRng, index: u64, sizes: f64) -> [f32; 3] {
        let side = |axis: usize| {
            let step = 2.0 * rng.unit(index, 0, axis as u64) - 1.0;
            // Away from the center along the axis chosen by the eye's index.
            if axis == index as usize % 3 { 1.0f64.copysign(step) } else { step }
        };
        in_f32(self.middle + sizes * self.size * DVec3::from([0, 1, 2].map(side)))
    }
}

fn in_f32(point: DVec3) -> [f32; 3] {
    narrow(point.clamp(DVec3::splat(f32::MIN.into()), DVec3::splat(f32::MAX.into())))
}

struct AimedTriangle {
    corners: [DVec3; 3],
    point: [f32; 3],
}

impl AimedTriangle {
    /// Chooses a random triangle, with one of its corners, or a point inside it.
    fn choose(mesh: &Mesh, rng: CounterRng, key: u64, index: u64) -> Option<Self> {
        let id = rng.bits(index, key, 100) % mesh.len().max(1) as u64;
        let exact = mesh.corners(id as u32)?;
        let corners = exact.map(wide);
        let kind = rng.bits(index, key, 101) % 4;
        if let Some(&point) = exact.get(kind as usize) {
            return Some(Self { corners, point });
        }
        let [mut u, mut v] = [102, 103].map(|dimension| rng.unit(index, key, dimension));
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        let [a, b, c] = corners;
        let point = in_f32(a + u * (b - a) + v * (c - a));
        Some(Self { corners, point })
    }

    /// Ray along an axis: cycles through all six directions and all four pairs of signs of the zeros.
    fn axis_ray(&self, place: &MeshExtent, index: u64) -> Option<Ray> {
        let axis = (index % 3) as usize;
        let sign = |bit: u64| if (index / 3) >> bit & 1 == 1 { -1.0f32 } else { 1.0 };
        let (way, mut direction) = (sign(0), [0.0, sign(1) * 0.0, sign(2) * 0.0]);
        direction[0] = way;
        direction.rotate_right(axis);
        let mut origin = wide(self.point);
        origin[axis] -= 2.0 * place.size * f64::from(way);
        Ray::new(in_f32(origin), direction).ok()
    }

    /// Ray in the plane of the triangle, from outside, beyond the corner a, towards the side bc.
    fn plane_ray(&self, rng: CounterRng, index: u64) -> Option<Ray> {
        let [a, b, c] = self.corners;
        // Every other ray runs along an edge.
        let share = if index.is_multiple_of(2) { 0.0 } else { rng.unit(index, 0, 104) };
        let along = b + share * (c - b) - a;
        Ray::new(in_f32(a - along), in_f32(along)).ok()
    }

    fn surface_ray(&self, rng: CounterRng, index: u64) -> Option<Ray> {
        let direction = [0, 1, 2].map(|axis| (2.0 * rng.unit(index, 1, axis) - 1.0) as f32);
        Ray::new(self.point, direction).ok()
    }
}
