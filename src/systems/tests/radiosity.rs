//! Unit tests of matrix radiosity: patches and their subdivision, closed forms, programs, the model of short
//! accumulators.

use std::f64::consts::PI;

use approx::{abs_diff_eq, assert_abs_diff_eq};
use crossbar_base::elementary::atan2;
use crossbar_base::error::input_error;
use crossbar_base::geom::Mesh;
use crossbar_base::geom::vector::{narrow, wide};
use crossbar_ground::linalg::Matrix;
use crossbar_ground::scene::{Camera, Material, Scene};
use crossbar_systems::radiosity::bias::{Accumulator, predicted};
use crossbar_systems::radiosity::display::Display;
use crossbar_systems::radiosity::form_factor::point_to_polygon;
use crossbar_systems::radiosity::form_factor::rectangles::{Interval, parallel, perpendicular};
use crossbar_systems::radiosity::kernels::{BLOCKS, of};
use crossbar_systems::radiosity::model::{BLOCK, MAX_INSTRUCTIONS, OVERHEAD, PER_TEXEL, block, passes};
use crossbar_systems::radiosity::packing::Packing;
use crossbar_systems::radiosity::solve::Solver;
use crossbar_systems::radiosity::{FormFactors, Patch, Patches, Subdivision, System};
use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::{ExecutorKind, Machine};
use refsim::num::Rounding;
use refsim::texture::TexelFormat;

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

#[test]
fn areas_add_up_to_the_face() {
    let long = SQUARE.map(|corner| DVec3::new(4.0, 3.0, 1.0) * corner);
    let both: [&[DVec3]; 2] = [&SQUARE[..3], &long];
    let cases = [
        (cut(&both, Subdivision::PerSide(4)), vec![(16, 0.5_f64), (16, 12.0)]),
        (cut(&[&long], Subdivision::AtMost(12)), vec![(12, 12.0)]),
    ];
    for (patches, faces) in cases {
        for (face, (count, area)) in (0..).zip(faces) {
            let of_face: Vec<&Patch> = patches.iter().filter(|patch| patch.face == face).collect();
            let sum: f64 = of_face.iter().map(|patch| patch.area()).sum();
            assert!(
                of_face.len() == count && abs_diff_eq!(sum, area, epsilon = 1e-14 * area.max(1.0)),
                "{} patches, {sum}",
                of_face.len()
            );
            assert!(of_face.iter().all(|p| p.normal() == DVec3::Z && p.material == face));
        }
    }
}

/// A float target holds the number of the patch at each pixel, negative for a patch seen from behind.
#[test]
fn a_picture_names_all_patches_from_the_front() {
    let patches = Patches::new(&scene(&[&SQUARE]), Subdivision::PerSide(128)).expect("patches");
    let mut machine = Machine::new(Profile::named("nv35").expect("a card"), ExecutorKind::Batch);
    let mut seen = |patch: usize, side: f32| {
        let center = narrow(patches.list()[patch].center());
        let eye = [center[0], center[1], side];
        let camera = Camera::new(eye, center, [0.0, 1.0, 0.0], 1e-4, 1, 1).expect("a camera");
        let display = Display::new(&mut machine, &patches, &camera, TexelFormat::Rgba32f).expect("a display");
        display.ids(&mut machine).expect("a picture")[0]
    };
    for patch in [0, 1, 16_383] {
        assert_eq!([seen(patch, 1.0), seen(patch, -1.0)], [Some(patch as u32), None]);
    }
}

/// A lid that faces the point from above: counter-clockwise seen from below.
const LID: [DVec3; 4] =
    [DVec3::new(-1.0, -1.0, 1.0), DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, 1.0, 1.0), DVec3::new(1.0, -1.0, 1.0)];

#[test]
fn a_square_above_its_middle_has_the_textbook_factor() {
    // Four corner rectangles of sides 1 and 1 at height 1: each 1 / (pi sqrt 2) atan(1 / sqrt 2).
    let corner = atan2(1.0, 2.0_f64.sqrt()) / (PI * 2.0_f64.sqrt());
    let found = point_to_polygon(DVec3::ZERO, DVec3::Z, &LID);
    assert_abs_diff_eq!(found, 4.0 * corner, epsilon = 1e-15);
    let mut back = LID;
    back.reverse();
    assert_eq!(point_to_polygon(DVec3::ZERO, DVec3::Z, &back), 0.0, "its back is black");
    assert_eq!(point_to_polygon(DVec3::ZERO, DVec3::NEG_Z, &LID), 0.0, "behind the horizon");
}

#[test]
fn the_horizon_cuts_what_straddles_it() {
    let half = point_to_polygon(DVec3::ZERO, DVec3::X, &LID);
    let front = LID.map(|corner| corner.with_x(corner.x.max(0.0)));
    assert_eq!(half, point_to_polygon(DVec3::ZERO, DVec3::X, &front));
    assert!(half > 0.0);
}

#[test]
fn the_unit_cube() {
    const SIDE: Interval = [0.0, 1.0];
    let (lid, wall) = (parallel([SIDE; 2], [SIDE; 2], 1.0), perpendicular([SIDE; 2], [SIDE; 2]));
    assert_abs_diff_eq!(lid.value, 0.199_824_895_698_387, epsilon = 1e-15);
    assert_abs_diff_eq!(wall.value, 0.200_043_776_075_403, epsilon = 1e-15);
    assert!((lid.value + 4.0 * wall.value - 1.0).abs() <= lid.error + 4.0 * wall.error, "{lid:?} {wall:?}");
}

#[test]
fn a_block_is_254_texels() {
    assert_eq!((BLOCK, BLOCK * PER_TEXEL + OVERHEAD), (254, MAX_INSTRUCTIONS));
    assert_eq!([1, 254, 255, 1540].map(|n| passes(n, 1, BLOCK)), [1, 1, 2, 7]);
    assert_eq!([4, 1016, 1017, 2048].map(|n| passes(n, 4, BLOCK)), [1, 1, 2, 3]);
    assert_eq!((block(96), block(0)), (22, 1));
}

#[test]
fn a_block_of_the_paper_is_the_longest_that_fits() {
    let most = MAX_INSTRUCTIONS as usize;
    for kernel in BLOCKS {
        let [rest, each] = [kernel.overhead(), kernel.per_texel()];
        let block = kernel.block(most);
        let expected = if each == 4 { BLOCK as usize } else { 204 };
        assert!(rest >= 3 && block >= expected, "{}: {rest} and {each}", kernel.name);
    }
    for packing in [Packing::Rgb, Packing::Luminance] {
        let least = of(packing, false).map(|kernel| kernel.block(most)).into_iter().min();
        assert_eq!(least, Some(BLOCK as usize));
    }
}

#[test]
fn files_are_programs_for_one_texel() {
    for kernel in BLOCKS {
        let stripped = |text: &str| -> Vec<String> {
            text.lines().filter(|line| line.ends_with(';')).map(str::to_owned).collect()
        };
        assert_eq!(stripped(&kernel.unrolled(1)), stripped(kernel.text), "{}", kernel.name);
    }
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

#[test]
fn truncation_loses_half_a_step_per_term_and_partial_sums_lose_less() {
    let terms: Vec<f64> = (0..800).map(|j| (1.0 + f64::from(j % 97) / 97.0) / 1200.0).collect();
    let one = lost(TRUNCATED, &terms);
    // The sum is between 1 and 2.
    assert_abs_diff_eq!(one / (-800.0 / 2048.0), 1.0, epsilon = 0.2);
    let four = Accumulator { packing: Packing::Luminance, ..TRUNCATED };
    assert!(lost(four, &terms).abs() < 0.2 * one.abs());
}
