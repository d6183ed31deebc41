//! Defects of a mesh are counted or refused.

use crossbar::cpca::transfer::{Response, TracedRays, Transfer};
use crossbar::geom::{Hit, Mesh, Ray};
use crossbar::sphere::DirectionRule;
use crossbar::tracer::{CastError, Caster};
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;

use super::{Soup, caster, step, trace};

#[test]
fn buried_vertices_are_listed() {
    let mut soup = Soup::default();
    soup.boxed(DVec3::splat(-0.5), DVec3::splat(0.5));
    soup.boxed(DVec3::splat(-2.0), DVec3::splat(2.0));
    let mesh = soup.flat();
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let rays = TracedRays::trace(&vertices, DirectionRule::hemisphere(10), &mut caster(&mesh), false).expect("traced");
    // The vertices of the inner box see back faces of the outer box.
    assert_eq!(rays.counts().dark, (0..24).collect::<Vec<u32>>());
    assert_eq!(rays.counts().buried, rays.counts().dark);
    assert_eq!(rays.counts().below_horizon, 0);
    let response = Response::diffuse(1.0, rays.rule()).expect("a response");
    let transfer = Transfer::new(&vertices, &rays, &[response], 2, 0).expect("t_p");
    assert!((0..24).all(|vertex| transfer.of(vertex) == [0.0; 4]));
    assert!((24..48).all(|vertex| transfer.of(vertex)[0] > 0.2));
}

#[test]
fn rays_into_the_surface_are_counted() {
    let mut soup = Soup::default();
    soup.quad(DVec3::ZERO, DVec3::X, DVec3::Y);
    let mesh = soup.mesh().welded();
    // Normals that point down, and normals that lie in the square's plane.
    for (normal, share) in [([0.0, 0.0, -1.0], 1.0), ([1.0, 0.0, 0.0], 0.5)] {
        let tilted = mesh.clone().with_normals(vec![normal; 4]).expect("normals");
        let vertices = Vertices::new(&tilted, Tangents::Any).expect("vertices");
        let counts = trace(&tilted, &vertices, 11).counts().clone();
        assert_eq!(counts.below_horizon as f64, share * counts.rays as f64);
        assert_eq!((counts.blocked, counts.dark.len() == 4), (counts.below_horizon, share == 1.0));
    }
}

#[test]
fn corners_that_no_origin_is_clear_of_are_listed() {
    // Two coincident squares back to back: the front of one is the back of the other.
    let mut soup = Soup::default();
    soup.quad(DVec3::ZERO, DVec3::X, DVec3::Y);
    soup.quad(DVec3::ZERO, DVec3::Y, DVec3::X);
    let mesh = soup.flat();
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    assert_eq!(trace(&mesh, &vertices, 5).counts().unclear.len(), 8);
}

#[test]
fn figures_that_do_not_fit_are_refused() {
    let mesh = step();
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let rays = TracedRays::trace(&vertices, DirectionRule::hemisphere(6), &mut caster(&mesh), false).expect("traced");
    let response = Response::diffuse(0.5, rays.rule()).expect("a response");
    let is_refused =
        |responses: &[Response], order, bounces| Transfer::new(&vertices, &rays, responses, order, bounces).is_err();
    let fits = [response.clone()];
    assert!(is_refused(&fits, 11, 0) && is_refused(&fits, 0, 0), "orders");
    assert!(is_refused(&[], 5, 0), "no material");
    assert!(is_refused(&fits, 5, 1), "hits were not kept");
    let other = Response::diffuse(0.5, &DirectionRule::hemisphere(8)).expect("a response");
    assert!(is_refused(&[other], 5, 0), "other directions");
    assert!(Response::diffuse(f64::NAN, rays.rule()).is_err());
    let elsewhere = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).expect("a mesh");
    let elsewhere = Vertices::new(&elsewhere, Tangents::Any).expect("vertices");
    assert!(Transfer::new(&elsewhere, &rays, &fits, 5, 0).is_err(), "other vertices");
}

/// A caster that fails.
struct Broken;

impl Caster for Broken {
    fn cast(&mut self, _: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        Err(CastError("out of order".into()))
    }
}

#[test]
fn a_failing_caster_is_reported() {
    let vertices = Vertices::new(&step(), Tangents::Any).expect("vertices");
    // The triangle of a blocked ray is always requested.
    let error = TracedRays::trace(&vertices, DirectionRule::hemisphere(6), &mut Broken, true).expect_err("refused");
    assert_eq!(error.to_string(), "the rays could not be traced");
}

#[test]
fn any_size_of_mesh_gives_the_same_transfer() {
    let of = |scale: f32| {
        let mesh = step();
        let positions = mesh.positions().iter().map(|at| at.map(|value| value * scale)).collect();
        let normals = mesh.normals().expect("normals").to_vec();
        let mesh = Mesh::new(positions, mesh.triangles().to_vec()).and_then(|mesh| mesh.with_normals(normals));
        let mesh = mesh.expect("a mesh");
        let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
        let rays = trace(&mesh, &vertices, 12);
        let response = Response::diffuse(0.5, rays.rule()).expect("a response");
        Transfer::new(&vertices, &rays, &[response], 4, 2).expect("t_p").into_values()
    };
    let unit = of(1.0);
    for power in [-60, 60, 90] {
        let scale = (0..i32::abs(power)).fold(1.0, |scale, _| if power < 0 { scale / 2.0 } else { scale * 2.0_f32 });
        assert_eq!(of(scale), unit, "2^{power}");
    }
}
