//! Tests form factors against closed forms, and properties of all form factors.

use approx::abs_diff_eq;
use crossbar::geom::Mesh;
use crossbar::geom::random::CounterRng;
use crossbar::quadrature::EIGHT;
use crossbar::radiosity::form_factor::{VisibilityParameters, point_to_polygon};
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::{FormFactors, Patches, Subdivision};
use crossbar::scene::Scene;
use glam::DVec3;

use super::{are_closed, tracer, white};

/// Quadrature error of the row sums of a subdivided room (docs/papers/radiosity.md derives it).
const QUADRATURE: f64 = 2e-7;

fn cube(per_side: u32) -> Patches {
    Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(per_side)).expect("patches")
}

/// The walls of a cube have the printed constants, whole and as sums over their parts.
#[test]
fn the_six_walls_of_a_cube_have_the_printed_constants() {
    for (per_side, epsilon) in [(1, 1e-9), (2, 1e-7), (5, 1e-7), (9, 1e-7)] {
        let patches = cube(per_side);
        let factors = FormFactors::unoccluded(&patches).expect("factors");
        let mut walls = [[0.0; 6]; 6];
        for (i, one) in patches.list().iter().enumerate() {
            for (other, factor) in patches.list().iter().zip(factors.matrix().row(i)) {
                walls[one.face as usize][other.face as usize] += one.area() * factor;
            }
        }
        for (i, j) in (0..6).flat_map(|i| (0..6).map(move |j| (i, j))) {
            let expected = match (i == j, i / 2 == j / 2) {
                (true, _) => 0.0,
                (_, true) => 0.199_824_895_698_387,
                _ => 0.200_043_776_075_403,
            };
            let found = walls[i][j];
            assert!(abs_diff_eq!(found, expected, epsilon = epsilon), "{per_side}: {i} to {j}: {found}");
        }
    }
}

#[test]
fn a_factor_is_the_mean_over_the_points_of_its_patch() {
    let patches = cube(2);
    let factors = FormFactors::unoccluded(&patches).expect("factors");
    for (i, one) in patches.list().iter().enumerate() {
        for (other, &found) in patches.list().iter().zip(factors.matrix().row(i)) {
            let mut mean = 0.0;
            for (u, v) in EIGHT.iter().flat_map(|u| EIGHT.iter().map(move |v| (u, v))) {
                let point = one.at(u.0, v.0);
                let factor = point_to_polygon(point.at, one.normal(), other.corners());
                mean += u.1 * v.1 * point.density / one.area() * factor;
            }
            assert!(abs_diff_eq!(found, mean, epsilon = 0.01 * found + 1e-15), "{i}: {found}, not {mean}");
        }
    }
}

#[test]
fn closed_rooms_close_and_pairs_are_reciprocal() {
    let rooms = [
        ("cube", Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(8))),
        ("box", Patches::new(&rooms::cornell(CornellBox::default()), Subdivision::AtMost(300))),
        ("tetrahedron", Patches::new(&tetrahedron(), Subdivision::PerSide(5))),
    ];
    for (name, patches) in rooms {
        let factors = FormFactors::unoccluded(&patches.expect("patches")).expect("factors");
        let sums = factors.summary();
        assert!((sums.least - 1.0).abs() < QUADRATURE && (sums.most - 1.0).abs() < QUADRATURE, "{name}: {sums:?}");
        let error = reciprocity_error(&factors);
        assert!(error <= 4.0 * f64::EPSILON, "{name}: {error}");
    }
}

/// The largest difference between A_i F_ij and A_j F_ji, relative to the larger one.
fn reciprocity_error(factors: &FormFactors) -> f64 {
    let (areas, matrix) = (factors.areas(), factors.matrix());
    let pairs = (0..areas.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let both = pairs.map(|(i, j)| (areas[i] * matrix.row(i)[j], areas[j] * matrix.row(j)[i]));
    both.filter(|(a, b)| a != b).map(|(a, b)| (a - b).abs() / a.max(b)).fold(0.0, f64::max)
}

/// A regular tetrahedron seen from inside: each wall sees the other three equally.
fn tetrahedron() -> Scene {
    let corners = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    white(Mesh::new(corners, triangles).expect("a mesh"))
}

#[test]
fn a_tetrahedron_shares_its_light_evenly() {
    let patches = Patches::new(&tetrahedron(), Subdivision::PerSide(1)).expect("patches");
    let factors = FormFactors::unoccluded(&patches).expect("factors");
    for i in 0..4 {
        for j in 0..4 {
            let expected = if i == j { 0.0 } else { 1.0 / 3.0 };
            let found = factors.matrix().row(i)[j];
            assert!(abs_diff_eq!(found, expected, epsilon = 1e-5), "{i} to {j}: {found}");
        }
    }
}

#[test]
fn enforcement_closes_rows_and_keeps_reciprocity() {
    let patches = Patches::new(&rooms::cornell(CornellBox::default()), Subdivision::AtMost(200)).expect("patches");
    let mut factors = FormFactors::unoccluded(&patches).expect("factors");
    // Perturbs the factors by up to a tenth.
    let mut spoilt = factors.matrix().clone();
    for i in 0..spoilt.row_count() {
        for (j, value) in spoilt.row_mut(i).iter_mut().enumerate() {
            *value *= 0.9 + 0.2 * CounterRng::new(3).unit(i as u64, j as u64, 0);
        }
    }
    factors = FormFactors::from_values(factors.areas().to_vec(), spoilt).expect("factors");
    assert!(reciprocity_error(&factors) > 0.1 && !are_closed(&factors, 1e-3));
    factors.enforce_closure().expect("a scaling");
    assert!(are_closed(&factors, 1e-12) && reciprocity_error(&factors) < 1e-15);
}

#[test]
fn a_point_sees_of_a_patch_what_rays_find() {
    let random = CounterRng::new(8);
    let patch = [[0.3, 2.0, -0.5], [1.4, 2.2, 0.6], [0.2, 1.9, 1.5], [-0.9, 1.7, 0.4]].map(DVec3::from);
    let factor = point_to_polygon(DVec3::ZERO, DVec3::Y, &patch);
    // Uniform points of the unit disk give cosine-distributed directions (Nusselt's analogue).
    let (mut hits, mut all) = (0_u32, 0_u32);
    for i in 0..200_000 {
        let [x, z] = [0, 1].map(|d| 2.0 * random.unit(i, 0, d) - 1.0);
        let square = x * x + z * z;
        if square < 1.0 {
            all += 1;
            hits += u32::from(pierces(&patch, DVec3::new(x, (1.0 - square).sqrt(), z)));
        }
    }
    let (share, sigma) = (f64::from(hits) / f64::from(all), (factor * (1.0 - factor) / f64::from(all)).sqrt());
    assert!(abs_diff_eq!(share, factor, epsilon = 5.0 * sigma), "{factor} against {share} of {all} rays");
}

/// `true` if the direction lies on one side of all planes through the origin and an edge.
fn pierces(corners: &[DVec3; 4], d: DVec3) -> bool {
    (0..4).all(|i| corners[i].cross(corners[(i + 1) % 4]).dot(d) <= 0.0)
}

#[test]
fn an_empty_room_keeps_its_factors_to_the_bit_when_rays_are_asked() {
    let scene = rooms::cornell(CornellBox::default());
    let patches = Patches::new(&scene, Subdivision::AtMost(150)).expect("patches");
    let parameters = VisibilityParameters { bundle: 5000, ..VisibilityParameters::default() };
    let mut calls = Vec::new();
    let seen = FormFactors::with_visibility(&patches, &mut tracer(&scene), parameters, &mut |done, all| {
        calls.push((done, all))
    });
    assert_eq!(seen.expect("factors"), FormFactors::unoccluded(&patches).expect("factors"));
    let all = calls[0].1;
    assert!(calls.last() == Some(&(all, all)) && calls.len() > 10 && calls.windows(2).all(|two| two[0].0 < two[1].0));
}

/// Two walls of a cube with a screen between them that hides everything, then half.
#[test]
fn a_screen_hides_what_is_behind_it() {
    let screen = |share: f32| {
        let wall = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let (floor, ceiling) = (wall.map(|[x, y]| [x, y, 0.0]), wall.map(|[x, y]| [x, 1.0 - y, 1.0]));
        let between = [[-1.0, -1.0, 0.5], [share, -1.0, 0.5], [share, 2.0, 0.5], [-1.0, 2.0, 0.5]];
        let triangles =
            (0..3).flat_map(|quad| [[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|k| 4 * quad + k))).collect();
        white(Mesh::new([floor, ceiling, between].concat(), triangles).expect("a mesh"))
    };
    let parameters = VisibilityParameters { side: 40, ..VisibilityParameters::default() };
    let factor = |share: f32| {
        let scene = screen(share);
        let patches = Patches::new(&scene, Subdivision::PerSide(1)).expect("patches");
        let found = FormFactors::with_visibility(&patches, &mut tracer(&scene), parameters, &mut |_, _| ());
        found.expect("factors").matrix().row(0)[1]
    };
    let open = 0.199_824_895_698_387;
    assert_eq!(factor(2.0), 0.0, "all hidden");
    let (none, half) = (factor(-0.5), factor(0.5));
    assert!(abs_diff_eq!(none, open, epsilon = 1e-9), "none hidden: {none}");
    assert!(abs_diff_eq!(half, 0.5 * open, epsilon = 0.02 * open), "half hidden, by symmetry: {half}");
}

#[test]
fn a_closed_room_with_blocks_closes_but_for_what_is_wholly_under_them() {
    let scene = rooms::cornell(CornellBox { blocks: true, open: false });
    let patches = Patches::new(&scene, Subdivision::AtMost(700)).expect("patches");
    let open = FormFactors::unoccluded(&patches).expect("factors");
    let parameters = VisibilityParameters { side: 2, ..VisibilityParameters::default() };
    let mut factors =
        FormFactors::with_visibility(&patches, &mut tracer(&scene), parameters, &mut |_, _| ()).expect("factors");
    // The visibility of a pair is the mean of side^2 samples of 0 or 1: its standard deviation is at most 1 / (2 side),
    // and a row sum's is this times the root of the sum of the row's squares. Allows five deviations. The covered part
    // of a floor patch does not count; blind patches are entirely covered.
    let covered = |i: usize| patches.open_parts(i).is_empty();
    for (i, (sum, row)) in factors.row_sums().into_iter().zip(open.matrix().rows()).enumerate() {
        let squares: f64 = row.iter().map(|f| f * f).sum();
        let tolerance = 5.0 * squares.sqrt() / (2.0 * f64::from(parameters.side));
        assert!(covered(i) == (sum == 0.0) && (covered(i) || (sum - 1.0).abs() <= tolerance), "{sum}, {tolerance}");
    }
    let blind = factors.blind();
    assert!(!blind.is_empty() && blind.iter().all(|&i| patches.list()[i].face == 0), "{blind:?}");
    factors.enforce_closure().expect("a closed room");
    assert!(are_closed(&factors, 1e-12), "closed but for blind patches");
    assert_eq!(factors.blind(), blind, "they stay blind");
}
