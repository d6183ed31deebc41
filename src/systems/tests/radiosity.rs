//! Unit tests of matrix radiosity: patches and their subdivision, closed forms, programs, the model of short
//! accumulators.

use approx::assert_abs_diff_eq;
use crossbar_base::error::input_error;
use crossbar_base::geom::Mesh;
use crossbar_base::geom::vector::{narrow, wide};
use crossbar_ground::linalg::Matrix;
use crossbar_ground::scene::{Material, Scene};
use crossbar_systems::radiosity::bias::{Accumulator, predicted};
use crossbar_systems::radiosity::form_factor::point_to_polygon;
use crossbar_systems::radiosity::packing::Packing;
use crossbar_systems::radiosity::solve::Solver;
use crossbar_systems::radiosity::{FormFactors, Patch, Patches, Subdivision, System};
use glam::DVec3;
use refsim::num::Rounding;

#[test]
fn a_trapezoid_has_its_area_and_centre() {
    let outline = [[0.0, 0.0], [4.0, 0.0], [3.0, 3.0], [1.0, 3.0]].map(|[x, y]| DVec3::new(x, y, 1.0));
    let patch = Patch::new(&outline, 0, 0).expect("a patch");
    assert_eq!((patch.area(), patch.normal()), (9.0, DVec3::Z));
    assert!(patch.center().abs_diff_eq(DVec3::new(2.0, 4.0 / 3.0, 1.0), 1e-15), "{}", patch.center());
    assert_eq!(patch.center().z, 1.0);
    let middle = patch.at(0.5, 0.5);
    assert_eq!((middle.at, middle.density), (DVec3::new(2.0, 1.5, 1.0), 9.0));
    assert_eq!(patch.at(1.0, 1.0).at, outline[2]);
}

#[test]
fn what_has_no_area_is_no_patch() {
    let line = [0.0, 1.0, 2.0].map(|x| DVec3::new(x, x, 0.0));
    assert_eq!(Patch::new(&line, 0, 0), None);
    assert_eq!(Patch::new(&line[..2], 0, 0), None);
    assert_eq!(Patch::new(&[DVec3::NAN; 3], 0, 0), None);
}

const SQUARE: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];

/// A scene of polygons, each a fan of triangles with its own material.
fn scene(polygons: &[&[DVec3]]) -> Scene {
    let (mut positions, mut triangles, mut material_of) = (Vec::new(), Vec::new(), Vec::new());
    for (material, polygon) in (0..).zip(polygons) {
        let first = positions.len() as u32;
        positions.extend(polygon.iter().map(|&corner| narrow(corner)));
        for k in 2..polygon.len() as u32 {
            triangles.push([first, first + k - 1, first + k]);
            material_of.push(material);
        }
    }
    let materials = polygons.iter().map(|_| Material::diffuse("white", [0.5; 3])).collect();
    Scene::new(Mesh::new(positions, triangles).expect("a mesh"), materials, material_of, Vec::new()).expect("a scene")
}

fn cut(polygons: &[&[DVec3]], subdivision: Subdivision) -> Vec<Patch> {
    Patches::new(&scene(polygons), subdivision).expect("patches").list().to_vec()
}

#[test]
fn a_triangle_is_cut_into_n_squared_parts() {
    let patches = cut(&[&SQUARE[..3]], Subdivision::PerSide(2));
    assert_eq!(patches.len(), 4);
    assert_abs_diff_eq!(patches.iter().map(Patch::area).sum::<f64>(), 0.5, epsilon = 1e-14);
}

#[test]
fn two_halves_make_a_square_and_a_kink_does_not() {
    let outlines = |triangles: [[DVec3; 3]; 2]| -> Vec<Vec<DVec3>> {
        let mesh = Mesh::new(triangles.concat().into_iter().map(narrow).collect(), vec![[0, 1, 2], [3, 4, 5]]);
        let white = vec![Material::diffuse("white", [0.5; 3])];
        let scene = Scene::new(mesh.expect("a mesh"), white, vec![0; 2], Vec::new()).expect("a scene");
        let patches = Patches::new(&scene, Subdivision::PerSide(1)).expect("patches");
        patches.list().iter().map(|patch| patch.corners().to_vec()).collect()
    };
    let [a, b, c, d] = SQUARE;
    assert_eq!(outlines([[b, c, a], [c, d, a]]), [[a, b, c, d]]);
    let kink = DVec3::new(0.0, 1.0, 0.1);
    assert_eq!(outlines([[a, b, c], [a, c, kink]]), [[a, b, c], [a, c, wide(narrow(kink))]]);
    assert_eq!(outlines([[a, b, c], [c, a, d]]), [[a, b, c], [c, a, d]], "it faces the other way");
    let dented = wide(narrow(DVec3::new(0.9, 0.8, 0.0)));
    assert_eq!(outlines([[a, b, c], [a, c, dented]]), [[a, b, c], [a, c, dented]], "not convex");
}

#[test]
fn parts_are_as_short_as_the_number_allows() {
    let long = SQUARE.map(|corner| DVec3::new(2.0, 1.0, 1.0) * corner);
    for (most, expected) in
        [(12, [[2, 2], [4, 2]]), (11, [[2, 2], [3, 2]]), (3, [[1, 1], [2, 1]]), (0, [[1, 1], [1, 1]])]
    {
        let patches = cut(&[&SQUARE, &long], Subdivision::AtMost(most));
        for (face, (width, [across, along])) in (0..).zip([1.0, 2.0].into_iter().zip(expected)) {
            let of_face: Vec<&Patch> = patches.iter().filter(|patch| patch.face == face).collect();
            assert_eq!(of_face.len(), across * along, "{most} patches, face {face}");
            let [a, b, _, d] = *of_face[0].corners() else { panic!("a quadrilateral") };
            assert_abs_diff_eq!(b.distance(a), width / across as f64, epsilon = 1e-14);
            assert_abs_diff_eq!(d.distance(a), 1.0 / along as f64, epsilon = 1e-14);
        }
    }
}

/// A lid that faces the point from above: counter-clockwise seen from below.
const LID: [DVec3; 4] =
    [DVec3::new(-1.0, -1.0, 1.0), DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, 1.0, 1.0), DVec3::new(1.0, -1.0, 1.0)];

#[test]
fn the_horizon_cuts_what_straddles_it() {
    let half = point_to_polygon(DVec3::ZERO, DVec3::X, &LID);
    let front = LID.map(|corner| corner.with_x(corner.x.max(0.0)));
    assert_eq!(half, point_to_polygon(DVec3::ZERO, DVec3::X, &front));
    assert!(half > 0.0);
}

#[test]
fn names_of_solvers_read_back() {
    for solver in [Solver::Jacobi, Solver::GaussSeidel, Solver::OverRelaxation(1.25), Solver::Shooting, Solver::Direct]
    {
        assert_eq!(solver.to_string().parse(), Ok(solver));
    }
    for name in ["", "sor", "sor:2", "sor:nan", "Jacobi"] {
        let expected = input_error!(
            "expected `jacobi`, `gauss-seidel`, `sor:FACTOR` (0 < FACTOR < 2), `shooting` or `direct`, found `{name}`"
        );
        assert_eq!(name.parse::<Solver>(), Err(expected));
    }
}

const HALF: Accumulator = Accumulator {
    mantissa: 10,
    least_exponent: -14,
    rounding: Rounding::NearestEven,
    packing: Packing::Rgb,
    block: 254,
};
const TRUNCATED: Accumulator = Accumulator { rounding: Rounding::TowardZero, ..HALF };

/// The loss of the first patch's row, which starts at 1 and adds these terms. The reflectance is 1/2; the other patches
/// exchange no light with each other and have radiosity 1, the first has 0.
fn lost(how: Accumulator, terms: &[f64]) -> f64 {
    let size = terms.len() + 1;
    let mut factors = Matrix::zeros([size; 2]).expect("a matrix");
    factors.row_mut(0)[1..].iter_mut().zip(terms).for_each(|(factor, term)| *factor = 2.0 * term);
    let factors = FormFactors::from_values(vec![1.0; size], factors).expect("form factors");
    let mut light = vec![[0.0; 3]; size];
    light[0] = [1.0; 3];
    let system = System::new(factors, vec![[0.5; 3]; size], light).expect("a system");
    let mut radiosity = vec![[1.0; 3]; size];
    radiosity[0] = [0.0; 3];
    predicted(&system, &radiosity, how).expect("a prediction")[0][0]
}

#[test]
fn a_term_counts_as_a_multiple_of_the_sums_step() {
    // The step of 1 is 2^-10.
    let step = 1.0 / 1024.0;
    for (term, nearest, below) in [(0.4, 0.0, 0.0), (0.6, 1.0, 0.0), (2.3, 2.0, 2.0), (2.7, 3.0, 2.0)] {
        assert_eq!(lost(HALF, &[term * step]), nearest * step - term * step);
        assert_eq!(lost(TRUNCATED, &[term * step]), below * step - term * step);
    }
}
