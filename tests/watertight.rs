//! Classification of missed rays as leaks or silhouettes: Woop's watertight test passes on a closed curved mesh,
//! Moeller and Trumbore's does not, and both verdicts are checked against the facing of the triangles at each edge.
//! Needs the crate without its features.

#[expect(dead_code, reason = "as an example it prints what the tests look at")]
#[path = "../docs/examples/watertight.rs"]
mod watertight;

use std::sync::LazyLock;

use crossbar::geom::vector::wide;
use crossbar::geom::{Adjacency, Contact, Hit, Mesh, Ray, Sides, exact};
use crossbar::oracle::{Aim, Disagreement, DisagreementKind, HardRay, Oracle, Report, Tolerance, hard_rays};
use watertight::{TriangleTest, closed_surface, moeller_trumbore, nearest, tables, woop};

const SIZE: f64 = 1.37;

/// Mesh, rays, and report on a triangle test.
type Examined = (Mesh, Vec<HardRay>, Report);

/// Reports that several tests use, each with the oracle's nearby rays.
static WOOP: LazyLock<Examined> = LazyLock::new(|| examined(woop, 8));
static MOELLER_TRUMBORE: LazyLock<Examined> = LazyLock::new(|| examined(moeller_trumbore, 8));

fn examined(test: TriangleTest, nearby_ulps: u32) -> Examined {
    let mesh = closed_surface(SIZE);
    let rays = hard_rays(&mesh, 984, 1);
    let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T).with_nearby_ulps(nearby_ulps);
    let report = oracle.examine(&rays, |ray| nearest(&mesh, ray, test));
    (mesh, rays, report)
}

#[test]
fn the_mesh_is_closed() {
    let mesh = closed_surface(SIZE);
    assert_eq!((mesh.positions().len(), mesh.len(), mesh.degenerate_count()), (1830, 3660, 0));
    assert_eq!((mesh.boundary_edge_count(), mesh.orientation_conflicts()), (0, 0));
}

/// Sizes whose ratio is not a power of two, so that corner coordinates are rounded differently.
#[test]
fn a_watertight_test_passes() {
    for size in [1.0, 77.7] {
        let mesh = closed_surface(size);
        let rays = hard_rays(&mesh, 984, 2);
        let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T);
        oracle.assert_watertight(&rays, |ray| nearest(&mesh, ray, woop));
    }
}

/// Expects no leaks and no false hits. The oracle accepts triangles that tie at a vertex of the outline; otherwise 27
/// of Woop's answers would be false hits at any `nearby_ulps`. Rays in the planes of triangles are omitted: one of them
/// misses the first surface, as next to an outline, and returns a neighbor of the second.
#[test]
fn a_watertight_test_is_faithful() {
    for (size, each, seed) in [(SIZE, 984, 1), (77.7, 240, 3)] {
        let mesh = closed_surface(size);
        let mut rays = hard_rays(&mesh, each, seed);
        rays.retain(|hard| hard.aim != Aim::Plane);
        let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T);
        oracle.assert_faithful(&rays, |ray| nearest(&mesh, ray, woop));
        let rays = hard_rays(&mesh, 120, 2);
        assert!(oracle.faithful(&rays, |ray| nearest(&mesh, ray, moeller_trumbore)).is_err());
    }
}

/// Checks each `touched_by` ray with the exact tracer: its first hit shares a corner with the triangle found or ties
/// with it in depth, and its direction is within 9 epsilon of the examined ray's.
#[test]
fn touching_rays_prove_what_is_said() {
    let (mesh, _, report) = &*WOOP;
    let tied = |wrong: &&Disagreement| wrong.kind == DisagreementKind::Silhouette && wrong.touched_by.is_some();
    let mut seen = 0;
    for wrong in report.disagreements().iter().filter(tied) {
        let by = wrong.touched_by.expect("a ray");
        let truth = exact::nearest(mesh, &by, Sides::Both).expect("a hit");
        let found = wrong.found.expect("a hit").triangle;
        let adjacent = truth.ties.iter().any(|&first| mesh.contact(first, found) != Contact::None);
        let along = wide(by.direction());
        let depths = mesh
            .corners(found)
            .expect("a triangle")
            .map(|corner| (wide(corner) - wide(by.origin())).dot(along) / along.length_squared());
        let tied = depths.iter().any(|depth| (depth / truth.t.to_f64() - 1.0).abs() < 1e-5);
        assert!(adjacent || tied, "{wrong}");
        let off = (wide(by.direction()) - wide(wrong.direction)).abs().max_element();
        let largest = wide(wrong.direction).abs().max_element();
        assert!(off <= 9.0 * f64::from(f32::EPSILON) * largest && by.origin() == wrong.origin, "{wrong}");
        assert_eq!(wrong.right_for, None);
        seen += 1;
    }
    assert!(seen > 10, "{seen}");
    assert_eq!(report.count(DisagreementKind::FalseHit), 0, "{report}");
}

/// An intersector that enlarges triangles by a tenth leaves no leaks, and reports false hits just outside outlines.
#[test]
fn blown_up_triangles_are_false_hits() {
    let mesh = closed_surface(SIZE);
    let aside = |hard: HardRay| {
        let [x, y, z] = hard.ray.direction();
        Ray::new(hard.ray.origin(), [x + 3e-4, y - 2e-4, z + 1e-4]).expect("a ray")
    };
    let rays: Vec<Ray> = hard_rays(&mesh, 400, 1).into_iter().filter(|hard| hard.aim == Aim::Edge).map(aside).collect();
    let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T);
    let blown = |ray: &Ray, corners: [[f32; 3]; 3]| {
        let middle = (wide(corners[0]) + wide(corners[1]) + wide(corners[2])) / 3.0;
        woop(ray, corners.map(|corner| (middle + 1.1 * (wide(corner) - middle)).as_vec3().into()))
    };
    oracle.assert_faithful(&rays, |ray| nearest(&mesh, ray, woop));
    let wrong = oracle.faithful(&rays, |ray| nearest(&mesh, ray, blown)).expect_err("false hits");
    let false_hits = wrong.count(DisagreementKind::FalseHit) + wrong.count(DisagreementKind::WrongTriangle);
    assert!(false_hits > 0 && wrong.count(DisagreementKind::Leak) == 0, "{wrong}");
}

#[test]
fn what_it_misses_lies_beside_outlines() {
    let (mesh, rays, report) = &*WOOP;
    let adjacency = mesh.adjacency();
    let missed = |wrong: &&Disagreement| {
        // Seen from far away a triangle is smaller than an ULP, so its missed edges may be on the outline of another
        // triangle.
        let surface = wrong.expected.is_some() && (wrong.found.is_none() || wrong.met_at.is_some());
        wrong.kind == DisagreementKind::Silhouette && surface && rays[wrong.ray].aim != Aim::Far
    };
    let mut silhouettes = 0;
    for wrong in report.disagreements().iter().filter(missed) {
        assert!(passes_outline(mesh, &adjacency, wrong), "{wrong}");
        silhouettes += 1;
    }
    assert!(silhouettes > 10, "{silhouettes}");
    let strict = examined(woop, 0).2;
    assert!(strict.leaks() > 10 && strict.count(DisagreementKind::Silhouette) == 0, "{strict}");
}

#[test]
fn leaks_of_another_test_are_holes() {
    let (mesh, rays, report) = &*MOELLER_TRUMBORE;
    let adjacency = mesh.adjacency();
    assert!(report.by_aim(rays).count(Aim::Edge, DisagreementKind::LeakThrough) > 10, "{report}");
    let at_edges = report.disagreements().iter().filter(|wrong| rays[wrong.ray].aim == Aim::Edge);
    for wrong in at_edges.filter(|wrong| wrong.kind.is_leak()) {
        assert!(!aimed_edge_is_outline(mesh, &adjacency, wrong), "{wrong}");
        assert_eq!(wrong.right_for, None);
    }
}

/// Checks each `right_for` ray with the exact tracer: the answer is right for it, and its direction is within 9 epsilon
/// of the examined ray's.
#[test]
fn nearby_rays_prove_what_is_said() {
    for (mesh, _, report) in [&*WOOP, &*MOELLER_TRUMBORE] {
        let proved = report.disagreements().iter().filter_map(|wrong| Some((wrong, wrong.right_for?)));
        for (wrong, right) in proved {
            let truth = exact::nearest(mesh, &right, Sides::Both);
            match wrong.found {
                None => assert_eq!(truth, None, "{wrong}"),
                Some(hit) => assert!(truth.is_some_and(|truth| truth.ties.contains(&hit.triangle)), "{wrong}"),
            }
            let by = (wide(right.direction()) - wide(wrong.direction)).abs().max_element();
            let largest = wide(wrong.direction).abs().max_element();
            assert!(by <= 9.0 * f64::from(f32::EPSILON) * largest, "{wrong}");
            assert!(right.origin() == wrong.origin || wrong.kind != DisagreementKind::Silhouette, "{wrong}");
        }
    }
}

/// A miss through a hole in a tetrahedron is a leak, although every other triangle is a neighbor of the missed one.
#[test]
fn a_hole_is_a_hole_though_a_neighbour_shows_through() {
    let corners = vec![[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
    let mesh = Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]).expect("a mesh");
    let oracle = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T);
    let through = |x: f32, y: f32| Ray::new([x, y, 9.0], [0.0, 0.0, -1.0]).expect("a ray");
    let kind = |ray: Ray, triangle| {
        let report = oracle.examine(&[ray], |_| Some(Hit { triangle, t: 9.0 }));
        report.disagreements().first().map(|wrong| wrong.kind)
    };
    assert_eq!(kind(through(1.0, 1.0), 0), Some(DisagreementKind::LeakThrough));
    assert_eq!(kind(through(2.0 - 1e-6, 2.0 - 1e-6), 0), Some(DisagreementKind::WrongNeighbour), "beside their edge");
    let miss = |ray| oracle.examine(&[ray], |_| None).disagreements()[0].kind;
    assert_eq!(miss(through(2.0 - 1e-6, 2.0 - 1e-6)), DisagreementKind::Silhouette);
    assert_eq!(miss(through(1.0, 1.0)), DisagreementKind::Leak);
    let start = Ray::new([1.0, 1.0, 0.0], [0.0, 0.0, -1.0]).expect("a ray");
    assert_eq!(miss(start), DisagreementKind::Start);
}

/// The page quotes all digits, because they come from additions and multiplications in f32, which are equal on every
/// CPU.
#[test]
fn the_page_says_what_is_measured() {
    let page = include_str!("../docs/examples/foreign_intersector.md").replace('\r', "");
    let tables = tables();
    assert!(page.contains(&tables), "docs/examples/foreign_intersector.md has other tables than\n{tables}");
}

/// Checks the README's sentence about the two tests.
#[test]
fn the_readme_says_what_is_measured() {
    let readme = include_str!("../README.md").replace(['\r', '\n'], " ");
    let ((_, rays, leaky), (_, _, tight)) = (&*MOELLER_TRUMBORE, &*WOOP);
    assert_eq!(tight.leaks(), 0);
    let count = rays.len().to_string();
    let (thousands, rest) = count.split_at(count.len() - 3);
    let sentence = format!("finds {} holes among {thousands},{rest} rays", leaky.leaks());
    assert!(readme.contains(&sentence), "README.md does not say: {sentence}");
}

/// Dot product n . d of a triangle's normal and the ray's direction; its sign shows which side faces the ray.
fn facing(mesh: &Mesh, triangle: u32, wrong: &Disagreement) -> f64 {
    let [a, b, c] = mesh.corners(triangle).expect("a triangle of the mesh").map(wide);
    (b - a).cross(c - a).dot(wide(wrong.direction))
}

/// Returns `true` if the two triangles of an edge face in opposite directions, or the edge belongs to only one
/// triangle.
fn is_outline(mesh: &Mesh, triangles: &[u32], wrong: &Disagreement) -> bool {
    let [one, other] = triangles else { return true };
    facing(mesh, *one, wrong) * facing(mesh, *other, wrong) <= 0.0
}

fn missed_triangle(wrong: &Disagreement) -> u32 {
    wrong.expected.as_ref().expect("a surface was missed").triangle
}

/// Returns `true` if an edge at a corner of the missed triangle is on the outline.
fn passes_outline(mesh: &Mesh, adjacency: &Adjacency, wrong: &Disagreement) -> bool {
    let corners = mesh.triangles()[missed_triangle(wrong) as usize];
    let at_corner = |vertices: [u32; 2]| vertices.iter().any(|vertex| corners.contains(vertex));
    let mut edges = adjacency.edges().iter().filter(|edge| at_corner(edge.vertices));
    edges.any(|edge| is_outline(mesh, &edge.triangles, wrong))
}

/// Returns `true` if, of the missed triangle's three edges, the edge nearest to the ray is on the outline.
fn aimed_edge_is_outline(mesh: &Mesh, adjacency: &Adjacency, wrong: &Disagreement) -> bool {
    let distance = |edge: u32| {
        let ends = adjacency.edges()[edge as usize].vertices;
        let [from, to] = ends.map(|vertex| wide(mesh.positions()[vertex as usize]) - wide(wrong.origin));
        (from.cross(to).dot(wide(wrong.direction)) / from.cross(to).length()).abs()
    };
    let edges = adjacency.edges_of(missed_triangle(wrong)).into_iter().flatten();
    let nearest = edges.min_by(|&a, &b| distance(a).total_cmp(&distance(b))).expect("three edges");
    is_outline(mesh, &adjacency.edges()[nearest as usize].triangles, wrong)
}
