//! Tests interreflections against the reference and in white furnaces.

use crossbar::cpca::paper::Reference;
use crossbar::cpca::transfer::{Incident, Response, Transfer};
use crossbar::geom::Mesh;
use crossbar::sphere::DirectionRule;
use crossbar::transfer::brdf::{Brdf, ExitBasis};
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;

use super::{Soup, close, mixed, step, trace, uniform};

#[test]
fn two_materials_light_each_other() {
    let mesh = step();
    let materials: Vec<u32> = (0..mesh.len() as u32).map(|triangle| triangle / 3 % 2).collect();
    let vertices = Vertices::with_materials(&mesh, &materials, Tangents::Any).expect("vertices");
    let rays = trace(&mesh, &vertices, 7);
    let albedos = [0.9, 0.2];
    let responses = albedos.map(|albedo| Response::diffuse(albedo, rays.rule()).expect("a response"));
    let transfer = Transfer::new(&vertices, &rays, &responses, 3, 1).expect("t_p");
    let (light, brdfs) = (mixed(9), albedos.map(|albedo| Brdf::Lambert { albedo }));
    let reference = Reference { vertices: &vertices, brdfs: &brdfs, rule: rays.rule(), light: &light };
    for vertex in (0..vertices.len()).step_by(5) {
        close(transfer.radiance(vertex, DVec3::Z, &light), reference.exit_radiance(vertex, DVec3::Z, 1), 2e-5, "light");
    }
    let one = Transfer::new(&vertices, &rays, &responses[..1], 3, 0).expect_err("refused");
    assert!(one.to_string().starts_with("triangle 3 has material 1"), "{one}");
}

/// A box without a lid, whose faces look inwards.
fn open_box() -> Mesh {
    let mut soup = Soup::default();
    soup.quad(DVec3::ZERO, DVec3::X, DVec3::Y);
    soup.quad(DVec3::ZERO, DVec3::Z, DVec3::X);
    soup.quad(DVec3::Y, DVec3::X, DVec3::Z);
    soup.quad(DVec3::ZERO, DVec3::Y, DVec3::Z);
    soup.quad(DVec3::X, DVec3::Z, DVec3::Y);
    soup.flat()
}

#[test]
fn where_nothing_is_lost_everything_looks_like_the_sky() {
    let mesh = open_box();
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    assert_eq!(vertices.len(), 20);
    let rays = trace(&mesh, &vertices, 12);
    assert_eq!((rays.counts().from_behind, &rays.counts().dark[..]), (0, &[][..]));
    let light = uniform(25);
    let white = Response::diffuse(1.0, rays.rule()).expect("a response");
    let exit = ExitBasis::of_order(5);
    let incident = Incident::Harmonics { order: 5, inverse: true };
    let lambert = Brdf::Lambert { albedo: 1.0 };
    let views = DirectionRule::hemisphere(12);
    let glossy = Response::glossy(&lambert, &exit, true, incident, rays.rule(), &views).expect("a response");
    for response in [white, glossy] {
        let mut before = vec![0.0; vertices.len()];
        for count in [0, 1, 2, 5, 10] {
            let transfer =
                Transfer::new(&vertices, &rays, std::slice::from_ref(&response), 5, count).expect("a transfer");
            for (vertex, before) in before.iter_mut().enumerate() {
                let now = transfer.radiance(vertex, DVec3::Z, &light);
                assert!(now > *before && now < 1.0 + 1e-5, "{count} bounces: {before} then {now}");
                *before = now;
            }
        }
        let transfer = Transfer::new(&vertices, &rays, &[response], 5, 200).expect("a transfer");
        assert!(transfer.bounces.windows(2).all(|pair| pair[1] < pair[0]));
        for vertex in 0..vertices.len() {
            close(transfer.radiance(vertex, DVec3::Z, &light), 1.0, 2e-5, "the furnace");
        }
    }
}

#[test]
fn glossy_bounces_are_those_of_the_reference_where_bands_suffice() {
    // Where it is positive, a lobe of exponent 1 times s_z is a polynomial of degree 2 in the light and 1 in the view.
    let mesh = step();
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let rays = trace(&mesh, &vertices, 9);
    let brdf = Brdf::Phong { albedo: 0.3, specular: 0.5, exponent: 1.0 };
    let exit = ExitBasis::of_order(6);
    let views = DirectionRule::hemisphere(60);
    let response = Response::glossy(&brdf, &exit, true, Incident::Directions, rays.rule(), &views).expect("a response");
    let light = mixed(9);
    let transfer = Transfer::new(&vertices, &rays, &[response], 3, 1).expect("M_p");
    let reference = Reference { vertices: &vertices, brdfs: &[brdf], rule: rays.rule(), light: &light };
    for vertex in (0..vertices.len()).step_by(9) {
        for view in [DVec3::new(0.0, 0.0, 1.0), DVec3::new(0.36, -0.48, 0.8), DVec3::new(-0.8, 0.0, 0.6)] {
            let expected = reference.exit_radiance(vertex, view, 1);
            close(transfer.radiance(vertex, view, &light), expected, 0.02 * expected.abs().max(0.1), "exit radiance");
        }
    }
}

#[test]
fn parts_add_up() {
    let mesh = step();
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let rays = trace(&mesh, &vertices, 12);
    let exit = ExitBasis::of_order(4);
    let incident = Incident::Harmonics { order: 5, inverse: true };
    let response = |albedo, specular| {
        let brdf = Brdf::Phong { albedo, specular, exponent: 12.0 };
        let views = DirectionRule::hemisphere(40);
        Response::glossy(&brdf, &exit, true, incident, rays.rule(), &views).expect("a response")
    };
    let of = |response| Transfer::new(&vertices, &rays, &[response], 5, 0).expect("a transfer");
    let whole = of(response(0.4, 0.3));
    let mut gloss = of(response(0.0, 0.3));
    let diffuse = of(Response::diffuse(0.4, rays.rule()).expect("a response"));
    gloss.add(&diffuse).expect("the same vertices");
    for vertex in 0..vertices.len() {
        for (found, expected) in gloss.of(vertex).iter().zip(whole.of(vertex)) {
            close(f64::from(*found), f64::from(*expected), 1e-5, "an element");
        }
    }
    let error = diffuse.clone().add(&whole).expect_err("radiance holds no lobes");
    assert!(error.to_string().contains("1 and 16 functions"), "{error}");
}
