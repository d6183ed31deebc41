//! Speed of the executors on the host: the Ray Engine's programs, 256 rays against 256 triangles; draws with one
//! bottleneck each; and ray-triangle tests of other crates.
//!
//! `cargo bench -p crossbar-benches --bench executors` measures, on two threads; `cargo bench -p crossbar-benches
//! --bench executors -- --table` writes the last measurement into docs/performance.md.
//!
//! An element is one fragment of the pixel program (in the crossbar's draws, an intersection), one vertex if the vertex
//! program is measured, or one test of the other crates. The time includes everything that a draw needs: textures,
//! vertices, set-up, attributes, depth and color, read-back. `resident` draws reuse textures, streams and targets,
//! which are cleared before each draw. `--table` also measures cards, and formats with different rules (`devices`).

mod devices;
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

/// The formats for which speed is measured.
const FORMATS: [&str; 4] = ["s3.12", "fp32", "fp16", "fp24"];
/// Triangles in a draw of the crossbar.
const TRIANGLES: usize = 256;
/// Suffix of the names of draws on a resident card.
const RESIDENT: &str = ", resident";
/// Number of threads used.
const THREADS: usize = 2;

/// 256 triangles of the teapot that face the camera, spread over all of it: the vertex program for rays of one origin
/// moves the quads of back faces off the screen.
fn mesh() -> Mesh {
    let whole = teapot(6).expect("the teapot tessellates");
    let eye = camera(1).eye().map(f64::from);
    let faces_the_eye = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|i| whole.positions()[i as usize].map(f64::from));
        let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
        let (e, f, to_eye) = (minus(b, a), minus(c, a), minus(eye, a));
        let normal = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
        let dot: f64 = normal.iter().zip(to_eye).map(|(n, o)| n * o).sum();
        let squares = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
        // Not edge-on, since a narrow format may make such a triangle face away.
        dot > 0.0 && dot * dot > 0.01 * squares(normal) * squares(to_eye)
    };
    let facing: Vec<[u32; 3]> = whole.triangles().iter().copied().filter(faces_the_eye).collect();
    let triangles: Vec<[u32; 3]> = (0..TRIANGLES).map(|i| facing[i * facing.len() / TRIANGLES]).collect();
    Mesh::new(whole.positions().to_vec(), triangles).expect("a part of the teapot is a mesh")
}

fn camera(side: u32) -> Camera {
    Camera::teapot(side, side).expect("the default camera takes any size")
}

/// Eye rays of the default camera, `side` by `side`.
fn rays(side: u32) -> RayBatch {
    RayBatch::new(side, side, camera(side).rays()).expect("a ray a pixel")
}

fn crossbar(criterion: &mut Criterion, name: &str, kind: ExecutorKind, rays: &RayBatch) {
    let mut group = criterion.benchmark_group("executors");
    group.sample_size(10);
    let mesh = mesh();
    for format in FORMATS {
        let profile = Profile::named(&format!("ideal-{format}")).expect("an ideal device of any format");
        let card = Crossbar::new(profile, kind).all_pairs(true);
        let shaded = card.intersect(&mesh, rays, Sides::Front).expect("the card intersects").events.fragments.shaded;
        assert_eq!(shaded, (TRIANGLES * rays.rays().len()) as u64, "{format}: every ray meets every triangle");
        group.throughput(Throughput::Elements(shaded));
        group.bench_function(BenchmarkId::new(format!("{name} {format}"), kind.name()), |b| {
            b.iter(|| card.intersect(black_box(&mesh), black_box(rays), Sides::Front).expect("the card intersects"));
        });
        let mut resident = card.make_resident(&mesh, rays, Sides::Front).expect("the card takes them");
        group.bench_function(BenchmarkId::new(format!("{name}{RESIDENT} {format}"), kind.name()), |b| {
            b.iter(|| black_box(resident.intersect().expect("the card intersects")));
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
            group.bench_function(BenchmarkId::new(scene.name, kind.name()), |b| {
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

fn pool(threads: usize) -> std::io::Result<rayon::ThreadPool> {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(std::io::Error::other)
}

fn main() -> std::io::Result<()> {
    if std::env::args().any(|argument| argument == "--table") {
        return pool(1)?.install(table::write);
    }
    // Called from a thread of the pool, as a renderer's worker would be: other callers wait for a worker to wake up.
    pool(THREADS)?.install(|| {
        let mut criterion = Criterion::default().configure_from_args();
        executors(&mut criterion);
        criterion.final_summary();
    });
    Ok(())
}
