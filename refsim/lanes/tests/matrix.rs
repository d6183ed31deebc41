//! Tests matrix units against results of models and GPUs, and laws of sums.

use refsim_lanes::num::matrix::{Element, MatrixUnit, Operand, ResultFormat, Rule, UNITS};
use refsim_lanes::num::{Format, Rounding, from_f64, power_of_two, random_word};
use refsim_lanes::{MatrixColumns, MatrixRows};
use std::fs;
use std::path::Path;

/// Parses numbers of `digits` hexadecimal digits each, without separators.
fn codes(text: &str, digits: usize) -> Vec<u64> {
    text.as_bytes()
        .chunks(digits)
        .map(|chunk| u64::from_str_radix(std::str::from_utf8(chunk).expect("ASCII"), 16).expect("hexadecimal"))
        .collect()
}

fn scales(text: &str) -> Vec<u8> {
    codes(text, 2).into_iter().map(|code| code as u8).collect()
}

/// Rows of a file as cells by column name.
fn rows(name: &str) -> Vec<Vec<(String, String)>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/matrix_vectors").join(name);
    let text = fs::read_to_string(path).expect("vectors");
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    lines.map(|cells| header.iter().cloned().zip(cells).collect()).collect()
}

/// Computes a row; returns a message if the result differs.
fn differing(unit: &MatrixUnit, row: &[(String, String)]) -> Option<String> {
    let cell = |name: &str| row.iter().find(|(key, _)| key == name).map_or("", |(_, value)| value);
    let typed = |name: &str| *unit.operands.iter().find(|e| e.name == name).unwrap_or(&unit.operands[0]);
    let ta = typed(cell("ta"));
    let tb = if cell("tb").is_empty() { ta } else { typed(cell("tb")) };
    let [a, b] = [codes(cell("a"), ta.digits()), codes(cell("b"), tb.digits())];
    let [sa, sb] = [scales(cell("sa")), scales(cell("sb"))];
    let a = Operand { element: ta, codes: &a, scales: &sa };
    let b = Operand { element: tb, codes: &b, scales: &sb };
    unit.check(&a, &b).expect("operands of the unit");
    let found = unit.dot(a, b, codes(cell("c"), 16)[0]);
    let expected = cell("result");
    let is_nan = unit.result.element.number(found).is_nan();
    let same = if expected == "nan" { is_nan } else { found == codes(expected, 16)[0] };
    (!same).then(|| format!("{} {row:?}: found {found:x}", unit.name))
}

#[test]
fn units_give_the_results_of_the_model() {
    for unit in &UNITS {
        if matches!(unit.rule, Rule::Synchronous { .. }) {
            continue;
        }
        let rows = rows(&format!("{}.csv", unit.name));
        assert!(rows.len() >= 300, "{}: {} rows", unit.name, rows.len());
        let wrong: Vec<String> = rows.iter().filter_map(|row| differing(unit, row)).collect();
        assert!(wrong.is_empty(), "{} of {}: {}", wrong.len(), rows.len(), wrong[0]);
    }
}

#[test]
fn units_give_the_results_that_were_measured_on_gpus() {
    let rows = rows("measured.csv");
    assert_eq!(rows.len(), 4000);
    let unit = |row: &[(String, String)]| MatrixUnit::find(&row[0].1).expect("a unit");
    let wrong: Vec<String> = rows.iter().filter_map(|row| differing(&unit(row), row)).collect();
    assert!(wrong.is_empty(), "{}: {}", wrong.len(), wrong[0]);
}

/// Random codes of ordinary numbers: exponents near the middle, so that nothing overflows, even if the numbers are
/// scaled.
fn ordinary(element: Element, count: usize, seed: u64) -> Vec<u64> {
    let (exponent_bits, fraction_bits) = element.fields();
    let fraction = fraction_bits + element.ignored_bits;
    let middle = (1 << (exponent_bits - 1)) - 1;
    let spread = if exponent_bits > 3 { 4 } else { 1 };
    let code = |k: usize| {
        let word = u64::from(random_word(seed, k as u64));
        let exponent = middle - spread / 2 + (word >> 24) % spread.max(1);
        ((word % 2) << (element.width() - 1)) | (exponent << fraction) | ((word >> 1) & ((1 << fraction) - 1))
    };
    (0..count).map(code).collect()
}

/// Checks a law for each unit without scales, with random operands of 64 products.
fn each_unit(mut law: impl FnMut(&MatrixUnit, Element, &[u64], &[u64])) {
    for unit in UNITS.iter().filter(|unit| unit.scaling.is_none()) {
        for seed in 0..20 {
            let element = unit.operands[seed as usize % unit.operands.len()];
            law(unit, element, &ordinary(element, 64, seed), &ordinary(element, 64, seed + 1000));
        }
    }
}

fn dot(unit: &MatrixUnit, element: Element, a: &[u64], b: &[u64], c: u64) -> u64 {
    let [a, b] = [a, b].map(|codes| Operand { element, codes, scales: &[] });
    unit.check(&a, &b).expect("operands of the unit");
    unit.dot(a, b, c)
}

#[test]
fn order_within_a_block_does_not_show_but_that_of_blocks_does() {
    let mut shown = [0; 2];
    each_unit(|unit, element, a, b| {
        let sum = dot(unit, element, a, b, 0);
        let reversed = |codes: &[u64]| codes.iter().rev().copied().collect::<Vec<_>>();
        shown[0] += usize::from(dot(unit, element, &reversed(a), &reversed(b), 0) != sum);
        if matches!(unit.rule, Rule::Aligned { .. } | Rule::Exact | Rule::Floored { halves: false }) {
            let within = |codes: &[u64]| codes.chunks(unit.block).flat_map(reversed).collect::<Vec<_>>();
            assert_eq!(dot(unit, element, &within(a), &within(b), 0), sum, "{}", unit.name);
            shown[1] += 1;
        }
    });
    assert!(shown[0] > 100 && shown[1] > 300, "{shown:?}");
}

#[test]
fn negation_negates_but_on_cdna3() {
    let mut asymmetric = 0;
    each_unit(|unit, element, a, b| {
        // The smallest addend; CDNA3 rounds a negative addend down, however small it is.
        let [sign, minus] = [unit.result.element, element].map(|of| 1 << (of.width() - 1));
        let both = |a: &[u64], b: &[u64]| {
            let negated: Vec<u64> = a.iter().map(|code| code ^ minus).collect();
            let c = 1 << (unit.addend.width() - 1);
            [dot(unit, element, a, b, c | 1), dot(unit, element, &negated, b, 1)]
        };
        if let Rule::Floored { halves } = unit.rule {
            let one = [element.code(1.0).expect("a number")];
            let [plus, minus] = both(&one, &one);
            asymmetric += usize::from(!halves && minus != plus ^ sign);
        } else {
            let [plus, minus] = both(a, b);
            assert_eq!(minus, if plus == 0 { 0 } else { plus ^ sign }, "{}", unit.name);
        }
    });
    assert_eq!(asymmetric, 60, "three units without halves");
}

#[test]
fn powers_of_two_scale_results() {
    each_unit(|unit, element, a, b| {
        let (exponent_bits, fraction_bits) = element.fields();
        let doubled: Vec<u64> = a.iter().map(|code| code + (1 << (fraction_bits + element.ignored_bits))).collect();
        let result = unit.result.element;
        let [single, double] = [dot(unit, element, a, b, 0), dot(unit, element, &doubled, b, 0)];
        let is_normal = result.number(single).abs() >= power_of_two(-126);
        if exponent_bits > 3 && is_normal && result != Element::FP16 {
            assert_eq!(result.number(double), 2.0 * result.number(single), "{}", unit.name);
        }
    });
}

#[test]
fn a_unit_with_enough_bits_rounds_the_exact_sum_once() {
    for (name, cut) in [("hopper_f16_f32", true), ("turing_f16_f16", false), ("blackwell_f8f6f4_f32", true)] {
        let unit = MatrixUnit::find(name).expect("a unit").with_bits(60).expect("an aligned adder");
        let mut narrow = 0;
        for seed in 0..200 {
            let element = unit.operands[0];
            let [a, b] = [seed, seed + 500].map(|seed| ordinary(element, unit.block, seed));
            // f64 holds sums of such numbers exactly.
            let exact: f64 = a.iter().zip(&b).map(|(&a, &b)| element.number(a) * element.number(b)).sum();
            let found = dot(&unit, element, &a, &b, 0);
            let format = if cut { Format::FP32.with_rounding(Rounding::TowardZero) } else { Format::FP16 };
            let expected = from_f64(format, exact).bits.into();
            assert_eq!(found, expected, "{name} {seed}");
            let short = unit.with_bits(8).expect("an aligned adder");
            narrow += usize::from(dot(&short, element, &a, &b, 0) != expected);
        }
        assert!(narrow > 50, "{name}: 8 bits must show, {narrow}");
    }
}

#[test]
fn padding_and_bad_operands() {
    each_unit(|unit, element, a, b| {
        let [x, y] = [a, b].map(|codes| [&codes[..37], &[0; 27]].concat());
        assert_eq!(dot(unit, element, &a[..37], &b[..37], 0), dot(unit, element, &x, &y, 0), "{}", unit.name);
    });
    let unit = MatrixUnit::find("blackwell-nvf4").expect("found with a hyphen");
    assert_eq!(unit.result, ResultFormat::CUT32);
    let operand = |element, codes, scales| Operand { element, codes, scales };
    let good = operand(Element::E2M1, &[0; 64][..], &[0; 4][..]);
    for bad in [
        operand(Element::FP16, &[0; 64], &[0; 4]),
        operand(Element::E2M1, &[0; 64], &[0; 3]),
        operand(Element::E2M1, &[0; 63], &[0; 4]),
    ] {
        assert!(unit.check(&good, &bad).is_err());
    }
    assert!(MatrixUnit::find("pascal").is_err() && unit.with_bits(61).is_none());
}

/// Random patterns; the seed decides whether they are arbitrary, ordinary, or mostly zero.
fn drawn(element: Element, count: usize, seed: u64) -> Vec<u64> {
    let any = |k: usize| {
        let [high, low] = [0, 1].map(|half| u64::from(random_word(seed, (2 * k + half) as u64)));
        (high << 32 | low) & (u64::MAX >> (64 - element.width()))
    };
    match seed % 4 {
        0 => (0..count).map(any).collect(),
        1 => (0..count).map(|k| if k.is_multiple_of(7) { any(k) } else { 0 }).collect(),
        // No exponent has its maximum, so there are no infinities or NaNs.
        2 => (0..count).map(|k| any(k) & !(3 << (element.width() - 3))).collect(),
        _ => ordinary(element, count, seed),
    }
}

#[test]
fn columns_at_once_give_what_the_definition_gives() {
    for (index, unit) in UNITS.iter().enumerate() {
        for seed in 0..24 {
            let [x, y] = [seed, seed / 5].map(|at| unit.operands[at % unit.operands.len()]);
            let (length, seed) = (3 * unit.block + seed % 5, (100 * index + seed) as u64);
            let rows = |element: Element, count: usize, seed: u64| {
                let share = unit.scaling.map_or(1, |(share, _)| share);
                let scales = unit.scaling.map_or(0, |_| count * length.div_ceil(share));
                let code = |k: usize| {
                    if seed.is_multiple_of(3) { random_word(seed, k as u64) as u8 } else { 120 + (k % 16) as u8 }
                };
                let codes = drawn(element, count * length, seed);
                MatrixRows { element, length, codes, scales: (0..scales).map(code).collect(), share }
            };
            let [a, b] = [rows(x, 2, seed), rows(y, 19, seed + 4)];
            let c = drawn(unit.addend, 19, seed + 1);
            let columns = MatrixColumns::new(*unit, &b);
            for row in 0..2 {
                let start = if row == 0 { 0 } else { unit.block };
                // Multiplies both rows at once, or only one.
                let twice = [&c[..], &c[..]].concat();
                let sums = match row {
                    0 => columns.multiply(&a, 0..2, start, length - start, &twice)[..19].to_vec(),
                    _ => columns.multiply(&a, row..row + 1, start, length - start, &c),
                };
                for (column, sum) in sums.into_iter().enumerate() {
                    let [p, q] = [a.row(row, start, length - start), b.row(column, start, length - start)];
                    unit.check(&p, &q).expect("operands of the unit");
                    assert_eq!(sum, unit.dot(p, q, c[column]), "{} {seed} {row} {column}", unit.name);
                }
            }
        }
    }
}

/// A sum that flushes to -0 stays -0 to the end of the instruction; as c of the next instruction it is +0.
#[test]
fn flushed_zeros_keep_their_sign_within_an_instruction_of_cdna2() {
    let unit = MatrixUnit::find("cdna2_bf16").expect("a unit");
    let code = |x: f64| Element::BF16.code(x).expect("a number");
    // 1.5 times the smallest normal number, minus that number, and products that flush.
    let (least, small) = (power_of_two(-126), power_of_two(-100));
    let a = [-1.5 * least, 0.0, least, 0.0].into_iter().chain([-small; 12]).map(code).collect::<Vec<_>>();
    let b = [1.0; 4].into_iter().chain([small; 12]).map(code).collect::<Vec<_>>();
    assert_eq!(dot(&unit, Element::BF16, &a[..8], &b[..8], 0), 0x8000_0000);
    assert_eq!(dot(&unit, Element::BF16, &a, &b, 0), 0);
}

/// 1 + 8 * 2^-25 - 7 * 2^-24, which is 3f7ffffd: docs/matrix_units.md prints the results of the units.
#[test]
fn one_sum_of_sixteen_tells_the_family_apart() {
    let sums = [
        ("volta_f16_f32", 0x3f80_0000),
        ("turing_f16_f32", 0x3f7f_fff9),
        ("ampere_f16_f32", 0x3f7f_fff9),
        ("ampere_bf16_f32", 0x3f7f_fff9),
        ("ampere_tf32_f32", 0x3f7f_fff9),
        ("ada_fp8_f32", 0x3f80_0000),
        ("hopper_f16_f32", 0x3f7f_fffd),
        ("hopper_tf32_f32", 0x3f7f_fffb),
        ("hopper_fp8_f32", 0x3f80_0000),
        ("blackwell_f8f6f4_f32", 0x3f7f_fffd),
        ("cdna1_f16", 0x3f7f_fffe),
        ("cdna2_f16", 0x3f7f_fffc),
        ("cdna3_f16", 0x3f7f_fffa),
        ("cdna3_fp8", 0x3f7f_fffb),
    ];
    for (name, expected) in sums {
        let unit = MatrixUnit::find(name).expect("a unit");
        let element = *unit.operands.iter().find(|element| element.fields().0 >= 5).expect("a type with 2^-13");
        let power = |n: i32| element.code(power_of_two(-n)).expect("a number");
        let minus = 1 << (element.width() - 1);
        let a = [vec![power(0)], vec![power(12); 8], vec![power(12) | minus; 7]].concat();
        let b = [vec![power(0)], vec![power(13); 8], vec![power(12); 7]].concat();
        assert_eq!(dot(&unit, element, &a, &b, 0), expected, "{name}: {:x}", dot(&unit, element, &a, &b, 0));
    }
}
