//! Host speed of subsurface scattering: links of an atlas, and pass 2 on the batch executor compared with an f32 loop.
//!
//! Figures to beat: 16 fixed links per texel of 1024 x 1024 in the paper's 9 s on two threads; gathering texels in
//! squares at least three times as fast as texel by texel; pass 2 at most five times the loop's time. Ratios compare
//! times of one run. An element is one texel. Measured once, on two cores: 6.9 s; 0.47 s on one core for every 64th
//! texel alone, so squares are only 2.2 times as fast, which misses the goal. Pass 2: 22.8 ms on two threads compared
//! with 4.7 ms for the loop on one thread, 4.9 times.
//!
//! `cargo bench -p crossbar-benches --bench subsurface`

use criterion::{BenchmarkId, Criterion, Throughput};
use crossbar::atlas::Atlas;
use crossbar::scene::built::stand_ins;
use crossbar::subsurface::links::{LinkChoice, Links, MeanWeighting};
use crossbar::subsurface::multipole::{ClusterId, Factors, SurfaceMoments, TOLERANCE};
use crossbar::subsurface::on_card::{
    CardModel, FloatTexels, Light, LightStage, LinkTextures, MapFormat, SubsurfaceCard, SubsurfaceCardOptions,
};
use crossbar::subsurface::{Coefficients, Dipole};
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use std::hint::black_box;
use std::time::Duration;

/// Texels along a side, as in Table 1 of the paper.
const SIDE: u32 = 1024;
/// Level of the atlas with 16 clusters.
const LEVEL: u32 = SIDE.ilog2() - 2;
/// Scale for a stand-in about 4 units long.
const MM_PER_UNIT: f64 = 20.0;
/// One in this many texels is gathered alone, for comparison.
const STEP: usize = 64;

/// The medium of the paper's Figure 7.
fn medium() -> Dipole {
    Dipole::new(Coefficients { sigma_s_prime: 2.21, sigma_a: 0.0012 }, 1.3).expect("a medium")
}

fn links(criterion: &mut Criterion, surface: &SurfaceMoments) {
    let factors = Factors::new(surface, [medium()], TOLERANCE).expect("a tolerance");
    let texels = u64::from(SIDE) * u64::from(SIDE);
    let mut group = criterion.benchmark_group("links");
    group.sample_size(10).warm_up_time(Duration::from_millis(100));
    group.throughput(Throughput::Elements(texels));
    for (name, choice) in
        [("16 fixed", LinkChoice::Fixed { level: LEVEL }), ("16 adaptive", LinkChoice::Adaptive { count: 16 })]
    {
        group.bench_function(BenchmarkId::new(name, SIDE), |bencher| {
            bencher.iter(|| black_box(Links::with(&factors, choice).expect("links")));
        });
    }
    group.throughput(Throughput::Elements(texels / STEP as u64));
    let clusters: Vec<_> = (0..16).map(|k| ClusterId { level: LEVEL, y: k / 4, x: k % 4 }).collect();
    group.bench_function(BenchmarkId::new("16 fixed, one texel in 64, alone, one thread", SIDE), |bencher| {
        bencher.iter(|| {
            let mut receiver = factors.receiver();
            let mut sum = 0.0;
            for texel in (0..SIDE * SIDE).step_by(STEP).map(|k| [k % SIDE, k / SIDE]) {
                sum += clusters.iter().map(|&cluster| receiver.factor(texel, cluster)[0]).sum::<f64>();
            }
            black_box(sum)
        });
    });
    group.finish();
}

/// Pass 2 as a plain loop on one thread: four factors of a texel at a time.
fn plain_gather(links: &Links, means: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let gather = |factors: &[f32]| {
        let mut sum = [0.0_f32; 4];
        for (factor, mean) in factors.iter().zip(means) {
            sum.iter_mut().zip(mean).for_each(|(sum, mean)| *sum += factor * mean);
        }
        sum
    };
    links.factors().chunks_exact(means.len()).map(gather).collect()
}

fn gathers(criterion: &mut Criterion, atlas: &Atlas, surface: &SurfaceMoments) {
    let choice = LinkChoice::Fixed { level: LEVEL };
    let links = Links::new(surface, &[medium()], choice, TOLERANCE).expect("links");
    let textures = LinkTextures::new(&links, surface, MeanWeighting::Count);
    let options = SubsurfaceCardOptions {
        light: LightStage::Vertices,
        map: MapFormat::Fp32,
        links: FloatTexels::Fp32,
        scattered: FloatTexels::Fp32,
        ..SubsurfaceCardOptions::default()
    };
    let nv35 = Profile::named("nv35").expect("a card");
    let mut card =
        SubsurfaceCard::new(nv35, ExecutorKind::Batch, CardModel::new(atlas), &textures, 1.3, options).expect("a card");
    card.light(&[Light::Directional { towards: [1.0, 2.0, 3.0], irradiance: [0.5, 0.4, 0.3] }]).expect("light");
    let means = card.read_levels().expect("levels").swap_remove(LEVEL as usize).texels;
    let plain = plain_gather(&links, &means);
    for (found, expected) in card.read_scattered().expect("a map").texels.iter().zip(&plain) {
        assert_eq!(found[..3], expected[..3], "pass 2 is the loop");
    }
    let mut group = criterion.benchmark_group("pass 2, 16 fixed links");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(3));
    group.throughput(Throughput::Elements(u64::from(SIDE) * u64::from(SIDE)));
    group.bench_function(BenchmarkId::new("plain loop, one thread", SIDE), |bencher| {
        bencher.iter(|| black_box(plain_gather(&links, black_box(&means))));
    });
    group.bench_function(BenchmarkId::new("batch executor, all threads", SIDE), |bencher| {
        bencher.iter(|| card.gather().expect("a pass"));
    });
    group.finish();
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let atlas = Atlas::new(&stand_ins::bunny(), SIDE).expect("an atlas");
    let surface = SurfaceMoments::new(&atlas, MM_PER_UNIT).expect("a scale");
    links(&mut criterion, &surface);
    gathers(&mut criterion, &atlas, &surface);
    criterion.final_summary();
}
