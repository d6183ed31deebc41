//! Exact consequences of equation 1, and its relation to the double integral of section 3.1.

use crossbar::cpca::paper::Reference;
use crossbar::cpca::transfer::{Incident, Response, TracedRays, Transfer};
use crossbar::geom::Mesh;
use crossbar::sphere::{DirectionRule, HarmonicRotation};
use crossbar::transfer::brdf::{Brdf, ExitBasis, brdf_matrix};
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;

use super::{close, mixed, step, trace};

const ORDER_5: Incident = Incident::Harmonics { order: 5, inverse: true };
const WARD: Brdf = Brdf::Ward { albedo: 0.2, specular: 0.4, roughness: [0.4, 0.7] };

fn vertices(mesh: &Mesh) -> Vertices {
    Vertices::new(mesh, Tangents::Along(DVec3::new(0.3, 1.0, 0.2))).expect("vertices")
}

fn glossy(brdf: &Brdf, exit: &ExitBasis, incident: Incident, rule: &DirectionRule) -> Response {
    Response::glossy(brdf, exit, true, incident, rule, &DirectionRule::hemisphere(40)).expect("a response")
}

#[test]
fn lambert_is_the_diffuse_path() {
    let mesh = step();
    let (vertices, lambert) = (vertices(&mesh), Brdf::Lambert { albedo: 0.8 });
    let rays = trace(&mesh, &vertices, 24);
    assert!(rays.counts().blocked > 0);
    for bounces in [0, 3] {
        let diffuse = Response::diffuse(0.8, rays.rule()).expect("a response");
        let diffuse = Transfer::new(&vertices, &rays, &[diffuse], 5, bounces).expect("t_p");
        for exit in [ExitBasis::of_order(5), ExitBasis::of_order(4), ExitBasis::without_1_0(5).expect("24")] {
            let response = glossy(&lambert, &exit, ORDER_5, rays.rule());
            let glossy = Transfer::new(&vertices, &rays, &[response], 5, bounces).expect("M_p");
            assert_eq!([glossy.row_count(), glossy.column_count()], [exit.len(), 25]);
            let y_0 = (1.0 / (4.0 * std::f64::consts::PI)).sqrt();
            for vertex in 0..vertices.len() {
                for (at, &value) in glossy.of(vertex).iter().enumerate() {
                    let expected = if at < 25 { f64::from(diffuse.of(vertex)[at]) / y_0 } else { 0.0 };
                    // Numbers up to 1 are rounded to single precision after each bounce.
                    close(f64::from(value), expected, 4e-7, "an element of M_p");
                }
            }
        }
    }
}

/// A convex body.
fn convex() -> Mesh {
    let mut soup = super::Soup::default();
    soup.boxed(DVec3::new(-1.0, -2.0, -0.5), DVec3::new(2.0, 1.0, 0.5));
    soup.flat()
}

#[test]
fn zero_hemisphere_projection_does_not_keep_lambert() {
    // The paper says that 20 % of energy is lost on average (section 3.2); the constant function loses half.
    let exit = ExitBasis::of_order(5);
    let (mesh, views) = (convex(), DirectionRule::hemisphere(40));
    let vertices = vertices(&mesh);
    let rays = trace(&mesh, &vertices, 20);
    let incident = Incident::Harmonics { order: 5, inverse: false };
    let (lambert, rule) = (Brdf::Lambert { albedo: 1.0 }, rays.rule());
    let zero = Response::glossy(&lambert, &exit, false, incident, rule, &views).expect("B");
    let [zero, least] = [zero, glossy(&lambert, &exit, ORDER_5, rule)]
        .map(|response| Transfer::new(&vertices, &rays, &[response], 5, 0).expect("M_p").of(0)[0]);
    close(f64::from(least), 1.0, 1e-7, "radiance 1 for radiance 1");
    assert!(zero < 0.6, "{zero}");
}

#[test]
fn unoccluded_transfer_is_the_brdf_turned() {
    let mesh = convex();
    let vertices = vertices(&mesh);
    let rays = trace(&mesh, &vertices, 8);
    assert_eq!((rays.counts().blocked, rays.rule().len()), (0, 45), "the least rule for order 5");
    let views = DirectionRule::hemisphere(40);
    for exit in [ExitBasis::of_order(5), ExitBasis::without_1_0(5).expect("24 functions")] {
        let response = glossy(&WARD, &exit, ORDER_5, rays.rule());
        let transfer = Transfer::new(&vertices, &rays, &[response], 5, 0).expect("M_p");
        let b = brdf_matrix(&WARD, &exit, 5, &views).expect("B");
        let ExitBasis::Harmonics(hemisphere) = &exit else { unreachable!("harmonics") };
        let expected = hemisphere.inverse().product(&b).expect("a product");
        for (vertex, frame) in vertices.frames().iter().enumerate() {
            let rotation = HarmonicRotation::new(5, &frame.matrix()).expect("a rotation");
            let largest = expected.rows().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
            for (found, row) in transfer.of(vertex).chunks(25).zip(expected.rows()) {
                let mut turned = vec![0.0; 25];
                rotation.apply(row, &mut turned);
                for (&found, expected) in found.iter().zip(turned) {
                    // One rounding to single precision.
                    close(f64::from(found), expected, 1e-7 * largest, "an element");
                }
            }
        }
    }
}

/// Transfer; all comparisons use the same rays, so that shadows are equal.
fn matrices(vertices: &Vertices, rays: &TracedRays, incident: Incident) -> Transfer {
    let response = glossy(&WARD, &ExitBasis::of_order(4), incident, rays.rule());
    Transfer::new(vertices, rays, &[response], 5, 0).expect("M_p")
}

#[test]
fn equation_1_tends_to_the_double_integral_as_the_inner_order_grows() {
    let mesh = step();
    let vertices = vertices(&mesh);
    let rays = trace(&mesh, &vertices, 40);
    let light = mixed(25);
    let truth = matrices(&vertices, &rays, Incident::Directions);
    let views = DirectionRule::hemisphere(10);
    let error = |order| {
        let transfer = matrices(&vertices, &rays, Incident::Harmonics { order, inverse: true });
        let squares = (0..vertices.len()).map(|vertex| {
            views.integral(|view| {
                let difference = transfer.radiance(vertex, view, &light) - truth.radiance(vertex, view, &light);
                difference * difference
            })
        });
        squares.sum::<f64>().sqrt()
    };
    let errors = [3, 4, 5, 7].map(error);
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
    assert!(errors[3] < 0.2 * errors[0], "{errors:?}");
}

#[test]
fn the_double_integral_is_the_projection_of_the_reference() {
    let mesh = step();
    let vertices = vertices(&mesh);
    let rays = trace(&mesh, &vertices, 14);
    let (light, views) = (mixed(25), DirectionRule::hemisphere(20));
    let exit = ExitBasis::of_order(3);
    let response =
        Response::glossy(&WARD, &exit, false, Incident::Directions, rays.rule(), &views).expect("a response");
    let transfer = Transfer::new(&vertices, &rays, &[response], 5, 0).expect("M_p");
    let reference = Reference { vertices: &vertices, brdfs: &[WARD], rule: rays.rule(), light: &light };
    for vertex in (0..vertices.len()).step_by(3) {
        let expected = views.project(3, |view| reference.exit_radiance(vertex, view, 0));
        for (row, expected) in transfer.of(vertex).chunks(25).zip(expected) {
            let found: f64 = row.iter().zip(&light).map(|(&m, l)| f64::from(m) * l).sum();
            close(found, expected, 1e-5, "a coefficient of exit radiance");
        }
    }
}
