//! Rows with lanes that leave the range of their format, or start at its limits: compares the batch executor, which
//! computes whole rows without checks and then repairs infinite results, with the scalar one.

use crate::random::Random;
use crate::sums::pixels;
use refsim::device::Profile;
use refsim::machine::{ExecutorKind, Machine};
use refsim::num::{Format, ops};

/// Side of a square of fragments, whose 256 pixels fill one row of lanes.
const SIDE: u32 = 16;

/// Operations on `r0` and `r1`: single ones, and combinations that rows compute in one pass.
const OPERATIONS: [&str; 11] = [
    "add r2, r0, r1",
    "sub r2, r0, r1",
    "mul r2, r0, r1",
    "add r2, r0, c0",
    "mul r2, r0, c0",
    "mad r2, r0, r1, r1.wzyx",
    "mad r2, r0, c0, r1",
    "dp3 r2, r0, r1",
    "dp4 r2, r0, c0",
    "mov r2, r1\ncrs r2.xyz, r0, r1",
    "rcp r2, r0.x",
];

const FORMATS: &str = "fp16:rna fp16:rtz fp16:rdn fp16:rtz:sat fp16:rdn:sat fp16:rna:nvovf fp16:rtz:nvovf \
                       fp16:rdn:nvovf fp16:rtz:ftz e4m3:rdn fp32:rna fp32:rtz fp32:rdn fp32:rtz:nvovf \
                       fp32:rdn:sat fp32:ftz:nvovf:nv fp32:sat fp32:nv e8m7:rtz s3.12:wrap";

/// Texels of ordinary numbers, with occasional numbers from the limits of the range.
fn texels(f: Format, random: &mut Random) -> Vec<[u32; 4]> {
    let ends = [0, 1, 2, f.one(), f.max_finite(), f.max_finite() - 1, f.max_finite() / 2, f.min_finite()];
    let mut number = || {
        let (r, more) = (random.bits(), random.bits());
        let pattern = match r % 16 {
            0 => ends[more as usize % ends.len()],
            1 => f.infinity(more % 2 == 0).unwrap_or(f.one()),
            2..=4 => more & f.mask(),
            _ => f.one() ^ more & (f.one() >> 3 | f.sign_bit()),
        };
        ops::convert(&f, Format::FP32, pattern).bits
    };
    (0..SIDE * SIDE).map(|_| [(); 4].map(|()| number())).collect()
}

fn drawn(profile: &Profile, kind: ExecutorKind, operation: &str, images: &[Vec<[u32; 4]>; 2]) -> Vec<u8> {
    let text = format!(
        "ps_2_0\ndef c0, 1.5, -3, 0.25, 7\ndcl t0\ndcl_2d s0\ndcl_2d s1\n\
         texld r0, t0, s0\ntexld r1, t0, s1\n{operation}\nmov oC0, r2\n"
    );
    pixels(&mut Machine::with_threads(profile.clone(), kind, 1).unwrap(), profile, &text, images)
}

#[test]
fn rows_agree_at_the_ends_of_the_range() {
    let mut random = Random::new(1);
    for name in FORMATS.split(' ') {
        let f: Format = name.parse().unwrap();
        let profile = Profile::named(&format!("ideal-{name}")).unwrap();
        for operation in OPERATIONS {
            let images = [texels(f, &mut random), texels(f, &mut random)];
            let expected = drawn(&profile, ExecutorKind::Scalar, operation, &images);
            let found = drawn(&profile, ExecutorKind::Batch, operation, &images);
            let differing = found.iter().zip(&expected).position(|(a, b)| a != b);
            let texel = differing.map(|byte| (images[0][byte / 16], images[1][byte / 16]));
            assert_eq!(texel, None, "{name}, {operation}: the first operands whose results differ");
        }
    }
}
