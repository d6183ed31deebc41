//! Tests array operations against `num`: doubles of any size and bit pattern, in every layout under every rule, in
//! arrays whose length is not a multiple of a row's.

use crate::lanes::{layout, variants};
use crate::random::Random;
use refsim::exec::batch::ArrayOperation;
use refsim::num::{self, Format, NumberOperation as Op, from_f64};

const LAYOUTS: &str = "s3.12 s0.1 s0.15 s31.0 s0.31 s15.16 n3.8 n0.8 n2.7 e5m10 e7m16 e8m23 e8m7 e2m1 e6m9 e7m22 e2m23 \
                       e4m3fn e2m1fn e2m3fn e5m2fnuz e7m23fn e7m16fnuz";

impl Random {
    /// A random double: arbitrary bits; within two ULPs of a limit of the format or of a tie; a value of the format; a
    /// special value; or between -4 and 4.
    fn double(&mut self, f: &Format) -> f64 {
        let (kind, bits, near) = (self.next() >> 8 & 7, self.next(), self.next() >> 8 & 3);
        let number = num::to_f64(f, (bits >> 11) as u32 & f.mask());
        let ends = [num::to_f64(f, f.max_finite()), num::to_f64(f, f.min_finite()), num::to_f64(f, 1), 0.0, -0.0, 1.0];
        let end = ends[bits as usize % ends.len()];
        let beside = |x: f64| f64::from_bits(x.to_bits().wrapping_add(near).wrapping_sub(1));
        match kind {
            0 => f64::from_bits(bits),
            1 => beside(end),
            2 => beside(1.5 * end),
            3 => beside((number + num::to_f64(f, ((bits >> 11) as u32).wrapping_add(1) & f.mask())) / 2.0),
            4 => number,
            5 => [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, f64::MAX, f64::MIN_POSITIVE, 5e-324][bits as usize % 6],
            _ => (bits >> 11) as f64 / 9_007_199_254_740_992.0 * 8.0 - 4.0,
        }
    }
}

/// Returns `true` if two doubles are equal; all NaNs count as equal.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

#[test]
fn doubles_are_rounded_as_the_definition_says() {
    for (k, f) in LAYOUTS.split(' ').flat_map(|text| variants(layout(text))).enumerate() {
        let mut random = Random::new(0x9e37_79b9_7f4a_7c15 + k as u64);
        let some: Vec<f64> = (0..600).map(|_| random.double(&f)).collect();
        let mut found = vec![0.0; some.len()];
        ArrayOperation::rounding(f).expect("a format of registers").doubles([&some, &[], &[]], &mut found);
        for (&x, &found) in some.iter().zip(&found) {
            let mut expected = num::to_f64(&f, from_f64(f, x).bits);
            if f.is_fixed() && expected == 0.0 {
                expected = 0.0;
            }
            assert!(same(found, expected), "{f}: {x:e} ({:#x}): rows {found:e}, definition {expected:e}", x.to_bits());
        }
    }
}

#[test]
fn operations_are_those_of_the_definition() {
    let operations = Op::ALL.into_iter().filter(|&operation| ArrayOperation::new(Format::FP16, operation).is_some());
    let operations: Vec<Op> = operations.collect();
    assert_eq!(operations.len(), 18);
    for (k, f) in LAYOUTS.split(' ').flat_map(|text| variants(layout(text))).enumerate() {
        let mut random = Random::new(0x1234_5678_9abc_def1 + k as u64);
        let operands = [0; 3].map(|_| (0..300).map(|_| random.double(&f)).collect::<Vec<f64>>());
        let bits = operands.each_ref().map(|some| some.iter().map(|&x| from_f64(f, x).bits).collect::<Vec<u32>>());
        for &operation in &operations {
            let mut unit = ArrayOperation::new(f, operation).expect("known");
            let (mut numbers, mut patterns) = (vec![0.0; 300], vec![0; 300]);
            unit.doubles(operands.each_ref().map(Vec::as_slice), &mut numbers);
            unit.patterns(bits.each_ref().map(Vec::as_slice), &mut patterns);
            for i in 0..300 {
                let own = [0, 1, 2].map(|operand: usize| bits[operand][i]);
                let expected = operation.evaluate(f, own).expect("defined").bits;
                assert_eq!(patterns[i], expected, "{f} {operation:?} {own:#x?}");
                let number = num::to_f64(&f, expected);
                assert!(same(numbers[i], number), "{f} {operation:?} {own:#x?}: {:e}, not {number:e}", numbers[i]);
            }
        }
    }
}

#[test]
fn one_element_counts_for_all() {
    let mut product = ArrayOperation::new(Format::FP16, Op::Mul).expect("known");
    let some: Vec<f64> = (0..1000).map(f64::from).collect();
    for length in [0, 1, 2, 255, 256, 257, 1000] {
        let mut out = vec![f64::NAN; length];
        product.doubles([&some[..length], &[2.0], &[]], &mut out);
        assert!(out.iter().zip(&some).all(|(twice, x)| *twice == 2.0 * x), "{length}");
        let mut out = vec![0; length];
        let bits: Vec<u32> = some[..length].iter().map(|&x| from_f64(Format::FP16, x).bits).collect();
        product.patterns([&[0xffff_4000], &bits, &[]], &mut out);
        assert!(out.iter().zip(&some).all(|(&twice, x)| num::to_f64(&Format::FP16, twice) == 2.0 * x), "{length}");
    }
}

#[test]
fn formats_and_operations_without_rows_are_refused() {
    assert!(ArrayOperation::rounding(Format::E8M0).is_none());
    assert!(ArrayOperation::new("fp16:rst".parse().expect("a format"), Op::Add).is_none());
    for operation in [Op::Less, Op::Select, Op::Decode, Op::Sin, Op::Scale, Op::Convert] {
        assert!(ArrayOperation::new(Format::FP16, operation).is_none(), "{operation:?}");
    }
}
