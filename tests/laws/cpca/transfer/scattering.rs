//! The subsurface term, with the dipole of system 3.

use crossbar::cpca::transfer::{Incident, Response, ScatteringOptions, TracedRays, Transfer};
use crossbar::geom::Mesh;
use crossbar::sphere::DirectionRule;
use crossbar::subsurface::{Coefficients, Dipole, fresnel_transmittance};
use crossbar::transfer::brdf::{Brdf, ExitBasis};
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;

use super::{caster, close, mixed, step, uniform};
use crate::subsurface::polygon::point_to_polygon;

fn dipole() -> Dipole {
    Dipole::new(Coefficients { sigma_s_prime: 2.21, sigma_a: 0.0012 }, 1.3).expect("a medium")
}

/// Transfer of the irradiance that enters each vertex; all irradiance enters if `transmittance` is 1.
fn entering(mesh: &Mesh, order: usize, transmittance: fn(f64) -> f64) -> (Vertices, Transfer) {
    let vertices = Vertices::new(mesh, Tangents::Any).expect("vertices");
    let rays = TracedRays::trace(&vertices, DirectionRule::hemisphere(14), &mut caster(mesh), false).expect("traced");
    let response = Response::entering(transmittance, rays.rule());
    let entering = Transfer::new(&vertices, &rays, &[response], order, 0).expect("irradiance");
    (vertices, entering)
}

fn scattered(vertices: &Vertices, entering: &Transfer, mm_per_unit: f64, solid_angle: f64) -> Transfer {
    let (options, dipole) = (ScatteringOptions { mm_per_unit, solid_angle }, dipole());
    Transfer::scattered(vertices, entering, |r| dipole.r_d(r), options).expect("scattered")
}

/// A square of 2 x 2 with `cells` x `cells` quads, in the plane z = 0.
fn sheet(cells: u32) -> Mesh {
    let side = cells + 1;
    let at = |k: u32| 2.0 * k as f32 / cells as f32 - 1.0;
    let positions = (0..side * side).map(|k| [at(k % side), at(k / side), 0.0]).collect();
    let cell = |k: u32| k / cells * side + k % cells;
    let triangles = (0..cells * cells).map(cell).flat_map(|a| [[a, a + 1, a + side + 1], [a, a + side + 1, a + side]]);
    Mesh::new(positions, triangles.collect()).expect("a mesh")
}

#[test]
fn a_sheet_scatters_as_the_exact_polygon() {
    let cells = 60;
    let (vertices, entering) = entering(&sheet(cells), 1, |_| 1.0);
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    for mm in [2.0, 6.0] {
        let scattered = scattered(&vertices, &entering, mm, 0.0);
        for at in [[0.0, 0.0], [0.5, 0.2]] {
            let vertex = vertices.positions().iter().position(|p| (p[0] - at[0]).abs() + (p[1] - at[1]).abs() < 1e-5);
            let place = DVec3::new(f64::from(at[0]), f64::from(at[1]), 0.0) * mm;
            let polygon = corners.map(|[x, y]| DVec3::new(x, y, 0.0) * mm);
            // Irradiance is pi under uniform light, so the radiance equals the fraction of light that is returned.
            let expected = point_to_polygon(&dipole(), place, &polygon);
            let found = scattered.radiance(vertex.expect("a vertex"), DVec3::Z, &uniform(1));
            // The error of midpoints in cells of 1/15 and 1/5 mm, with a mean free path of 0.45 mm.
            close(found, expected, if mm < 3.0 { 2e-3 } else { 1e-2 }, "the share");
        }
    }
}

#[test]
fn a_sphere_under_uniform_light_is_what_is_known() {
    let mm = 3.0;
    let expected = dipole().disc(2.0 * mm);
    let errors = [8, 16, 32].map(|parts| {
        let (vertices, entering) = entering(&super::ball(parts), 1, |_| 1.0);
        let scattered = scattered(&vertices, &entering, mm, 0.01);
        let error = |vertex| (scattered.radiance(vertex, DVec3::Z, &uniform(1)) / expected - 1.0).abs();
        (0..vertices.len()).map(error).fold(0.0, f64::max)
    });
    // Edges of 0.6, 0.3 and 0.15 mm, with a mean free path of 0.45 mm: the convergence is of second order.
    assert!(errors[1] < errors[0] / 2.5 && errors[2] < errors[1] / 2.5 && errors[2] < 0.01, "{errors:?}");
}

#[test]
fn the_hierarchy_tends_to_all_pairs() {
    let (vertices, entering) = entering(&super::ball(8), 4, |cosine| fresnel_transmittance(1.3, cosine));
    let light = mixed(16);
    let of = |solid_angle| {
        let scattered = scattered(&vertices, &entering, 4.0, solid_angle);
        (0..vertices.len()).map(|vertex| scattered.radiance(vertex, DVec3::Z, &light)).collect::<Vec<f64>>()
    };
    let truth = of(0.0);
    let largest = truth.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let errors = [1.0, 0.1, 0.01].map(|solid_angle| {
        let differences = of(solid_angle).into_iter().zip(&truth).map(|(found, truth)| (found - truth).abs());
        differences.fold(0.0, f64::max) / largest
    });
    assert!(errors[0] > errors[1] && errors[1] > errors[2], "{errors:?}");
    assert!(errors[2] < 1e-3 && errors[0] > 0.0, "{errors:?}");
}

#[test]
fn what_cannot_scatter_is_refused() {
    let (vertices, entering) = entering(&step(), 3, |_| 1.0);
    let refused = |mm_per_unit, solid_angle| {
        let options = ScatteringOptions { mm_per_unit, solid_angle };
        Transfer::scattered(&vertices, &entering, |_| 1.0, options).expect_err("refused").to_string()
    };
    assert!(refused(0.0, 0.1).contains("mm per unit") && refused(1.0, f64::NAN).contains("solid angle"));
    let rays = super::trace(&step(), &vertices, 14);
    let (exit, incident) = (ExitBasis::of_order(3), Incident::Harmonics { order: 4, inverse: true });
    let views = DirectionRule::hemisphere(20);
    let gloss = Response::glossy(&Brdf::Lambert { albedo: 0.5 }, &exit, true, incident, rays.rule(), &views);
    let rows = Transfer::new(&vertices, &rays, &[gloss.expect("a response")], 3, 0).expect("a transfer");
    let options = ScatteringOptions { mm_per_unit: 1.0, solid_angle: 0.1 };
    let error = Transfer::scattered(&vertices, &rows, |_| 1.0, options).expect_err("9 rows").to_string();
    assert!(error.contains("rows, found 1 and 9"), "{error}");
}
