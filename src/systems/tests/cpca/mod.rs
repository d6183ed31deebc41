//! Matrices of harmonics per vertex, coherence of clusters, programs and their results on a card.

mod card;
mod kernels;
mod rays;
mod sizes;

use crossbar_systems::cpca::paper::Reference;
use crossbar_systems::transfer::brdf::Brdf;
use crossbar_systems::transfer::{Tangents, Vertices};
use glam::DVec3;

use crate::geom::Mesh;
use crate::sphere::{DirectionRule, harmonics};

/// Light of one harmonic at a triangle, which does not occlude its own hemisphere: the reference equals the rule's sum
/// over the harmonic by recurrence.
#[test]
fn harmonics_by_definition_are_those_by_recurrence() {
    let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.25, 0.5], [-0.5, 1.0, 0.25]], vec![[0, 1, 2]]).expect("a mesh");
    let (rule, brdf) = (DirectionRule::hemisphere(3), Brdf::Lambert { albedo: 1.0 });
    for axis in [DVec3::new(2.0, -3.0, 6.0), DVec3::new(-6.0, 2.0, -3.0), DVec3::Z] {
        let vertices = Vertices::new(&mesh, Tangents::Along(axis)).expect("vertices");
        let mut expected = [0.0; 100];
        for (&local, weight) in rule.directions().iter().zip(rule.weights()) {
            let mut values = [0.0; 100];
            harmonics(10, vertices.frames()[0].to_global(local), &mut values);
            let factor = weight * brdf.value(DVec3::Z, local) * local.z;
            expected.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * value);
        }
        for (index, expected) in expected.into_iter().enumerate() {
            let mut light = [0.0; 100];
            light[index] = 1.0;
            let reference = Reference { vertices: &vertices, brdfs: &[brdf], rule: &rule, light: &light };
            let found = reference.exit_radiance(0, DVec3::Z, 0);
            assert!((found - expected).abs() < 1e-10, "{index} at {axis}: {found} {expected}");
        }
    }
}
