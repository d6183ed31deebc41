//! Compares rows in the units of cards with the definition, bit for bit, at each SIMD level: numbers,
//! special words, and the operands of the test vectors.

use refsim_lanes::num::{DotOrder, Format, NumberOperation as Op, ops};
use refsim_lanes::{
    AnyLane, LANES, LaneCode, LaneOp, LaneRow, OPERANDS, SimdLevel, Slots, TRUE, convert, evaluate, run,
};

const FORMATS: [&str; 8] = [
    "e8m23:nv2x",
    "e8m23:nv3x-legacy",
    "e8m23:nv3x",
    "e8m23:gt200",
    "e8m23:gt200:rtz",
    "e8m23:gt200-zero-wins",
    "e8m23:gt200-zero-wins:rtz",
    "e8m23:ftz",
];

/// Operations on numbers that lanes support. Sines are computed by the definition.
const OPERATIONS: [Op; 36] = [
    Op::Add,
    Op::Sub,
    Op::Mul,
    Op::Mad,
    Op::FusedMad,
    Op::Min,
    Op::Max,
    Op::Neg,
    Op::Abs,
    Op::Less,
    Op::LessEqual,
    Op::Equal,
    Op::SelectNonNegative,
    Op::SelectAboveHalf,
    Op::Floor,
    Op::Frc,
    Op::Rcp,
    Op::Rsq,
    Op::Exp2,
    Op::Log2,
    Op::Saturate,
    Op::Div,
    Op::Sqrt,
    Op::ExpFloor,
    Op::ExpFraction,
    Op::ExpPower,
    Op::LogExponent,
    Op::LogMantissa,
    Op::LogPower,
    Op::LitDiffuse,
    Op::LitSpecular,
    Op::SetLess,
    Op::SetLessEqual,
    Op::SetEqual,
    Op::SetNotEqual,
    Op::Sign,
];

const AWKWARD: [u32; 32] = [
    0,
    0x8000_0000,
    1,
    0x8000_0001,
    0x0040_0000,
    0x807f_ffff,
    0x0080_0000,
    0x8080_0001,
    0x00ff_ffff,
    0x0100_0000,
    0x3380_0000,
    0x3f00_0000,
    0x3f7f_ffff,
    0x3f80_0000,
    0xbf80_0000,
    0x3f80_0001,
    0x3fff_ffff,
    0x4000_0000,
    0xc040_0000,
    0x4b80_0000,
    0xcb7f_ffff,
    0x4f00_0000,
    0x7e80_0000,
    0x7f00_0000,
    0x7f7f_ffff,
    0xff7f_ffff,
    0x7f80_0000,
    0xff80_0000,
    0x7f80_0001,
    0x7fc0_0000,
    0xffff_ffff,
    0x7fff_ffff,
];

/// A generator of words (splitmix64).
struct Words(u64);

impl Words {
    fn word(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z >> 32) as u32
    }

    /// A number with one of `span` exponents around `center`, often with few bits, sometimes zero.
    fn number(&mut self, center: u32, span: u32) -> u32 {
        let (w, shape) = (self.word(), self.word());
        let field = center - span / 2 + w % span;
        let mantissa = match shape % 8 {
            0 => 0,
            1 => 0x7f_ffff,
            2 => 1 << ((shape >> 8) % 23),
            3 => (0x7f_ffff << ((shape >> 8) % 23)) & 0x7f_ffff,
            _ => self.word() & 0x7f_ffff,
        };
        if shape >> 20 & 15 == 0 { w & 1 << 31 } else { w & 1 << 31 | field << 23 | mantissa }
    }

    /// A row of operands: low values of `kind` mean ordinary numbers, high values rarer numbers.
    fn row(&mut self, kind: usize, other: &LaneRow) -> LaneRow {
        let mut row = [0; LANES];
        for (i, word) in row.iter_mut().enumerate() {
            *word = match kind {
                0 => self.number(127, 6),
                1 => self.number(127, 40),
                // Limits of the range that vector loops handle, and of the format.
                2 => self.number(64, 10),
                3 => self.number(251, 8),
                4 => self.number(64, 126),
                5 => self.number(8, 14),
                // What cancels.
                6 => other[i] ^ 1 << 31 ^ (self.word() % 4),
                7 => (other[i] ^ 1 << 31).wrapping_add(1 << (self.word() % 26)),
                8 => AWKWARD[self.word() as usize % 32],
                9 => {
                    if self.word().is_multiple_of(64) {
                        AWKWARD[self.word() as usize % 32]
                    } else {
                        self.number(127, 20)
                    }
                }
                _ => self.word(),
            };
        }
        row
    }
}

const KINDS: usize = 11;

/// The definition's result for one lane.
fn defined(f: Format, code: LaneCode, x: &[u32; OPERANDS]) -> u32 {
    let mask = |bits: u32| if bits == 0 { 0 } else { TRUE };
    match code {
        LaneCode::Dot(terms) => {
            let terms: Vec<(u32, u32)> = x.chunks(2).take(terms.into()).map(|pair| (pair[0], pair[1])).collect();
            ops::dot(f, DotOrder::Exact, &terms).bits
        }
        LaneCode::Immediate(Op::Scale, shift) => ops::scale(f, x[0], shift.into()).bits,
        LaneCode::Plain(operation) => {
            let bits = operation.evaluate(f, [x[0], x[1], x[2]]).map_or(0, |outcome| outcome.bits);
            if matches!(operation, Op::Less | Op::LessEqual | Op::Equal) { mask(bits) } else { bits }
        }
        _ => 0,
    }
}

/// Returns `true` if a format supports an operation.
fn has(f: Format, code: LaneCode) -> bool {
    !matches!(code, LaneCode::Plain(operation) if operation.evaluate(f, [0; 3]).is_none())
}

/// The codes of all operations.
fn codes() -> Vec<LaneCode> {
    let plain = OPERATIONS.into_iter().map(LaneCode::Plain);
    let scales = [-3, 1, 2].map(|shift| LaneCode::Immediate(Op::Scale, shift));
    plain.chain(scales).chain([LaneCode::Dot(2), LaneCode::Dot(3), LaneCode::Dot(4)]).collect()
}

/// Compares all operations on rows of operands.
fn compare(text: &str, rows: &[LaneRow; OPERANDS], codes: &[LaneCode], note: &str) {
    let f: Format = text.parse().expect("a format");
    let lane = AnyLane::new(f);
    let mut args = [0; OPERANDS];
    args.iter_mut().enumerate().for_each(|(k, arg)| *arg = k as u16);
    for &code in codes.iter().filter(|&&code| has(f, code)) {
        let expected: Vec<u32> = (0..LANES).map(|i| defined(f, code, &std::array::from_fn(|k| rows[k][i]))).collect();
        for simd in SimdLevel::available() {
            let mut slots = Slots::new(OPERANDS + 1);
            for (k, row) in rows.iter().enumerate() {
                *slots.row_mut(k as u16) = row.map(|bits| lane.decode(bits));
            }
            run(&lane, simd, &[LaneOp { code, to: OPERANDS as u16, args, zero_wins: false }], &mut slots);
            for i in 0..LANES {
                let raw = slots.row(OPERANDS as u16)[i];
                let is_mask = matches!(code, LaneCode::Plain(Op::Less | Op::LessEqual | Op::Equal));
                let bits = if is_mask { raw } else { lane.encode(raw) };
                let operands: Vec<String> = rows.iter().map(|row| format!("{:08x}", row[i])).collect();
                assert_eq!(
                    format!("{bits:08x}"),
                    format!("{:08x}", expected[i]),
                    "{text} {code:?} {} of {operands:?}, {note}",
                    simd.name()
                );
            }
        }
    }
}

#[test]
fn rows_are_as_defined() {
    let mut words = Words(1);
    for first in 0..KINDS {
        for second in [first, (first + 4) % KINDS, (first + 7) % KINDS] {
            let a = words.row(first, &[0; LANES]);
            let mut rows = [a; OPERANDS];
            for k in 1..OPERANDS {
                let other = rows[k - 1];
                rows[k] = words.row(if k % 2 == 1 { second } else { first }, &other);
            }
            for text in FORMATS {
                compare(text, &rows, &codes(), &format!("rows of kinds {first} and {second}"));
            }
        }
    }
}

/// Rows in which every second pair cancels except for the bits that the alignment cuts off.
#[test]
fn sums_that_cancel_are_as_defined() {
    let mut words = Words(2);
    for span in (1..34).step_by(3) {
        let mut rows: [LaneRow; OPERANDS] = std::array::from_fn(|_| words.row(1, &[0; LANES]));
        let [first, second] = [rows[0], rows[1]];
        rows[2] = first.map(|word| word ^ 1 << 31);
        rows[3] = second.map(|word| word ^ (words.word() & 7));
        rows[4] = first.map(|word| word.wrapping_sub(span << 23));
        rows[6] = first.map(|word| word.wrapping_sub((span + 1) << 23));
        for text in FORMATS {
            compare(text, &rows, &codes(), &format!("addends {span} binades apart"));
        }
    }
}

/// Operands of the test vectors, in rows; other tests compare the definition with the vectors' results.
#[test]
fn rows_of_the_vectors_are_as_defined() {
    use Op::{Abs, Add, Equal, Exp2, Floor, Frc, Less, LessEqual, Log2, Mad, Max, Min, Mul, Rcp, Rsq, Sub};
    const EXP: [Op; 4] = [Op::ExpFloor, Op::ExpFraction, Op::ExpPower, Exp2];
    const LOG: [Op; 4] = [Op::LogExponent, Op::LogMantissa, Op::LogPower, Log2];
    let (vertex, gt200) = (&FORMATS[..3], &FORMATS[3..7]);
    let vectors: [(&str, usize, &[&str], &[Op]); 12] = [
        (include_str!("vectors/nv_mul_add_mad.csv"), 3, vertex, &[Mul, Add, Sub, Mad]),
        (include_str!("vectors/nv_dot.csv"), 8, vertex, &[]),
        (include_str!("vectors/nv_compare.csv"), 2, vertex, &[Less, LessEqual, Equal, Min, Max]),
        (include_str!("vectors/nv_rcp_rsq.csv"), 1, vertex, &[Rcp, Rsq]),
        (include_str!("vectors/nv_exp_ex2.csv"), 1, vertex, &EXP),
        (include_str!("vectors/nv_log_lg2.csv"), 1, vertex, &LOG),
        (include_str!("vectors/nv_lit.csv"), 3, vertex, &[Op::LitDiffuse, Op::LitSpecular]),
        (include_str!("vectors/nv3x_frc_flr_ssg.csv"), 1, vertex, &[Floor, Frc, Op::Sign]),
        (include_str!("vectors/gt200_add_mul_mad.csv"), 3, gt200, &[Mul, Add, Sub, Mad]),
        (include_str!("vectors/gt200_compare.csv"), 2, gt200, &[Less, LessEqual, Equal, Min, Max]),
        (include_str!("vectors/gt200_rcp_rsq_lg2.csv"), 1, gt200, &[Rcp, Rsq, Log2]),
        (include_str!("vectors/gt200_sin_cos_ex2.csv"), 1, gt200, &[Exp2, Floor, Abs]),
    ];
    for (text, columns, formats, operations) in vectors {
        let cells = |line: &str| -> Vec<u32> {
            line.split(',').take(columns).map(|cell| u32::from_str_radix(cell, 16).expect("a word")).collect()
        };
        let operands: Vec<Vec<u32>> = text.lines().skip(1).map(cells).collect();
        assert!(operands.len() > 1000, "vectors");
        let plain = operations.iter().copied().map(LaneCode::Plain);
        let dots = [LaneCode::Dot(3), LaneCode::Dot(4)];
        let codes: Vec<LaneCode> = plain.chain(dots.into_iter().filter(|_| columns == 8)).collect();
        for block in operands.chunks(LANES) {
            // Operands of dot products are listed vector by vector.
            let place = |k: usize| if columns == 8 { k / 2 + 4 * (k % 2) } else { k % columns };
            let rows = std::array::from_fn(|k| {
                let mut row = [0; LANES];
                row.iter_mut().zip(block).for_each(|(word, operands)| *word = operands[place(k)]);
                row
            });
            formats.iter().for_each(|format| compare(format, &rows, &codes, "of vectors"));
        }
    }
}

#[test]
fn rows_of_powers_of_two_are_as_defined() {
    let powers: [u32; LANES] = std::array::from_fn(|k| (k as u32) << 23);
    let codes = [Op::Rcp, Op::Rsq, Op::Log2, Op::Exp2].map(LaneCode::Plain);
    FORMATS.iter().for_each(|format| compare(format, &[powers; OPERANDS], &codes, "powers of two"));
}

/// Operations on single operands equal the operations on rows.
#[test]
fn single_operations_are_as_defined() {
    let mut words = Words(3);
    for text in FORMATS {
        let f: Format = text.parse().expect("a format");
        for kind in 0..KINDS {
            let [a, b, c] = [0; 3].map(|_| words.row(kind, &[0x3f80_0000; LANES]));
            for operation in OPERATIONS.into_iter().filter(|operation| operation.evaluate(f, [0; 3]).is_some()) {
                let found = evaluate(f, operation, [&a, &b, &c]).expect("an operation of lanes");
                for i in 0..LANES {
                    let expected = operation.evaluate(f, [a[i], b[i], c[i]]).map(|outcome| outcome.bits);
                    assert_eq!(Some(found[i]), expected, "{text} {operation:?} {:08x} {:08x} {:08x}", a[i], b[i], c[i]);
                }
            }
        }
    }
}

/// Conversions to half floats near and below the smallest half float, in rows and one by one.
#[test]
fn half_floats_are_as_defined() {
    let mut words = Words(4);
    for (from, to) in
        FORMATS.into_iter().flat_map(|from| ["fp16", "fp16:rtz", "fp16:rdn", "fp16:rup"].map(|to| (from, to)))
    {
        let [from, to]: [Format; 2] = [from, to].map(|text| text.parse().expect("a format"));
        let (source, target) = (AnyLane::new(from), AnyLane::new(to));
        for (center, span) in [(127 - 33, 4), (127 - 24, 8), (127, 60), (8, 14)] {
            let row: LaneRow = std::array::from_fn(|_| words.number(center, span));
            let expected: Vec<u32> = row.iter().map(|&bits| ops::convert(&from, to, bits).bits).collect();
            assert_eq!(convert(from, to, &row), expected, "{from} to {to}");
            let mut slots = Slots::new(1);
            *slots.row_mut(0) = row.map(|bits| source.decode(bits));
            run(&source, SimdLevel::widest(), &[LaneOp::of_one(LaneCode::widen(&from, &to), 0, 0)], &mut slots);
            run(&target, SimdLevel::widest(), &[LaneOp::of_one(LaneCode::Narrow, 0, 0)], &mut slots);
            let found: Vec<u32> = slots.row(0).iter().map(|&raw| target.encode(raw)).collect();
            assert_eq!(found, expected, "{from} to {to}, a row");
        }
    }
}
