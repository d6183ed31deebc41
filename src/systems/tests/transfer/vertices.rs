//! Vertices of a mesh, their frames, and the origins of their rays.

use approx::assert_abs_diff_eq;
use crossbar_systems::cpca::transfer::TracedRays;
use crossbar_systems::transfer::{LocalFrame, Tangents, Vertices};
use glam::{DMat3, DVec3};

use crate::geom::{Mesh, Sides};
use crate::sphere::DirectionRule;
use crate::tracer::HostTracer;

#[test]
fn frames_are_orthonormal_and_right_handed() {
    let normals = [DVec3::X, -DVec3::Z, DVec3::new(0.36, 0.48, 0.8), DVec3::new(1e-9, 1.0, 0.0)];
    for normal in normals {
        let given = LocalFrame::new(normal, DVec3::new(0.3, -0.5, 7.0)).into_iter();
        for frame in given.chain([LocalFrame::of_normal(normal)]) {
            let m = frame.matrix();
            assert!((m.transpose() * m).abs_diff_eq(DMat3::IDENTITY, 1e-15));
            assert_abs_diff_eq!(m.determinant(), 1.0, epsilon = 1e-15);
            let v = DVec3::new(0.1, 0.2, -0.3);
            assert!(frame.to_local(frame.to_global(v)).abs_diff_eq(v, 1e-15));
            assert_eq!(frame.to_local(v).z, normal.dot(v));
        }
    }
}

#[test]
fn a_tangent_along_the_normal_makes_no_frame() {
    for tangent in [DVec3::ZERO, DVec3::Z, DVec3::new(1e-9, 0.0, -3.0), DVec3::NAN] {
        assert_eq!(LocalFrame::new(DVec3::Z, tangent), None);
    }
}

fn square() -> Mesh {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [5.0; 3]];
    Mesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh")
}

#[test]
fn vertices_are_shared_by_position_and_normal() {
    let vertices = Vertices::new(&square(), Tangents::Any).expect("vertices");
    assert_eq!((vertices.len(), vertices.unused), (4, 1));
    assert!(vertices.frames().iter().all(|frame| frame.normal() == DVec3::Z));
    let doubled = Mesh::new(
        vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        vec![[0, 1, 2], [3, 4, 5]],
    );
    let doubled = Vertices::new(&doubled.expect("a mesh"), Tangents::Any).expect("vertices");
    assert_eq!(doubled.triangles(), vertices.triangles());
    let two = Vertices::with_materials(&square(), &[0, 1], Tangents::Any).expect("vertices");
    assert_eq!((two.len(), two.materials()), (6, &[0, 0, 0, 1, 1, 1][..]));
}

#[test]
fn tangents_follow_the_texture_and_its_mirror() {
    let texture = |turned: f32| vec![[0.0, 0.0], [0.0, turned], [1.0, turned], [1.0, 0.0], [0.0, 0.0]];
    let tangent = |texture| {
        let mesh = square().with_texcoords(texture).expect("coordinates");
        let vertices = Vertices::new(&mesh, Tangents::Texture).expect("vertices");
        (vertices.frames()[0].tangent(), vertices.replaced_tangents.len())
    };
    assert_eq!(tangent(texture(1.0)), (DVec3::Y, 0));
    assert_eq!(tangent(texture(-1.0)), (DVec3::Y, 0));
    assert_eq!(tangent(vec![[0.5; 2]; 5]).1, 4, "without area");
    let mut mirrored = texture(1.0);
    mirrored[3] = [0.0, 2.0];
    let mesh = square().with_texcoords(mirrored).expect("coordinates");
    assert_eq!(Vertices::new(&mesh, Tangents::Texture).expect("vertices").len(), 6);
}

#[test]
fn bad_input_is_named() {
    let message = |mesh: &Mesh, tangents| Vertices::new(mesh, tangents).expect_err("refused").to_string();
    assert!(message(&square(), Tangents::Texture).contains("no texture coordinates"));
    assert!(message(&square(), Tangents::Along(DVec3::ZERO)).contains("an axis of finite length"));
    assert!(message(&Mesh::default(), Tangents::Any).contains("at least one triangle"));
    let flat = Mesh::new(vec![[0.0; 3], [1.0; 3], [2.0; 3]], vec![[0, 1, 2]]).expect("a mesh");
    assert!(message(&flat, Tangents::Any).starts_with("vertex 0 (counted from 0) has no normal"));
    let given = flat.with_normals(vec![[0.0, 0.0, 2.0]; 3]).expect("normals");
    assert_eq!(Vertices::new(&given, Tangents::Any).expect("vertices").len(), 3);
    assert!(Vertices::with_materials(&given, &[], Tangents::Any).is_err());
    let along = Vertices::new(&given, Tangents::Along(DVec3::Z)).expect("vertices");
    assert_eq!(along.replaced_tangents, [0, 1, 2]);
}

/// From the corner of a room, the three walls hide all directions outside the octant between them.
#[test]
fn corners_of_a_room_are_left_to_the_inside() {
    let mesh = Mesh::new(
        vec![[7.0; 3], [8.0, 7.0, 7.0], [7.0, 8.0, 7.0], [7.0, 7.0, 8.0]],
        vec![[0, 1, 2], [0, 3, 1], [0, 2, 3]],
    );
    let mesh = mesh.expect("a mesh");
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let (mut caster, rule) = (HostTracer::new(&mesh, Sides::Both), DirectionRule::hemisphere(31));
    let traced = TracedRays::trace(&vertices, rule, &mut caster, false).expect("traced");
    assert!(!traced.counts().unclear.contains(&0) && !traced.counts().dark.contains(&0));
    for (at, &local) in traced.rule().directions().iter().enumerate() {
        let direction = vertices.frames()[0].to_global(local);
        if direction.abs().min_element() > 0.01 {
            assert_eq!(traced.is_blocked(0, at), direction.min_element() < 0.0, "{direction}");
        }
    }
}
