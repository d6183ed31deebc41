//! Unit tests of the renderers: sampling, frames, refraction, normals, the photon map.

use std::f64::consts::PI;

use approx::{abs_diff_eq, assert_abs_diff_eq};
use crossbar_base::geom::exact::Sides;
use crossbar_base::geom::random::CounterRng;
use crossbar_base::geom::vector::{unit, wide};
use crossbar_base::geom::{Hit, Mesh, Ray};
use crossbar_ground::scene::{Camera, Material, PointLight, Scene};
use crossbar_ground::sphere::CubeMap;
use crossbar_ground::tracer::{CastError, Caster, HostTracer};
use crossbar_systems::renderer::environment::seen_around;
use crossbar_systems::renderer::photon_map::{Photon, PhotonMap};
use crossbar_systems::renderer::sampling::{DiscreteDistribution, cosine, triangle};
use crossbar_systems::renderer::{Settings, eye, whitted};
use glam::DVec3;

fn one_triangle(corners: [[f32; 3]; 3], normals: Vec<[[f32; 3]; 3]>) -> Scene {
    let mesh = Mesh::new(corners.to_vec(), vec![[0, 1, 2]]).expect("a triangle");
    Scene::new(mesh, vec![Material::diffuse("white", [0.5; 3])], vec![0], normals).expect("a scene")
}

/// The color along one ray into a scene.
fn seen_by<R>(eye: DVec3, at: DVec3, render: impl FnOnce(&Camera) -> R) -> R {
    let up = if (at - eye).truncate().length() < 1e-3 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    render(&Camera::new(eye.as_vec3().into(), at.as_vec3().into(), up, 1e-6, 1, 1).expect("a camera"))
}

/// A caster that finds the host's hits, but returns an unrelated t.
struct WithoutDistance(HostTracer);

impl Caster for WithoutDistance {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        let hits = self.0.cast(rays)?;
        Ok(hits.into_iter().map(|hit| hit.map(|hit| Hit { t: 77.0, ..hit })).collect())
    }
}

/// A caster's t has no effect: the hit point receives the light that arrives there, and no light from the other side.
#[test]
fn places_lie_on_their_triangle_whatever_t_says() {
    let corners = [[10.0, 0.0, 3.0], [11.0, 0.5, 3.25], [10.0, 2.0, 4.0]];
    let mut scene = one_triangle(corners, Vec::new());
    let light = DVec3::new(10.5, 0.25, 6.0);
    scene.point_lights.push(PointLight { position: light.as_vec3().into(), intensity: [PI as f32; 3] });
    let [a, b, c] = corners.map(|corner| DVec3::from(corner.map(f64::from)));
    let normal = unit((b - a).cross(c - a)).expect("a normal");
    let mut caster = WithoutDistance(HostTracer::new(scene.mesh(), Sides::Both));
    let random = CounterRng::new(1);
    let mut lit = 0;
    for i in 0..200 {
        let eye = DVec3::from([0, 1, 2].map(|k| f64::from((20.0 * random.unit(i, 0, k)) as f32)));
        let weights = triangle([random.unit(i, 1, 0), random.unit(i, 1, 1)]);
        let at = weights.x * a + weights.y * b + weights.z * c;
        let color = seen_by(eye, at, |camera| {
            whitted::render(&scene, camera, &Settings::default(), &mut caster, &mut |_| {}).expect("a picture").color[0]
        });
        let to_light = light - at;
        let front = normal.dot(eye - at) >= 0.0;
        let irradiance = normal.dot(to_light) / (to_light.length() * to_light.length_squared());
        let expected = if front { 0.5 * f64::from(PI as f32) / PI * irradiance } else { 0.0 };
        // At a distance of about 3 the light falls with the third power, so a displacement of 1e-4 is detected.
        assert_abs_diff_eq!(color[0], expected, epsilon = 1e-5);
        lit += u32::from(front);
    }
    assert!((50..150).contains(&lit), "{lit} from the front");
}

/// The light at the eye shows the cosine between the shading normal and the view.
#[test]
fn normals_that_look_away_are_bent() {
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
    let shown = |normal: DVec3, eye: DVec3| {
        let normals = if normal == DVec3::ZERO { Vec::new() } else { vec![[normal.as_vec3().to_array(); 3]] };
        let scene = one_triangle(corners, normals);
        let mut host = HostTracer::new(scene.mesh(), Sides::Both);
        seen_by(eye, DVec3::ZERO, |camera| {
            eye::render(&scene, camera, &Settings::default(), &mut host, &mut |_| {}).expect("a picture").color[0][0]
        })
    };
    let low = DVec3::new(1.0, 0.0, 0.1);
    let bent = shown(unit(DVec3::new(-0.9, 0.0, 0.2)).expect("a normal"), low);
    assert!(bent > 0.0 && bent < 0.01, "just towards the viewer, not {bent}");
    assert_eq!(shown(DVec3::NEG_Z, low), shown(DVec3::ZERO, low), "the triangle's own instead");
    assert_abs_diff_eq!(shown(DVec3::ZERO, low), 0.5 * 0.1 / low.length(), epsilon = 1e-6);
}

#[test]
fn frames_are_square() {
    for normal in [DVec3::Z, DVec3::X, DVec3::new(0.6, -0.8, 0.0), DVec3::new(-2.0, 3.0, 6.0) / 7.0] {
        // Points on the rim of the disk are the axes of the frame, a quarter turn apart.
        let [x, y] = [0.0, 0.25].map(|turn| cosine(normal, [1.0, turn]));
        assert!(x.dot(y).abs() < 1e-15 && x.dot(normal).abs() < 1e-15 && y.dot(normal).abs() < 1e-15);
        assert!(abs_diff_eq!(x.length(), 1.0, epsilon = 1e-15) && abs_diff_eq!(y.length(), 1.0, epsilon = 1e-15));
        assert!((x.cross(y) - normal).length() < 1e-15, "right-handed");
    }
}

/// Texels of what is seen around a place lie in the directions of a cube map.
#[test]
fn a_cube_map_shows_its_directions() {
    let (place, map) = (DVec3::new(3.0, -1.0, 0.5), CubeMap::new(8));
    let texels = seen_around(place, 8, |camera| {
        assert_eq!(wide(camera.eye()), place);
        Ok(camera.rays().iter().map(|ray| wide(ray.direction()).normalize().to_array()).collect())
    });
    for (at, texel) in texels.expect("texels").into_iter().enumerate() {
        let expected = map.direction(at / 64, at % 8, at / 8 % 8);
        assert!(DVec3::from(texel).distance(expected) < 1e-6, "texel {at}: {texel:?}, not {expected}");
    }
}

fn scattered(count: u64) -> Vec<Photon> {
    let random = CounterRng::new(3);
    let photon = |i| Photon {
        at: DVec3::new(random.unit(i, 0, 0), random.unit(i, 0, 1), if i % 5 == 0 { 0.5 } else { 0.0 }),
        normal: if i % 7 == 0 { DVec3::NEG_Z } else { DVec3::Z },
        from: DVec3::Z,
        power: DVec3::ONE,
    };
    (0..count).map(photon).collect()
}

/// The estimate of a photon map, by testing all photons.
fn brute_force(photons: &[Photon], at: DVec3, nearest: usize, radius: f64) -> f64 {
    let up = photons.iter().filter(|photon| photon.normal.z > 0.0);
    let mut squares: Vec<f64> = up.map(|photon| photon.at.distance_squared(at)).collect();
    squares.sort_by(f64::total_cmp);
    squares.retain(|&square| square <= radius * radius);
    squares.truncate(nearest);
    let full = squares.len() == nearest;
    let count = squares.len() - usize::from(full);
    let square = if full { squares[nearest - 1] } else { radius * radius };
    count as f64 / (PI * square)
}

#[test]
fn the_nearest_are_those_that_a_plain_search_finds() {
    let random = CounterRng::new(4);
    for (i, count) in (0..100).flat_map(|i| [(i, 0), (i, 500)]) {
        let photons = scattered(count);
        let map = PhotonMap::new(photons.clone());
        let at = DVec3::from([0, 1, 2].map(|k| 1.2 * random.unit(i, 0, k) - 0.1));
        for (nearest, radius) in [(2, 1.0), (10, 0.3), (50, 2.0), (1000, 0.5), (1000, 9.0)] {
            let found = map.density(at, DVec3::Z, nearest, radius, |photon| photon.power)[0];
            let expected = brute_force(&photons, at, nearest, radius);
            assert_abs_diff_eq!(found, expected, epsilon = 1e-9 * expected);
        }
    }
}

#[test]
fn tables_pass_over_what_has_no_weight() {
    let table = DiscreteDistribution::new([0.0, 1.0, 0.0, 3.0, 0.0]);
    assert_eq!(table.draw(0.0), Some((1, 0.25)));
    assert_eq!(table.draw(0.2499), Some((1, 0.25)));
    assert_eq!(table.draw(0.25), Some((3, 0.75)));
    assert_eq!(table.draw(0.999), Some((3, 0.75)));
    assert_eq!(DiscreteDistribution::new([0.0]).draw(0.5), None);
}
