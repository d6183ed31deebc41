//! Rules for products and sums: their effect, their stage, their equivalences, and refusals.

use crate::running::{ideal, run, run_vertex};
use crate::sums::drawn;
use refsim::device::{AddMode, DeviceError, MadMode, Profile, Storage};
use refsim::exec::Constants;
use refsim::machine::{ExecutorKind, Machine};
use refsim::num::{DotOrder, Format, Rounding, ops};

fn scalar(profile: &Profile, seed: u64) -> Vec<u8> {
    drawn(Machine::new(profile.clone(), ExecutorKind::Scalar), profile, seed)
}

/// GT200 flushes magnitudes below 2^-33 in conversions to half floats, in every rounding.
#[test]
fn executors_agree_on_half_floats_of_gt200() {
    for rounding in ["rne", "rtz", "rdn", "rup"] {
        let mut profile = ideal("fp32");
        profile.set_format("e8m23:gt200".parse().unwrap()).unwrap();
        profile.set_storage_format(Storage::Outputs, Some(format!("fp16:{rounding}").parse().unwrap())).unwrap();
        let batch = drawn(Machine::new(profile.clone(), ExecutorKind::Batch), &profile, 7);
        assert!(batch == scalar(&profile, 7), "{rounding}");
    }
}

#[test]
fn products_rounded_as_sums_are_no_rule() {
    for format in ["fp24", "fp24:rtz", "s3.12:rdn", "n3.8:rna"] {
        let plain = ideal(format);
        let mut same = plain.clone();
        same.rules.product_rounding = Some(plain.rules.format.rounding);
        assert!(scalar(&plain, 3) == scalar(&same, 3), "{format}");
        let mut other = plain.clone();
        let rounding =
            if plain.rules.format.rounding == Rounding::Down { Rounding::TowardZero } else { Rounding::Down };
        other.rules.product_rounding = Some(rounding);
        assert!(scalar(&plain, 3) != scalar(&other, 3), "{format}: the rule does nothing");
    }
}

/// With enough bits for the exponents of a short format, an aligned sum is the exact one.
#[test]
fn enough_bits_are_rounded_sums() {
    let plain = ideal("e4m3fn");
    let mut aligned = plain.clone();
    aligned.rules.add = AddMode::Aligned(28);
    assert!(scalar(&plain, 5) == scalar(&aligned, 5));
    aligned.rules.add = AddMode::Aligned(1);
    assert!(scalar(&plain, 5) != scalar(&aligned, 5));
}

/// The first product is the midpoint of two representable numbers.
#[test]
fn every_rule_shows_in_pixels_and_in_pixels_alone() {
    let (a, b) = ([1.5, 1.000_122_1, 3.0, 0.0], [1.000_015_3, 1.000_122_1, -0.333_251_95, 0.0]);
    let c = [-1.5, 0.5, 0.5, 0.5];
    let pixel = |profile: &Profile| {
        let text = "ps_2_0\nmov r0, c0\nmov r1, c1\nmad r2, r0, r1, c2\ndp3 r3, r0, r1\nadd r4, r2, r3\nmov oC0, r4";
        let ran = run(text, profile, &[a, b, c]);
        [ran.value(2), ran.value(3), ran.value(4)]
    };
    let vertex = |profile: &Profile| {
        let text = "vs_1_1\ndcl_position v0\ndcl_normal v1\nmov oPos, v0\nmad oT0, v0, v1, v1";
        run_vertex(text, profile, &Constants::default(), &[a, b]).vertex.texcoords[0]
    };
    let mut plain = ideal("fp24:rtz");
    plain.rules.vertex_format = Format::FP24;
    let (pixels, vertices) = (pixel(&plain), vertex(&plain));
    let changed = |change: fn(&mut Profile)| {
        let mut profile = plain.clone();
        change(&mut profile);
        assert_eq!(vertex(&profile), vertices, "{:?}", profile.rules);
        pixel(&profile) != pixels
    };
    assert!(changed(|p| p.rules.product_rounding = Some(Rounding::NearestEven)));
    assert!(changed(|p| p.rules.dot = DotOrder::Aligned(3)));
    assert!(changed(|p| p.rules.add = AddMode::Aligned(3)));
    assert!(changed(|p| p.rules.mad = MadMode::Fused));
}

#[test]
fn products_are_cut_with_any_exponent() {
    let mut profile = ideal("fp32");
    profile.set_switch("mad", "product-cut").unwrap();
    let mad = |operands: [u32; 3]| {
        let text = "ps_2_0\nmov r0, c0\nmov r1, c1\nmad r2, r0, r1, c2\nmov oC0, r2";
        run(text, &profile, &operands.map(|x| [f32::from_bits(x); 4])).value(2)[0]
    };
    // Results measured on a GT200.
    assert_eq!(mad([0x3fff_ffff, 0x3fff_ffff, 0xc080_0000]), 0xb500_0000);
    assert_eq!(mad([0x7f00_0000, 0x4000_0000, 0xff7f_ffff]), 0x7380_0000);
}

#[test]
fn rules_of_exponents_are_refused_for_fixed_point() {
    for (switch, value) in [("dot", "aligned:17"), ("add", "aligned:17"), ("mad", "product-cut")] {
        for format in ["s3.12", "n3.8"] {
            let mut profile = ideal(format);
            let before = profile.clone();
            let error = profile.set_switch(switch, value).expect_err("a refusal");
            assert!(matches!(&error, DeviceError::NeedsFloats { switch: name, .. } if name == switch), "{error}");
            assert_eq!(profile, before);
        }
        // Nor does replacing the format drop settings silently.
        let mut profile = ideal("fp24");
        profile.set_switch(switch, value).unwrap();
        assert!(matches!(profile.replace_format("s3.12"), Err(DeviceError::NeedsFloats { .. })), "{switch}");
        profile.replace_format("fp16").unwrap();
        profile.set_format(Format::S3_12).unwrap();
        assert!(profile.set_switch(switch, value).is_err());
        let text = "ps_2_0\nmov r0, c0\nmad r1, r0, r0, r0\nmov oC0, r1";
        let x = ops::convert(&Format::FP32, Format::S3_12, 0x3fc0_0000).bits;
        assert_eq!(run(text, &profile, &[[1.5; 4]]).value(1), [ops::mad(Format::S3_12, x, x, x).bits; 4]);
        profile.set_format(Format::FP16).unwrap();
        profile.set_switch(switch, value).unwrap();
    }
    assert!(ideal("fp24").set_switch("dot", "aligned:29").is_err());
}
