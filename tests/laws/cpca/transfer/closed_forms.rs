//! Occluders whose shadow is known.

use std::f64::consts::PI;

use crossbar::cpca::transfer::{Response, TracedRays, Transfer};
use crossbar::elementary::on_circle;
use crossbar::geom::Mesh;
use crossbar::sphere::{DirectionRule, function_index, harmonics};
use crossbar::study::prt::{ExitRadiance, Precomputation};
use crossbar::transfer::brdf::Brdf;
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;

use super::{Soup, caster, close, uniform};

/// A triangle at the origin that faces up, too small to affect visibility; its first corner is vertex 0.
fn observer() -> Soup {
    Soup(vec![[0.0; 3], [1e-4, 0.0, 0.0], [0.0, 1e-4, 0.0]])
}

fn diffuse(mesh: &Mesh, degree: usize, order: usize) -> (Transfer, TracedRays) {
    let vertices = Vertices::new(mesh, Tangents::Along(DVec3::X)).expect("vertices");
    let rays = TracedRays::trace(&vertices, DirectionRule::hemisphere(degree), &mut caster(mesh), false).expect("rays");
    let response = Response::diffuse(1.0, rays.rule()).expect("a response");
    (Transfer::new(&vertices, &rays, &[response], order, 0).expect("t_p"), rays)
}

#[test]
fn a_long_wall_shadows_as_the_formula_says() {
    for k in [0.25, 1.0, 4.0] {
        let mut soup = observer();
        soup.quad(DVec3::new(-1e4, 1.0, -1.0), DVec3::X * 2e4, DVec3::Z * (1.0 + k));
        let (transfer, rays) = diffuse(&soup.flat(), 511, 1);
        let expected = f64::midpoint(1.0, 1.0 / (1.0 + k * k).sqrt());
        // The wall's rim passes between directions: the error is at most one cosine-weighted step in z for each of 512
        // azimuths.
        let found = transfer.radiance(0, DVec3::Z, &uniform(1));
        close(found, expected, 2e-3, "irradiance over pi");
        assert!(rays.counts().buried.is_empty() && rays.counts().unclear.is_empty());
    }
}

/// A disk that looks down, as a fan.
fn disk(soup: &mut Soup, height: f64, radius: f64) {
    let corners = 2000;
    let at = |corner: i32| {
        let [x, y] = on_circle(f64::from(corner) / f64::from(corners));
        DVec3::new(radius * x, radius * y, height).as_vec3().into()
    };
    for corner in 0..corners {
        soup.0.extend([[0.0, 0.0, height as f32], at(corner + 1), at(corner)]);
    }
}

#[test]
fn a_disk_overhead_shadows_every_band_as_the_formula_says() {
    let (degree, order) = (63, 10);
    // The rim lies between two rings of the rule, so that the shadow consists of whole rings.
    let rule = DirectionRule::hemisphere(degree);
    for ring in [3, 12, 25] {
        let [below, above] = [ring, ring + 1].map(|ring| rule.directions()[ring * (degree + 1)].z);
        let cosine = f64::midpoint(below, above);
        let mut soup = observer();
        disk(&mut soup, 1.0, (1.0 - cosine * cosine).sqrt() / cosine);
        let (transfer, rays) = diffuse(&soup.flat(), degree, order);
        let blocked = (0..rule.len()).filter(|&direction| rays.is_blocked(0, direction)).count();
        assert_eq!(blocked, (31 - ring) * (degree + 1));
        // The sky is visible for z below the rim. The expected value is the integral of y z / pi over it, by a separate
        // rule; it is nonzero only for m = 0.
        let mut expected = [0.0; 100];
        let mut y = [0.0; 100];
        for (z, weight) in crossbar::quadrature::integral_points(0.0, cosine) {
            harmonics(order, DVec3::new((1.0 - z * z).sqrt(), 0.0, z), &mut y);
            for l in 0..order {
                let index = function_index(l, 0);
                expected[index] += weight * 2.0 * PI * y[index] * z / PI;
            }
        }
        // A ring's weight covers the band around it: the rim lies within half a step of the end of a band.
        let step = (above - below) * above * 1.1;
        for (index, expected) in expected.into_iter().enumerate() {
            let m_is_0 = index == function_index(index.isqrt(), 0);
            close(f64::from(transfer.of(0)[index]), expected, if m_is_0 { step } else { 1e-6 }, "a coefficient");
        }
        // Exact: the unblocked rings.
        let rings: f64 = (0..=ring).map(|ring| rule.weights()[ring * 64] * 64.0 * rule.directions()[ring * 64].z).sum();
        close(transfer.radiance(0, DVec3::Z, &uniform(100)), rings / PI, 1e-6, "radiance");
    }
}

#[test]
fn at_the_foot_of_a_wall_half_of_the_sky_is_seen() {
    // The floor ends in the middle of the wall's lower edge, and shares no vertex with it.
    let mut soup = Soup::default();
    soup.quad(DVec3::new(-1.0, -1.0, 0.0), DVec3::X * 2.0, DVec3::Y);
    soup.quad(DVec3::new(-1e4, 0.0, 0.0), DVec3::X * 2e4, DVec3::Z * 1e4);
    let mesh = soup.flat();
    let foot = Vertices::new(&mesh, Tangents::Along(DVec3::X)).expect("vertices");
    let foot = foot.positions().iter().position(|at| *at == [-1.0, 0.0, 0.0]).expect("a corner");
    // The rule has 32 azimuths, half of them toward the wall.
    let (transfer, rays) = diffuse(&mesh, 31, 3);
    close(transfer.radiance(foot, DVec3::Z, &uniform(9)), 0.5, 1e-7, "half of the sky");
    assert!(rays.counts().unclear.is_empty() && rays.counts().below_horizon == 0);
}

/// A circular wall with inner radius 1; `sine` is the sine of its elevation above the horizon.
fn bowl(sine: f64) -> Mesh {
    let mut soup = observer();
    let corners = 128;
    let height = sine / ((1.0 - sine) * (1.0 + sine)).sqrt();
    let at = |corner: i32| {
        let [x, y] = on_circle(f64::from(corner) / f64::from(corners));
        DVec3::new(x, y, -0.5)
    };
    for corner in 0..corners {
        soup.quad(at(corner + 1), at(corner) - at(corner + 1), DVec3::Z * (0.5 + height));
    }
    soup.flat()
}

/// Light in a bowl, computed with the default rule for transfer, has the same error bound for every height of the rim.
#[test]
fn bowls_of_any_height_cost_no_more_than_walls() {
    let albedo = Brdf::Lambert { albedo: 1.0 };
    let mut worst = 0.0_f64;
    for step in 0..12 {
        let sine = 0.06 + 0.05 * f64::from(step);
        let mesh = bowl(sine);
        let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
        let precomputation = Precomputation {
            mesh: &mesh,
            vertices: &vertices,
            channels: vec![(0, vec![albedo])],
            exit: ExitRadiance::Diffuse,
            order: 2,
            degree: 44,
            bounces: 0,
            scatterer: None,
        };
        let found = precomputation.run(&mut |_, _, _| ()).expect("transfer");
        let transfer = found.file.transfer.expect("transfer");
        let light = f64::from(transfer.point(0)[0]) * (4.0 * PI).sqrt();
        worst = worst.max((light / (1.0 - sine * sine) - 1.0).abs());
        assert_eq!(found.directions, 1058);
    }
    // The error was 3 % with a rule of 23 rings.
    assert!(worst < 5e-3, "{worst}");
}
