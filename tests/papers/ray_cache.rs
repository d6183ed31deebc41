//! Section 5.3: the ray cache's statistics, and the cost and gain of culling in the vertex program.

use crossbar::geom::exact::Sides;
use crossbar::geom::random::CounterRng;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Hit, Mesh, Ray};
use crossbar::ray_engine::engine::{EngineParameters, RayEngine};
use crossbar::scene::Camera;
use crossbar::tracer::HostTracer;
use glam::Vec3;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::ExecutorKind;
use refsim::timing::{Level, Model};

/// The reflected ray of a hit, slightly perturbed.
fn reflected(mesh: &Mesh, ray: &Ray, hit: &Hit, random: CounterRng, i: u64) -> Option<Ray> {
    let [a, b, c] = mesh.corners(hit.triangle)?.map(Vec3::from);
    let (n, d) = ((b - a).cross(c - a), Vec3::from(ray.direction()));
    let by = 2.0 * n.dot(d) / n.dot(n);
    let rough = Vec3::from([0, 1, 2].map(|k| 0.1 * (random.unit(i, 0, k) as f32 - 0.5)));
    let start = Vec3::from(ray.origin()) + 0.999 * hit.t * d;
    Ray::new(start.into(), (d - by * n + rough).into()).ok()
}

/// Eye rays and the reflected rays of their hits.
fn rays(mesh: &Mesh, side: u32) -> Vec<Ray> {
    let mut rays = Camera::teapot(side, side).expect("a camera").rays();
    let hits = HostTracer::new(mesh, Sides::Front).nearest_all(&rays).0;
    let random = CounterRng::new(5);
    let second: Vec<Ray> = (0..)
        .zip(rays.iter().zip(&hits))
        .filter_map(|(i, (ray, hit))| reflected(mesh, ray, hit.as_ref()?, random, i))
        .collect();
    rays.extend(second);
    rays
}

fn engine<'a>(mesh: &'a Mesh, device: &str, parameters: EngineParameters) -> RayEngine<'a> {
    let profile = Profile::named(device).expect("a profile");
    RayEngine::new(mesh, profile, ExecutorKind::Batch, parameters).expect("an engine")
}

/// Bucket occupancy of a ray tree, at its fullest and over time.
struct Cache {
    /// The mean fill of the tree's buckets, in [0, 1], with all rays in it.
    full: f64,
    /// The mean fill of the batches that left the tree, in [0, 1].
    batches: f64,
    /// Number of levels removed per batch that removed any.
    levels: f64,
}

fn cache(mesh: &Mesh, rays: &[Ray], shuffle: Option<u64>) -> Cache {
    let parameters = EngineParameters { shuffle, card: false, ..EngineParameters::default() };
    let mut engine = engine(mesh, "ideal-fp32", parameters);
    engine.submit(rays).expect("the host works");
    let full = engine.occupancy();
    engine.finish().expect("the host works");
    let tree = engine.counts().tree;
    Cache {
        full: full.iter().sum::<f64>() / full.len() as f64,
        batches: (tree.own + tree.stolen) as f64 / tree.batches as f64 / 256.0,
        levels: tree.levels_merged as f64 / tree.merges as f64,
    }
}

#[test]
fn buckets_are_as_full_as_the_paper_says_and_merge_as_little() {
    let mesh = teapot(5).expect("a teapot");
    let rays = rays(&mesh, 160);
    let (ordered, shuffled) = (cache(&mesh, &rays, None), cache(&mesh, &rays, Some(1)));
    assert!((0.5..=0.8).contains(&shuffled.full), "typically 50 to 80 % full: {}", shuffled.full);
    assert!(ordered.full < shuffled.full, "random order helps: {} and {}", ordered.full, shuffled.full);
    assert!(shuffled.batches > 0.85, "stealing fills batches: {}", shuffled.batches);
    assert!((1.0..1.6).contains(&shuffled.levels), "typically a single level: {}", shuffled.levels);
}

fn drawing(device: &str, log: &[Event]) -> u64 {
    let model = Model::new(Level::Pipeline, &Profile::named(device).expect("a card")).expect("a model");
    let cost = |event: &Event| match event {
        Event::Draw(record) => model.draw(record).total.0,
        _ => 0,
    };
    log.iter().map(cost).sum()
}

#[test]
fn culling_in_the_vertex_program_pays() {
    let mesh = teapot(5).expect("a teapot");
    let rays = rays(&mesh, 128);
    for (device, size, least) in [("r300", 64, 0.3), ("r300", 256, 0.05), ("nv35", 64, 0.3), ("r200", 64, 0.05)] {
        let [(drawn, whole), (culled, less)] = [false, true].map(|cull| {
            let parameters = EngineParameters { rays: size, cull, record: true, ..EngineParameters::default() };
            let mut engine = engine(&mesh, device, parameters);
            engine.trace(&rays).expect("the card works");
            (engine.counts(), drawing(device, &engine.take_log()))
        });
        let share = culled.culled as f64 / culled.pass_triangles as f64;
        assert!(share > least, "{device}, {size} rays a pass: {share} of {} triangles", culled.pass_triangles);
        assert!(less < whole, "{device}, {size} rays a pass: {whole} and {less} ps");
        assert_eq!(drawn.culled, 0);
    }
}

#[test]
fn testing_buckets_against_cells_pays() {
    let mesh = teapot(5).expect("a teapot");
    let rays = rays(&mesh, 160);
    let [(plain, hits), (beams, same)] = [false, true].map(|beams| {
        let parameters = EngineParameters { beams, card: false, ..EngineParameters::default() };
        let mut engine = engine(&mesh, "ideal-fp32", parameters);
        let hits = engine.trace(&rays).expect("the host works");
        (engine.counts(), hits)
    });
    assert_eq!(hits, same);
    let (before, after) = (plain.traversal.cells, beams.traversal.cells + beams.beam_cells);
    assert!(after < before && beams.beam_rays > 0, "{before} cells without, {after} with");
}
