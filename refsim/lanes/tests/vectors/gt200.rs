//! The unit of GT200.

use std::cmp::Ordering;

use refsim_lanes::num::unit::{gt200, gt200_functions};
use refsim_lanes::num::{Format, NumberOperation as Op, Rounding, Unit, ops};

use super::table::{Row, check, columns, format, toward_zero, unary};

#[test]
fn products_and_sums() {
    let (nearest, zero_wins) = (format(Unit::Gt200), format(Unit::Gt200ZeroWins));
    let cut = toward_zero(Unit::Gt200);
    let rows = check(
        include_str!("gt200_add_mul_mad.csv"),
        3,
        &[
            ("add_rn", &columns(nearest, Op::Add, &["a", "c"])),
            ("add_rz", &columns(cut, Op::Add, &["a", "c"])),
            ("mul_rn", &columns(nearest, Op::Mul, &["a", "b"])),
            ("mul_rz", &columns(cut, Op::Mul, &["a", "b"])),
            ("mul_rn_zw", &columns(zero_wins, Op::Mul, &["a", "b"])),
            ("mad", &columns(nearest, Op::Mad, &["a", "b", "c"])),
            ("mad_zw", &columns(zero_wins, Op::Mad, &["a", "b", "c"])),
        ],
    );
    assert_eq!(rows, 9628);
}

#[test]
fn comparisons() {
    let card = format(Unit::Gt200);
    let compare = |row: &Row<'_>| {
        let (a, b) = (row.word("a"), row.word("b"));
        let order = gt200::compare(a, b);
        assert_eq!(ops::lt_quiet(card, a, b).bits != 0, order == Some(Ordering::Less));
        assert_eq!(ops::le_quiet(card, a, b).bits != 0, order.is_some_and(Ordering::is_le));
        assert_eq!(ops::eq(card, a, b).bits != 0, order == Some(Ordering::Equal));
        let letter = match order {
            Some(Ordering::Less) => "l",
            Some(Ordering::Equal) => "e",
            Some(Ordering::Greater) => "g",
            None => "u",
        };
        letter.to_owned()
    };
    let rows = check(
        include_str!("gt200_compare.csv"),
        2,
        &[
            ("min", &columns(card, Op::Min, &["a", "b"])),
            ("max", &columns(card, Op::Max, &["a", "b"])),
            ("compare", &compare),
        ],
    );
    assert_eq!(rows, 3374);
}

#[test]
fn reciprocals_and_logarithms() {
    let card = format(Unit::Gt200);
    let rows = check(
        include_str!("gt200_rcp_rsq_lg2.csv"),
        1,
        &[
            ("rcp", &columns(card, Op::Rcp, &["x"])),
            ("rsqrt", &columns(card, Op::Rsq, &["x"])),
            ("lg2", &columns(card, Op::Log2, &["x"])),
        ],
    );
    assert_eq!(rows, 8126);
    // Only the logarithm of 1 is exact: the table's first row has a constant term, as 0.5 shows.
    let facts = [
        (Op::Rcp, 0x4040_0000, 0x3eaa_aaab),
        (Op::Rcp, 0x3f80_0001, 0x3f7f_fffe),
        (Op::Rsq, 0x4000_0000, 0x3f35_04f2),
        (Op::Log2, 0x4040_0000, 0x3fca_e00d),
        (Op::Log2, 0x3f80_0000, 0),
        (Op::Log2, 0x3f00_0000, 0xbf7f_fffe),
    ];
    for (operation, x, expected) in facts {
        let found = operation.evaluate(card, [x, 0, 0]).map(|outcome| outcome.bits);
        assert_eq!(found, Some(expected), "{operation:?} {x:08x}");
    }
}

#[test]
fn waves_and_exponentials() {
    let card = format(Unit::Gt200);
    let rows = check(
        include_str!("gt200_sin_cos_ex2.csv"),
        1,
        &[
            ("presin", &unary("x", gt200_functions::presin)),
            ("sin_of_presin", &columns(card, Op::Sin, &["x"])),
            ("cos_of_presin", &columns(card, Op::Cos, &["x"])),
            ("preex2", &unary("x", gt200_functions::preex2)),
            ("ex2_of_preex2", &columns(card, Op::Exp2, &["x"])),
        ],
    );
    assert_eq!(rows, 8444);
}

/// The half float of a row; the card gives NaN other bits.
fn half(rounding: Rounding) -> impl Fn(&Row<'_>) -> String {
    move |row| match ops::convert(&format(Unit::Gt200), Format::FP16.with_rounding(rounding), row.word("x")).bits {
        0x7e00 => "7fff".to_owned(),
        half => format!("{half:04x}"),
    }
}

#[test]
fn conversions() {
    let card = format(Unit::Gt200);
    let rows = check(
        include_str!("gt200_convert.csv"),
        1,
        &[
            ("sat", &columns(card, Op::Saturate, &["x"])),
            ("f16_rn", &half(Rounding::NearestEven)),
            ("f16_rm", &half(Rounding::Down)),
            ("f16_rp", &half(Rounding::Up)),
            ("f16_rz", &half(Rounding::TowardZero)),
            ("floor", &columns(card, Op::Floor, &["x"])),
        ],
    );
    assert_eq!(rows, 4401);
}
