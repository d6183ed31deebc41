//! Draws whose pixels multiply and add under rules for products and sums.
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

use crate::random::Random;
use crate::running::{checked, ideal, image, quads, screen};
use refsim::device::{AddMode, MadMode, Profile};
use refsim::exec::Constants;
use refsim::machine::Machine;
use refsim::num::{DotOrder, Format, Rounding};
use refsim::texture::{SamplerState, TexelFormat};

/// Width and height of the target, in pixels.
const SIDE: u32 = 24;

const FORMATS: &str = "fp24:rtz:ftz fp24 fp16 fp16:rdn:ftz fp32 fp32:rtz:ftz fp32:rna:nvovf:nv e5m2:rdn:sat \
                       e4m3fn fp24:rup s3.12:rtz n3.8:rna";

/// A device with random rules for products and sums; the seed selects the format in turn.
pub(crate) fn profile(seed: u64) -> Profile {
    let mut random = Random::new(seed);
    let formats: Vec<&str> = FORMATS.split(' ').collect();
    let mut profile = ideal(formats[seed as usize % formats.len()]);
    let rules = &mut profile.rules;
    let roundings = [Rounding::NearestEven, Rounding::NearestAway, Rounding::TowardZero, Rounding::Down];
    rules.product_rounding = [None, Some(random.of(&roundings))][random.below(2usize)];
    rules.add = [AddMode::Rounded, AddMode::Aligned(random.below(29))][random.below(2usize)];
    rules.mad = random.of(MadMode::ALL);
    let aligned = DotOrder::Aligned(random.below(29));
    rules.dot = random.of(&[aligned, aligned, DotOrder::Sequential, DotOrder::Tree, DotOrder::Exact]);
    rules.zero_times_anything = random.coin();
    if random.one_in(3) && !rules.format.is_fixed() {
        let accumulators = ["e8m13", "fp16:rtz", "fp32:rtz:ftz", "e6m9:rna:sat"];
        let accumulator = random.of(&accumulators).parse::<Format>().expect("a format");
        // An accumulator that does not fit is ignored.
        let _ = profile.set_accumulator(Some(accumulator));
    }
    profile
}

/// Numbers in single precision: some with equal exponents, some with few bits, some special.
fn numbers(random: &mut Random) -> Vec<[u32; 4]> {
    let mut number = || {
        let bits = random.bits();
        match random.below(8u32) {
            0..4 => bits & 0x8000_0000 | (118 + bits % 18) << 23 | bits >> 8 & 0x7f_ffff,
            4 | 5 => bits & 0x8000_0000 | (124 + bits % 6) << 23 | ((bits >> 4) % 32) << 18,
            6 => random.number(),
            _ => random.special(),
        }
    };
    (0..SIDE * SIDE).map(|_| [0; 4].map(|_: u32| number())).collect()
}

/// Program bodies that compute all components of `r3` from three vectors.
const BODIES: [&str; 5] = [
    "mad r3, r0, r1, r2",
    "dp4 r3.x, r0, r1\ndp3 r3.y, r0, r2\ndp2add r3.z, r0, r1, r2.x\ndp4 r3.w, r0, -r1",
    "sub r3, r0, r1\nmul r3.yw, r0, r1\nadd r3.z, r1, -r2",
    "lrp r3, r0, r1, r2",
    "crs r3.xyz, r0, r1\nnrm r4, r2\nmov r3.w, r4.x",
];

/// Draws every program; returns the pixels in the order of the programs.
pub(crate) fn drawn(mut machine: Machine, profile: &Profile, seed: u64) -> Vec<u8> {
    let mut random = Random::new(seed ^ 0x5eed);
    let textures = [0; 3].map(|_: u32| numbers(&mut random));
    let head = "ps_2_a\ndcl t0\ndcl_2d s0\ndcl_2d s1\ndcl_2d s2\ntexld r0, t0, s0\ntexld r1, t0, s1\ntexld r2, t0, s2";
    let draw = |body| pixels(&mut machine, profile, &format!("{head}\n{body}\nmov oC0, r3"), &textures);
    BODIES.into_iter().flat_map(draw).collect()
}

/// Draws a square with a program that reads single-precision textures, one texel per pixel; returns the pixels.
pub(crate) fn pixels(machine: &mut Machine, profile: &Profile, text: &str, textures: &[Vec<[u32; 4]>]) -> Vec<u8> {
    let side = textures[0].len().isqrt() as u32;
    let program = checked(text, profile);
    let target = machine.create_target(TexelFormat::Rgba32f, side, side).unwrap();
    let (vertices, constants) = (screen(), Constants::default());
    let mut call = quads(&vertices, &program, &constants, target);
    for (sampler, values) in textures.iter().enumerate() {
        let texture = machine.create_texture(image(TexelFormat::Rgba32f, [side; 2], values)).unwrap();
        call = call.with_texture(sampler, texture, SamplerState::NEAREST_CLAMP);
    }
    machine.draw(&call).unwrap();
    machine.read_back(target).unwrap().bytes().to_vec()
}
