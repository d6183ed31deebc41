//! The card's picture: each pixel shows the patch that exact arithmetic finds there.

use crate::support::profile;
use approx::{abs_diff_eq, assert_abs_diff_eq};
use crossbar::geom::exact::{Sides, nearest_all};
use crossbar::geom::vector::{narrow, wide};
use crossbar::geom::{Mesh, Ray};
use crossbar::radiosity::display::{Display, at_corners};
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::{DrawError, Patch, Patches, Subdivision};
use crossbar::scene::{Camera, Scene};
use glam::DVec3;
use refsim::machine::{ExecutorKind, Machine};

use super::all_pictures::{FLOATS, colours, pixels, rooms_and_cameras};
use super::white;

/// NV35 truncates corners to a sixteenth of a pixel: an edge moves by at most sqrt(2) / 16 = 0.0884 pixels, and
/// rounding adds a little.
const SNAPPED: f64 = 0.09;

fn card(device: &str) -> Machine {
    Machine::new(profile(device), ExecutorKind::Batch)
}

/// The ray through a point of the picture, given in pixels from the upper left corner.
fn ray(camera: &Camera, [x, y]: [f64; 2]) -> Ray {
    Ray::new(camera.eye(), narrow(camera.direction_at(x, y))).expect("a ray")
}

fn holds(patch: &Patch, point: DVec3) -> bool {
    let corners = patch.corners();
    let inside = |i: usize| {
        let side = corners[(i + 1) % corners.len()] - corners[i];
        side.cross(point - corners[i]).dot(patch.normal()) >= 0.0
    };
    (0..corners.len()).all(inside)
}

/// Exact hit for each point of the picture: the patch and the position on it.
fn exact(patches: &Patches, camera: &Camera, points: &[[f64; 2]]) -> Vec<Option<(usize, DVec3)>> {
    let rays: Vec<Ray> = points.iter().map(|&point| ray(camera, point)).collect();
    let hits = nearest_all(patches.mesh(), &rays, Sides::Both);
    let found = |(ray, hit): (&Ray, Option<crossbar::geom::exact::NearestHit>)| {
        let hit = hit?;
        let [origin, direction] = [ray.origin(), ray.direction()].map(wide);
        let (point, face) = (origin + hit.t.to_f64() * direction, patches.face_of(hit.triangle));
        let seen = |patch: &Patch| patch.face == face && patch.height(origin) > 0.0 && holds(patch, point);
        patches.list().iter().position(seen).map(|patch| (patch, point))
    };
    rays.iter().zip(hits).map(found).collect()
}

/// The patch and position of each pixel whose center is farther than [`SNAPPED`] from any other patch; the outer `None`
/// marks all other pixels.
fn certain(patches: &Patches, camera: &Camera) -> Vec<Option<Option<(usize, DVec3)>>> {
    let around = [[0.0, 0.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let pixels = (0..camera.height()).flat_map(|y| (0..camera.width()).map(move |x| [x, y]));
    let points: Vec<[f64; 2]> =
        pixels.flat_map(|p| around.map(|a| [0, 1].map(|k| f64::from(p[k]) + 0.5 + SNAPPED * a[k]))).collect();
    let found = exact(patches, camera, &points);
    found
        .chunks(around.len())
        .map(|five| five.iter().all(|other| other.map(|o| o.0) == five[0].map(|o| o.0)).then_some(five[0]))
        .collect()
}

#[test]
fn a_pixel_shows_the_patch_that_exact_arithmetic_finds_there() {
    for (patches, camera) in rooms_and_cameras() {
        let mut machine = card("nv35");
        let display = Display::new(&mut machine, &patches, &camera, FLOATS).expect("a display");
        let colours = colours(&patches);
        let texture = display.upload(&mut machine, &colours).expect("a texture");
        let ids = display.ids(&mut machine).expect("ids");
        let flat = display.flat(&mut machine, texture, 2.0).expect("a picture");
        let factor = (2.0 / std::f64::consts::PI) as f32;
        let certain = certain(&patches, &camera);
        let sure = certain.iter().flatten().count();
        assert!(sure * 10 > certain.len() * 8, "{sure} of {} pixels are no edge", certain.len());
        for (pixel, ((id, colour), want)) in ids.iter().zip(pixels(&flat)).zip(&certain).enumerate() {
            let shown = id.map_or([0.0; 3], |id| colours[id as usize].map(|b| f64::from(b as f32 * factor)));
            assert_eq!(colour, shown, "pixel {pixel}: flat shows what ids say");
            if let Some(want) = want {
                assert_eq!(id.map(|id| id as usize), want.map(|w| w.0), "pixel {pixel}");
            }
        }
    }
}

#[test]
fn a_radiosity_that_is_the_same_everywhere_makes_a_picture_of_one_colour() {
    let (patches, camera) = rooms_and_cameras().remove(1);
    let mut machine = card("nv30");
    let display = Display::new(&mut machine, &patches, &camera, FLOATS).expect("a display");
    let same = [0.3, 0.7, 1.9];
    let texture = display.upload(&mut machine, &vec![same; patches.list().len()]).expect("a texture");
    let want = same.map(|b| f64::from(b as f32 * std::f64::consts::FRAC_1_PI as f32));
    for picture in [display.flat(&mut machine, texture, 1.0), display.smooth(&mut machine, texture, 1.0)] {
        let other = pixels(&picture.expect("a picture")).into_iter().filter(|&pixel| pixel != want).count();
        // No crack shows the background, even between faces whose corners do not coincide.
        assert_eq!(other, 0, "pixels of another colour");
    }
}

/// Along the side that ceiling and wall share, the ceiling has corners that the wall lacks. The wall's side is drawn
/// through these corners; a single edge would leave two black pixels at 192 x 192.
#[test]
fn a_closed_room_shows_a_patch_in_every_pixel() {
    for blocks in [false, true] {
        let scene = rooms::cornell(CornellBox { blocks, open: false });
        let patches = Patches::new(&scene, Subdivision::AtMost(1000)).expect("patches");
        for size in [[192, 192], [256, 256], [101, 67]] {
            let camera = scene.views[0].camera(size[0], size[1]).expect("a camera");
            let mut machine = card("nv35");
            let display = Display::new(&mut machine, &patches, &camera, FLOATS).expect("a display");
            let ids = display.ids(&mut machine).expect("ids");
            let cracks: Vec<usize> = (0..ids.len()).filter(|&pixel| ids[pixel].is_none()).collect();
            assert_eq!(cracks, [0_usize; 0], "blocks: {blocks}, {size:?}");
        }
    }
}

#[test]
fn a_smooth_picture_is_what_the_host_interpolates() {
    let scene = rooms::furnace(0.5);
    let patches = Patches::new(&scene, Subdivision::PerSide(4)).expect("patches");
    let camera = scene.views[0].camera(64, 64).expect("a camera");
    let mut machine = card("nv35");
    let display = Display::new(&mut machine, &patches, &camera, FLOATS).expect("a display");
    let slope = |DVec3 { x, y, z }| [1.0 + x + 2.0 * y, 1.0 + z * z, 1.0 + x * y];
    let radiosity: Vec<[f64; 3]> = patches.list().iter().map(|patch| slope(patch.center())).collect();
    let corners = at_corners(&patches, &radiosity);
    let texture = display.upload(&mut machine, &radiosity).expect("a texture");
    let picture = display.smooth(&mut machine, texture, std::f64::consts::PI).expect("a picture");
    let mut compared = 0;
    for (pixel, certain) in pixels(&picture).iter().zip(certain(&patches, &camera)) {
        let Some(Some((patch, point))) = certain else { continue };
        let values = &corners[patch];
        let [a, b, _, d] = *patches.list()[patch].corners() else { panic!("a quadrilateral") };
        let share = |side: DVec3| (point - a).dot(side) / side.dot(side);
        let (u, v) = (share(b - a), share(d - a));
        for c in 0..3 {
            let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
            let want: f64 = weights.iter().zip(values).map(|(w, corner)| w * corner[c]).sum();
            let spread =
                values.iter().map(|x| x[c]).fold(0.0, f64::max) - values.iter().map(|x| x[c]).fold(9.0, f64::min);
            // The nearest patches are at least 12 pixels wide, the farthest 10: snapped corners change interpolated
            // values by about 0.5 %.
            assert!(
                abs_diff_eq!(pixel[c], want, epsilon = 0.01 * spread + 1e-5),
                "{} and {want}, spread {spread}",
                pixel[c]
            );
            compared += 1;
        }
    }
    assert!(compared > 3 * 3000, "{compared}");
}

/// A disc of triangles around the origin, ordered so that consecutive triangles are never neighbors, which would be
/// joined into one face.
fn disc(triangles: u32) -> Scene {
    let turn = |k: u32| {
        let angle = f64::from(k) / f64::from(triangles) * std::f64::consts::TAU;
        [libm::cos(angle) as f32, libm::sin(angle) as f32, 0.0]
    };
    let mut positions = vec![[0.0; 3]];
    positions.extend((0..triangles).map(turn));
    let order = (0..triangles).step_by(2).chain((1..triangles).step_by(2));
    let list: Vec<[u32; 3]> = order.map(|k| [0, 1 + k, 1 + (k + 1) % triangles]).collect();
    white(Mesh::new(positions, list).expect("a mesh"))
}

#[test]
fn any_number_of_patches_can_meet_in_a_corner() {
    for triangles in [5, 6, 8, 13] {
        let patches = Patches::new(&disc(triangles), Subdivision::PerSide(1)).expect("patches");
        let count = patches.list().len();
        assert_eq!(count, triangles as usize, "each triangle a face");
        let camera = Camera::new([0.0, 0.0, 4.0], [0.0; 3], [0.0, 1.0, 0.0], 0.3, 33, 33).expect("a camera");
        let mut machine = card("nv35");
        let display = Display::new(&mut machine, &patches, &camera, FLOATS).expect("a display");
        let radiosity: Vec<[f64; 3]> = (0..count).map(|i| [i as f64, 1.0, (i * i) as f64]).collect();
        let texture = display.upload(&mut machine, &radiosity).expect("a texture");
        let picture = display.smooth(&mut machine, texture, std::f64::consts::PI).expect("a picture");
        let middle = pixels(&picture)[16 * 33 + 16];
        let mean = at_corners(&patches, &radiosity)[0][0];
        for (found, want) in middle.into_iter().zip(mean) {
            // Each operation has an error of 2^-24 of its result; there are 3 per patch.
            assert_abs_diff_eq!(found, want, epsilon = 1e-6 * f64::from(triangles) * (want + 1.0));
        }
    }
}

#[test]
fn what_a_card_cannot_draw_is_refused() {
    let (patches, camera) = rooms_and_cameras().remove(0);
    let display = |device: &str, camera: &Camera| Display::new(&mut card(device), &patches, camera, FLOATS);
    assert!(display("r300", &camera).is_err(), "it runs no fragment programs");
    let wide = Camera::new([2.75, -8.0, 2.75], [2.75; 3], [0.0, 0.0, 1.0], 0.3, 5000, 4).expect("a camera");
    assert!(display("nv35", &wide).is_err(), "5000 columns");
    let mut machine = card("nv35");
    let display = Display::new(&mut machine, &patches, &camera, FLOATS).expect("a display");
    let refused = display.upload(&mut machine, &[[0.0; 3]; 5]).expect_err("five of many");
    assert_eq!(refused, DrawError::Count { patches: patches.list().len(), found: 5 });
}
