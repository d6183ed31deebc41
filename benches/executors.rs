//! Ray-triangle intersections a second on the emulated cards: the Ray Engine's own programs, 256 rays against 256
//! triangles, and a tile-major draw of many rays.
//!
//! `cargo bench --bench executors`. One element is one intersection: a fragment of one triangle's quad that the pixel program
//! ran for. Everything that a draw needs is in the time: textures, set-up, attributes, depth and colour.
//!
//! To beat: 114 M a second, a Radeon 8500 (the paper, section 4.4); docs/performance.md has what was measured.

use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput, measurement::WallTime};
use crossbar::geom::{Mesh, Sides, teapot::teapot};
use crossbar::ray_engine::{Crossbar, RayBatch};
use crossbar::scene::Camera;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use std::hint::black_box;

/// The formats of the first speed figures.
const FORMATS: [&str; 4] = ["s3.12", "fp16", "fp24", "fp32"];
/// Triangles in a draw.
const TRIANGLES: usize = 256;

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

fn intersect(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, kind: ExecutorKind, format: &str, rays: &RayBatch) {
    let profile = Profile::named(&format!("ideal-{format}")).expect("an ideal device of any format");
    let (mesh, card) = (mesh(), Crossbar::new(profile, kind).all_pairs(true));
    // Quads that the vertex program moved off the screen are no intersections.
    let shaded = card.intersect(&mesh, rays, Sides::Front).expect("the card intersects").events.fragments.shaded;
    group.throughput(Throughput::Elements(shaded));
    group.bench_function(BenchmarkId::new(name, format), |b| {
        b.iter(|| card.intersect(black_box(&mesh), black_box(rays), Sides::Front).expect("the card intersects"));
    });
}

fn executors(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("intersections");
    group.sample_size(10);
    let (few, many) = (rays(16), rays(256));
    for format in FORMATS {
        intersect(&mut group, "batch/256x256", ExecutorKind::Batch, format, &few);
        intersect(&mut group, "scalar/256x256", ExecutorKind::Scalar, format, &few);
        intersect(&mut group, "batch/65536x256", ExecutorKind::Batch, format, &many);
    }
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    executors(&mut criterion);
    criterion.final_summary();
}
