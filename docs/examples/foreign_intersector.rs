//! The oracle judges other people's intersectors, the crates `bvh`, `obvhs` and `parry3d`, and this project's own host
//! tracer.
//!
//! `cargo run --release -p crossbar-benches --example foreign_intersector` prints the tables of foreign_intersector.md;
//! a test checks that the page has the same tables.
#![expect(clippy::print_stdout, reason = "an example prints")]

use std::fmt::Write as _;

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Hit, Mesh, Ray, Sides};
use crossbar::oracle::{Aim, DisagreementKind, Oracle, Report, Tolerance, hard_rays};
use crossbar::tracer::HostTracer;

fn main() {
    println!("{}\n{}", teapot_table(), walls_table());
}

/// Somebody's intersector over a mesh: rays in, hits out.
pub(crate) type Intersector<'a> = Box<dyn FnMut(&Ray) -> Option<Hit> + 'a>;

/// Intersectors under test, and the sides of a triangle that each can hit.
pub(crate) const LIBRARIES: [(&str, Sides); 4] =
    [("bvh 0.13", Sides::Front), ("obvhs 0.4", Sides::Both), ("parry3d 0.31", Sides::Both), ("crossbar", Sides::Both)];

/// The intersector of this name.
pub(crate) fn intersector<'a>(name: &str, mesh: &'a Mesh) -> Intersector<'a> {
    match name {
        "bvh 0.13" => with_bvh(mesh),
        "obvhs 0.4" => with_obvhs(mesh),
        "parry3d 0.31" => with_parry(mesh),
        _ => {
            let tracer = HostTracer::new(mesh, Sides::Both);
            Box::new(move |ray| tracer.nearest(ray).0)
        }
    }
}

/// A triangle with the fields that `bvh` needs.
struct Shape {
    id: u32,
    corners: [[f32; 3]; 3],
    node: usize,
}

impl Bounded<f32, 3> for Shape {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [a, b, c] = self.corners;
        let low = [0, 1, 2].map(|axis| a[axis].min(b[axis]).min(c[axis]));
        let high = [0, 1, 2].map(|axis| a[axis].max(b[axis]).max(c[axis]));
        Aabb::with_bounds(low.into(), high.into())
    }
}

impl BHShape<f32, 3> for Shape {
    fn set_bh_node_index(&mut self, node: usize) {
        self.node = node;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

fn with_bvh(mesh: &Mesh) -> Intersector<'_> {
    let shape = |(id, corners)| Shape { id, corners, node: 0 };
    let mut shapes: Vec<Shape> = (0..).zip(mesh.iter_corners()).map(shape).collect();
    let tree = bvh::bvh::Bvh::build(&mut shapes);
    Box::new(move |ray| {
        let [x, y, z] = ray.direction().map(f64::from);
        let length = (x * x + y * y + z * z).sqrt();
        // `bvh` normalises directions, so its distances are lengths.
        let foreign = bvh::ray::Ray::new(ray.origin().into(), ray.direction().into());
        let mut first: Option<Hit> = None;
        for shape in tree.traverse_iterator(&foreign, &shapes) {
            let [a, b, c] = shape.corners.map(Into::into);
            let distance = foreign.intersects_triangle(&a, &b, &c).distance;
            let t = (f64::from(distance) / length) as f32;
            if distance < f32::INFINITY && first.is_none_or(|first| t < first.t) {
                first = Some(Hit { triangle: shape.id, t });
            }
        }
        first
    })
}

fn with_obvhs(mesh: &Mesh) -> Intersector<'_> {
    use obvhs::ray::RayHit;
    use obvhs::triangle::Triangle;
    let triangle = |[a, b, c]: [[f32; 3]; 3]| Triangle { v0: a.into(), v1: b.into(), v2: c.into() };
    let triangles: Vec<Triangle> = mesh.iter_corners().map(triangle).collect();
    let parameters = obvhs::BvhBuildParams::medium_build();
    let tree = obvhs::cwbvh::builder::build_cwbvh_from_tris(&triangles, parameters, &mut Default::default());
    Box::new(move |ray| {
        let foreign = obvhs::ray::Ray::new_inf(ray.origin().into(), ray.direction().into());
        let mut hit = RayHit::none();
        let met = |ray: &obvhs::ray::Ray, at: usize| triangles[tree.primitive_indices[at] as usize].intersect(ray);
        let found = tree.ray_traverse(foreign, &mut hit, met);
        found.then(|| Hit { triangle: tree.primitive_indices[hit.primitive_id as usize], t: hit.t })
    })
}

/// Runs the triangle test of `parry3d` on all pairs, without a tree.
fn with_parry(mesh: &Mesh) -> Intersector<'_> {
    use parry3d::query::details::local_ray_intersection_with_triangle as intersection;
    let corners: Vec<_> = mesh.iter_corners().map(|[a, b, c]| [a.into(), b.into(), c.into()]).collect();
    Box::new(move |ray| {
        let foreign = parry3d::query::Ray::new(ray.origin().into(), ray.direction().into());
        let mut first: Option<Hit> = None;
        for (triangle, &[a, b, c]) in (0..).zip(&corners) {
            let Some((hit, _)) = intersection(a, b, c, &foreign) else { continue };
            if first.is_none_or(|first| hit.time_of_impact < first.t) {
                first = Some(Hit { triangle, t: hit.time_of_impact });
            }
        }
        first
    })
}

/// The number of wrong surfaces, as counted in the tables.
fn wrong(report: &Report) -> usize {
    [
        DisagreementKind::FalseHit,
        DisagreementKind::BackFace,
        DisagreementKind::WrongTriangle,
        DisagreementKind::WrongNeighbour,
    ]
    .map(|kind| report.count(kind))
    .iter()
    .sum()
}

/// Up to 2,000 hard rays of each kind at the teapot of 2,256 triangles: missed surfaces, and wrong surfaces.
pub(crate) fn teapot_table() -> String {
    let mesh = teapot(6).expect("a teapot");
    let rays = hard_rays(&mesh, 2000, 1);
    let mut out = String::from("| holes, wrong of 2,000 rays |");
    LIBRARIES.iter().for_each(|(name, _)| write!(out, " {name} |").expect("text"));
    out += "\n|---|---|---|---|---|\n";
    let oracles = LIBRARIES.map(|(_, sides)| Oracle::new(&mesh, sides, Tolerance::ANY_T));
    let mut asked = LIBRARIES.map(|(name, _)| intersector(name, &mesh));
    for aim in Aim::ALL {
        let rays: Vec<Ray> = rays.iter().filter(|hard| hard.aim == aim).map(|hard| hard.ray).collect();
        write!(out, "| {aim} |").expect("text");
        for (oracle, intersector) in oracles.iter().zip(&mut asked) {
            let report = oracle.examine(&rays, intersector);
            write!(out, " {}, {} |", report.leaks(), wrong(&report)).expect("text");
        }
        out += "\n";
    }
    out
}

/// Number of squares into which the walls divide each side.
const CELLS: u32 = 6;

/// Walls in the planes x, y and z = 0 to 6, each of 36 squares of two triangles.
pub(crate) fn walls() -> Mesh {
    let side = CELLS + 1;
    let vertex = |[x, y, z]: [u32; 3]| (x * side + y) * side + z;
    let point = |id: u32| [id / side / side, id / side % side, id % side].map(|x| x as f32);
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for place in 0..side * CELLS * CELLS {
            let at = |u: u32, v: u32| {
                let mut corner = [place / CELLS / CELLS, place / CELLS % CELLS + u, place % CELLS + v];
                corner.rotate_right(axis);
                vertex(corner)
            };
            triangles.extend([[at(0, 0), at(1, 0), at(1, 1)], [at(0, 0), at(1, 1), at(0, 1)]]);
        }
    }
    Mesh::new((0..side * side * side).map(point).collect(), triangles).expect("indices in range")
}

/// Rays along the axes from the middle of every cell: away from all walls, in the plane of a wall, or along the line of
/// two walls. `minus` tells which of the two zeros of a direction are -0.
pub(crate) fn wall_rays(free: [bool; 2], minus: [bool; 2]) -> Vec<Ray> {
    let mut rays = Vec::new();
    for cell in 0..CELLS * CELLS * CELLS {
        let corner = [cell / CELLS / CELLS, cell / CELLS % CELLS, cell % CELLS].map(|x| x as f32);
        for axis in 0..3 {
            for way in [1.0f32, -1.0] {
                let zero = |minus: bool| if minus { -0.0 } else { 0.0f32 };
                let (mut direction, mut offset) = ([way, zero(minus[0]), zero(minus[1])], [0.5, 0.0, 0.0]);
                offset[1] = if free[0] { 0.25 } else { 0.0 };
                offset[2] = if free[1] { 0.625 } else { 0.0 };
                direction.rotate_right(axis);
                offset.rotate_right(axis);
                let origin = [0, 1, 2].map(|axis| corner[axis] + offset[axis]);
                rays.extend(Ray::new(origin, direction));
            }
        }
    }
    rays
}

/// Counts holes in the walls, by the place of the ray and the signs of its zeros.
pub(crate) fn walls_table() -> String {
    let mesh = walls();
    let mut out = String::from("| holes in 1,296 rays | zeros |");
    LIBRARIES.iter().for_each(|(name, _)| write!(out, " {name} |").expect("text"));
    out += "\n|---|---|---|---|---|---|\n";
    let oracles = LIBRARIES.map(|(_, sides)| Oracle::new(&mesh, sides, Tolerance::ANY_T));
    let mut asked = LIBRARIES.map(|(name, _)| intersector(name, &mesh));
    for (place, free) in
        [("between walls", [true, true]), ("in a wall's plane", [false, true]), ("along two walls", [false, false])]
    {
        for minus in [[false, false], [false, true], [true, false], [true, true]] {
            let sign = minus.map(|minus| if minus { "-0" } else { "+0" });
            write!(out, "| {place} | {}, {} |", sign[0], sign[1]).expect("text");
            for (oracle, intersector) in oracles.iter().zip(&mut asked) {
                let report = oracle.examine(&wall_rays(free, minus), intersector);
                write!(out, " {} |", report.leaks()).expect("text");
            }
            out += "\n";
        }
    }
    out
}
