//! Host speed of transfer precomputation: the shadow rays of all vertices, and diffuse transfer from their results.
//!
//! Figure to beat: 30 million rays in 5 s on two threads, which is 10 s of processor time. An element is one ray,
//! traced or not. Measured once, on one thread of a shared EPYC (Zen 5), for a bumpy body of 49,990 vertices with 1,035
//! directions each, 36 % of them blocked: 10.1 s of processor time for 51.7 million rays, so 5.9 s for 30 million.
//!
//! `cargo bench -p crossbar-benches --bench transfer`

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::cpca::transfer::{Response, TracedRays, Transfer};
use crossbar::geom::{Mesh, Sides};
use crossbar::scene::built::transfer_models::TransferModel;
use crossbar::sphere::DirectionRule;
use crossbar::tracer::HostTracer;
use crossbar::transfer::{Tangents, Vertices};

/// 11 rings of 21 directions.
const DEGREE: usize = 20;

fn trace(mesh: &Mesh, vertices: &Vertices) -> TracedRays {
    let mut caster = HostTracer::new(mesh, Sides::Both);
    TracedRays::trace(vertices, DirectionRule::hemisphere(DEGREE), &mut caster, false).expect("traced")
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("transfer");
    group.sample_size(10).warm_up_time(Duration::from_millis(100));
    for (name, mesh) in [("bird", TransferModel::Bird.mesh(1)), ("buddha", TransferModel::FoldedBuddha.mesh(1))] {
        let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
        let rays = trace(&mesh, &vertices);
        group.throughput(Throughput::Elements(rays.counts().rays));
        group.bench_function(BenchmarkId::new("shadow rays", name), |bench| {
            bench.iter(|| black_box(trace(&mesh, &vertices)));
        });
        let response = [Response::diffuse(0.5, rays.rule()).expect("a response")];
        group.bench_function(BenchmarkId::new("diffuse, order 5", name), |bench| {
            bench.iter(|| black_box(Transfer::new(&vertices, &rays, &response, 5, 0).expect("t_p")));
        });
    }
    group.finish();
    criterion.final_summary();
}
