//! Rotating the whole scene, or dividing the work differently, does not change the result.

use crossbar::cpca::transfer::{Incident, Response, TracedRays, Transfer};
use crossbar::geom::{Mesh, Sides};
use crossbar::sphere::{DirectionRule, HarmonicRotation};
use crossbar::tracer::HostTracer;
use crossbar::transfer::brdf::{Brdf, ExitBasis};
use crossbar::transfer::{Tangents, Vertices};
use glam::{DMat3, DVec3};

use super::{close, mixed, step};

const AXIS: DVec3 = DVec3::new(0.3, 1.0, 0.2);

fn transfer(mesh: &Mesh, axis: DVec3) -> (Transfer, TracedRays, Response) {
    let vertices = Vertices::new(mesh, Tangents::Along(axis)).expect("vertices");
    let mut caster = HostTracer::new(mesh, Sides::Both);
    let rays = TracedRays::trace(&vertices, DirectionRule::hemisphere(15), &mut caster, true).expect("traced");
    let brdf = Brdf::AshikhminShirley { albedo: 0.4, specular: 0.3, exponents: [3.0, 20.0] };
    let incident = Incident::Harmonics { order: 5, inverse: true };
    let views = DirectionRule::hemisphere(40);
    let exit = ExitBasis::of_order(4);
    let response = Response::glossy(&brdf, &exit, true, incident, rays.rule(), &views).expect("a response");
    let responses = std::slice::from_ref(&response);
    let transfer = Transfer::new(&vertices, &rays, responses, 5, 0).expect("M_p");
    (transfer, rays, response)
}

fn turned(mesh: &Mesh, rotation: &DMat3) -> Mesh {
    let turn = |at: [f32; 3]| (*rotation * DVec3::from(at.map(f64::from))).as_vec3().to_array();
    let positions = mesh.positions().iter().map(|&at| turn(at)).collect();
    let normals = mesh.normals().expect("normals").iter().map(|&at| turn(at)).collect();
    Mesh::new(positions, mesh.triangles().to_vec()).and_then(|mesh| mesh.with_normals(normals)).expect("a mesh")
}

#[test]
fn turning_mesh_tangents_and_light_changes_nothing() {
    // Rotated, so that no ray runs along an edge.
    let mesh = turned(&step(), &DMat3::from_axis_angle(DVec3::new(0.36, -0.48, 0.8), 0.4));
    let light = mixed(25);
    let (before, rays, response) = transfer(&mesh, AXIS);
    let quarter = DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X);
    let any = DMat3::from_axis_angle(DVec3::new(0.48, 0.6, 0.64), 1.1);
    for rotation in [quarter, any] {
        let (after, turned_rays, _) = transfer(&turned(&mesh, &rotation), rotation * AXIS);
        let mut turned_light = vec![0.0; 25];
        HarmonicRotation::new(5, &rotation).expect("a rotation").apply(&light, &mut turned_light);
        assert_eq!(before.vertex_count(), after.vertex_count());
        let view = DVec3::new(0.48, 0.36, 0.8);
        let mut differ = 0;
        for vertex in 0..before.vertex_count() {
            let of =
                |direction: &usize| rays.is_blocked(vertex, *direction) != turned_rays.is_blocked(vertex, *direction);
            // Corners are rounded to single precision: a ray that just misses an edge may hit it.
            let flipped: Vec<usize> = (0..rays.rule().len()).filter(of).collect();
            differ += flipped.len();
            // A ray contributes its weight times the lobe toward the view and the light, both below 20.
            let share: f64 = flipped.iter().map(|&direction| 400.0 * rays.rule().weights()[direction]).sum();
            let [found, expected] =
                [after.radiance(vertex, view, &turned_light), before.radiance(vertex, view, &light)];
            close(found, expected, 2e-5 + share, "radiance");
        }
        let all = rays.rule().len() * before.vertex_count();
        assert!(1000 * differ < all, "{differ} of {all} rays differ");
    }
    assert!(rays.counts().blocked > 0 && response.basis().len() == 16);
}
