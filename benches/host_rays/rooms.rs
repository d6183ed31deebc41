//! What is traced: rooms of the paper's sizes, from within.

use crossbar::geom::{Mesh, Ray, Sides};
use crossbar::scene::{Scene, built};
use crossbar::tracer::HostTracer;

/// Pixels along a side of the picture.
const SIDE: u32 = 256;
/// Shadow rays start so far before what a primary ray hit, in shares of its t, that the surface does not shade itself.
const BEFORE: f32 = 1e-3;

/// A mesh and the rays of a picture of it.
pub(crate) struct Room {
    pub(crate) name: &'static str,
    pub(crate) mesh: Mesh,
    /// Through every pixel of the scene's first view.
    pub(crate) primary: Vec<Ray>,
    /// From what they hit to a light, which is at t = 1.
    pub(crate) shadow: Vec<Ray>,
}

pub(crate) fn all() -> Vec<Room> {
    ["teapot-room", "office"].into_iter().filter_map(|name| Some(room(name, &built::build(name)?))).collect()
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

/// The first point light; else a corner of the first triangle that shines.
fn light(scene: &Scene) -> [f32; 3] {
    let shining = || scene.mesh().corners(scene.emitters()[0]).expect("a triangle of the scene")[0];
    scene.point_lights.first().map_or_else(shining, |light| light.position)
}
