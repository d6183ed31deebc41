//! Tests the texture cache against an independent simulator, and on draws whose texture reads are observed.

use crate::only_draw;
use crate::running::{bits, checked, image, quads, screen};
use proptest::prelude::*;
use refsim::device::Profile;
use refsim::event::{DrawEvents, DrawRecord, SamplerTraffic};
use refsim::exec::Constants;
use refsim::machine::{ExecutorKind, Machine};
use refsim::raster::full_screen_quad;
use refsim::texture::{Filter, Image, MipFilter, SamplerState, TexelFormat, TextureKind};
use refsim::timing::TimingError;
use refsim::timing::cache::{TextureCache, TextureCaches};
use std::collections::{BTreeMap, BTreeSet};

/// Misses by definition: a line is present if fewer than `ways` different lines of its set were used since its last
/// use.
fn misses_by_definition(addresses: &[u64], bytes: u64, line: u64, ways: u64) -> u64 {
    let sets = bytes / line / ways;
    let mut used: BTreeMap<u64, usize> = BTreeMap::new();
    let mut misses = 0;
    for (now, address) in addresses.iter().enumerate() {
        let own = address / line;
        let between = |from: usize| {
            let lines =
                addresses[from + 1..now].iter().map(|a| a / line).filter(|l| *l != own && l % sets == own % sets);
            lines.collect::<BTreeSet<u64>>().len() as u64
        };
        misses += u64::from(used.get(&own).is_none_or(|&from| between(from) >= ways));
        used.insert(own, now);
    }
    misses
}

fn misses(addresses: &[u64], bytes: u64, line: u64, ways: u64) -> u64 {
    let mut cache = TextureCache::new(bytes, line, ways).unwrap();
    addresses.iter().filter(|&&a| !cache.access(a)).count() as u64
}

/// Random walks with jumps.
fn addresses() -> impl Strategy<Value = Vec<u64>> {
    let step = prop_oneof![4 => -64_i64..64, 1 => -4096_i64..4096];
    prop::collection::vec(step, 1..300).prop_map(|steps| {
        let walk = steps.iter().scan(8192_i64, |at, step| {
            *at = (*at + step).rem_euclid(16_384);
            Some(*at as u64)
        });
        walk.collect()
    })
}

fn shape() -> impl Strategy<Value = (u64, u64, u64)> {
    (4_u32..8, 1_u64..9, 1_u64..9).prop_map(|(line, ways, sets)| ((1 << line) * ways * sets, 1 << line, ways))
}

proptest! {
    #[test]
    fn the_cache_does_what_its_definition_says(walk in addresses(), (bytes, line, ways) in shape()) {
        prop_assert_eq!(misses(&walk, bytes, line, ways), misses_by_definition(&walk, bytes, line, ways));
    }

    /// For any shape, each line misses at least once, and a cache that holds all lines misses no more.
    #[test]
    fn a_cache_that_holds_all_lines_has_compulsory_misses_only(walk in addresses(), line in 4_u32..8) {
        let line = 1 << line;
        let distinct = walk.iter().map(|a| a / line).collect::<BTreeSet<u64>>().len() as u64;
        prop_assert_eq!(misses(&walk, distinct * line, line, distinct), distinct);
        if distinct > 1 {
            prop_assert!(misses(&walk, line, line, 1) >= distinct);
        }
    }

    /// Inclusion property: the larger of two fully associative caches contains all lines of the smaller.
    #[test]
    fn a_larger_cache_never_misses_more(walk in addresses(), small in 1_u64..20, more in 0_u64..20) {
        let full = |lines: u64| misses(&walk, lines * 32, 32, lines);
        prop_assert!(full(small + more) <= full(small));
    }
}

#[test]
fn impossible_caches_are_refused() {
    for (bytes, line, ways) in [(0, 32, 4), (8192, 24, 4), (8192, 8, 4), (8192, 32, 0), (100, 32, 4), (1 << 40, 32, 4)]
    {
        assert!(
            matches!(TextureCache::new(bytes, line, ways), Err(TimingError::CacheShape { .. })),
            "{bytes} {line} {ways}"
        );
    }
    for name in Profile::card_names() {
        TextureCaches::new(&Profile::named(name).unwrap()).unwrap();
    }
    let ideal = TextureCaches::new(&Profile::named("ideal-fp32").unwrap());
    assert!(matches!(ideal, Err(TimingError::Missing { figure: "texture_cache_bytes", .. })));
}

fn noise(n: u32, levels: u32) -> Image {
    let mut image = Image::new(TexelFormat::Rgba8, TextureKind::D2, [n, n, 1], levels).unwrap();
    for (i, byte) in (0_u32..).zip(image.bytes_mut()) {
        *byte = (i.wrapping_mul(2_654_435_761) >> 24) as u8;
    }
    image
}

/// Results of a draw: counts, bits, record.
struct Drawn {
    events: DrawEvents,
    bits: Vec<u8>,
    record: DrawRecord,
}

fn draw(
    kind: ExecutorKind,
    threads: usize,
    observe: bool,
    (texture, state): (&Image, SamplerState),
    scale: f32,
) -> Drawn {
    let profile = Profile::named("r200").unwrap();
    let text = "ps_1_4\ntexld r0, t0\ntexld r1, t1\nphase\ntexld r2, r0\nadd r0.rgb, r0, r2\n+mov r0.a, r2.a";
    let program = checked(text, &profile);
    let mut machine = Machine::with_threads(profile.clone(), kind, threads).unwrap();
    machine.record(true);
    if observe {
        machine.observe_textures(Some(Box::new(TextureCaches::new(&profile).unwrap())));
    }
    let id = machine.create_texture(texture.clone()).unwrap();
    let other = machine.create_texture(noise(16, 1)).unwrap();
    // A separate texture, because lines fetched through one sampler hit through another sampler of the same texture.
    let third = machine.create_texture(noise(16, 1)).unwrap();
    let target = machine.create_target(TexelFormat::Bgra8, 64, 64).unwrap();
    let vertices = full_screen_quad(|u, v| [[u * scale, v * scale, 0.0, 1.0]; 8]);
    let host = Constants::default();
    let call = quads(&vertices, &program, &host, target)
        .with_texture(0, id, state)
        .with_texture(1, other, SamplerState::NEAREST_CLAMP)
        .with_texture(2, third, SamplerState::default());
    let events = machine.draw(&call).unwrap();
    let bits = machine.read_back(target).unwrap().bytes().to_vec();
    Drawn { events, bits, record: only_draw(&machine.take_log()).clone() }
}

fn traffic(drawn: &Drawn) -> Vec<SamplerTraffic> {
    drawn.record.samplers.iter().map(|s| s.traffic.unwrap()).collect()
}

/// Observation changes no bits or counts, and its result does not depend on the executor.
#[test]
fn watching_changes_nothing_and_depends_on_nobody() {
    let linear =
        SamplerState { min: Filter::Linear, mag: Filter::Linear, mip: MipFilter::Linear, ..SamplerState::default() };
    let texture = noise(64, 7);
    for (state, scale) in [(SamplerState::NEAREST_CLAMP, 1.0), (linear, 1.0), (linear, 3.7), (linear, 0.3)] {
        let plain = draw(ExecutorKind::Scalar, 1, false, (&texture, state), scale);
        let watched = draw(ExecutorKind::Scalar, 1, true, (&texture, state), scale);
        assert_eq!(plain.bits, watched.bits, "no bit changes");
        assert_eq!(plain.events, watched.events, "no count changes");
        for (kind, threads) in [(ExecutorKind::Batch, 1), (ExecutorKind::Batch, 3), (ExecutorKind::Scalar, 3)] {
            for (observe, like) in [(false, &plain), (true, &watched)] {
                let drawn = draw(kind, threads, observe, (&texture, state), scale);
                assert!(drawn.record == like.record && drawn.bits == like.bits, "{kind:?} {threads} {observe}");
            }
        }
        for t in traffic(&watched) {
            assert!(t.distinct <= t.misses[1] && t.misses[1] <= t.accesses, "{t:?}");
        }
    }
}

/// One texel per pixel, each pixel once: every line is requested eight times, once per texel, and fetched once, or
/// twice where it is shared by the quad's two triangles.
#[test]
fn a_copy_moves_the_texture_once() {
    let texture = noise(64, 1);
    let watched = draw(ExecutorKind::Scalar, 1, true, (&texture, SamplerState::NEAREST_CLAMP), 1.0);
    let seen = traffic(&watched)[0];
    assert_eq!((seen.accesses, seen.distinct), (64 * 64, 64 * 64 * 4 / 32));
    assert!(seen.misses[1] <= seen.distinct + 64, "{seen:?}");
    // Unfiltered, a fetch touches one texel.
    let linear = SamplerState { min: Filter::Linear, mag: Filter::Linear, ..SamplerState::NEAREST_CLAMP };
    // At texel centers the neighbors have no weight; between centers four texels have weights.
    assert_eq!(traffic(&draw(ExecutorKind::Scalar, 1, true, (&texture, linear), 1.0))[0].accesses, 64 * 64);
    let between = traffic(&draw(ExecutorKind::Scalar, 1, true, (&texture, linear), 0.5))[0];
    assert_eq!(between.accesses, 4 * 64 * 64);
    assert_eq!(
        between.distinct * 32,
        33_u64.next_multiple_of(4) * 33_u64.next_multiple_of(2) * 4,
        "a quarter and a rim"
    );
}

#[test]
fn a_texture_of_floats_is_watched_like_any_other() {
    let profile = Profile::named("r300").unwrap();
    let program = checked("ps_2_0\ndcl t0\ndcl_2d s0\ntexld r0, t0, s0\nmov oC0, r0", &profile);
    let mut machine = Machine::new(profile.clone(), ExecutorKind::Batch);
    machine.record(true);
    machine.observe_textures(Some(Box::new(TextureCaches::new(&profile).unwrap())));
    let values = vec![bits([1.0, 2.0, 3.0, 4.0]); 32 * 32];
    let id = machine.create_texture(image(TexelFormat::Rgba32f, [32; 2], &values)).unwrap();
    let target = machine.create_target(TexelFormat::Rgba32f, 32, 32).unwrap();
    let (vertices, host) = (screen(), Constants::default());
    let call = quads(&vertices, &program, &host, target).with_texture(0, id, SamplerState::NEAREST_CLAMP);
    machine.draw(&call).unwrap();
    let seen = only_draw(&machine.take_log()).samplers[0].traffic.unwrap();
    assert_eq!((seen.accesses, seen.distinct), (1024, 1024 * 16 / 32));
}
