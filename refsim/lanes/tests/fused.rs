//! Tests sums of products and quotients by fused multiply-adds (short formats that round to nearest, at the wider SIMD
//! level), compared with integer arithmetic at the narrowest level; and formats that must not be fused.

use refsim_lanes::num::{Format, NumberOperation};
use refsim_lanes::{AnyLane, LANES, LaneCode, LaneOp, LaneRow, OPERANDS, SimdLevel, Slots, run};

/// Formats, each with the step between its operands.
const FORMATS: [(&str, usize); 23] = [
    ("s3.12", 397),
    ("s0.15", 397),
    ("s15.0", 397),
    ("s1.10", 397),
    ("s7.8", 397),
    ("s0.4", 1),
    ("s2.3", 1),
    ("s7.0", 1),
    ("s3.12:rna", 397),
    ("s3.12:rtz", 397),
    ("s3.12:rdn", 397),
    ("s3.12:rup", 397),
    ("n0.8", 1),
    ("n3.8:rna", 3),
    ("n4.8", 11),
    ("n4.8:rna", 13),
    ("n2.2:rna", 1),
    ("n10.2", 17),
    ("n5.8", 29),
    ("n3.8:rtz", 11),
    ("n3.8:rdn", 11),
    ("n3.8:rup", 11),
    ("s3.12:wrap", 397),
];

/// Operands of a format: both limits, zero, their neighbors, and evenly spaced values between.
fn operands(f: &Format, step: usize) -> Vec<i32> {
    let end = 1i32 << (f.width() - 1);
    let near = [-end, 0, end - 1].into_iter().flat_map(|x| x - 3..=x + 3);
    near.chain((-end..end).step_by(step)).filter(|x| (-end..end).contains(x)).collect()
}

/// Sums of one to four products, and a quotient. Slot 0 has a uniform value, slots 1 to 3 rows.
fn operations() -> [LaneOp; 6] {
    let sum = [0, 1, 2, 3, 3, 2, 1, 0];
    let op = |code, to, args: [u16; OPERANDS]| LaneOp { code, to, args, zero_wins: false };
    [
        op(LaneCode::SumBy(1), 4, sum),
        op(LaneCode::Sum(2), 5, sum),
        op(LaneCode::Sum(3), 6, sum),
        op(LaneCode::Sum(4), 7, sum),
        op(LaneCode::Plain(NumberOperation::Div), 8, sum),
        op(LaneCode::Plain(NumberOperation::Div), 9, [2, 3, 0, 0, 0, 0, 0, 0]),
    ]
}

#[test]
fn levels_have_the_same_sums_and_quotients() {
    for (text, step) in FORMATS {
        let f: Format = text.parse().expect("a format");
        let lane = AnyLane::new(f);
        let all = operands(&f, step);
        let row = |start: usize, stride: usize| -> LaneRow {
            std::array::from_fn(|i| all[(start + i) * stride % all.len()].cast_unsigned())
        };
        let mut levels = SimdLevel::available().into_iter().map(|level| (level, Slots::new(10))).collect::<Vec<_>>();
        for (k, &a) in all.iter().enumerate() {
            for start in (0..all.len()).step_by(LANES) {
                for (level, slots) in &mut levels {
                    slots.fill(0, a.cast_unsigned());
                    for (slot, (offset, stride)) in (1..).zip([(0, 1), (7 * k, 5), (k, 7)]) {
                        *slots.row_mut(slot) = row(start + offset, stride);
                    }
                    run(&lane, *level, &operations(), slots);
                }
                let (_, narrowest) = &levels[0];
                for (level, slots) in &levels {
                    for slot in 4..10 {
                        let differing = (0..LANES).find(|&i| slots.row(slot)[i] != narrowest.row(slot)[i]);
                        let lanes = differing.map(|i| [1, 2, 3].map(|operand| slots.row(operand)[i].cast_signed()));
                        assert_eq!(lanes, None, "{text} {level:?}: operands of {a}, result {slot}");
                    }
                }
            }
        }
    }
}
