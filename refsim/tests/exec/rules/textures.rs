//! Texture instructions before ps_1_4.

use refsim::device::Profile;
use refsim::exec::{BumpStage, DepthValue, PixelBindings, Projection, SamplerBinding};
use refsim::num::Format;
use refsim::texture::{Image, SamplerState, TexelFormat};

use crate::running::{QuadRun, bits, constants, ideal, image, input, run_quad};

/// `D3DTTFF_PROJECTED`: `tex` reads at (x / w, y / w) or (x / z, y / z); `texbem` adds to these coordinates.
#[test]
fn projected_textures_before_1_4() {
    let fp32 = ideal("e8m23");
    let image = texture([[0.0, 0.1, 0.2, 0.3], [0.25, 0.5, 0.75, 1.0], [0.5, 0.25, 0.0, 0.75], [0.75, 0.0, 0.0, 0.5]]);
    let constants = constants(&[]);
    let mut bindings = PixelBindings::new(&constants);
    bindings.samplers[..2].fill(Some(SamplerBinding { image: &image, state: SamplerState::NEAREST_CLAMP }));
    bindings.bump[1].matrix = bits([1.0, 0.0, 0.0, 0.0]);
    let first = |projection, text, index: usize| {
        let mut projected = bindings;
        projected.projections = [projection; 8];
        let ran = run_quad(text, &fp32, &projected, &[input(&[[1.2, 0.0, 2.0, 4.0], [0.0, 0.0, 1.0, 2.0]]); 4]);
        f32::from_bits(ran.value(index)[0])
    };
    let tex = "ps_1_1\ntex t0\nmov r0, t0";
    let texels = [Projection::None, Projection::Z, Projection::W].map(|p| first(p, tex, 0));
    assert_eq!(texels, [0.75, 0.5, 0.25], "1.2 is clamped to the last texel, 0.6 in the third, 0.3 in the second");
    let texbem = "ps_1_1\ntex t0\ntexbem t1, t0\nmov r0, t1";
    assert_eq!(first(Projection::W, texbem, 1), 0.25, "0 / 2 + 0.25");
}

fn texture(texels: [[f32; 4]; 4]) -> Image {
    image(TexelFormat::Rgba32f, [4, 1], &texels.map(bits))
}

/// Runs with a 4x1 texture on the first four stages.
pub(crate) fn with_texture(text: &str, profile: &Profile, sets: &[[f32; 4]], bump: BumpStage) -> QuadRun {
    let image = texture([[0.0, 0.1, 0.2, 0.3], [0.25, 0.5, 0.75, 1.0], [0.5, 0.25, 0.0, 0.75], [0.75, 0.0, 0.0, 0.5]]);
    let constants = constants(&[[1.0, 0.0, 0.0, 0.0]]);
    let mut bindings = PixelBindings::new(&constants);
    let binding = SamplerBinding { image: &image, state: SamplerState::NEAREST_CLAMP };
    bindings.samplers[..4].fill(Some(binding));
    bindings.bump = [bump; 8];
    run_quad(text, profile, &bindings, &[input(sets); 4])
}

#[test]
fn every_texture_instruction_before_1_4() {
    let fp32 = ideal("e8m23");
    let none = BumpStage::default();
    let f = |v: [u32; 4]| v.map(f32::from_bits);
    let run = |text: &str, sets: &[[f32; 4]], index: usize| f(with_texture(text, &fp32, sets, none).value(index));
    let t = [0.3, 0.0, 0.0, 1.0]; // texel 1: .25 .5 .75 1
    assert_eq!(run("ps_1_1\ntex t0\nmov r0, t0", &[t], 0), [0.25, 0.5, 0.75, 1.0]);
    assert_eq!(run("ps_1_1\ntexcoord t0\nmov r0, t0", &[[-1.0, 0.5, 3.0, 9.0]], 0), [0.0, 0.5, 1.0, 1.0]);
    // a = 1 -> clamped to texel 3; r = .25 -> v.
    assert_eq!(run("ps_1_1\ntex t0\ntexreg2ar t1, t0\nmov r0, t1", &[t], 1), [0.75, 0.0, 0.0, 0.5]);
    // g = .5 -> texel 2
    assert_eq!(run("ps_1_1\ntex t0\ntexreg2gb t1, t0\nmov r0, t1", &[t], 1), [0.5, 0.25, 0.0, 0.75]);
    // r = .25 -> texel 1
    assert_eq!(run("ps_1_2\ntex t0\ntexreg2rgb t1, t0\nmov r0, t1", &[t], 1), [0.25, 0.5, 0.75, 1.0]);
    // (1, 2, 0).(.25, .5, .75) = 1.25
    let row = [1.0, 2.0, 0.0, 0.0];
    assert_eq!(run("ps_1_2\ntex t0\ntexdp3 t1, t0\nmov r0, t1", &[t, row], 1), [1.25; 4]);
    let half = [1.0, 0.5, 0.0, 0.0]; // .5: texel 2
    assert_eq!(run("ps_1_2\ntex t0\ntexdp3tex t1, t0\nmov r0, t1", &[t, half], 1), [0.5, 0.25, 0.0, 0.75]);
    let matrix = "ps_1_1\ntex t0\ntexm3x2pad t1, t0\ntexm3x2tex t2, t0\nmov r0, t2";
    assert_eq!(run(matrix, &[t, half, row], 2), [0.5, 0.25, 0.0, 0.75]);
    let matrix = "ps_1_1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3tex t3, t0\nmov r0, t3";
    assert_eq!(run(matrix, &[t, half, row, row], 3), [0.5, 0.25, 0.0, 0.75]);
    let matrix = "ps_1_2\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3 t3, t0\nmov r0, t3";
    assert_eq!(run(matrix, &[t, half, row, [0.0, 0.0, 1.0, 0.0]], 3), [0.5, 1.25, 0.75, 1.0]);
}

#[test]
fn reflections_depth_and_bumps_before_1_4() {
    let fp32 = ideal("e8m23");
    let none = BumpStage::default();
    let f = |v: [u32; 4]| v.map(f32::from_bits);
    let t = [0.3, 0.0, 0.0, 1.0];
    // Normal (.5, 0, 0) from texel 1; eye (1, 0, 0): the reflection is the eye itself, u = 1: texel 3.
    let (x, z) = ([2.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 0.0]);
    let spec = "ps_1_1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3spec t3, t0, c0\nmov r0, t3";
    assert_eq!(f(with_texture(spec, &fp32, &[t, x, z, z], none).value(3)), [0.75, 0.0, 0.0, 0.5]);
    // The eye is in the fourth components of the coordinates: (1, 0, 0) again.
    let vspec = "ps_1_1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3vspec t3, t0\nmov r0, t3";
    assert_eq!(f(with_texture(vspec, &fp32, &[t, x, z, z], none).value(3)), [0.75, 0.0, 0.0, 0.5]);
    let depth = "ps_1_3\ntex t0\ntexm3x2pad t1, t0\ntexm3x2depth t2, t0\nmov r0, c0";
    let single = |bits| Some(DepthValue { format: Format::FP32, bits });
    let ran = with_texture(depth, &fp32, &[t, [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]], none);
    assert_eq!(ran.results[0].depth, single(0.5f32.to_bits()));
    let ran = with_texture(depth, &fp32, &[t, [1.0, 0.0, 0.0, 0.0], z], none);
    assert_eq!(ran.results[0].depth, single(1.0f32.to_bits()), "a zero divisor gives 1.0");
    let bump = BumpStage {
        matrix: bits([1.0, 0.0, 0.5, 0.0]),
        luminance_scale: bits([0.5; 4])[0],
        luminance_offset: bits([0.25; 4])[0],
    };
    // u' = (0 + 1 * .25) + .5 * .5 = .5: texel 2.
    let start = [t, [0.0, 0.0, 0.0, 1.0]];
    let ran = with_texture("ps_1_1\ntex t0\ntexbem t1, t0\nmov r0, t1", &fp32, &start, bump);
    assert_eq!(f(ran.value(1)), [0.5, 0.25, 0.0, 0.75]);
    // Brightness .75 * .5 + .25 = .625
    let ran = with_texture("ps_1_1\ntex t0\ntexbeml t1, t0\nmov r0, t1", &fp32, &start, bump);
    assert_eq!(f(ran.value(1)), [0.3125, 0.15625, 0.0, 0.46875]);
    let ran = with_texture(
        "ps_1_4\ntexld r0, t0\ntexcrd r1.rgb, t1\nbem r1.rg, r1, r0\nphase\ntexld r2, r1\nmov r0, r2",
        &fp32,
        &start,
        bump,
    );
    assert_eq!(f(ran.value(2))[..2], [0.5, 0.0], "bem");
    assert_eq!(f(ran.value(4)), [0.5, 0.25, 0.0, 0.75], "and the read that depends on it");
}
