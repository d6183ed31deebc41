//! Random inputs of a quad, and the reference's results for it without textures.

use proptest::{collection::vec, prelude::*, sample::select};
use refsim::device::Profile;
use refsim::exec::scalar::PixelProgram;
use refsim::exec::{Constants, FragmentResult, NoObserver, PixelBindings};
use refsim::isa::{Program, Version};
use refsim::raster::FragmentInput;

const PS_2: [Version; 3] = [Version::Ps2_0, Version::Ps2A, Version::Ps2B];

/// Formats whose numbers are all representable in fp32.
pub(crate) const WITHIN_FP32: [&str; 8] =
    ["fp16:rup", "e5m2", "e4m3fn:sat", "fp24:ftz", "s3.12:rup", "s0.7:wrap", "e2m1fn", "e5m2fnuz"];

fn number() -> impl Strategy<Value = u32> {
    prop_oneof![
        4 => (-2000i32..2000).prop_map(|n| (n as f32 / 512.0).to_bits()),
        1 => any::<u32>(),
        1 => select(vec![0u32, 0x8000_0000, 1, 0x7f7f_ffff, 0x7f80_0000, 0xff80_0000, 0x7fc0_0000, 0x3f80_0000]),
    ]
}

pub(crate) fn vectors(count: usize) -> impl Strategy<Value = Vec<[u32; 4]>> {
    vec(prop::array::uniform4(number()), count)
}

pub(crate) fn inputs(data: &[[u32; 4]]) -> [FragmentInput; 4] {
    std::array::from_fn(|lane| {
        let mut input = FragmentInput::default();
        (0..8).for_each(|set| input.t[set] = data[(lane + 3 * set) % data.len()]);
        (0..2).for_each(|color| input.v[color] = data[(2 * lane + color) % data.len()]);
        input
    })
}

/// The text of a legal program of `ps_2_x`, the inputs of a quad, and constants.
pub(crate) fn cases() -> impl Strategy<Value = (String, [FragmentInput; 4], Constants)> {
    (select(&PS_2[..]), any::<u64>(), vectors(24), vectors(8)).prop_map(|(version, seed, data, float)| {
        (crate::generate::legal(version, seed), inputs(&data), Constants { float, ..Constants::default() })
    })
}

/// The results of a program on a quad, without textures; `None` if the device refuses the program.
pub(crate) fn results(
    program: Program,
    profile: &Profile,
    inputs: &[FragmentInput; 4],
    host: &Constants,
) -> Option<[FragmentResult; 4]> {
    let checked = crate::running::ready(program, profile).ok()?;
    let bindings = PixelBindings::new(host);
    let prepared = PixelProgram::new(&checked, &profile.rules, &bindings);
    Some(prepared.run(inputs, 0b1111, &mut [0; 16], &mut NoObserver).0)
}
