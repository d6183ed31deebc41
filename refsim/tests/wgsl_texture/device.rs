//! The library on an adapter.

use super::cases::{self, Case, READ_WORDS, Read};
use super::random::Random;
use super::{module, reference};
use refsim::exec::gpu::Gpu;
use refsim::exec::wgsl::number::format_words;
use refsim::exec::wgsl::texture::{component_words, image_words, sampler_words};
use refsim::num::Format;
use refsim::texture::TexelFormat;
use std::sync::Arc;

const FORMATS: &str = "fp32 s3.12 fp16 fp24:rtz:ftz s1.10 s0.31 s3.12:rtz:wrap s0.7:rdn bf16:rna \
                       fp32:ftz:rtz e5m10:nvovf:nv:rtz e4m3:sat e2m1:rdn s15.16:rna";
/// Quad reads per texture.
const READS: usize = 24;

fn groups(invocations: usize) -> [u32; 3] {
    [invocations.div_ceil(64) as u32, 1, 1]
}

/// The sampler table and the texels of all cases.
fn tables(cases: &[Case]) -> (Vec<u32>, Vec<u32>) {
    let (mut samplers, mut video) = (Vec::new(), vec![0xdead_beef; 3]);
    for case in cases {
        let first = video.len() as u32;
        samplers.extend(sampler_words(case.binding().as_ref(), &case.rules, first));
        video.extend(case.image.as_ref().map(image_words).unwrap_or_default());
    }
    (samplers, video)
}

/// The first read whose results differ.
fn difference(gpu: &Gpu, text: &str, seed: u64, name: &str) -> Option<String> {
    let format: Format = name.parse().unwrap_or_else(|e| panic!("{name}: {e}"));
    let mut random = Random::new(seed);
    let cases = cases::cases(&mut random, format).unwrap_or_else(|e| panic!("{e}"));
    let (samplers, video) = tables(&cases);
    let mut reads: Vec<Read> = Vec::new();
    for _ in 0..READS {
        reads.extend(cases.iter().enumerate().map(|(i, case)| cases::read(&mut random, i, case)));
    }
    let words: Vec<u32> = reads.iter().flat_map(Read::words).collect();
    assert_eq!(words.len(), reads.len() * READ_WORDS);
    let inputs: [&[u32]; 4] = [&format_words(&format), &samplers, &video, &words];
    let made = gpu
        .compute(text, "read_texels", &inputs, 16 * reads.len(), groups(reads.len()))
        .unwrap_or_else(|e| panic!("{e}"));
    reads.iter().zip(made.chunks_exact(16)).find_map(|(read, made)| {
        let case = &cases[read.sampler];
        (0..4).find_map(|lane| {
            let runs = read.run >> lane & 1 == 1;
            let expected = if runs { reference::texel(case, read, lane) } else { [0; 4] };
            let found = [0, 1, 2, 3].map(|c: usize| made[4 * c + lane]);
            let image = case.image.as_ref().map(|i| (i.format(), i.kind(), i.levels()));
            let (state, rules) = (&case.state, &case.rules);
            (found != expected).then(|| {
                format!(
                    "{name}: expected {expected:x?}, found {found:x?} for {image:x?} {state:x?} {rules:?}, lane {lane} of {read:x?}"
                )
            })
        })
    })
}

pub(crate) fn reads_are_those_of_the_texture_room(gpu: &Arc<Gpu>) {
    let text = module::reading();
    for (seed, name) in (0..).zip(FORMATS.split(' ')) {
        assert_eq!(difference(gpu, &text, seed, name), None);
    }
}

pub(crate) fn texels_decode_as_the_texture_room_has_it(gpu: &Arc<Gpu>) {
    let text = module::decoding();
    for (seed, name) in (100..).zip(FORMATS.split(' ')) {
        let main: Format = name.parse().unwrap_or_else(|e| panic!("{name}: {e}"));
        let mut random = Random::new(seed);
        let (mut words, mut expected) = (Vec::new(), Vec::new());
        for i in 0..64 * TexelFormat::ALL.len() {
            let format = TexelFormat::ALL[i % TexelFormat::ALL.len()];
            let rules = cases::rules(&mut random, main);
            let stored: [u32; 4] = [0; 4].map(|_: u32| random.bits());
            let raw = stored.iter().rev().fold(0, |raw, &w| raw << 32 | u128::from(w));
            words.extend(stored);
            words.extend(component_words(format, &rules));
            expected.extend(reference::stored(format, raw, &rules).map(|x| reference::raw(main, x)));
        }
        let inputs: [&[u32]; 4] = [&format_words(&main), &[0], &[0], &words];
        let count = words.len() / 8;
        let made =
            gpu.compute(&text, "decode_texels", &inputs, 4 * count, groups(count)).unwrap_or_else(|e| panic!("{e}"));
        for (i, (made, expected)) in made.chunks_exact(4).zip(expected.chunks_exact(4)).enumerate() {
            let format = TexelFormat::ALL[i % TexelFormat::ALL.len()];
            assert_eq!(made, expected, "{name} {format}: {:x?}", &words[8 * i..8 * i + 4]);
        }
    }
}
