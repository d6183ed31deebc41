//! Partly covered patches: form factors and radiosities belong to their open parts.

use std::f64::consts::PI;

use approx::abs_diff_eq;
use crossbar::geom::random::CounterRng;
use crossbar::geom::vector::narrow;
use crossbar::radiosity::form_factor::VisibilityParameters;
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::solve::{Options, Solver};
use crossbar::radiosity::{FormFactors, Patch, Patches, Subdivision, System};
use crossbar::renderer::Settings;
use crossbar::renderer::path::{self, Direct};
use crossbar::scene::{Camera, Scene};
use glam::DVec3;

use super::tracer;

/// Corners of the two blocks' base areas on the floor, as `rooms::cornell` builds them.
#[expect(clippy::approx_constant, reason = "a corner of a block")]
const FEET: [[[f64; 2]; 4]; 2] =
    [[[1.3, 0.65], [0.82, 2.25], [2.4, 2.72], [2.9, 1.14]], [[4.23, 2.47], [2.65, 2.96], [3.14, 4.56], [4.72, 4.06]]];
const RAYS: VisibilityParameters = VisibilityParameters { side: 3, seed: 1, bundle: 1 << 18 };

fn scene() -> Scene {
    rooms::cornell(CornellBox { blocks: true, open: false })
}

fn factors(scene: &Scene, patches: &Patches) -> FormFactors {
    FormFactors::with_visibility(patches, &mut tracer(scene), RAYS, &mut |_, _| ()).expect("factors")
}

fn solved(patches: &Patches, factors: &FormFactors) -> Vec<[f64; 3]> {
    let system = System::new(factors.clone(), patches.reflectances(), patches.emittances()).expect("a system");
    let options = Options { tolerance: 1e-9, most_iterations: 500 };
    system.solve(Solver::GaussSeidel, &options, None).expect("a solution").radiosity()
}

/// Returns `true` if a point of the floor is under a block: inside one of the base areas.
fn under_a_block(DVec3 { x, y, .. }: DVec3) -> bool {
    FEET.iter().any(|foot| {
        (0..4).all(|i| {
            let ([ax, ay], [bx, by]) = (foot[i], foot[(i + 1) % 4]);
            (bx - ax) * (y - ay) - (by - ay) * (x - ax) <= 0.0
        })
    })
}

/// Random points on the open part of a patch, and that part's share of the area.
fn open_points(patch: &Patch, count: u64, seed: u64) -> (Vec<DVec3>, f64) {
    let random = CounterRng::new(seed);
    let (mut points, mut tried) = (Vec::new(), 0);
    while (points.len() as u64) < count && tried < 1000 * count {
        let point = patch.at(random.unit(tried, 0, 0), random.unit(tried, 0, 1)).at;
        tried += 1;
        if patch.normal()[2] < 0.5 || point[2] > 0.0 || !under_a_block(point) {
            points.push(point);
        }
    }
    let share = points.len() as f64 / tried as f64;
    (points, share)
}

/// The radiosity at a point by path tracing of one pixel, seen from just above the point.
fn radiosity_by_paths(
    scene: &Scene,
    caster: &mut dyn crossbar::tracer::Caster,
    at: [DVec3; 2],
    samples: u32,
) -> [f64; 3] {
    let [point, normal] = at;
    let eye = narrow(point + 0.02 * normal);
    let up = if normal[2].abs() > 0.5 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    let camera = Camera::new(eye, narrow(point), up, 1e-3, 1, 1).expect("a camera");
    let settings = Settings { samples, depth: 40, seed: (point[0] * 1e6) as u64, ..Settings::default() };
    let picture = path::render(scene, &camera, &settings, Direct::Both, caster, &mut |_| ()).expect("a pixel");
    picture.color[0].map(|l| PI * l)
}

/// Mean and standard error.
fn estimate(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0);
    [mean, (square / n).sqrt()]
}

#[test]
fn open_areas_are_what_the_feet_leave() {
    let scene = scene();
    let feet: f64 = FEET.iter().map(|foot| shoelace(foot).abs()).sum();
    // No cuts are made within four lifts (2^-16 of the diagonal) of a border, which affects at most the perimeter of
    // each base area.
    let perimeter: f64 = FEET.iter().flat_map(|foot| (0..4).map(|i| distance(foot[i], foot[(i + 1) % 4]))).sum();
    let finest = 4.0 * (3.0_f64 * 5.5 * 5.5).sqrt() / 65_536.0;
    for count in [20, 150, 700, 2000] {
        let patches = Patches::new(&scene, Subdivision::AtMost(count)).expect("patches");
        let floor = |i: &usize| patches.list()[*i].normal()[2] > 0.5 && patches.list()[*i].center()[2] == 0.0;
        let open: f64 = (0..patches.list().len()).filter(floor).map(|i| patches.open_area(i)).sum();
        let left = 5.5 * 5.5 - feet;
        assert!((open - left).abs() <= finest * perimeter, "{count} patches: {open}, expected {left}");
        let touched = |i: &usize| patches.open_area(*i) < patches.list()[*i].area();
        assert!((0..patches.list().len()).filter(touched).all(|i| floor(&i)), "nothing stands on a wall or a block");
        assert!(patches.covered()[0] > 0 && (count < 700 || patches.covered()[1] > 0), "{:?}", patches.covered());
    }
    let empty = Patches::new(&rooms::cornell(CornellBox::default()), Subdivision::AtMost(700)).expect("patches");
    assert_eq!(empty.covered(), [0, 0]);
}

fn shoelace(foot: &[[f64; 2]; 4]) -> f64 {
    let cross = |i: usize| foot[i][0] * foot[(i + 1) % 4][1] - foot[i][1] * foot[(i + 1) % 4][0];
    (0..4).map(cross).sum::<f64>() / 2.0
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])).sqrt()
}

#[test]
fn enforcing_closure_hardly_changes_a_room_with_blocks() {
    let scene = scene();
    let patches = Patches::new(&scene, Subdivision::AtMost(500)).expect("patches");
    let mut factors = factors(&scene, &patches);
    let found = solved(&patches, &factors);
    let blind = factors.blind();
    factors.enforce_closure().expect("a closed room");
    let closed = solved(&patches, &factors);
    let (mut worst, mut light) = (0.0_f64, [0.0; 2]);
    for i in (0..found.len()).filter(|i| !blind.contains(i)) {
        worst = (0..3).map(|c| (closed[i][c] / found[i][c] - 1.0).abs()).fold(worst, f64::max);
        light = [light[0] + factors.areas()[i] * found[i][0], light[1] + factors.areas()[i] * closed[i][0]];
    }
    // Closure removes the noise of nine rays per pair: here at most 1.5 % of a patch's radiosity, and a fortieth of
    // that over the whole room.
    assert!(worst < 0.03, "a patch changes by {worst}");
    assert!(
        abs_diff_eq!(light[1] / light[0], 1.0, epsilon = 1e-3),
        "the room changes by {}",
        light[1] / light[0] - 1.0
    );
}

#[test]
fn a_patch_mostly_under_a_block_is_as_bright_as_paths_say() {
    let scene = scene();
    let patches = Patches::new(&scene, Subdivision::AtMost(500)).expect("patches");
    let mut factors = factors(&scene, &patches);
    let found = solved(&patches, &factors);
    factors.enforce_closure().expect("a closed room");
    let closed = solved(&patches, &factors);
    let mut caster = tracer(&scene);
    let (mut compared, mut bias) = (0, [const { Vec::new() }; 3]);
    for (i, patch) in patches.list().iter().enumerate().filter(|(_, p)| p.normal()[2] > 0.5 && p.center()[2] == 0.0) {
        let (points, share) = open_points(patch, 24, 5);
        if !(0.01..0.35).contains(&share) {
            continue;
        }
        compared += 1;
        let seen: Vec<[f64; 3]> =
            points.iter().map(|&p| radiosity_by_paths(&scene, &mut caster, [p, patch.normal()], 64)).collect();
        for c in 0..3 {
            let [truth, sigma] = estimate(&seen.iter().map(|b| b[c]).collect::<Vec<_>>());
            // Four standard errors of the paths and points, plus a tenth, because a patch of this size has a single
            // radiosity under uneven light.
            for (what, b) in [("found", found[i][c]), ("closed", closed[i][c])] {
                let off = (b - truth).abs();
                let message = format!("{what}: patch {i}, {share} open, channel {c}: {b} against {truth} +- {sigma}");
                assert!(off <= 4.0 * sigma + 0.1 * truth, "{message}");
                bias[c].push(b / truth - 1.0);
            }
        }
    }
    assert!(compared >= 5, "{compared}");
    // Over all patches the unevenness of the light averages out.
    for bias in bias {
        let mean = bias.iter().sum::<f64>() / bias.len() as f64;
        assert!(mean.abs() < 0.06, "{mean}: {bias:?}");
    }
}
