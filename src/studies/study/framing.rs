//! Framing: the view from an eye position in which a model fills the picture.

use glam::{DVec2, DVec3};

use crate::geom::vector::unit;
use crate::scene::View;

/// Size of the picture relative to the model in it.
const MARGIN: f64 = 1.06;
/// Number of steps of the iteration that centers the view on the model.
const STEPS: usize = 4;

/// View from an eye in which points just fill a picture of `aspect`, width over height, with a margin of 3 % at each
/// edge. Up is +z. Points behind the eye are ignored.
pub fn framed(eye: DVec3, points: &[DVec3], aspect: f64) -> View {
    let (low, high) =
        points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &at| (low.min(at), high.max(at)));
    let mut target = 0.5 * (low + high);
    for _ in 0..STEPS {
        let axes = axes(target - eye);
        let [low, high] = extent(eye, axes, points);
        let middle = 0.5 * (low + high);
        target = eye + (target - eye).length() * (axes[2] + middle.x * axes[0] + middle.y * axes[1]);
    }
    let [low, high] = extent(eye, axes(target - eye), points);
    let half = low.abs().max(high.abs());
    View {
        name: "framed".to_owned(),
        eye: eye.as_vec3().to_array(),
        target: target.as_vec3().to_array(),
        up: [0.0, 0.0, 1.0],
        tan_half_height: (MARGIN * half.y.max(half.x / aspect)) as f32,
    }
}

/// Unit vectors to the right, up and along the view.
fn axes(toward: DVec3) -> [DVec3; 3] {
    let forward = unit(toward).unwrap_or(DVec3::Y);
    let right = unit(forward.cross(DVec3::Z)).unwrap_or(DVec3::X);
    [right, right.cross(forward), forward]
}

/// Lowest and highest position of the points in the plane at distance 1 from the eye.
fn extent(eye: DVec3, [right, up, forward]: [DVec3; 3], points: &[DVec3]) -> [DVec2; 2] {
    let in_plane = |&at: &DVec3| {
        let from = at - eye;
        let depth = from.dot(forward);
        (depth > 0.0).then(|| DVec2::new(from.dot(right), from.dot(up)) / depth)
    };
    let widen = |[low, high]: [DVec2; 2], at: DVec2| [low.min(at), high.max(at)];
    points.iter().filter_map(in_plane).fold([DVec2::INFINITY, DVec2::NEG_INFINITY], widen)
}
