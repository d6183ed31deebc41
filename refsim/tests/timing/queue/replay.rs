//! Recorded and artificial logs, replayed in modelled time.

use std::sync::Arc;

use proptest::prelude::*;
use refsim::event::{
    DrawEvents, DrawRecord, Event, FenceId, FlowConstants, HostWork, MipmapRecord, ProgramWork, ReadBackMode,
    ResourceId, SamplerRecord, TargetRecord,
};
use refsim::timing::host::{HostCounts, HostModel, HostOperation};
use refsim::timing::queue::QueueFigures;
use refsim::timing::replay::{Costs, Options, Replay, ReplayError, replay};
use refsim::timing::timeline::Unit;
use refsim::timing::{DrawCost, Picoseconds};

use super::{cost, free, spans};

/// One picosecond per byte on the buses and per state change; draws take as long as their vertex count.
struct Simple;

impl Costs for Simple {
    fn draw(&self, record: &DrawRecord) -> DrawCost {
        cost(0, record.counts.vertices, 0, 0)
    }

    fn mipmaps(&self, record: &MipmapRecord) -> DrawCost {
        cost(0, record.texels_written(), 0, 0)
    }

    fn upload(&self, bytes: u64) -> Picoseconds {
        Picoseconds(bytes)
    }

    fn read_back(&self, bytes: u64) -> Picoseconds {
        Picoseconds(bytes)
    }

    fn clear(&self, _: u64) -> Picoseconds {
        Picoseconds(1)
    }

    fn state(&self, changes: u32, constants: u32) -> Picoseconds {
        Picoseconds(u64::from(changes) + u64::from(constants))
    }
}

const RAYS: ResourceId = ResourceId::Texture(0);
const IDS: ResourceId = ResourceId::Texture(1);

fn draw(time: u64) -> Event {
    let program = refsim::asm::assemble("ps_1_4\nmov r0, c0").expect("a program");
    let sampler =
        SamplerRecord { sampler: 0, texture: RAYS, texel_bytes: 4, texture_bytes: 4, trilinear: false, traffic: None };
    Event::Draw(Box::new(DrawRecord {
        counts: DrawEvents { vertices: time, ..DrawEvents::default() },
        vertices_run: [0; 3],
        quads: 0,
        pixel: Arc::new(ProgramWork::new(&program, FlowConstants::default())),
        vertex: None,
        samplers: vec![sampler],
        targets: vec![TargetRecord { target: IDS, pixel_bytes: 4, written: true, read: false }],
        depth: None,
        alpha_test: false,
        blend: false,
    }))
}

fn read_back(bytes: u64, mode: ReadBackMode, fence: Option<u32>) -> Event {
    Event::ReadBack { resource: IDS, bytes, mode, fence: fence.map(FenceId) }
}

fn played(log: &[Event], options: &Options<'_>) -> Replay {
    replay(log, &Simple, &Options { queue: free(), ..*options }).expect("a good log")
}

/// Two buckets, as in `examples`: 6 on the host, 3 upload, 1 clear, 20 draw, 5 read-back.
fn two_buckets(mode: ReadBackMode) -> Vec<Event> {
    let bucket = |fence| {
        vec![
            Event::Host(HostWork { kind: HostOperation::RayGenerated, operations: 6 }),
            Event::Upload { resource: RAYS, bytes: 3 },
            Event::Clear { resource: IDS, bytes: 4 },
            draw(20),
            read_back(5, mode, (mode == ReadBackMode::Asynchronous).then_some(fence)),
        ]
    };
    [bucket(1), bucket(2)].concat()
}

/// A generated ray costs one picosecond.
fn picosecond_a_ray() -> HostModel {
    let counts = HostCounts::default().with(HostOperation::RayGenerated, 1_000_000_000_000);
    HostModel::calibrate(&counts, 1, 1).expect("good counts")
}

#[test]
fn the_worked_example_from_a_log() {
    let model = picosecond_a_ray();
    let host = Some(&model);
    let (synchronous, asynchronous) = (ReadBackMode::Synchronous, ReadBackMode::Asynchronous);
    let makespan = |mode, options: Options<'_>| played(&two_buckets(mode), &options).timeline.makespan().0;
    let plain = Options { host, ..Options::default() };
    let double = Options { double_buffered: true, ..plain };
    assert_eq!(makespan(synchronous, plain), 68);
    assert_eq!(makespan(synchronous, double), 68);
    assert_eq!(makespan(asynchronous, plain), 60);
    assert_eq!(makespan(asynchronous, double), 55);
    // The option overrides the log.
    assert_eq!(makespan(synchronous, Options { read_back: Some(asynchronous), ..double }), 55);
    assert_eq!(makespan(asynchronous, Options { read_back: Some(synchronous), ..double }), 68);
}

#[test]
fn draws_and_their_costs_come_in_order() {
    let found = played(&[draw(3), draw(4)], &Options::default());
    assert_eq!(found.draws, [cost(0, 3, 0, 0), cost(0, 4, 0, 0)]);
    assert_eq!(spans(&found.timeline, Unit::ShaderArray), [(0, 3), (3, 7)]);
    assert_eq!(found.timeline.spans()[1].label.as_ref(), "draw 1");
}

#[test]
fn host_work_without_a_model_is_counted_and_free() {
    let found = played(&two_buckets(ReadBackMode::Synchronous), &Options::default());
    assert_eq!((found.uncosted, found.timeline.makespan()), (12, Picoseconds(56)));
}

#[test]
fn what_is_wrong_with_a_log() {
    let wrong = |log: &[Event]| replay(log, &Simple, &Options::default()).unwrap_err();
    let unset = ReplayError { event: 1, fence: FenceId(3) };
    assert_eq!(wrong(&[draw(1), Event::FinishFence(FenceId(3))]), unset);
    assert_eq!(unset.to_string(), "event 1: expected a fence that has been set, found fence 3 that was not");
}

fn event() -> impl Strategy<Value = Event> {
    let resource = || prop_oneof![Just(RAYS), Just(IDS), Just(ResourceId::Depth(0))];
    prop_oneof![
        (resource(), 0..50_u64).prop_map(|(resource, bytes)| Event::Upload { resource, bytes }),
        (resource(), 0..50_u64).prop_map(|(resource, bytes)| Event::Clear { resource, bytes }),
        (0..50_u64).prop_map(draw),
        (0..50_u64).prop_map(|bytes| read_back(bytes, ReadBackMode::Asynchronous, Some(1))),
        (0..50_u32, 0..9_u32).prop_map(|(changes, constants)| Event::StateChange { changes, constants }),
        (0..50_u64).prop_map(|operations| Event::Host(HostWork { kind: HostOperation::RayGenerated, operations })),
    ]
}

proptest! {
    #[test]
    fn two_copies_of_everything_are_never_slower_and_asynchrony_is_not(
        log in proptest::collection::vec(event(), 0..40), double in any::<bool>()
    ) {
        let model = picosecond_a_ray();
        let time = |read_back, double_buffered| {
            let queue = QueueFigures { commands: 4, draw_ps: 3, upload_ps: 2, ..free() };
            let options = Options { queue, read_back: Some(read_back), double_buffered, host: Some(&model) };
            replay(&log, &Simple, &options).expect("a good log").timeline.makespan()
        };
        use ReadBackMode::{Asynchronous, Synchronous};
        prop_assert!(time(Asynchronous, double) <= time(Synchronous, double));
        prop_assert!(time(Asynchronous, true) <= time(Asynchronous, false));
    }
}
