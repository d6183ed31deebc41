//! Speed of the emulated cards: criterion on modelled time.
//!
//! `cargo bench -p crossbar-benches --bench modelled`. The measure is the timeline of a run in picoseconds, so all
//! samples are equal on every machine, and any change is a change of the model. (Criterion's confidence intervals are
//! points.)
//!
//! There is no figure to beat; `crossbar reproduce` compares with the papers' figures. An element is one fragment of a
//! crossbar draw, i.e. a ray-triangle test. The group of the systems takes its times from what `crossbar reproduce`
//! draws, and has the printed figure in each name.

mod runs;

use criterion::{BenchmarkId, Criterion};
use crossbar::study::reproduce::timed;
use refsim::device::Profile;
use refsim::event::{Event, ReadBackMode};
use refsim::timing::replay::Options;
use refsim::timing::{Level, Model};
use refsim_criterion::ModelledTime;
use runs::Batches;

const CARDS: [&str; 2] = ["nv20", "nv25"];

/// The model of a card.
fn model(device: &str) -> Model {
    let profile = Profile::named(device).expect("a card of the project");
    Model::new(Level::Pipeline, &profile).expect("the card has a time")
}

type Group<'a> = criterion::BenchmarkGroup<'a, ModelledTime>;

fn measure(group: &mut Group<'_>, id: BenchmarkId, elements: u64, log: &[Event], model: &Model) {
    let options = Options { double_buffered: true, ..Options::default() };
    let time = ModelledTime::of(log, model, &options).expect("the log can be replayed");
    ModelledTime::measure(group, id, elements, time);
}

/// Fill versus read-back, by R rays and T triangles.
fn grid(criterion: &mut Criterion<ModelledTime>) {
    for device in CARDS {
        let (model, mut group) = (model(device), criterion.benchmark_group(format!("R x T, {device}")));
        for rays in [64, 256, 1024, 4096] {
            for triangles in [4, 10, 32, 128] {
                let run = Batches { rays, triangles, ..Batches::new(device) };
                let id = BenchmarkId::new(format!("R {rays}"), format!("T {triangles}"));
                measure(&mut group, id, run.tests(), &run.log(), &model);
            }
        }
        group.finish();
    }
}

/// Bytes per ray: ids of one, two and four bytes, and with barycentrics.
fn widths(criterion: &mut Criterion<ModelledTime>) {
    let (model, mut group) = (model("nv20"), criterion.benchmark_group("bytes read back a ray, nv20"));
    for bytes in [1, 2, 4, 16] {
        let run = Batches { read_back_bytes: bytes, ..Batches::new("nv20") };
        measure(&mut group, BenchmarkId::from_parameter(bytes), run.tests(), &run.log(), &model);
    }
    group.finish();
}

/// Sixteen batches as above, read back synchronously, and one batch later behind a fence.
fn asynchrony(criterion: &mut Criterion<ModelledTime>) {
    for device in CARDS {
        let (model, mut group) = (model(device), criterion.benchmark_group(format!("read-back, {device}")));
        for (name, mode) in [("synchronous", ReadBackMode::Synchronous), ("asynchronous", ReadBackMode::Asynchronous)] {
            let run = Batches { batches: 16, mode, ..Batches::new(device) };
            measure(&mut group, BenchmarkId::from_parameter(name), run.tests(), &run.log(), &model);
        }
        group.finish();
    }
}

/// Textures with the simulated cache, and without a cache.
fn cache(criterion: &mut Criterion<ModelledTime>) {
    for device in CARDS {
        let (model, mut group) = (model(device), criterion.benchmark_group(format!("texture cache, {device}")));
        for rays in [256, 4096] {
            let run = Batches { rays, observed: true, ..Batches::new(device) };
            let log = run.log();
            measure(&mut group, BenchmarkId::new("on", format!("R {rays}")), run.tests(), &log, &model);
            let log = runs::without_cache(log);
            measure(&mut group, BenchmarkId::new("off", format!("R {rays}")), run.tests(), &log, &model);
        }
        group.finish();
    }
}

/// A unit of work of each system. Printed: 114 M intersections per second on the Radeon 8500; 29.7 Jacobi iterations
/// per second; 1.8, 13.4 and 1.1 ms of the three passes on the head at 512 x 512; frames of systems 4 to 6 per second:
/// the bird 45.3, the glossy bunny 5.0, a view of the bunny 97.0 in Table I and 277.9 in Table II.
fn systems(criterion: &mut Criterion<ModelledTime>) {
    let mut group = criterion.benchmark_group("systems");
    for work in timed().expect("the cards take the work") {
        let id = BenchmarkId::new(format!("{} on {}", work.figure, work.device), format!("printed {}", work.printed));
        ModelledTime::measure(&mut group, id, work.items, work.time);
    }
    group.finish();
}

fn main() {
    let mut criterion = ModelledTime::criterion();
    grid(&mut criterion);
    widths(&mut criterion);
    asynchrony(&mut criterion);
    cache(&mut criterion);
    systems(&mut criterion);
    criterion.final_summary();
}
