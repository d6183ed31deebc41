//! The adapter's own single precision: the probe's results, and the accuracy required by WGSL.

use crate::environment::by_form;
use refsim::exec::gpu::{FULL_PROBE, Gpu, probe};
use refsim::exec::wgsl::accuracy::{Allowed, SingleOperation, allowed};
use std::sync::Arc;

pub(crate) fn the_probe_finds_nothing_outside_the_standard(gpu: &Arc<Gpu>) {
    let count = by_form(1 << 14, FULL_PROBE);
    let report = probe(gpu, count).expect("the probe runs");
    assert!(report.conforms(), "results outside what WGSL allows: {:#?}", report.operations);
}

pub(crate) fn the_intervals_are_those_of_the_standard() {
    use SingleOperation as Op;
    let one = 0x3f80_0000;
    let within = |op, operands, bits| allowed(op, operands).contains(bits);
    // Exact sums have one result; inexact ones two.
    assert!(within(Op::Add, [one, one, 0], 0x4000_0000));
    assert!(!within(Op::Add, [one, one, 0], 0x4000_0001));
    let tiny = 0x3080_0000;
    assert!(within(Op::Add, [one, tiny, 0], one) && within(Op::Add, [one, tiny, 0], one + 1));
    assert!(!within(Op::Add, [one, tiny, 0], one - 1) && !within(Op::Add, [one, tiny, 0], one + 2));
    // One third is 3eaaaaaa.aa..: two and a half units reach 3eaaaaa9 below (1.67; the next is 2.67 away).
    let third = 0x3eaa_aaab;
    for near in [third - 2, third - 1, third, third + 1, third + 2] {
        assert!(within(Op::Div, [one, 0x4040_0000, 0], near), "{near:x}");
    }
    assert!(!within(Op::Div, [one, 0x4040_0000, 0], third + 4) && !within(Op::Div, [one, 0x4040_0000, 0], third - 4));
    // Subnormal operands and results may be flushed or kept; nothing between is allowed.
    assert!(within(Op::Add, [5, 0, 0], 5) && within(Op::Add, [5, 0, 0], 0) && !within(Op::Add, [5, 0, 0], 3));
    assert!(within(Op::Mul, [0x0080_0000, 0x3f00_0000, 0], 0));
    // A subnormal product may be flushed before it is added; nothing else.
    assert!(within(Op::MulAdd, [0x8080_0000, 0x3f00_0000, 0x80b7_66e5], 0x80b7_66e5));
    assert!(!within(Op::MulAdd, [0x8100_0000, 0x3f80_0000, 0x81b7_66e5], 0x81b7_66e5));
    // Overflow, infinities and NaN are indeterminate.
    assert_eq!(allowed(Op::Mul, [0x7f00_0000, 0x7f00_0000, 0]), Allowed::Any);
    assert_eq!(allowed(Op::Max, [one, 0x7fc0_0000, 0]), Allowed::Any);
    // The square root of four, as 1 / inverseSqrt.
    assert!(within(Op::Sqrt, [0x4080_0000, 0, 0], 0x4000_0000) && within(Op::Sqrt, [0x4080_0000, 0, 0], 0x4000_0002));
    assert!(!within(Op::Sqrt, [0x4080_0000, 0, 0], 0x4000_0010));
}
