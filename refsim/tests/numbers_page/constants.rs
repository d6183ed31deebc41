//! Tests of "Constants": the values that a pixel program reads, on both executors of the host.

use super::running::{checked, constants, quads, screen};
use super::{Random, probes};
use refsim::device::{ConstantStorage, Profile};
use refsim::machine::{ExecutorKind, Machine};
use refsim::texture::TexelFormat;

/// The value of a constant as docs/numbers.md states it, for FP32 registers.
fn stored(storage: ConstantStorage, before_2_0: bool, x: f32) -> f32 {
    let x = if before_2_0 && !x.is_nan() { x.clamp(-1.0, 1.0) } else { x };
    let magnitude = x.abs().min(1.0);
    let k = match storage {
        ConstantStorage::Register => return x,
        // The FP64 sum is exact for every number whose last bit can affect k.
        ConstantStorage::Unorm8Expanded => {
            let x = if x.is_nan() { 0.0 } else { f64::from(x).clamp(-1.0, 1.0) };
            return (2.0 * (127.5 * (x + 1.0)).floor() as f32 - 255.0) / 255.0;
        }
        _ if x.is_nan() => 0,
        // The product is exact in FP64.
        ConstantStorage::Snorm8 => (f64::from(magnitude) * 255.0 + 0.5) as u8,
        ConstantStorage::Snorm8Cut => (magnitude * 255.0) as u8,
    };
    if x < 0.0 { -f32::from(k) / 255.0 } else { f32::from(k) / 255.0 }
}

#[test]
fn constants_are_stored_as_the_page_says() {
    let mut r = Random::new(47);
    for (&storage, version) in ConstantStorage::ALL.iter().flat_map(|s| [(s, "ps_1_4"), (s, "ps_2_0")]) {
        let mut profile = Profile::named("ideal-fp32").expect("a device");
        profile.rules.constant_storage = storage;
        let before_2_0 = version == "ps_1_4";
        let end = if before_2_0 { "" } else { "mov oC0, r0" };
        let program = checked(&format!("{version}\nmov r0, c0\n{end}"), &profile);
        // All bytes, and numbers between two of them.
        let codes = (0..128).map(|quad: u16| [0, 1, 2, 3].map(|i| f32::from(4 * quad + i) / 510.0));
        let random: Vec<[f32; 4]> = (0..probes(60)).map(|_| std::array::from_fn(|_| r.single())).collect();
        for values in random.into_iter().chain(codes) {
            // Results of ps_1_x are saturated: they show magnitudes, and no NaN.
            let shown = values.map(|x| {
                if !before_2_0 {
                    x
                } else if x.is_nan() {
                    0.5
                } else {
                    x.abs()
                }
            });
            let saturated = |x: f32| if before_2_0 { x.max(0.0) } else { x };
            let expected = shown.map(|x| saturated(stored(storage, before_2_0, x)));
            let host = constants(&[shown]);
            for kind in [ExecutorKind::Scalar, ExecutorKind::Batch] {
                let mut machine = Machine::new(profile.clone(), kind);
                let target = machine.create_target(TexelFormat::Rgba32f, 1, 1).expect("a target");
                machine.draw(&quads(&screen(), &program, &host, target)).expect("drawn");
                let texel = machine.read_back(target).expect("read").raw(0, 0, 0, 0);
                let found: [f32; 4] = std::array::from_fn(|i| f32::from_bits((texel >> (32 * i)) as u32));
                for (found, expected) in found.into_iter().zip(expected) {
                    let same = found == expected || (found.is_nan() && expected.is_nan());
                    assert!(same, "{storage:?}, {version}, {shown:?}: {found} for {expected}");
                }
            }
        }
    }
}
