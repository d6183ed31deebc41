//! Framing: the view from an eye that a model fills.

use glam::{DVec2, DVec3};

use crate::geom::vector::unit;
use crate::scene::View;

/// Size of the picture relative to that of the model in it.
const MARGIN: f64 = 1.06;
/// Steps by which the middle of the view moves to the middle of the model as seen from the eye.
const STEPS: usize = 4;

/// View from an eye in which points just fill a picture of `aspect`, width over height, but for a margin of 3 % at each
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::exact::Sides;
    use crate::geom::teapot::teapot;
    use crate::geom::vector::wide;
    use crate::tracer::HostTracer;

    /// The teapot touches the margin on two opposite sides, from any eye, and lies within the picture.
    #[test]
    fn a_model_fills_its_picture_from_any_eye() {
        let mesh = teapot(4).expect("a teapot");
        let points: Vec<DVec3> = mesh.positions().iter().map(|&at| wide(at)).collect();
        for (eye, [width, height]) in
            [([4.0, -9.0, 3.0], [64, 48]), ([-3.0, 7.0, 8.0], [64, 64]), ([9.0, 0.5, 0.2], [40, 80])]
        {
            let view = framed(DVec3::from(eye), &points, f64::from(width) / f64::from(height));
            let camera = view.camera(width, height).expect("a camera");
            let (hits, _) = HostTracer::new(&mesh, Sides::Both).nearest_all(&camera.rays());
            let seen: Vec<[u32; 2]> = (0..width * height)
                .filter(|at| hits[*at as usize].is_some())
                .map(|at| [at % width, at / width])
                .collect();
            let range = |axis: usize| {
                let of = || seen.iter().map(|at| at[axis]);
                [of().min().expect("pixels"), of().max().expect("pixels")]
            };
            let gaps = [(0, width), (1, height)].map(|(axis, side)| {
                let [low, high] = range(axis);
                [low, side - 1 - high]
            });
            let tight = |[low, high]: [u32; 2]| (1..=4).contains(&low) && (1..=4).contains(&high);
            assert!(gaps.into_iter().any(tight) && gaps.iter().flatten().all(|gap| *gap > 0), "{eye:?}: {gaps:?}");
        }
    }
}
