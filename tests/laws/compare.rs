//! Laws of `crossbar::compare`: ULPs are a metric, and every change to a trace is found where it was made.

use std::path::Path;

use crate::support::file;
use crossbar::{
    case::{Loaded, Scope, Setup, Side, compare},
    compare::{Number, TargetFormats, TraceDifference, TraceSide, TraceStage, first_difference, ulps},
};
use proptest::prelude::*;
use refsim::{
    exec::ResolvedConstants,
    isa::Mask,
    machine::{ExecutorKind, FragmentTrace},
    num::{Format, ops},
    output::FragmentFate,
};

const FORMATS: [&str; 10] =
    ["s3.12", "s3.12:rtz", "s1.10", "s15.16", "fp16", "fp16:ftz", "fp24", "fp32", "fp32:rtz", "e3m4"];

fn format() -> impl Strategy<Value = Format> {
    prop::sample::select(&FORMATS[..]).prop_map(|text| text.parse().expect("a format"))
}

fn number() -> impl Strategy<Value = Number> {
    (format(), any::<u32>()).prop_map(|(format, bits)| Number { format, bits: bits & format.mask() })
}

proptest! {
    #[test]
    fn ulps_do_not_ask_who_is_left(a in number(), b in number()) {
        prop_assert_eq!(a.equals(&b), b.equals(&a));
        prop_assert_eq!(ulps(&a, &b).0, ulps(&b, &a).0);
    }

    #[test]
    fn equal_numbers_are_no_ulps_apart(a in number(), b in number()) {
        if a.equals(&b) {
            prop_assert_eq!(ulps(&a, &b).0, Some(0.0));
        } else if ulps(&a, &b).0 == Some(0.0) {
            prop_assert_eq!(a.double(), b.double(), "two zeros of one layout");
        }
    }

    #[test]
    fn the_next_number_is_one_ulp_away(format in format(), bits in any::<u32>()) {
        let bits = bits & format.mask();
        let (a, b) = (Number { format, bits }, Number { format, bits: (bits + 1) & format.mask() });
        // Excludes steps to infinity or NaN, and steps from the largest number of one sign to the zero of the other
        // sign.
        prop_assume!(format.is_finite(a.bits) && format.is_finite(b.bits));
        prop_assume!(format.is_negative(a.bits) == format.is_negative(b.bits));
        prop_assert_eq!(ulps(&a, &b).0, Some(1.0));
    }

    /// The error of rounding to nearest is at most half a unit of the coarser format.
    #[test]
    fn a_rounded_number_is_half_an_ulp_away(bits in any::<u32>(), to in prop::sample::select(&["fp16", "fp24", "s3.12"][..])) {
        let (single, to): (Number, Format) = (Number { format: Format::FP32, bits }, to.parse().expect("a format"));
        let rounded = Number { format: to, bits: ops::convert(&Format::FP32, to, bits).bits };
        let range = Number { format: to, bits: to.max_finite() }.double();
        prop_assume!(single.double().abs() < range && to.is_finite(rounded.bits));
        let (apart, unit) = ulps(&single, &rounded);
        prop_assert!(apart.is_some_and(|apart| apart <= 0.5), "{:?} of {}", apart, unit);
        prop_assert!(unit == to || apart == Some(0.0));
    }

    #[test]
    fn different_numbers_are_written_differently(a in number(), b in number()) {
        prop_assume!(a.double() != b.double() && !a.double().is_nan());
        prop_assert_ne!(a.decimal(), b.decimal());
    }
}

fn example(name: &str) -> Setup {
    Setup::read(&file("fixtures/cases").join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The first difference between a pixel's trace and the same trace after a change.
fn after(setup: &Setup, pixel: (u32, u32), change: impl Fn(&mut Vec<FragmentTrace>)) -> Option<TraceDifference> {
    let loaded = Loaded::new(setup, ExecutorKind::Scalar).expect("the example fits its card");
    let trace = loaded.trace(&[pixel]).expect("the pixel is inside").remove(0);
    let mut changed = trace.clone();
    change(&mut changed);
    let rules = &setup.profile.rules;
    let constants = ResolvedConstants::pixel(&setup.pixel, rules, &setup.pixel_constants);
    let side = |fragments| TraceSide { program: &setup.pixel, format: rules.format, constants: &constants, fragments };
    let shape = TargetFormats { targets: &setup.targets, depth: setup.depth.map(|(format, ..)| format) };
    assert!(first_difference(&side(&trace), &side(&trace), &shape).is_none(), "a trace is equal to itself");
    first_difference(&side(&trace), &side(&changed), &shape)
}

fn names(difference: &TraceDifference) -> Vec<&str> {
    difference.values.iter().map(|v| v.name.as_str()).collect()
}

#[test]
fn one_bit_of_one_step() {
    let setup = example("transform.toml");
    let loaded = Loaded::new(&setup, ExecutorKind::Scalar).expect("the example fits its card");
    let steps = loaded.trace(&[(2, 2)]).expect("inside")[0][0].shading.steps.clone();
    assert_eq!(steps.len(), 3);
    for (k, step) in steps.iter().enumerate() {
        for c in step.mask.components() {
            let found = after(&setup, (2, 2), |t| t[0].shading.steps[k].value[c] ^= 1).expect("a difference");
            assert_eq!(found.stage, TraceStage::Instruction { index: step.instruction });
            assert_eq!((found.values.len(), found.values[0].ulps), (1, Some(1.0)), "{found:?}");
            let register = if k == 2 { "oC0" } else { "r0" };
            assert_eq!(found.values[0].name, format!("{register}.{}", ["x", "y", "z", "w"][c]));
            assert!(found.operands.iter().all(|operand| !operand.differs), "{found:?}");
            // The operands that each instruction of the example reads, in its order.
            let read: Vec<&str> = found.operands.iter().map(|operand| operand.values[0].name.as_str()).collect();
            assert_eq!(read, [&["c0.x"][..], &["r0.x", "c1.x"], &["r0.x"]][k]);
        }
    }
}

type Change = fn(&mut Vec<FragmentTrace>);

#[test]
fn every_stage_in_its_order() {
    let setup = example("two_triangles.toml");
    // Each change alone, from the latest stage to the earliest, and together with all changes of later stages, which it
    // must hide.
    let changes: [(&str, Change); 7] = [
        ("merge", |t| t[1].after.colors[0] = Some(7)),
        ("test", |t| t[1].shading.fate = FragmentFate::AlphaFailed),
        ("output", |t| t[1].shading.output.killed = true),
        ("flow", |t| t[1].shading.steps.clear()),
        ("input", |t| t[1].shading.delivered[0].1[2] ^= 1),
        ("interpolation", |t| t[1].shading.input.depth ^= 1),
        ("coverage", |t| t[1].triangle = 5),
    ];
    for (place, (name, _)) in changes.iter().enumerate() {
        let found = after(&setup, (7, 4), |t| changes[..=place].iter().for_each(|(_, change)| change(t)));
        let found = found.expect("a difference");
        assert_eq!((found.pass.index, found.passes), (1, [2, 2]), "{name}");
        let stage = match &found.stage {
            TraceStage::Coverage { left: Some(left), right: Some(right) } => {
                assert_eq!((left.triangle, right.triangle), (1, 5));
                "coverage"
            }
            TraceStage::Coverage { .. } => "one side only",
            TraceStage::Input => {
                assert_eq!(names(&found), ["depth"]);
                "interpolation"
            }
            TraceStage::Delivered => {
                assert_eq!(names(&found), ["v0.z"]);
                assert!(matches!(found.instruction.as_ref().map(|i| &i.stage), Some(TraceStage::Flow { .. })));
                "input"
            }
            TraceStage::Flow { left: Some(0), right: None } => "flow",
            TraceStage::Output { instruction: None } => {
                assert_eq!(names(&found), ["killed"]);
                "output"
            }
            TraceStage::Test { right: FragmentFate::AlphaFailed, .. } => "test",
            TraceStage::Merge => {
                assert_eq!(names(&found)[0], "target 0 red");
                "merge"
            }
            other => panic!("{name}: {other:?}"),
        };
        assert_eq!(stage, *name);
    }
    let shorter = after(&setup, (7, 4), |t| t.truncate(1)).expect("a difference");
    assert!(matches!(shorter.stage, TraceStage::Coverage { left: Some(_), right: None }), "{shorter:?}");
}

/// A matrix entry that a short format rounds from 1.06 to 1: the right edge moves from column 3.06 to 3, and no longer
/// covers the center of column 3.
#[test]
fn vertices_come_before_what_they_cause() {
    let mut setup = example("transform.toml");
    setup.vertex_constants.float[0][0] = 1.06_f32.to_bits();
    let mut short = setup.clone();
    short.profile.rules.vertex_format = "e5m3".parse().expect("a format");
    let sides = [&setup, &short].map(|setup| Side { setup, executor: ExecutorKind::Batch.into() });
    let found = compare(&sides[0], &sides[1], Scope::Results).expect("both can be drawn");
    let first = found.first.expect("a difference");
    assert_eq!(first.pixel, [3, 0]);
    let difference = first.difference.expect("a stage");
    assert_eq!((&difference.stage, names(&difference)), (&TraceStage::Vertex { corner: 0 }, vec!["oPos.x"]));
    assert_eq!((&*difference.values[0].left, &*difference.values[0].right), ("-0.5299999713897705", "-0.5"));
}

#[test]
fn a_mask_is_a_difference() {
    let setup = example("transform.toml");
    let found = after(&setup, (2, 2), |t| t[0].shading.steps[1].mask = Mask(0b0101)).expect("a difference");
    assert_eq!(found.stage, TraceStage::Mask { index: 1, left: Mask::ALL, right: Mask(0b0101) });
}

/// Operand values are recovered from earlier writes: across `phase`, which loses alpha, and for both instructions of a
/// co-issued pair from the writes before the pair.
#[test]
fn operands_are_what_was_read() {
    let text = r#"shader_model = "ps_1_4"
format = "fp16"
[pixel]
source = """
ps_1_4
texcrd r0.rgb, t0
mov r1, c0
phase
mul r1.rgb, r1, c1
+mov r1.a, r1.b
mul r0, r1, c0
"""
[constants]
c0 = [0.5, 0.25, 0.125, 0.75]
c1 = [0.5, 0.5, 0.5, 0.5]
[geometry]
full_screen = true
[target]
size = [4, 4]
format = "rgba16f"
"#;
    let setup = Setup::from_bytes("case.toml", text.as_bytes(), Path::new("")).unwrap_or_else(|e| panic!("{e}"));
    // Steps: texcrd, mov, mul, mov, mul; instructions: 0, 1, 3, 4, 5.
    let read = |k: usize, operand: usize| {
        let found = after(&setup, (1, 2), |t| t[0].shading.steps[k].value[if k == 3 { 3 } else { 0 }] ^= 1);
        let operand = found.and_then(|found| found.operands.into_iter().nth(operand)).expect("an operand");
        operand.values.into_iter().map(|v| format!("{} {}", v.name, v.left)).collect::<Vec<_>>()
    };
    // The coordinate as interpolated: pixel (1, 2) of 4 x 4, with its center at integer coordinates.
    assert_eq!(read(0, 0), ["t0.x 0.25", "t0.y 0.5", "t0.z 0", "t0.w 1"]);
    assert_eq!(read(1, 0), ["c0.x 0.5", "c0.y 0.25", "c0.z 0.125", "c0.w 0.75"]);
    let before_the_pair = ["r1.x 0.5", "r1.y 0.25", "r1.z 0.125", "r1.w 0"];
    assert_eq!(read(2, 0), before_the_pair);
    assert_eq!(read(3, 0), before_the_pair);
    assert_eq!(read(4, 0), ["r1.x 0.25", "r1.y 0.125", "r1.z 0.0625", "r1.w 0.125"]);
}
