//! False-color pictures of the atlas and of the mesh.

use glam::DVec3;

use crate::atlas::Atlas;
use crate::geom::random::CounterRng;
use crate::geom::vector::{unit, wide};
use crate::geom::{Mesh, Ray, Sides};
use crate::picture::{RgbImage, rgb8};
use crate::scene::Camera;
use crate::tracer::HostTracer;

/// Maximum side of a picture of the atlas, in pixels. A picture of a larger atlas shows every second or fourth texel.
const MAX_PICTURE: u32 = 2048;

/// Criterion of coloring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coloring {
    /// Color per face.
    Face,
    /// Color per cluster of a level.
    Level(u32),
}

impl Coloring {
    /// Color of a texel.
    fn color(self, atlas: &Atlas, x: u32, y: u32) -> [u8; 3] {
        let side = atlas.side();
        match self {
            Self::Face => color_of(atlas.texels()[y as usize * side as usize + x as usize].face.into()),
            Self::Level(level) => color_of(u64::from(y >> level) * u64::from(side >> level) + u64::from(x >> level)),
        }
    }
}

/// Color for a number: bright, never grey, and dissimilar for consecutive numbers.
fn color_of(number: u64) -> [u8; 3] {
    let random = CounterRng::new(1);
    let hue = 6.0 * random.unit(number, 0, 0);
    let low = 0.15 + 0.4 * random.unit(number, 0, 1);
    let rise = |shift: f64| {
        let at = (hue + shift).rem_euclid(6.0);
        (2.0 - (at - 3.0).abs()).clamp(0.0, 1.0)
    };
    [0.0, 2.0, 4.0].map(|shift| (255.0 * (low + (0.95 - low) * rise(shift))) as u8)
}

/// Picture of the atlas, rows from the top.
pub(super) fn atlas(atlas: &Atlas, coloring: Coloring) -> RgbImage {
    let step = atlas.side().div_ceil(MAX_PICTURE);
    let side = atlas.side() / step;
    let texels = (0..side).flat_map(|y| (0..side).map(move |x| [x * step, y * step]));
    rgb8(side, side, texels.map(|[x, y]| coloring.color(atlas, x, y)))
}

/// Pictures of the mesh, colored by the texel under each hit.
pub(super) struct ModelPictures<'a> {
    atlas: &'a Atlas,
    camera: &'a Camera,
    /// Texel of each pixel, and the cosine between normal and view.
    seen: Vec<Option<([u32; 2], f64)>>,
}

impl<'a> ModelPictures<'a> {
    pub(super) fn new(mesh: &Mesh, atlas: &'a Atlas, camera: &'a Camera) -> Self {
        let rays = camera.rays();
        let (hits, _) = HostTracer::new(mesh, Sides::Both).nearest_all(&rays);
        let seen = |(ray, hit): (&Ray, Option<crate::geom::Hit>)| {
            let hit = hit?;
            let direction = wide(ray.direction());
            let at = wide(ray.origin()) + direction * f64::from(hit.t);
            let [x, y] = atlas.coordinates(hit.triangle, weights(atlas.corners(hit.triangle), at));
            let [left, top, right, bottom] = atlas.places()[hit.triangle as usize].bounds();
            let [a, b, c] = atlas.corners(hit.triangle);
            let facing = unit((b - a).cross(c - a)).unwrap_or(DVec3::Z).dot(unit(direction).unwrap_or(DVec3::Z)).abs();
            Some(([x.clamp(left, right) as u32, y.clamp(top, bottom) as u32], facing))
        };
        let seen = rays.iter().zip(hits).map(seen).collect();
        Self { atlas, camera, seen }
    }

    pub(super) fn picture(&self, coloring: Coloring) -> RgbImage {
        let pixel = |seen: &Option<([u32; 2], f64)>| match seen {
            None => [255; 3],
            Some(([x, y], facing)) => {
                coloring.color(self.atlas, *x, *y).map(|channel| (f64::from(channel) * (0.35 + 0.65 * facing)) as u8)
            }
        };
        rgb8(self.camera.width(), self.camera.height(), self.seen.iter().map(pixel))
    }
}

/// Barycentric weights of a point in a triangle's plane.
fn weights([a, b, c]: [DVec3; 3], at: DVec3) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let whole = normal.length_squared();
    let share = |p: DVec3, q: DVec3| if whole > 0.0 { (p - at).cross(q - at).dot(normal) / whole } else { 1.0 / 3.0 };
    [share(b, c), share(c, a), share(a, b)]
}
