//! Rules of the shader models: comparisons at the boundary, modifiers, co-issue, phases, kills, depth, constants.

mod textures;

use crate::running::{bits, constants, ideal, image, input, into, run, run_quad, run_with_coordinates};
use refsim::device::{Profile, TexcrdOverflow, TexkillComponents};
use refsim::exec::DepthValue;
use refsim::exec::{BumpStage, Constants, PixelBindings, SamplerBinding};
use refsim::num::{Flags, Format};
use refsim::raster::FragmentInput;
use refsim::texture::{Filter, Image, MipFilter, SamplerState, TexelFormat, TextureKind};
use textures::with_texture;

const S3_12: Format = Format::S3_12;

fn s(v: [f32; 4]) -> [u32; 4] {
    into(S3_12, v)
}

/// r200 with constants in full precision.
fn r200() -> Profile {
    let mut profile = Profile::named("r200").unwrap();
    profile.set_switch("constants", "register").unwrap();
    profile.set_switch("rounding", "rne").unwrap();
    profile
}

#[test]
fn cnd_and_cmp_at_the_edge() {
    let c = [[0.5, 0.500_25, 0.0, -0.000_25], [1.0; 4], [0.25; 4]];
    let ran = run("ps_1_4\nmov r0, c0\nmov r1, c1\ncnd r2, r0, r1, c2\ncmp r3, r0, r1, c2\nmov r0, r2", &r200(), &c);
    assert_eq!(ran.value(2), s([0.25, 1.0, 0.25, 0.25]), "cnd: one half itself selects the second");
    assert_eq!(ran.value(3), s([1.0, 1.0, 1.0, 0.25]), "cmp: zero itself selects the first");
}

#[test]
fn cnd_before_1_4_looks_at_r0_alpha() {
    let text = "ps_1_1\nmov r0, c0\ncnd r0, r0.a, c1, c2";
    let a = run(text, &ideal("s3.12"), &[[0.0, 0.0, 0.0, 0.75], [1.0; 4], [0.25; 4]]);
    assert_eq!(a.value(1), s([1.0; 4]));
    let b = run(text, &ideal("s3.12"), &[[1.0, 1.0, 1.0, 0.5], [1.0; 4], [0.25; 4]]);
    assert_eq!(b.value(1), s([0.25; 4]));
}

#[test]
fn source_modifiers_round_each_step_and_negate_last() {
    let c = [[0.25, 0.75, 1.0, 0.0]];
    for (source, expected) in [
        ("-r0", [-0.25, -0.75, -1.0, 0.0]),
        ("1-r0", [0.75, 0.25, 0.0, 1.0]),
        ("r0_bias", [-0.25, 0.25, 0.5, -0.5]),
        ("-r0_bias", [0.25, -0.25, -0.5, 0.5]),
        ("r0_bx2", [-0.5, 0.5, 1.0, -1.0]),
        ("-r0_bx2", [0.5, -0.5, -1.0, 1.0]),
        ("r0_x2", [0.5, 1.5, 2.0, 0.0]),
        ("-r0_x2", [-0.5, -1.5, -2.0, 0.0]),
    ] {
        let ran = run(&format!("ps_1_4\nmov r0, c0\nmov r1, {source}\nmov r0, r1"), &r200(), &c);
        assert_eq!(ran.value(1), s(expected), "{source}");
    }
    // The replicate selector is applied before the modifier.
    let ran = run("ps_1_4\nmov r0, c0\nmov r1, 1-r0.g\nmov r0, r1", &r200(), &c);
    assert_eq!(ran.value(1), s([0.25; 4]));
    // -(-8) is not representable and saturates.
    let text = "ps_1_4\nmov_x8 r0, c0\nmov r1, -r0\nmov r0, r1";
    let ran = run(text, &r200(), &[[-1.0; 4]]);
    assert_eq!((ran.value(0), ran.value(1)), ([0x8000; 4], [0x7fff; 4]));
}

#[test]
fn shift_then_saturation_then_mask() {
    let c = [[0.25, -0.25, 0.75, 0.5]];
    for (modifier, expected) in [
        ("_x2", [0.5, -0.5, 1.5, 1.0]),
        ("_x4", [1.0, -1.0, 3.0, 2.0]),
        ("_x8", [2.0, -2.0, 6.0, 4.0]),
        ("_d2", [0.125, -0.125, 0.375, 0.25]),
        ("_d4", [0.0625, -0.0625, 0.1875, 0.125]),
        ("_d8", [0.03125, -0.03125, 0.09375, 0.0625]),
        ("_sat", [0.25, 0.0, 0.75, 0.5]),
        ("_x4_sat", [1.0, 0.0, 1.0, 1.0]),
    ] {
        let ran = run(&format!("ps_1_4\nmov{modifier} r0, c0"), &r200(), &c);
        assert_eq!(ran.value(0), s(expected), "{modifier}");
    }
    let ran = run("ps_1_4\nmov r0, c0\nmov r0.ga, c1\nadd r0, r0, r0", &r200(), &[c[0], [1.0; 4]]);
    assert_eq!(ran.value(2), s([0.5, 2.0, 1.5, 2.0]), "only the masked components are written");
}

#[test]
fn a_co_issued_pair_reads_what_stood_before_it() {
    let c = [[0.25, 0.25, 0.25, 0.75], [0.5; 4]];
    let text = "ps_1_4\nmov r0, c0\nmov r0.rgb, r0.a\n+mov r0.a, r0.r\nadd r0, r0, r0";
    let ran = run(text, &r200(), &c);
    assert_eq!(ran.value(3), s([1.5, 1.5, 1.5, 0.5]), "swapped, not copied");
    let apart = run(&text.replace("\n+mov", "\nmov"), &r200(), &c);
    assert_eq!(apart.value(3), s([1.5, 1.5, 1.5, 1.5]), "one after the other");
    let text = "ps_1_1\nmov r0, c0\ndp3 r0.rgb, r0, r0\n+mul r0.a, r0.b, r0.b";
    let ran = run(text, &ideal("e8m23"), &[[0.5, 0.5, 0.5, 1.0]]);
    assert_eq!(f32::from_bits(ran.value(1)[0]), 0.75);
    assert_eq!(f32::from_bits(ran.value(2)[3]), 0.25, "the old blue");
}

#[test]
fn alpha_is_lost_at_the_phase_marker() {
    let text = "ps_1_4\nmov r0, c0\nmov r1, c0\nphase\nmov r0.rgb, r1\nmov r0.a, c1.a";
    let ran = run(text, &r200(), &[[0.5; 4], [0.25; 4]]);
    assert_eq!(ran.results[0].colors[0], s([0.5, 0.5, 0.5, 0.25]));
}

#[test]
fn texdepth_divides_red_by_green() {
    let depth = |profile: &Profile, r: f32, g: f32| {
        let text = "ps_1_4\ntexcrd r5.rgb, t0\nphase\ntexdepth r5\nmov r0, c0";
        let ran = run_with_coordinates(text, profile, &[[r, g, 0.0, 0.0]]);
        let DepthValue { format, bits } = ran.results[0].depth.unwrap();
        assert_eq!(format, S3_12);
        bits
    };
    let raw = r200();
    let one = S3_12.one();
    assert_eq!(depth(&raw, 0.25, 0.5), one / 2);
    assert_eq!(depth(&raw, 0.25, 0.0), one, "a zero divisor gives 1.0");
    assert_eq!(depth(&raw, 0.0, 0.0), one);
    assert_eq!(depth(&raw, 0.5, 2.0), one / 4);
    assert_eq!(depth(&raw, -0.25, -0.5), one / 2, "signs cancel");
    let mut min1 = r200();
    min1.set_switch("texdepth-denominator", "min1").unwrap();
    assert_eq!(depth(&min1, 0.5, 2.0), one / 2, "the divisor is at most 1");
    assert_eq!(depth(&min1, 0.25, 0.5), one / 2);
}

#[test]
fn texkill_looks_at_the_components_its_version_names() {
    let tiny = -f32::MIN_POSITIVE;
    let killed =
        |text: &str, profile: &Profile, t: [f32; 4]| run_with_coordinates(text, profile, &[t]).results[0].killed;
    for text in ["ps_1_1\ntexkill t0\nmov r0, c0", "ps_1_4\ntexkill t0\nmov r0, c0"] {
        let profile = ideal("s3.12");
        assert!(!killed(text, &profile, [0.0, 1.0, 0.5, -1.0]), "w does not count");
        assert!(!killed(text, &profile, [-0.0, 0.0, 0.0, 0.0]), "-0 is not below zero");
        assert!(!killed(text, &profile, [f32::NAN, 0.0, 0.0, 0.0]), "nor is NaN");
        for i in 0..3 {
            let mut t = [0.5; 4];
            t[i] = tiny;
            assert!(killed(text, &profile, t), "component {i}, unrounded");
        }
    }
    let text = "ps_2_0\ndcl t0\ntexkill t0\nmov r0, c0\nmov oC0, r0";
    for (components, expected) in [(TexkillComponents::Three, false), (TexkillComponents::Four, true)] {
        let mut profile = ideal("e8m23");
        profile.rules.texkill_components = components;
        assert_eq!(killed(text, &profile, [1.0, 1.0, 1.0, -1.0]), expected);
    }
    let registers = "ps_1_4\ntexcrd r0.rgb, t0\nphase\ntexkill r0\nmov r0, c0";
    assert!(killed(registers, &r200(), [0.0, -0.5, 0.0, 0.0]));
    assert!(!killed(registers, &r200(), [0.0, tiny, 0.0, 0.0]), "a register holds the rounded value");
}

#[test]
fn an_unbound_sampler_reads_black_and_opaque() {
    let ran = run("ps_1_4\ntexld r0, t0\nmov r1, r0\nmov r0, r1", &r200(), &[]);
    assert_eq!(ran.value(0), s([0.0, 0.0, 0.0, 1.0]));
    assert_eq!(ran.fetches[0], 4, "and counts as a read");
}

#[test]
fn texcrd_saturates_or_wraps() {
    let at = |profile: &Profile, x: f32| {
        let ran = run_with_coordinates("ps_1_4\ntexcrd r0.rgb, t0\nmov r0, r0.r", profile, &[[x, 0.0, 0.0, 0.0]]);
        ran.value(0)[0]
    };
    let (mut clamp, wrap) = (r200(), r200());
    assert_eq!(wrap.rules.texcrd_overflow, TexcrdOverflow::PreserveWrap, "what the first hardware of ps_1_4 does");
    clamp.set_switch("texcrd-overflow", "clamp").unwrap();
    assert_eq!((at(&clamp, 9.25), at(&clamp, -20.0)), (0x7fff, 0x8000));
    assert_eq!(at(&wrap, 9.25), s([-6.75; 4])[0], "the fraction stays");
    assert_eq!((at(&clamp, 1.5), at(&wrap, 1.5)), (0x1800, 0x1800));
}

#[test]
fn projection_divides_in_single_precision_with_one_for_a_zero_divisor() {
    let text = "ps_1_4\ntexcrd r1.rg, t0_dw.xyw\nmov r0, c0\nmov r0.rg, r1";
    let at = |t: [f32; 4]| {
        let ran = run_with_coordinates(text, &r200(), &[t]);
        let v = ran.value(0);
        [v[0], v[1]]
    };
    assert_eq!(at([1.0, 3.0, 9.0, 4.0]), [0x400, 0xc00]);
    assert_eq!(at([1.0, 3.0, 9.0, 0.0]), [0x1000, 0x1000]);
}

/// `max(min(result, 1), -1)` after the shift, also for texture instructions; `_sat` precedes the clamp. The clamp
/// raises the overflow flag.
#[test]
fn results_of_nv2x_are_clamped_to_one() {
    let nv25 = Profile::named("nv25").unwrap();
    let c = [[0.75, -0.75, 0.5, -0.25], [1.0, 1.0, -1.0, 1.0], [1.0; 4]];
    let ran = run("ps_1_3\nmov r0, c0\nadd_d2 r1, r0, c0\nadd r0, r0, c0", &nv25, &c);
    let s = |v| into("n3.8:rna".parse().unwrap(), v);
    assert_eq!(ran.value(1), s([0.75, -0.75, 0.5, -0.25]), "scaled before it is clamped");
    assert_eq!(ran.value(2), s([1.0, -1.0, 1.0, -0.5]), "both ends belong to the range");
    let flags = |index| ran.steps.iter().find(|s| s.instruction == index).map(|s| s.flags);
    assert_eq!([1, 2].map(flags), [Some(Flags::empty()), Some(Flags::OVERFLOW | Flags::INEXACT)]);
    let ran = run("ps_1_3\nmov r1, c1\ndp3 r0, r1, c2\ndp3_x4 r0, r1, c2", &nv25, &c);
    assert_eq!((ran.value(1), ran.value(2)), (s([1.0; 4]), s([1.0; 4])), "1 + 1 - 1, clamped once");
    let t = [0.3, 0.0, 0.0, 1.0];
    let row = [[4.0, 4.0, 4.0, 0.0], [-4.0, -4.0, -4.0, 0.0]];
    let text = "ps_1_2\ntex t0\ntexdp3 t1, t0\ntexdp3 t2, t0\nmov r0, t1";
    let ran = with_texture(text, &nv25, &[t, row[0], row[1]], BumpStage::default());
    assert_eq!((ran.value(1), ran.value(2)), (s([1.0; 4]), s([-1.0; 4])));
    // Vertex programs are not affected.
    assert_eq!(nv25.rules.vertex_format, "e8m23:nv2x".parse().unwrap());
}

#[test]
fn addresses_are_not_rounded_to_the_register_format() {
    let values: Vec<[u32; 4]> = (0..8192).map(|i| bits([(i % 64) as f32, 0.0, 0.0, 0.0])).collect();
    let image = image(TexelFormat::R32f, [8192, 1], &values);
    let constants = Constants::default();
    let mut bindings = PixelBindings::new(&constants);
    bindings.samplers[0] = Some(SamplerBinding { image: &image, state: SamplerState::NEAREST_CLAMP });
    // At this coordinate fp16's step is four texels: 6001.5/8192 is truncated to 6000/8192.
    let t = 6001.5 / 8192.0;
    let program = "ps_2_0\ndcl t0\ndcl_2d s0\ntexld r0, t0, s0\nmov r1, t0\ntexld r1, r1, s0\nmov oC0, r0";
    let ran = run_quad(program, &ideal("e5m10:rtz"), &bindings, &[input(&[[t, 0.0, 0.0, 1.0]]); 4]);
    let half = |x: f32| into(Format::FP16, [x; 4])[0];
    assert_eq!(ran.value(0)[0], half(49.0), "texel 6001 from the coordinate");
    assert_eq!(ran.value(2)[0], half(48.0), "texel 6000 from the register");
}

#[test]
fn texldd_takes_the_level_of_its_derivatives() {
    let mut image = Image::new(TexelFormat::R32f, TextureKind::D2, [4, 4, 1], 3).unwrap();
    for level in 0..3 {
        for y in 0..4 >> level {
            for x in 0..4 >> level {
                image.set_raw(level, 0, y, x, u128::from((level as f32).to_bits()));
            }
        }
    }
    let state = SamplerState { mip: MipFilter::Nearest, min: Filter::Nearest, ..SamplerState::NEAREST_CLAMP };
    let constants = constants(&[[1.0, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0]]);
    let mut bindings = PixelBindings::new(&constants);
    bindings.samplers[0] = Some(SamplerBinding { image: &image, state });
    let text = "ps_2_a\ndcl t0\ndcl_2d s0\nmov r1, c0\nmov r2, c1\ntexldd r0, t0, s0, r1, r2\nmov oC0, r0";
    let ran = run_quad(text, &ideal("e8m23"), &bindings, &[FragmentInput::default(); 4]);
    assert_eq!(ran.results[3].colors[0][0], 2.0f32.to_bits(), "a step of a whole texture");
}

#[test]
fn partial_precision_rounds_through_fp16() {
    let profile = Profile::named("nv35").unwrap();
    assert!(profile.rules.partial.is_some(), "nv35 has a partial format");
    let c = [[1.0 + 1.0 / 4096.0, 1.0 / 3.0, 0.0, 1.0]];
    let ran = run("ps_2_0\nmov r0, c0\nmul_pp r1, r0, r0.x\nmul r2, r0, r0.x\nmov oC0, r1", &profile, &c);
    let fp16 = Format::FP16;
    let narrow = |x: f32| {
        let partial = profile.rules.partial.unwrap_or(fp16);
        refsim::num::ops::convert(&Format::FP32, partial, x.to_bits()).bits
    };
    let partial = profile.rules.partial.unwrap_or(fp16);
    let expected = [0, 1].map(|i: usize| {
        let product = refsim::num::ops::mul(partial, narrow(c[0][i]), narrow(c[0][0])).bits;
        refsim::num::ops::convert(&partial, profile.rules.format, product).bits
    });
    assert_eq!(ran.value(1)[..2], expected);
    assert_ne!(ran.value(1)[1], ran.value(2)[1]);
}

#[test]
fn the_trace_has_flags() {
    let ran = run("ps_1_4\nmov_x8 r0, c0\nmul r0, r0, r0", &r200(), &[[1.0, 0.25, 0.1, 0.0]]);
    let step = ran.steps.iter().find(|s| s.instruction == 1).unwrap();
    assert!(step.flags.contains(Flags::OVERFLOW), "8 * 8 leaves s3.12: {:?}", step.flags);
    // Inexact coordinates are attributed to the read, not to the instruction after it.
    let text = "ps_1_4\ntexcrd r0.rgb, t0\nmov r0.a, c0.a\nmov r1, r0\nmov r0, r1";
    let ran = run_with_coordinates(text, &r200(), &[[0.1; 4]]);
    let flags: Vec<Flags> = ran.steps.iter().map(|s| s.flags).collect();
    assert_eq!(flags, [Flags::INEXACT, Flags::empty(), Flags::empty(), Flags::empty()]);
}

#[test]
fn derivatives_are_differences_of_the_quad_in_every_lane() {
    let constants = constants(&[]);
    let bindings = PixelBindings::new(&constants);
    let quad: [FragmentInput; 4] =
        std::array::from_fn(|lane| input(&[[0.25 * (lane & 1) as f32, 0.25 * (lane >> 1) as f32, 0.0, 1.0]]));
    let text = "ps_2_a\ndcl t0\ndsx r0, t0\ndsy r1, t0\nmov r0.z, r1.y\nmov oC0, r0";
    for ran in run_quad(text, &ideal("e8m23"), &bindings, &quad).results {
        assert_eq!(ran.colors[0].map(f32::from_bits)[..3], [0.25, 0.0, 0.25]);
    }
}
