//! Textures that are too large for a table of their texels, read by the batch executor and by the scalar one.

use crate::random::Random;
use crate::running::{checked, ideal, image, quads, screen};
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{ExecutorKind, Machine};
use refsim::texture::{AddressMode, Filter, FilterArithmetic, Image, SamplerState, TexelFormat};

/// Width and height of the target, in pixels.
const SIDE: u32 = 18;
const MODES: [AddressMode; 4] = [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border];

/// Reads the texture at the coordinates that another texture holds for each pixel; returns the bytes of the target.
fn drawn(profile: &Profile, kind: ExecutorKind, [coordinates, texture]: [&Image; 2], state: SamplerState) -> Vec<u8> {
    let text = "!!FP1.0\nTEX R0, f[TEX0], TEX0, 2D;\nTEX R1, R0, TEX1, 2D;\nMOVR o[COLR], R1;\nEND";
    let program = checked(text, profile);
    let mut machine = Machine::new(profile.clone(), kind);
    let target = machine.create_target(TexelFormat::Rgba32f, SIDE, SIDE).unwrap();
    let [coordinates, texture] = [coordinates, texture].map(|image| machine.create_texture(image.clone()).unwrap());
    let (vertices, constants) = (screen(), Constants::default());
    let call = quads(&vertices, &program, &constants, target)
        .with_texture(0, coordinates, SamplerState::NEAREST_CLAMP)
        .with_texture(1, texture, state);
    machine.draw(&call).unwrap();
    machine.read_back(target).unwrap().bytes().to_vec()
}

#[test]
fn large_textures_are_read_alike() {
    let mut random = Random::new(1);
    for (&format, mode) in TexelFormat::ALL.iter().zip(MODES.into_iter().cycle()) {
        let mut texture = Image::new_2d(format, 601, 600).unwrap();
        texture.bytes_mut().fill_with(|| random.next() as u8);
        let mut coordinate = || random.between(-1.5, 2.5).to_bits();
        let values: Vec<_> = (0..SIDE * SIDE).map(|_| [coordinate(), coordinate(), 0, 0]).collect();
        let images = [&image(TexelFormat::Rgba32f, [SIDE; 2], &values), &texture];
        let border = [0x3e80_0000, 0x3f00_0000, 0x3f40_0000, 0x3f80_0000];
        let nearest = SamplerState { address_u: mode, address_v: mode, border, ..SamplerState::NEAREST_CLAMP };
        let linear = SamplerState { min: Filter::Linear, mag: Filter::Linear, ..nearest };
        for registers in ["fp32", "fp16", "fp24:rdn", "fp32:rna:ftz", "s3.12"] {
            let mut profile = ideal("fp32");
            profile.set_format(registers.parse().unwrap()).unwrap();
            for (state, arithmetic) in
                [nearest, linear].into_iter().flat_map(|s| FilterArithmetic::ALL.iter().map(move |a| (s, *a)))
            {
                profile.rules.filter_arithmetic = arithmetic;
                let [scalar, batch] =
                    [ExecutorKind::Scalar, ExecutorKind::Batch].map(|kind| drawn(&profile, kind, images, state));
                assert!(scalar == batch, "{format}, {registers}, {state:?}, {arithmetic:?}");
            }
        }
    }
}
