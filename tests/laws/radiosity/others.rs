//! Compares radiosity with independent methods: light by path tracing, scenes of other authors.

use std::f64::consts::PI;

use approx::abs_diff_eq;
use crossbar::geom::Ray;
use crossbar::geom::random::CounterRng;
use crossbar::geom::vector::narrow;
use crossbar::io::scenes;
use crossbar::radiosity::form_factor::{VisibilityParameters, point_to_polygon};
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::solve::{Options, Solver};
use crossbar::radiosity::{FormFactors, Patches, Subdivision, System};
use crossbar::renderer::Settings;
use crossbar::renderer::path::{self, Direct};
use crossbar::scene::Camera;
use crossbar::tracer::offset::scene_clearance;
use crossbar::tracer::{Caster, HostTracer};
use glam::DVec3;

use super::tracer;

const FULL: CornellBox = CornellBox { blocks: true, open: false };

/// Irradiance at a point with a normal: the radiosity of each open part of a patch, times its form factor from the
/// point, times the unblocked fraction of 4 x 4 rays, which the integrand weighs.
fn irradiance(patches: &Patches, b: &[[f64; 3]], [point, normal]: [DVec3; 2], tracer: &mut HostTracer) -> [f64; 3] {
    let (random, lift, mut sum) = (CounterRng::new(1), scene_clearance(patches.extent()), [0.0; 3]);
    let start = point + lift * normal;
    for (j, part) in (0..b.len()).flat_map(|j| patches.open_parts(j).iter().map(move |part| (j, part))) {
        let factor = point_to_polygon(point, normal, part.corners());
        if factor == 0.0 {
            continue;
        }
        let along = |stratum: u64, k: u64, d: u64| (stratum as f64 + random.unit(j as u64, k, d)) / 4.0;
        let (mut weights, mut rays, mut ends) = (Vec::new(), Vec::new(), Vec::new());
        for k in 0..16 {
            let there = part.at(along(k % 4, k, 0), along(k / 4, k, 1));
            let (to, way) = (there.at - point, there.at - start);
            let cosines = normal.dot(to).max(0.0) * (-part.normal().dot(to)).max(0.0);
            weights.push(there.density * cosines / (to.length_squared() * to.length_squared()));
            rays.push(Ray::new(narrow(start), narrow(way)).expect("a ray"));
            ends.push((1.0 - 2.0 * lift / way.length()) as f32);
        }
        let hits = tracer.cast(&rays).expect("hits").into_iter().zip(ends);
        let open =
            hits.map(|(hit, end)| hit.is_none_or(|hit| hit.t >= end || patches.face_of(hit.triangle) == part.face));
        let seen: f64 = open.zip(&weights).map(|(is_open, weight)| if is_open { *weight } else { 0.0 }).sum();
        let all: f64 = weights.iter().sum();
        let share = if seen == all { 1.0 } else { seen / all };
        (0..3).for_each(|c| sum[c] += factor * share * b[j][c]);
    }
    sum
}

/// Irradiance at points of the walls equals the radiance that a path tracer finds there, times pi over the reflectance.
#[test]
fn the_cornell_box_is_as_bright_as_paths_say() {
    let scene = rooms::cornell(FULL);
    let patches = Patches::new(&scene, Subdivision::AtMost(700)).expect("patches");
    let mut tracer = tracer(&scene);
    let parameters = VisibilityParameters { side: 2, ..VisibilityParameters::default() };
    let factors = FormFactors::with_visibility(&patches, &mut tracer, parameters, &mut |_, _| ()).expect("factors");
    let system = System::new(factors, patches.reflectances(), patches.emittances()).expect("a system");
    let b = system.solve(Solver::GaussSeidel, &Options::default()).expect("a solution").radiosity();
    let eye = [2.75, 0.3, 2.75];
    let white = [0.725_f64, 0.71, 0.68];
    let points = [
        ("back wall", [2.75, 5.5, 4.5], [0.0, -1.0, 0.0], white),
        ("floor", [4.6, 1.0, 0.0], [0.0, 0.0, 1.0], white),
        ("left wall", [0.0, 2.5, 3.5], [1.0, 0.0, 0.0], [0.63, 0.065, 0.05]),
        ("right wall", [5.5, 2.0, 3.0], [-1.0, 0.0, 0.0], [0.14, 0.45, 0.091]),
    ];
    for (name, at, normal, albedo) in points {
        let found = irradiance(&patches, &b, [at, normal].map(DVec3::from), &mut tracer);
        let camera = Camera::new(eye, at.map(|x| x as f32), [0.0, 0.1, 1.0], 1e-3, 1, 1).expect("a camera");
        let settings = Settings { samples: 6000, depth: 40, ..Settings::default() };
        let picture =
            path::render(&scene, &camera, &settings, Direct::Both, &mut tracer, &mut |_| ()).expect("a pixel");
        for c in 0..3 {
            let to_irradiance = PI / albedo[c];
            let (truth, sigma) = (picture.color[0][c] * to_irradiance, picture.variance[0][c].sqrt() * to_irradiance);
            assert!(
                abs_diff_eq!(found[c], truth, epsilon = 3.0 * sigma),
                "{name}, channel {c}: {} against {truth} +- {sigma}",
                found[c]
            );
        }
    }
}

#[test]
fn the_built_furnace_has_the_radiance_that_it_says() {
    let scene = scenes::named("white-box").expect("a scene");
    let patches = Patches::new(&scene, Subdivision::PerSide(3)).expect("patches");
    let mut factors = FormFactors::unoccluded(&patches).expect("factors");
    factors.enforce_closure().expect("closed");
    let system = System::new(factors, patches.reflectances(), patches.emittances()).expect("a system");
    let b = system.solve(Solver::Direct, &Options::default()).expect("a solution").radiosity();
    assert!(b.iter().flatten().all(|b| abs_diff_eq!(b / PI, 1.0, epsilon = 1e-12)), "radiance 1");
}
