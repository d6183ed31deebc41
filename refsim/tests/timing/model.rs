//! Tests the timing models on draws with known counts.

use crate::only_draw;
use crate::running::{bits, checked, quads, screen};
use refsim::asm::assemble;
use refsim::device::Profile;
use refsim::event::{DrawRecord, Event, FlowConstants, ProgramWork};
use refsim::exec::Constants;
use refsim::machine::{AttributeStream, DrawCall, ExecutorKind, Machine, StepRate, VertexSource, VertexStreams};
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::Primitive;
use refsim::texture::{Image, SamplerState, TexelFormat};
use refsim::timing::{Bottleneck, Clocks, Level, Model, Picoseconds, TimingError};

/// Draws a quad over an n x n target with depth test and write; the first `samplers` samplers read n x n textures.
fn draw(device: &str, text: &str, n: u32, samplers: usize, format: TexelFormat) -> DrawRecord {
    let profile = Profile::named(device).unwrap();
    let program = checked(text, &profile);
    let mut machine = Machine::new(profile, ExecutorKind::Scalar);
    machine.record(true);
    let textures: Vec<_> =
        (0..samplers).map(|_| machine.create_texture(Image::new_2d(format, n, n).unwrap()).unwrap()).collect();
    let target = machine.create_target(TexelFormat::Bgra8, n, n).unwrap();
    let depth = machine.create_depth(DepthFormat::Unorm24, n, n).unwrap();
    let (vertices, host) = (screen(), Constants::default());
    let mut call = quads(&vertices, &program, &host, target);
    call.depth = DepthState { test: Some(CompareFunction::Less), write: true };
    call.depth_buffer = Some(depth);
    for (sampler, texture) in textures.into_iter().enumerate() {
        call = call.with_texture(sampler, texture, SamplerState::NEAREST_CLAMP);
    }
    machine.draw(&call).unwrap();
    only_draw(&machine.take_log()).clone()
}

const DUAL: &str = "ps_1_1\ntex t0\ntex t1\nmul r0, t0, t1";

/// 20 bytes per pixel (two texels, a color, a depth read and written) take longer than the pipelines' work: 368
/// Mpixel/s versus the printed 390 on the GeForce3, 520 versus the implied 527 on the GeForce4.
#[test]
fn dual_texturing_is_bound_by_memory() {
    for (device, expected, printed) in [("nv20", 368_000_000, 390.0), ("nv25", 520_000_000, 527.3)] {
        let n = 256_u32;
        let record = draw(device, DUAL, n, 2, TexelFormat::Rgba8);
        let model = Model::new(Level::Pipeline, &Profile::named(device).unwrap()).unwrap();
        let clocks = model.clocks(&record);
        let vertices = record.counts.bytes.vertices;
        assert_eq!(clocks.traffic.total() - vertices, u64::from(n * n) * 20, "{device}");
        assert_eq!(clocks.bottleneck(), Bottleneck::Memory);
        assert_eq!(clocks.textures, clocks.arithmetic, "one clock for two reads, one for one multiply");
        // Steady-state rate: without fixed costs and vertices.
        let bandwidth = Profile::named(device).unwrap().rates.memory_bytes_per_s.unwrap();
        assert_eq!(bandwidth / 20, expected);
        let rate = f64::from(n * n)
            / (clocks.memory.0 as f64 / Profile::named(device).unwrap().rates.core_clock_hz.unwrap() as f64);
        assert!((rate / expected as f64 - 1.0).abs() < 0.001, "{device}: {rate}");
        assert!((rate / 1e6 / printed - 1.0).abs() < 0.06, "{device}: {rate} of {printed} M");
    }
}

#[test]
fn the_rates_level_is_equation_11() {
    let record = draw("nv20", DUAL, 128, 2, TexelFormat::Rgba8);
    let model = Model::new(Level::Rates, &Profile::named("nv20").unwrap()).unwrap();
    let cost = model.draw(&record);
    // 16384 / 390 MHz and 4 bytes per pixel at 250 MB/s, each rounded up to a picosecond.
    assert_eq!(cost.total, Picoseconds((16_384 * 1_000_000_u64).div_ceil(390)));
    assert_eq!(model.read_back(4 * 16_384), Picoseconds(4 * 16_384 * 4_000));
    assert_eq!(cost.bottleneck, Bottleneck::Rate);
    assert_eq!((cost.front_end, cost.memory), (Picoseconds::ZERO, Picoseconds::ZERO));
}

#[test]
fn an_ideal_device_has_no_time() {
    for level in [Level::Rates, Level::Pipeline] {
        let error = Model::new(level, &Profile::named("ideal-fp32").unwrap()).unwrap_err();
        let TimingError::Missing { have, .. } = &error else { panic!("{error}") };
        assert!(have.contains("r200") && have.contains("gt200"), "{error}");
        for name in Profile::card_names() {
            Model::new(level, &Profile::named(name).unwrap()).unwrap();
        }
    }
}

#[test]
fn the_units_count_what_the_program_says() {
    let model = |device: &str| Model::new(Level::Pipeline, &Profile::named(device).unwrap()).unwrap();
    let fragment = |device: &str, text: &str| {
        let record = draw(device, text, 8, 0, TexelFormat::Rgba8);
        let clocks = model(device).fragment(&record.pixel);
        (clocks.arithmetic.0, clocks.textures.0, clocks.total().0)
    };
    // Two phases: two pairs and one instruction; two texture instructions and one, at two texture instructions per
    // clock.
    let two = "ps_1_4\ntexld r0, t0\ntexcrd r1.rgb, t1\nmul r0.rgb, r0, r1\n+mov r0.a, r0.a\nadd r0, r0, r0\nphase\n\
               texld r1, r0\nmul r0.rgb, r0, r1\n+mov r0.a, r1.a";
    assert_eq!(fragment("r200", two), (3, 2, 3));
    // NV30 alternates on the same program: the dependent read runs at one per clock, and the program uses two registers
    // more than run at full speed.
    assert_eq!(fragment("nv30", two), (3, 2, 5));
    // An independent vec3 and scalar: one slot on r300, two on nv30.
    let split = "ps_2_0\ndcl t0\ndcl_2d s0\ntexld r0, t0, s0\nmul r1.xyz, r0, r0\nmov r1.w, r0.w\nmov oC0, r1";
    assert_eq!(fragment("r300", split), (2, 1, 2));
    assert_eq!(fragment("nv30", split), (3, 1, 4));
    // Six live registers exceed two by two steps; each step adds half the clocks.
    let wide = "ps_2_0\ndcl t0\ndcl t1\nmov r0, t0\nmov r1, t1\nmul r2, r0, r1\nmul r3, r0, r2\nmul r4, r1, r3\nmul r5, r2, r4\n\
                mad r0, r0, r1, r2\nmad r0, r0, r3, r4\nadd r0, r0, r5\nmov oC0, r0";
    assert_eq!(fragment("nv30", wide).0, 20);
}

#[test]
fn a_guess_can_be_scaled_and_nothing_else() {
    let model = Model::new(Level::Pipeline, &Profile::named("r200").unwrap()).unwrap();
    let record = draw("r200", "ps_1_4\ntexld r0, t0\nmul r0, r0, r0\nmul r0, r0, r0", 32, 1, TexelFormat::Rgba8);
    let guesses = model.guesses();
    assert!(guesses.iter().any(|k| k == "rates.alu_pairs_per_clock"));
    assert!(!guesses.iter().any(|k| k == "rates.core_clock_hz"));
    for key in &guesses {
        let doubled = model.with_scaled(key, 2, 1).unwrap();
        let row = doubled.constants().into_iter().find(|r| &r.key == key).unwrap();
        let before = model.constants().into_iter().find(|r| &r.key == key).unwrap();
        assert_eq!(row.value.parse::<u64>().unwrap(), 2 * before.value.parse::<u64>().unwrap(), "{key}");
        assert!(model.with_scaled(key, 1, 2).is_ok());
    }
    // 256 quads, and the 16 on the diagonal twice, over four pipelines, two slots each.
    let faster = model.with_scaled("rates.alu_pairs_per_clock", 2, 1).unwrap();
    assert_eq!((model.clocks(&record).arithmetic, faster.clocks(&record).arithmetic), (Clocks(544), Clocks(272)));
    assert!(matches!(model.with_scaled("rates.core_clock_hz", 2, 1), Err(TimingError::NoGuess { .. })));
    assert!(matches!(model.with_scaled("rates.draw_clocks", 0, 1), Err(TimingError::Scale { .. })));
}

/// Clocks of a fragment: arithmetic, textures, total.
fn clocks(device: &str, lines: &str) -> (u64, u64, u64) {
    let profile = Profile::named(device).unwrap();
    let program = assemble(&format!("!!FP1.0\n{lines}\nEND")).unwrap();
    let model = Model::new(Level::Pipeline, &profile).unwrap();
    let fragment = model.fragment(&ProgramWork::new(&program, FlowConstants::default()));
    (fragment.arithmetic.0, fragment.textures.0, fragment.total().0)
}

/// A read, five fixed-point instructions and a dot product: 2 clocks with X, 7 with H, 3 on the NV35.
#[test]
fn fixed_point_goes_beside_the_float_unit_of_nv30() {
    let lines = |x: &str| {
        format!(
            "TEX H0, f[TEX0], TEX0, 2D;\nMUL{x} H1, H0, p[0];\nMUL{x} H1, H1, H0;\nADD{x} H1, H1, p[1];\n\
             MAD{x} H2, H1, H0, H1;\nDP3H H3, H2, H0;\nMUL{x} o[COLH], H2, H3;"
        )
    };
    assert_eq!(clocks("nv30", &lines("X")), (1, 1, 2));
    assert_eq!(clocks("nv30", &lines("H")), (6, 1, 7));
    // The NV35 has a second float unit instead of fixed-point units.
    assert_eq!(clocks("nv35", &lines("X")), (3, 1, 3));
    assert_eq!(clocks("nv35", &lines("H")), (3, 1, 3));
}

#[test]
fn nv30_does_three_operations_or_five_multiplications_in_fixed_point_a_clock() {
    let times = |line: &str, n: usize| clocks("nv30", &format!("{line};\n").repeat(n)).2;
    for n in 1..40 {
        assert_eq!(times("ADDX H0, H0, p[0]", n), n.div_ceil(3) as u64, "{n} sums");
        assert_eq!(times("MULX H0, H0, p[0]", n), n.div_ceil(5) as u64, "{n} products");
        assert_eq!(times("ADDH H0, H0, p[0]", n), n as u64, "{n} sums of half precision");
    }
    // After 4 float operations there is room for 8 sums or 16 products.
    let behind =
        |line: &str, n: usize| clocks("nv30", &("ADDH H1, H1, p[0];\n".repeat(4) + &format!("{line};\n").repeat(n))).2;
    assert_eq!([8, 9, 11, 12].map(|n| behind("ADDX H0, H0, p[0]", n)), [4, 5, 5, 6]);
    assert_eq!([16, 17, 21, 22].map(|n| behind("MULX H0, H0, p[0]", n)), [4, 5, 5, 6]);
}

/// Generates the mip levels of a 1024 x 1024 map with 8-bit channels.
#[test]
fn mip_levels_are_drawn_one_after_the_other() {
    let mut machine = Machine::new(Profile::named("nv35").unwrap(), ExecutorKind::Batch);
    let map = machine.create_target_with_levels(TexelFormat::Bgra8, 1024, 1024, 11).unwrap();
    let record = machine.generate_mipmaps(map).unwrap();
    assert_eq!((record.texels_read(), record.texels_written()), (1_398_100, 349_525));
    let cost = |level| Model::new(level, machine.profile()).unwrap().mipmaps(&record);
    // 1.8 Gpixel/s.
    assert_eq!(cost(Level::Rates).total, Picoseconds((349_525 * 10_000_u64).div_ceil(18)));
    // Level 1: four texels read and one written per texel of 512 x 512, at 27.2 GB/s and 450 MHz.
    let first = 5_u64 * 4 * 512 * 512 * 450;
    assert_eq!(first.div_ceil(27_200), 86_739);
    let pipeline = cost(Level::Pipeline);
    // Each level has 300 fixed clocks; from 4 x 4 texels on, set-up of two triangles dominates the rest.
    let moved: u64 = (0..8).map(|k| (first >> (2 * k)).div_ceil(27_200)).sum();
    assert_eq!(pipeline.core_clocks, Clocks(10 * 300 + moved + 2 * 4));
    assert_eq!(pipeline.bottleneck, Bottleneck::Memory);
    assert_eq!(pipeline.memory.0 / 1_000_000, 257, "microseconds");
}

const TRANSFORM: &str = "vs_1_1\ndcl_position v0\nmov oPos, v0\nmul r0, v0, c1\nmov oD0, c2";

/// The event log of a draw of indexed triangles with the constants from c0 on.
fn indexed(order: &[u32], constants: &[[f32; 4]]) -> Vec<Event> {
    let profile = Profile::named("r300").unwrap();
    let (vertex, pixel) = (checked(TRANSFORM, &profile), checked("ps_2_0\ndcl v0\nmov oC0, v0", &profile));
    let mut machine = Machine::new(profile, ExecutorKind::Scalar);
    let target = machine.create_target(TexelFormat::Bgra8, 8, 8).unwrap();
    let positions: Vec<[u32; 4]> = (0..40).map(|n| bits([n as f32, 2.0, 0.5, 1.0])).collect();
    let stream = AttributeStream { register: 0, step: StepRate::Vertex, data: &positions };
    let streams = VertexStreams { vertex_count: positions.len(), instance_count: 1, streams: vec![stream] };
    let host = Constants { float: constants.iter().copied().map(bits).collect(), ..Constants::default() };
    let none = Constants::default();
    let source = VertexSource::Program { program: &vertex, constants: &host, streams };
    let mut call = DrawCall::new(source, Primitive::TriangleList, &pixel, &none, target);
    call.indices = Some(order);
    machine.record(true);
    machine.draw(&call).unwrap();
    machine.take_log()
}

/// Three instructions and 16 bytes per processed vertex: a strip processes each vertex once; a vertex is processed
/// again after 16 others.
#[test]
fn vertices_that_left_the_cache_are_run_again() {
    let strip: Vec<u32> = (0..38).flat_map(|n| [n, n + 1, n + 2]).collect();
    let around: Vec<u32> = (0..3).flat_map(|_| 0..39).collect();
    let model = Model::new(Level::Pipeline, &Profile::named("r300").unwrap()).unwrap();
    for (order, run) in [(&strip, [40; 3]), (&around, [117; 3]), (&[0, 1, 2, 2, 1, 3].to_vec(), [4; 3])] {
        let log = indexed(order, &[]);
        let record = only_draw(&log);
        assert_eq!(record.vertices_run, run);
        let clocks = model.clocks(record);
        assert_eq!(clocks.vertices, Clocks((3 * run[1]).div_ceil(4)), "four vertex units");
        assert_eq!(clocks.traffic.vertices, 16 * run[1]);
    }
    // Twelve vertices in a cycle: too many for half of the 16-entry cache, but not for all of it.
    let twelve: Vec<u32> = (0..4).flat_map(|_| 0..12).collect();
    let log = indexed(&twelve, &[]);
    assert_eq!(only_draw(&log).vertices_run, [48, 12, 12]);
    let half = model.with_scaled("rates.vertex_cache_entries", 1, 2).unwrap();
    assert_eq!(half.clocks(only_draw(&log)).vertices, Clocks(36));
    assert_eq!(model.clocks(only_draw(&log)).vertices, Clocks(9));
}

/// Only changed constants are sent; all start at 0. Each takes four clocks or the time of its bytes on the bus.
#[test]
fn constants_are_sent_where_they_differ() {
    let changed = |constants: &[[f32; 4]]| match indexed(&[0, 1, 2], constants).first() {
        Some(Event::StateChange { constants, .. }) => *constants,
        other => panic!("{other:?}"),
    };
    assert_eq!(changed(&[[0.0; 4], [1.0; 4], [0.0, 0.0, 0.0, 2.0]]), 2);
    assert_eq!(changed(&[]), 0);
    let model = Model::new(Level::Pipeline, &Profile::named("r300").unwrap()).unwrap();
    // 325 MHz: 100 constants take 400 clocks, 1.23 us; their 1,600 bytes at 2.112 GB/s take 0.76 us.
    assert_eq!(model.state_change(0, 100), Picoseconds((400_u64 * 1_000_000).div_ceil(325)));
    assert_eq!(model.state_change(0, 0), Picoseconds::ZERO);
}
