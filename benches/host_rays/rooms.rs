//! Test scenes: rooms of the paper's sizes, seen from within.

use crossbar::geom::{Mesh, Ray, Sides};
use crossbar::io::scenes;
use crossbar::scene::Scene;
use crossbar::tracer::HostTracer;

/// Width and height of the image, in pixels.
const SIDE: u32 = 256;
/// Start offset of shadow rays before the primary hit, relative to its t, to avoid self-shadowing.
const BEFORE: f32 = 1e-3;

/// A mesh, and the rays of a picture of it.
pub(crate) struct Room {
    pub(crate) name: &'static str,
    pub(crate) mesh: Mesh,
    /// Rays through every pixel of the scene's first view.
    pub(crate) primary: Vec<Ray>,
    /// Rays from these hits to a light, which is at t = 1.
    pub(crate) shadow: Vec<Ray>,
}

pub(crate) fn all() -> Vec<Room> {
    ["teapot-room", "office"].into_iter().filter_map(|name| Some(room(name, &scenes::named(name)?))).collect()
}

fn room(name: &'static str, scene: &Scene) -> Room {
    let mesh = scene.mesh().clone();
    let primary = scene.views[0].camera(SIDE, SIDE).expect("a view of the scene").rays();
    let light = light(scene);
    let tracer = HostTracer::new(&mesh, Sides::Front);
    let to_the_light = |(ray, hit): (&Ray, Option<crossbar::geom::Hit>)| {
        let t = hit?.t * (1.0 - BEFORE);
        let from = [0, 1, 2].map(|k| ray.origin()[k] + t * ray.direction()[k]);
        Ray::new(from, [0, 1, 2].map(|k| light[k] - from[k])).ok()
    };
    let shadow = primary.iter().zip(tracer.nearest_all(&primary).0).filter_map(to_the_light).collect();
    Room { name, mesh, primary, shadow }
}

/// The first point light, otherwise a corner of the first emitting triangle.
fn light(scene: &Scene) -> [f32; 3] {
    let shining = || scene.mesh().corners(scene.emitters()[0]).expect("a triangle of the scene")[0];
    scene.point_lights.first().map_or_else(shining, |light| light.position)
}
