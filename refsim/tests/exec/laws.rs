//! Properties of the scalar executor over random programs, random data and every device.

use crate::{generate, running};
use proptest::{collection::vec, prelude::*, sample::select};
use refsim::asm::assemble;
use refsim::device::Profile;
use refsim::exec::scalar::{PixelProgram, VertexProgram};
use refsim::exec::{BumpStage, CheckedProgram, Constants, NoObserver, PixelBindings, SamplerBinding};
use refsim::isa::{Opcode, Stage, Version};
use refsim::num::Format;
use refsim::raster::FragmentInput;
use refsim::texture::{Filter, Image, SamplerState, TexelFormat, TextureKind};

/// The cards, and some ideal devices with unusual formats.
fn profiles() -> Vec<Profile> {
    let mut names: Vec<String> = Profile::card_names().into_iter().map(str::to_owned).collect();
    let formats = [
        "s3.12:rdn:wrap",
        "s0.7",
        "e5m10:nvovf:nv",
        "e2m1",
        "e7m16:rtz:ftz",
        "e8m23:sat",
        "s31.0",
        "s7.24",
        "n3.8:rna",
        "n0.4:wrap",
    ];
    for format in formats {
        names.push(format!("ideal-{format}"));
    }
    names.iter().map(|n| Profile::named(n).unwrap()).collect()
}

/// A number of any kind, mostly ordinary ones.
fn number() -> impl Strategy<Value = u32> {
    prop_oneof![
        4 => (-2000i32..2000).prop_map(|n| (n as f32 / 512.0).to_bits()),
        2 => any::<u32>(),
        1 => select(vec![0u32, 0x8000_0000, 1, 0x7f7f_ffff, 0x7f80_0000, 0xff80_0000, 0x7fc0_0000, 0x3f80_0000]),
    ]
}

fn vectors(count: usize) -> impl Strategy<Value = Vec<[u32; 4]>> {
    vec(prop::array::uniform4(number()), count)
}

fn image(seed: u32) -> Image {
    // Wide channels, narrow ones, signed bytes, and a single channel.
    let formats = [TexelFormat::Rgba16, TexelFormat::Bgr565, TexelFormat::Rg8Snorm, TexelFormat::A8];
    let mut image = Image::new(formats[seed as usize % 4], TextureKind::D2, [4, 4, 1], 1).unwrap();
    for (i, byte) in image.bytes_mut().iter_mut().enumerate() {
        *byte = (i as u32).wrapping_mul(seed | 1).to_le_bytes()[1];
    }
    image
}

fn inputs(data: &[[u32; 4]]) -> [FragmentInput; 4] {
    let mut out = [FragmentInput::default(); 4];
    for (i, v) in data.iter().enumerate() {
        let input = &mut out[i % 4];
        match i / 4 {
            n @ 0..8 => input.t[n] = *v,
            n => input.v[n & 1] = *v,
        }
    }
    out
}

/// Checks a result: no bits above the width, and only the canonical NaN. The units of cards pass NaN payloads
/// unchanged.
fn well_formed(format: Format, value: [u32; 4]) -> bool {
    let any_nan = format.unit.is_card();
    value
        .iter()
        .all(|&x| x & !format.mask() == 0 && (any_nan || !format.is_nan(x) || Some(x) == format.canonical_nan()))
}

fn run_pixel(
    program: &CheckedProgram,
    profile: &Profile,
    data: &[[u32; 4]],
    host: &Constants,
) -> Result<(), TestCaseError> {
    let image = image(data[0][0]);
    let mut bindings = PixelBindings::new(host);
    let linear = SamplerState { min: Filter::Linear, mag: Filter::Linear, ..SamplerState::default() };
    let state = if data[0][1] & 1 == 0 { SamplerState::default() } else { linear };
    bindings.samplers[0] = Some(SamplerBinding { image: &image, state });
    bindings.bump = [BumpStage { matrix: data[1], luminance_scale: data[2][0], luminance_offset: data[2][1] }; 8];
    let prepared = PixelProgram::new(program, &profile.rules, &bindings);
    let inputs = inputs(data);
    let mut fetches = [0; 16];
    let all = prepared.run(&inputs, 0b1111, &mut fetches, &mut NoObserver).0;
    for result in &all {
        for color in result.colors {
            prop_assert!(well_formed(profile.rules.format, color), "{color:x?} in {}", profile.rules.format);
        }
    }
    // The set of covered lanes affects only the counts.
    let mut fewer = [0; 16];
    prop_assert_eq!(all, prepared.run(&inputs, 0b0100, &mut fewer, &mut NoObserver).0);
    prop_assert!(fewer.iter().zip(fetches).all(|(&few, many)| few <= many));
    // Without derivatives, lanes are independent: each equals its lane in a quad of copies.
    if !program.instructions.iter().any(|i| matches!(i.opcode, Opcode::Dsx | Opcode::Dsy)) {
        for (lane, input) in inputs.iter().enumerate() {
            let alone = prepared.run(&[*input; 4], 0b1111, &mut [0; 16], &mut NoObserver).0;
            prop_assert_eq!(alone[0], all[lane], "lane {}", lane);
        }
    }
    Ok(())
}

fn run_vertex(
    program: &CheckedProgram,
    profile: &Profile,
    data: &[[u32; 4]],
    host: &Constants,
) -> Result<(), TestCaseError> {
    let prepared = VertexProgram::new(program, &profile.rules, host);
    let mut attributes = [[0; 4]; 16];
    for (slot, v) in attributes.iter_mut().zip(data) {
        *slot = *v;
    }
    let (result, cut) = prepared.run(&attributes, &mut NoObserver);
    let handed_on = Format::FP32.with_unit(profile.rules.vertex_format.unit);
    prop_assert!(well_formed(handed_on, result.vertex.position));
    prop_assert_eq!((result, cut), prepared.run(&attributes, &mut NoObserver));
    Ok(())
}

fn run(program: &CheckedProgram, profile: &Profile, data: &[[u32; 4]], host: &Constants) -> Result<(), TestCaseError> {
    match program.version.stage() {
        Stage::Pixel => run_pixel(program, profile, data, host),
        Stage::Vertex => run_vertex(program, profile, data, host),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// Legal programs run on every device that has their version, with any data.
    #[test]
    fn legal_programs_run(
        version in select(&Version::ALL[..]),
        seed in any::<u64>(),
        data in vectors(40),
        constants in vectors(8),
        which in any::<prop::sample::Index>(),
    ) {
        let fitting: Vec<Profile> = profiles().into_iter().filter(|p| p.supports(version)).collect();
        let profile = which.get(&fitting);
        let text = generate::legal(version, seed);
        let program = assemble(&text).map_err(|e| TestCaseError::fail(format!("{text}\n{e:?}")))?;
        let Ok(program) = running::ready(program, profile) else {
            // A limit of this device rejects it; an ideal device accepts all programs, as tested below.
            return Ok(());
        };
        let host = Constants { float: constants, int: vec![[2, 0, 1, 0]; 16], boolean: vec![true, false], ..Constants::default() };
        run(&program, profile, &data, &host)?;
    }
}
