//! Host speed of ray casting: our octree compared with other crates' trees, in the same run, on the same rays.
//!
//! Figure to beat: the fastest correct traversal of the crate `bvh` 0.13, with its own ray-triangle test
//! (measured once: about 5 million rays per second on one thread; `obvhs` 8 to 15). Ratios compare times of one run.
//!
//! `cargo bench -p crossbar-benches --bench host_rays` measures with criterion; `cargo bench -p crossbar-benches
//! --bench host_rays -- --table` measures by repeated short runs and writes docs/performance.md. An element is one ray:
//! a primary ray finds the nearest hit, a shadow ray any hit before the light. Building the trees is not measured.

mod rooms;
mod table;
mod tracers;

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::geom::Ray;
use rooms::Room;
use std::hint::black_box;
use std::time::Duration;
use tracers::Tracer;

/// Numbers of threads that are measured.
const THREADS: [usize; 2] = [1, 2];

/// Name of a kind of rays, the rays, and the query.
type Kind = (&'static str, fn(&Room) -> &[Ray], fn(&dyn Tracer, &[Ray]) -> usize);
const KINDS: [Kind; 2] = [
    ("primary", |room| &room.primary, |tracer, rays| tracer.nearest(rays)),
    ("shadow", |room| &room.shadow, |tracer, rays| tracer.occluded(rays)),
];

fn host_rays(criterion: &mut Criterion, room: &Room) {
    let tracers = tracers::all(&room.mesh);
    tracers::compare(&tracers, room);
    let mut group = criterion.benchmark_group("host_rays");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    for (kind, rays, trace) in KINDS {
        let rays = rays(room);
        group.throughput(Throughput::Elements(rays.len() as u64));
        for threads in THREADS {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
            let what = format!("{}, {kind}, {threads}", room.name);
            for (who, tracer) in &tracers {
                group.bench_function(BenchmarkId::new(&what, who), |b| {
                    pool.install(|| b.iter(|| black_box(trace(tracer.as_ref(), black_box(rays)))));
                });
            }
        }
    }
    group.finish();
}

fn main() -> std::io::Result<()> {
    if std::env::args().any(|argument| argument == "--table") {
        return table::write();
    }
    let mut criterion = Criterion::default().configure_from_args();
    for room in rooms::all() {
        host_rays(&mut criterion, &room);
    }
    criterion.final_summary();
    Ok(())
}
