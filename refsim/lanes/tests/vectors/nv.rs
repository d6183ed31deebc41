//! Vertex units of NV20 to NV35.

use refsim_lanes::num::unit::nv_functions;
use refsim_lanes::num::{DotOrder, Format, NumberOperation as Op, Unit, ops};

use super::table::{Row, check, columns, digits, evaluate, format, unary};

/// The three units, in the order of the columns.
fn units() -> [Format; 3] {
    [Unit::Nv2x, Unit::Nv3xLegacy, Unit::Nv3x].map(format)
}

#[test]
fn products_and_sums() {
    let [old, legacy, modern] = units();
    let rows = check(
        include_str!("nv_mul_add_mad.csv"),
        3,
        &[
            ("mul_nv2x", &columns(old, Op::Mul, &["a", "b"])),
            ("mul_nv3x_legacy", &columns(legacy, Op::Mul, &["a", "b"])),
            ("mul_nv3x_modern", &columns(modern, Op::Mul, &["a", "b"])),
            ("add_nv2x", &columns(old, Op::Add, &["a", "c"])),
            ("add_nv3x", &|row: &Row<'_>| {
                let sum = columns(legacy, Op::Add, &["a", "c"])(row);
                assert_eq!(sum, columns(modern, Op::Add, &["a", "c"])(row));
                sum
            }),
            ("mad_nv2x", &columns(old, Op::Mad, &["a", "b", "c"])),
            ("mad_nv3x_legacy", &columns(legacy, Op::Mad, &["a", "b", "c"])),
            ("mad_nv3x_modern", &columns(modern, Op::FusedMad, &["a", "b", "c"])),
        ],
    );
    assert_eq!(rows, 9602);
}

/// DP3, DPH or DP4 of a row.
fn dot(format: Format, name: &'static str) -> impl Fn(&Row<'_>) -> String {
    move |row| {
        let term = |a: &str, b: &str| (row.word(a), row.word(b));
        let mut terms = vec![term("ax", "bx"), term("ay", "by"), term("az", "bz")];
        match name {
            "dp3" => {}
            "dph" => terms.push((format.one(), row.word("bw"))),
            _ => terms.push(term("aw", "bw")),
        }
        let results =
            [DotOrder::Sequential, DotOrder::Tree, DotOrder::Exact].map(|order| ops::dot(format, order, &terms));
        assert_eq!((results[0], results[0]), (results[1], results[2]));
        // The order of the addends does not affect the result.
        terms.reverse();
        assert_eq!(results[0], ops::dot(format, DotOrder::Sequential, &terms));
        digits(results[0].bits)
    }
}

#[test]
fn dot_products() {
    let [old, legacy, modern] = units();
    let rows = check(
        include_str!("nv_dot.csv"),
        8,
        &[
            ("dp3_nv2x", &dot(old, "dp3")),
            ("dp3_nv3x_legacy", &dot(legacy, "dp3")),
            ("dp3_nv3x_modern", &dot(modern, "dp3")),
            ("dph_nv2x", &dot(old, "dph")),
            ("dph_nv3x_legacy", &dot(legacy, "dph")),
            ("dph_nv3x_modern", &dot(modern, "dph")),
            ("dp4_nv2x", &dot(old, "dp4")),
            ("dp4_nv3x_legacy", &dot(legacy, "dp4")),
            ("dp4_nv3x_modern", &dot(modern, "dp4")),
        ],
    );
    assert_eq!(rows, 8700);
}

/// Results of SLT, SGE, SEQ, SGT, SLE and SNE for the operands of a row, as digits 0 and 1.
fn sets(row: &Row<'_>, format: Format) -> String {
    let (a, b) = (row.word("a"), row.word("b"));
    let all = [(Op::SetLess, a, b), (Op::SetLessEqual, b, a), (Op::SetEqual, a, b), (Op::SetLess, b, a)];
    let all = all.into_iter().chain([(Op::SetLessEqual, a, b), (Op::SetNotEqual, a, b)]);
    all.map(|(operation, a, b)| match evaluate(format, operation, [a, b, 0]) {
        0 => '0',
        0x3f80_0000 => '1',
        0x7fff_ffff => 'n',
        other => panic!("{operation:?} gives {other:08x}"),
    })
    .collect()
}

#[test]
fn comparisons() {
    let [old, legacy, modern] = units();
    let both = |operation| {
        move |row: &Row<'_>| {
            let result = columns(old, operation, &["a", "b"])(row);
            assert_eq!(result, columns(legacy, operation, &["a", "b"])(row));
            result
        }
    };
    let rows = check(
        include_str!("nv_compare.csv"),
        2,
        &[
            ("min_legacy", &both(Op::Min)),
            ("max_legacy", &both(Op::Max)),
            ("slt_sge_seq_sgt_sle_sne_legacy", &|row: &Row<'_>| {
                let result = sets(row, old);
                assert_eq!(result, sets(row, legacy));
                result
            }),
            ("min_modern", &columns(modern, Op::Min, &["a", "b"])),
            ("max_modern", &columns(modern, Op::Max, &["a", "b"])),
            ("slt_sge_seq_sgt_sle_sne_modern", &|row: &Row<'_>| sets(row, modern)),
        ],
    );
    assert_eq!(rows, 4264);
}

/// Evaluates an operation on operand x in several units, whose results must be equal.
fn same(formats: &[Format], operation: Op) -> impl Fn(&Row<'_>) -> String {
    move |row| {
        let results = formats.iter().map(|&format| columns(format, operation, &["x"])(row));
        results.reduce(|first, next| if first == next { first } else { format!("{first} and {next}") }).expect("a unit")
    }
}

#[test]
fn reciprocals() {
    let [old, legacy, modern] = units();
    let rows = check(
        include_str!("nv_rcp_rsq.csv"),
        1,
        &[
            ("rcp", &same(&units(), Op::Rcp)),
            ("rcc", &unary("x", nv_functions::rcc)),
            ("rsq_nv2x", &columns(old, Op::Rsq, &["x"])),
            ("rsq_nv3x_legacy", &columns(legacy, Op::Rsq, &["x"])),
            ("rsq_nv3x_modern", &columns(modern, Op::Rsq, &["x"])),
        ],
    );
    assert_eq!(rows, 8301);
}

#[test]
fn exponentials() {
    let rows = check(
        include_str!("nv_exp_ex2.csv"),
        1,
        &[
            ("exp_x", &same(&units(), Op::ExpFloor)),
            ("exp_y", &same(&units(), Op::ExpFraction)),
            ("exp_z", &same(&units(), Op::ExpPower)),
            ("ex2_nv3x", &same(&units()[1..], Op::Exp2)),
        ],
    );
    assert_eq!(rows, 8209);
}

#[test]
fn logarithms() {
    let [old, legacy, modern] = units();
    let rows = check(
        include_str!("nv_log_lg2.csv"),
        1,
        &[
            ("log_x_nv2x", &columns(old, Op::LogExponent, &["x"])),
            ("log_x_nv3x_legacy", &columns(legacy, Op::LogExponent, &["x"])),
            ("log_x_nv3x_modern", &columns(modern, Op::LogExponent, &["x"])),
            ("log_y_nv2x", &columns(old, Op::LogMantissa, &["x"])),
            ("log_y_nv3x_legacy", &columns(legacy, Op::LogMantissa, &["x"])),
            ("log_y_nv3x_modern", &columns(modern, Op::LogMantissa, &["x"])),
            ("log_z_nv2x", &columns(old, Op::LogPower, &["x"])),
            ("log_z_nv3x_legacy", &columns(legacy, Op::LogPower, &["x"])),
            ("log_z_nv3x_modern", &columns(modern, Op::LogPower, &["x"])),
            ("lg2_nv3x", &same(&units()[1..], Op::Log2)),
        ],
    );
    assert_eq!(rows, 7529);
}

#[test]
fn lighting() {
    let specular = |row: &Row<'_>| {
        let words = [row.word("x"), row.word("y"), row.word("w")];
        let results = units().map(|format| evaluate(format, Op::LitSpecular, words));
        assert_eq!((results[0], results[0]), (results[1], results[2]));
        digits(results[0])
    };
    let formats = units();
    let diffuse = same(&formats, Op::LitDiffuse);
    let rows = check(include_str!("nv_lit.csv"), 3, &[("lit_y", &diffuse), ("lit_z", &specular)]);
    assert_eq!(rows, 9279);
}

#[test]
fn waves() {
    let new = [format(Unit::Nv3xLegacy), format(Unit::Nv3x)];
    let rows =
        check(include_str!("nv3x_sin_cos.csv"), 1, &[("sin", &same(&new, Op::Sin)), ("cos", &same(&new, Op::Cos))]);
    assert_eq!(rows, 8631);
}

#[test]
fn fractions_and_signs() {
    let [_, legacy, modern] = units();
    let rows = check(
        include_str!("nv3x_frc_flr_ssg.csv"),
        1,
        &[
            ("frc", &same(&[legacy, modern], Op::Frc)),
            ("flr", &same(&[legacy, modern], Op::Floor)),
            ("ssg_legacy", &columns(legacy, Op::Sign, &["x"])),
            ("ssg_modern", &columns(modern, Op::Sign, &["x"])),
        ],
    );
    assert_eq!(rows, 5143);
}
