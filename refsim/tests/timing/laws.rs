//! More work never takes less time, on any card, in either model.

use proptest::prelude::*;
use refsim::asm::assemble;
use refsim::device::Profile;
use refsim::event::{
    DepthRecord, DrawEvents, DrawRecord, FlowConstants, ProgramWork, ResourceId, SAMPLERS, SamplerRecord,
    SamplerTraffic, TargetRecord,
};
use refsim::timing::{Level, Model, Picoseconds};
use std::sync::Arc;

const LINES: [&str; 10] = [
    "mad r0, r0, r1, r0",
    "add r1, r1, r0",
    "rsq r0.w, r0.w",
    "mul r2.xyz, r2, r0",
    "mov r3.w, r3.w",
    "lrp r0, r0, r1, r2",
    "pow r2.x, r2.x, r1.x",
    "texld r1, t0, s0",
    "texld r1, r1, s1",
    "texkill r0",
];

fn program(lines: &[usize]) -> Arc<ProgramWork> {
    let body: Vec<&str> = lines.iter().map(|&i| LINES[i % LINES.len()]).collect();
    let text = format!("ps_2_0\ndcl t0\ndcl_2d s0\ndcl_2d s1\n{}", body.join("\n"));
    Arc::new(ProgramWork::new(&assemble(&text).expect("every line is one"), FlowConstants::default()))
}

/// Quantities of work that can increase.
#[derive(Clone, Debug)]
struct Work {
    lines: Vec<usize>,
    counts: [u64; 10],
    observed: bool,
}

fn work() -> impl Strategy<Value = Work> {
    let lines = prop::collection::vec(0..LINES.len(), 1..20);
    let count = prop_oneof![0_u64..100, 0_u64..10_000_000, Just(1 << 40)];
    (lines, prop::array::uniform10(count), any::<bool>()).prop_map(|(lines, counts, observed)| Work {
        lines,
        counts,
        observed,
    })
}

fn record(work: &Work) -> DrawRecord {
    let [quads, generated, vertices, slots, triangles, fetches, misses, depth, color, streams] = work.counts;
    let mut counts =
        DrawEvents { draws: 1, instances: 1, vertices, vertex_instructions: slots, ..DrawEvents::default() };
    counts.fragments.generated = generated;
    counts.fragments.fetches = [fetches; SAMPLERS];
    (counts.primitives.assembled, counts.primitives.rasterised) = (triangles, triangles);
    (counts.bytes.depth_read, counts.bytes.color_written, counts.bytes.vertices) = (depth, color, streams);
    let traffic = SamplerTraffic { accesses: fetches, misses: [misses; 3], distinct: misses };
    let sampler = |sampler| SamplerRecord {
        sampler,
        texture: ResourceId::Texture(sampler.into()),
        texel_bytes: 8,
        texture_bytes: 1 << 19,
        trilinear: false,
        traffic: work.observed.then_some(traffic),
    };
    DrawRecord {
        counts,
        vertices_run: [vertices; 3],
        quads,
        pixel: program(&work.lines),
        vertex: None,
        samplers: vec![sampler(0), sampler(1)],
        targets: vec![TargetRecord { target: ResourceId::Texture(9), pixel_bytes: 4, written: true, read: false }],
        depth: Some(DepthRecord {
            buffer: ResourceId::Depth(0),
            pixel_bytes: 4,
            test: true,
            write: false,
            replaced: false,
        }),
        alpha_test: false,
        blend: false,
    }
}

fn models() -> Vec<Model> {
    let cards = Profile::card_names().into_iter().map(|name| Profile::named(name).expect("a card"));
    cards
        .flat_map(|card| {
            [Level::Rates, Level::Pipeline].map(|level| Model::new(level, &card).expect("a card has time"))
        })
        .collect()
}

proptest! {
    #[test]
    fn more_work_never_takes_fewer_clocks(work in work(), field in 0_usize..10, more in 1_u64..1_000_000, line in 0..LINES.len()) {
        let mut larger = work.clone();
        larger.counts[field] = larger.counts[field].saturating_add(more);
        let mut longer = work.clone();
        longer.lines.push(line);
        for model in models() {
            let (before, grown) = (model.draw(&record(&work)), model.draw(&record(&larger)));
            prop_assert!(before.total >= before.front_end.max(before.shader).max(before.memory));
            prop_assert!(model.draw(&record(&work)) == before, "the same again");
            prop_assert!(grown.core_clocks >= before.core_clocks, "{} {:?}: {field}", model.device(), model.level());
            prop_assert!(grown.total >= before.total);
            let written = model.draw(&record(&longer));
            prop_assert!(written.core_clocks >= before.core_clocks, "{}: {}", model.device(), LINES[line]);
        }
    }

    #[test]
    fn more_bytes_never_take_less_time(bytes in any::<u64>(), more in 0_u64..1 << 40) {
        for model in models() {
            let larger = bytes.saturating_add(more);
            prop_assert!(model.upload(larger) >= model.upload(bytes));
            prop_assert!(model.read_back(larger) >= model.read_back(bytes));
            prop_assert!(model.clear(larger) >= model.clear(bytes));
            prop_assert!(model.state_change(3, 5) >= model.state_change(2, 5));
            prop_assert!(model.state_change(2, 6) >= model.state_change(2, 5));
        }
    }
}

#[test]
fn nothing_overflows() {
    let most = Work { lines: vec![0; 19], counts: [u64::MAX; 10], observed: true };
    for model in models() {
        assert_eq!(model.draw(&record(&most)).total, Picoseconds(u64::MAX), "{}", model.device());
    }
}
