//! Partly covered patches: form factors and radiosities belong to their open parts.

use approx::abs_diff_eq;
use crossbar::radiosity::form_factor::VisibilityParameters;
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::solve::{Options, Solver};
use crossbar::radiosity::{FormFactors, Patches, Subdivision, System};
use crossbar::scene::Scene;

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
    system.solve(Solver::GaussSeidel, &options).expect("a solution").radiosity()
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
