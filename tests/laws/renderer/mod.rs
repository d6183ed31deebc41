//! Compares the renderers with closed forms, with each other, and with themselves for other numbers of threads and
//! other casters.

mod agreement;
mod bits;
mod direct;
mod drawn;
mod furnace;
mod photons;
mod points;
mod whitted;

use crate::support::soup;
use crossbar::geom::exact::Sides;
use crossbar::renderer::path::Direct;
use crossbar::renderer::photon::Photons;
use crossbar::renderer::{RenderedPicture, Settings, distributed, path, photon};
use crossbar::scene::{Camera, Color, Material, Scene, Surface};
use crossbar::tracer::HostTracer;

/// Builds a scene of quads and triangles, each with its material.
#[derive(Default)]
struct Builder {
    corners: Vec<[f32; 3]>,
    materials: Vec<Material>,
}

impl Builder {
    fn triangle(&mut self, corners: [[f32; 3]; 3], material: Material) {
        self.corners.extend(corners);
        self.materials.push(material);
    }

    /// A parallelogram given by a corner and two sides; `u x v` points to its front.
    fn quad(&mut self, corner: [f32; 3], u: [f32; 3], v: [f32; 3], material: Material) {
        let at = |a: f32, b: f32| [0, 1, 2].map(|k| corner[k] + a * u[k] + b * v[k]);
        self.triangle([at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)], material.clone());
        self.triangle([at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)], material);
    }

    /// The six sides of a box, seen from inside or outside.
    fn boxed(&mut self, low: [f32; 3], high: [f32; 3], inwards: bool, material: &Material) {
        for axis in 0..3 {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let (mut u, mut v) = ([0.0; 3], [0.0; 3]);
            u[next] = high[next] - low[next];
            v[last] = high[last] - low[last];
            let mut top = low;
            top[axis] = high[axis];
            // u x v points along the axis: inwards at the low side.
            let (from_low, from_high) = if inwards { ((u, v), (v, u)) } else { ((v, u), (u, v)) };
            self.quad(low, from_low.0, from_low.1, material.clone());
            self.quad(top, from_high.0, from_high.1, material.clone());
        }
    }

    fn scene(self) -> Scene {
        let material_of = (0..self.materials.len() as u32).collect();
        Scene::new(soup(self.corners), self.materials, material_of, Vec::new()).expect("a scene")
    }
}

fn white(albedo: f32) -> Material {
    Material::diffuse("white", [albedo; 3])
}

fn lamp(emission: Color) -> Material {
    Material { emission, ..Material::diffuse("lamp", [0.0; 3]) }
}

fn of(surface: Surface) -> Material {
    Material { name: "made".to_owned(), surface, emission: [0.0; 3] }
}

fn host(scene: &Scene) -> HostTracer {
    HostTracer::new(scene.mesh(), Sides::Both)
}

fn by_paths(scene: &Scene, camera: &Camera, settings: &Settings, direct: Direct) -> RenderedPicture {
    path::render(scene, camera, settings, direct, &mut host(scene), &mut |_| {}).expect("a picture")
}

fn by_distributed_rays(scene: &Scene, camera: &Camera, settings: &Settings) -> RenderedPicture {
    distributed::render(scene, camera, settings, &mut host(scene), &mut |_| {}).expect("a picture")
}

fn by_whitted_rays(scene: &Scene, camera: &Camera, settings: &Settings) -> RenderedPicture {
    crossbar::renderer::whitted::render(scene, camera, settings, &mut host(scene), &mut |_| {}).expect("a picture")
}

fn by_photons(scene: &Scene, camera: &Camera, settings: &Settings, photons: &Photons) -> RenderedPicture {
    photon::render(scene, camera, settings, photons, &mut host(scene), &mut |_| {}).expect("a picture")
}

/// A camera with one pixel and a very small field of view.
fn needle(eye: [f32; 3], target: [f32; 3]) -> Camera {
    let way = [0, 1, 2].map(|k| target[k] - eye[k]);
    let up = if way[0] == 0.0 && way[1] == 0.0 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    Camera::new(eye, target, up, 1e-6, 1, 1).expect("a camera")
}

fn near(found: [f64; 3], expected: [f64; 3], within: f64) {
    for channel in 0..3 {
        let wrong = (found[channel] - expected[channel]).abs();
        assert!(wrong <= within, "found {found:?}, expected {expected:?} within {within}");
    }
}

fn settings() -> Settings {
    Settings::default()
}

/// A room of side 2 with a lamp of side `lamp_side` in its ceiling and a block on its floor.
fn room(lamp_side: f32, block: &Material) -> Scene {
    let mut builder = Builder::default();
    let (s, h) = (lamp_side, lamp_side / 2.0);
    builder.boxed([-1.0, -1.0, 0.0], [1.0, 1.0, 2.0], true, &of(Surface::Diffuse { albedo: [0.75, 0.5, 0.25] }));
    builder.quad([-h, -h, 1.99], [0.0, s, 0.0], [s, 0.0, 0.0], lamp([4.0, 4.0, 8.0]));
    builder.boxed([-0.6, 0.0, 0.0], [0.1, 0.6, 0.8], false, block);
    builder.scene()
}

/// A camera at the room's front wall that looks into the room.
fn room_camera(width: u32, height: u32) -> Camera {
    Camera::new([0.2, -0.95, 1.1], [0.0, 0.3, 0.7], [0.0, 0.0, 1.0], 0.8, width, height).expect("a camera")
}

/// Tolerance of a mean in standard deviations. With a normal distribution, one channel in 150,000 has a larger error.
/// The seeds are fixed, so a test that passed once passes until something changes.
const FAR: f64 = 4.5;

/// Compares one pixel with its expected value.
fn within_chance(picture: &RenderedPicture, pixel: usize, expected: [f64; 3]) {
    let variances = picture.variance[pixel];
    for ((found, variance), expected) in picture.color[pixel].into_iter().zip(variances).zip(expected) {
        let spread = variance.sqrt();
        let off = (found - expected) / spread;
        assert!(off.abs() < FAR, "found {found}, expected {expected}: {off} of {spread} off");
        assert!(spread < 0.05 * expected, "{spread} is too wide to tell anything");
    }
}
