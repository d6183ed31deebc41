//! How fast the executors are, on the host: the Ray Engine's own programs, 256 rays against 256 triangles, and draws that
//! are bound by one thing each; beside them, ray-triangle tests of other people's crates.
//!
//! `cargo bench --bench executors` measures, on two threads; `cargo bench --bench executors -- --table` writes what was
//! measured last into docs/performance.md.
//!
//! One element is one fragment that the pixel program ran for (an intersection, in the crossbar's draws), one vertex where
//! the vertex program is measured, one test of the yardsticks. Everything that a draw needs is in the time: textures, vertices, set-up,
//! attributes, depth and colour, read-back.

mod scenes;
mod table;
mod yardsticks;

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::geom::{Mesh, Sides, teapot::teapot};
use crossbar::ray_engine::{Crossbar, RayBatch};
use crossbar::scene::Camera;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use std::hint::black_box;

/// The formats of the speed figures.
const FORMATS: [&str; 4] = ["s3.12", "fp32", "fp16", "fp24"];
/// Triangles in a draw of the crossbar.
const TRIANGLES: usize = 256;
/// Threads of the figures.
const THREADS: usize = 2;

/// The first 256 triangles of the teapot.
fn mesh() -> Mesh {
    let whole = teapot(4).expect("the teapot tessellates");
    let triangles = whole.triangles()[..TRIANGLES].to_vec();
    Mesh::new(whole.positions().to_vec(), triangles).expect("a part of the teapot is a mesh")
}

/// Eye rays of the default camera, `side` by `side`.
fn rays(side: u32) -> RayBatch {
    let camera = Camera::teapot(side, side).expect("the default camera takes any size");
    RayBatch::new(side, side, camera.rays()).expect("a ray a pixel")
}

fn executor_name(kind: ExecutorKind) -> &'static str {
    match kind {
        ExecutorKind::Scalar => "scalar",
        ExecutorKind::Batch => "batch",
        #[cfg(feature = "wgpu")]
        ExecutorKind::Wgpu => "wgpu",
    }
}

fn crossbar(criterion: &mut Criterion, name: &str, kind: ExecutorKind, rays: &RayBatch) {
    let mut group = criterion.benchmark_group("executors");
    group.sample_size(10);
    let mesh = mesh();
    for format in FORMATS {
        let profile = Profile::named(&format!("ideal-{format}")).expect("an ideal device of any format");
        let card = Crossbar::new(profile, kind).all_pairs(true);
        // Quads that the vertex program moved off the screen are no intersections.
        let shaded = card.intersect(&mesh, rays, Sides::Front).expect("the card intersects").events.fragments.shaded;
        group.throughput(Throughput::Elements(shaded));
        group.bench_function(BenchmarkId::new(format!("{name} {format}"), executor_name(kind)), |b| {
            b.iter(|| card.intersect(black_box(&mesh), black_box(rays), Sides::Front).expect("the card intersects"));
        });
    }
    group.finish();
}

fn draws(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("executors");
    group.sample_size(10);
    for kind in [ExecutorKind::Batch, ExecutorKind::Scalar] {
        for scene in scenes::all(kind) {
            let mut card = scenes::Card::new(&scene, kind);
            group.throughput(Throughput::Elements(card.elements(&scene)));
            group.bench_function(BenchmarkId::new(scene.name, executor_name(kind)), |b| {
                b.iter(|| black_box(card.draw(&scene)));
            });
        }
    }
    group.finish();
}

fn executors(criterion: &mut Criterion) {
    let few = rays(16);
    crossbar(criterion, "256 rays x 256 triangles", ExecutorKind::Batch, &few);
    crossbar(criterion, "65536 rays x 256 triangles", ExecutorKind::Batch, &rays(256));
    crossbar(criterion, "256 rays x 256 triangles", ExecutorKind::Scalar, &few);
    draws(criterion);
    yardsticks::run(criterion, &mesh(), &few);
}

fn main() -> std::io::Result<()> {
    if std::env::args().any(|argument| argument == "--table") {
        return table::write();
    }
    rayon::ThreadPoolBuilder::new().num_threads(THREADS).build_global().map_err(std::io::Error::other)?;
    let mut criterion = Criterion::default().configure_from_args();
    executors(&mut criterion);
    criterion.final_summary();
    Ok(())
}
