//! The methods of waiting for the card: the log of each, and its effect on the time.

use std::collections::BTreeSet;

use crate::support::profile;
use crossbar::geom::Hit;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Mesh, Ray};
use crossbar::ray_engine::engine::{EngineCounts, EngineParameters, RayEngine, Readback};
use crossbar::scene::Camera;
use crossbar::tracer::octree::OctreeParameters;
use refsim::event::{Event, FenceId, ReadBackMode};
use refsim::machine::ExecutorKind;
use refsim::timing::host::{CPU_ONLY_RAYS_PER_SECOND, HostCounts, HostModel, HostOperation};
use refsim::timing::replay::{Options, Replay, replay};
use refsim::timing::{Level, Model};

struct Run {
    hits: Vec<Option<Hit>>,
    counts: EngineCounts,
    log: Vec<Event>,
}

fn run(mesh: &Mesh, rays: &[Ray], parameters: EngineParameters) -> Run {
    let octree = OctreeParameters { most_triangles: 4, most_depth: 6 };
    // The tree is small, so buckets leave it while rays still enter.
    let parameters = EngineParameters { octree, rays: 32, waiting: 600, record: true, ..parameters };
    let mut engine = RayEngine::new(mesh, profile("ideal-fp32"), ExecutorKind::Batch, parameters).expect("an engine");
    let hits = engine.trace(rays).expect("the card works");
    Run { hits, counts: engine.counts(), log: engine.take_log() }
}

fn with(readback: Readback) -> EngineParameters {
    EngineParameters { readback, ..EngineParameters::default() }
}

fn host_work(log: &[Event]) -> HostCounts {
    let mut out = HostCounts::default();
    for event in log {
        if let Event::Host(work) = event {
            out.add(work.kind, work.operations);
        }
    }
    out
}

/// Replays the run in modelled time: commands come from the log, durations from the card's figures.
fn timed(run: &Run, host: &HostModel) -> Replay {
    let model = Model::new(Level::Pipeline, &profile("nv35")).expect("a model");
    replay(&run.log, &model, &Options { host: Some(host), ..Options::of(Level::Pipeline) }).expect("a good log")
}

#[test]
fn waiting_changes_the_time_and_the_log_and_never_a_hit() {
    let mesh = teapot(3).expect("a teapot");
    let rays = Camera::teapot(64, 48).expect("a camera").rays();
    let alone = run(&mesh, &rays, EngineParameters { card: false, ..with(Readback::Synchronous) });
    let host = HostModel::calibrate(&host_work(&alone.log), rays.len() as u64, CPU_ONLY_RAYS_PER_SECOND)
        .expect("the host did something");
    let modes = [
        Readback::Synchronous,
        Readback::Asynchronous { passes: 1 },
        Readback::Asynchronous { passes: 4 },
        Readback::InfinitelyFast,
    ];
    let runs = modes.map(|mode| run(&mesh, &rays, with(mode)));
    for (mode, found) in modes.iter().zip(&runs) {
        assert_eq!(found.hits, alone.hits, "{mode:?}");
        assert!(found.counts.passes > 20, "{mode:?}: {} passes", found.counts.passes);
    }
    let [synchronous, one, four, infinite] = runs.each_ref().map(|run| timed(run, &host).timeline.makespan().0);
    // Each entry of host work is rounded up to a picosecond, and passes divide equal work into different entries.
    let rounding = runs[2].log.len() as u64;
    assert!(four <= one + rounding && one < synchronous, "{synchronous} {one} {four}");
    assert!(infinite < four, "{four} {infinite}");
    let working = host.time_of_all(&host_work(&runs[3].log)).0;
    assert!(infinite >= working && infinite - working <= runs[3].log.len() as u64, "nothing but host work, rounded up");

    let [synchronous, one, four, infinite] = &runs;
    is_synchronous(synchronous);
    has_passes_in_flight(one, 1);
    has_passes_in_flight(four, 4);
    // An infinitely fast card is not in the log, and causes the same work.
    assert!(infinite.log.iter().all(|event| matches!(event, Event::Host(_))));
    assert_eq!(host_work(&infinite.log), host_work(&synchronous.log));
    assert_eq!(infinite.counts, synchronous.counts);
}

/// A synchronous host waits for every pass.
fn is_synchronous(found: &Run) {
    let mode = |event: &Event| match event {
        Event::ReadBack { mode, .. } => Some(*mode),
        _ => None,
    };
    let modes: Vec<ReadBackMode> = found.log.iter().filter_map(mode).collect();
    assert_eq!(modes, vec![ReadBackMode::Synchronous; 2 * found.counts.passes as usize], "ids and t");
    assert!(!found.log.iter().any(|event| matches!(event, Event::FinishFence(_))));
}

/// An asynchronous host has some passes in flight, and waits for the oldest.
fn has_passes_in_flight(found: &Run, passes: usize) {
    let (mut open, mut most) = (Vec::new(), 0);
    let (mut seen, mut looked) = (BTreeSet::new(), 0);
    let mut last: Option<FenceId> = None;
    for event in &found.log {
        match event {
            Event::Draw(_) => {
                open.push(last.take());
                most = most.max(open.len());
            }
            Event::ReadBack { mode, fence, .. } => {
                assert_eq!(*mode, ReadBackMode::Asynchronous);
                *open.last_mut().expect("a draw before") = *fence;
                assert!(seen.insert(fence.expect("a fence")), "a fence of its own");
            }
            Event::FinishFence(fence) => assert_eq!(open.remove(0), Some(*fence), "the last of the oldest pass"),
            Event::Host(work) if work.kind == HostOperation::ResultRead => looked += work.operations,
            _ => {}
        }
    }
    assert!(open.is_empty(), "every pass is taken");
    assert_eq!(most, passes + 1, "one more while the host waits for the oldest");
    assert_eq!(looked, found.counts.pass_rays, "every result is looked at");
}
