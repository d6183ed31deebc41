//! An independent estimate: random directions instead of a rule, and no transfer.

use crossbar::cpca::transfer::{Bounces, Response, Transfer};
use crossbar::elementary::on_circle;
use crossbar::geom::Ray;
use crossbar::geom::random::CounterRng;
use crossbar::sphere::evaluate;
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;

use super::{caster, mixed, step, trace};

const SAMPLES: u64 = 40_000;

#[test]
fn random_directions_see_as_much_light() {
    let mesh = step();
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let rays = trace(&mesh, &vertices, 255);
    let (light, random, caster) = (mixed(25), CounterRng::new(4), caster(&mesh));
    let response = Response::diffuse(1.0, rays.rule()).expect("a response");
    let transfer = Transfer::new(&vertices, &rays, &[response], 5, Bounces::Count(0)).expect("t_p");
    let (mut squares, mut count) = (0.0, 0);
    for (vertex, (at, frame)) in vertices.positions().iter().zip(vertices.frames()).enumerate() {
        // Skips the edge between floor and wall, where an offset point would lie on one of them.
        if at[1] == 1.0 {
            continue;
        }
        let from = (DVec3::from(at.map(f64::from)) + 1e-4 * frame.normal()).as_vec3().to_array();
        let sample = |sample: u64| {
            let [u, turns] = [0, 1].map(|dimension| random.unit(vertex as u64, sample, dimension));
            let [x, y] = on_circle(turns);
            let towards = frame.to_global(DVec3::new(u.sqrt() * x, u.sqrt() * y, (1.0 - u).sqrt()));
            (towards, Ray::new(from, (16.0 * towards).as_vec3().to_array()).expect("a ray"))
        };
        let (directions, rays): (Vec<DVec3>, Vec<Ray>) = (0..SAMPLES).map(sample).unzip();
        let seen = directions.iter().zip(caster.occluded_all(&rays, 1.0).0);
        let values: Vec<f64> =
            seen.map(|(&towards, blocked)| if blocked { 0.0 } else { evaluate(&light, towards) }).collect();
        let mean = values.iter().sum::<f64>() / SAMPLES as f64;
        let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / SAMPLES as f64;
        let z = (transfer.radiance(vertex, DVec3::Z, &light) - mean) / (variance / SAMPLES as f64).sqrt();
        assert!(z.abs() < 4.5, "vertex {vertex}: {z} standard deviations");
        (squares, count) = (squares + z * z, count + 1);
    }
    let spread = (squares / f64::from(count)).sqrt();
    assert!(count > 20 && (0.6..1.4).contains(&spread), "{count} vertices, {spread} standard deviations on average");
}
