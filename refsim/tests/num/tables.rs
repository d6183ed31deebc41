//! Tests short formats against ml_dtypes and gfloat, using the tables of `fixtures/formats` (its README explains the
//! lines): every value, every pair of operands, every fp16 number converted with every rounding, MX blocks.

use refsim::num::{Format, Outcome, Rounding, block::BlockFormat, ops, random_word, to_f64};

use crate::random::Random;

const TABLES: &str = include_str!("../../../fixtures/formats/tables.txt");

/// The lines that begin with the word `kind`, each split into its remaining words.
fn lines(kind: &str) -> Vec<Vec<&'static str>> {
    let words = TABLES.lines().map(|line| line.split(' ').collect::<Vec<_>>());
    words.filter(|words| words[0] == kind).map(|words| words[1..].to_vec()).collect()
}

fn format(text: &str) -> Format {
    text.parse().unwrap_or_else(|error| panic!("{error}"))
}

/// FNV-1a of 32 bits.
fn digest(bytes: impl Iterator<Item = u32>) -> String {
    let state = bytes.fold(0x811c_9dc5_u32, |state, byte| (state ^ byte).wrapping_mul(0x0100_0193));
    format!("{state:08x}")
}

#[test]
fn every_value() {
    let lines = lines("values");
    assert_eq!(lines.len(), 9);
    for line in lines {
        let f = format(line[0]);
        assert_eq!(line.len() - 1, 1 << f.width(), "{f}");
        for (code, text) in (0u32..).zip(&line[1..]) {
            let single = f32::from_bits(u32::from_str_radix(text, 16).expect("a pattern"));
            let found = to_f64(&f, code);
            // Compares bits, so that -0 differs from 0, and treats all NaNs as equal.
            let same = if single.is_nan() { found.is_nan() } else { found.to_bits() == f64::from(single).to_bits() };
            assert!(same, "{f} {code:#x}: found {found}, expected {single}");
            if !single.is_nan() {
                assert_eq!(ops::convert(&Format::FP32, f, single.to_bits()), Outcome::exact(code), "{f} {single}");
                assert_eq!(ops::convert(&f, Format::FP32, code), Outcome::exact(single.to_bits()), "{f} {code:#x}");
            }
        }
    }
}

#[test]
fn every_pair() {
    let lines = lines("pairs");
    assert_eq!(lines.len(), 9 * 4);
    for line in lines {
        let (f, name) = (format(line[0]), line[1]);
        let operation = match name {
            "add" => ops::add,
            "sub" => ops::sub,
            "mul" => ops::mul,
            _ => ops::div,
        };
        let some = if f == Format::E8M0 && matches!(name, "mul" | "div") { 64..191 } else { 0..1 << f.width() };
        assert_eq!(line.len() - 2, some.len(), "{f} {name}");
        for (a, expected) in some.clone().zip(&line[2..]) {
            let found = digest(some.clone().map(|b| operation(f, a, b).bits));
            assert_eq!(found, **expected, "{f} {name}: row of {a:#x}");
        }
    }
}

/// Compares the results of a conversion, which gets the format and the number's index, for all finite halves; each
/// digest covers 2,048 of them.
fn every_half(table: &str, formats: usize, convert: impl Fn(Format, u64, u32) -> u32) {
    let lines = lines(table);
    assert_eq!(lines.len(), formats);
    let halves: Vec<(u64, u32)> = (0..).zip((0..0x7c00).chain(0x8000..0xfc00)).collect();
    for line in lines {
        let f = format(line[0]);
        assert_eq!(line.len() - 1, halves.len() / 2048, "{f}");
        for (halves, expected) in halves.chunks(2048).zip(&line[1..]) {
            let found = digest(halves.iter().map(|&(i, half)| convert(f, i, half)));
            assert_eq!(found, **expected, "{f}: fp16 from {:#x}", halves[0].1);
        }
    }
}

#[test]
fn every_half_in_every_rounding() {
    every_half("fp16", (4 * 2 + 3) * 6, |f, _, half| ops::convert(&Format::FP16, f, half).bits);
}

/// Number i of the list is rounded with random word i of seed 2002.
#[test]
fn every_half_by_chance() {
    every_half("stochastic", 5, |f, i, half| {
        ops::convert(&Format::FP16, f.with_rounding(Rounding::Stochastic(random_word(2002, i))), half).bits
    });
}

/// A remainder of 2^-k units is rounded up by the fraction 2^-k of all random words: sums, products, quotients, roots,
/// fixed point.
#[test]
fn chance_is_the_fraction() {
    let ups = |format: Format, operation: &dyn Fn(Format) -> u32, exact: u32| {
        let words = (0..256u32).map(|word| word << 24 | 0xff_ffff);
        words.filter(|&word| operation(format.with_rounding(Rounding::Stochastic(word))) != exact).count()
    };
    let (half, single) = (Format::FP16, Format::FP32);
    // 1 + 2^-12: a quarter of a unit in the last place.
    assert_eq!(ups(half, &|f| ops::add(f, 0x3c00, 0x0c00).bits, 0x3c00), 64);
    // (1 + 2^-10)^2 = 1 + 2^-9 + 2^-20: a remainder of 2^-10 units, which one of the 256 words rounds up.
    assert_eq!(ups(half, &|f| ops::mul(f, 0x3c01, 0x3c01).bits, 0x3c02), 1);
    // 1 / 3 ends in ...01|01 01: a remainder of a third of a unit, also in s3.12.
    assert_eq!(ups(half, &|f| ops::div(f, 0x3c00, 0x4200).bits, 0x3555), 86);
    assert_eq!(ups(Format::S3_12, &|f| ops::div(f, 0x1000, 0x3000).bits, 0x0555), 86);
    assert_eq!(ups(single, &|f| ops::div(f, 0x3f80_0000, 0x4040_0000).bits, 0x3eaa_aaaa), 171);
    // sqrt 2 in units of 2^-12 is 5792.6187; 0.6187 * 256 = 158.4.
    assert_eq!(ups(Format::S3_12, &|f| ops::sqrt(f, 0x2000).bits, 5792), 159);
    // 2.75 to an integer.
    assert_eq!(ups(single, &|f| ops::round_to_int(f, 0x4030_0000).bits, 0x4000_0000), 192);
    // Exact results are unchanged.
    assert_eq!(ups(single, &|f| ops::add(f, 0x3f80_0000, 0x3f80_0000).bits, 0x4000_0000), 0);
}

/// Blocks of 32 finite singles: each number is zero, or has the block's exponent lowered by up to 15.
fn blocks() -> Vec<Vec<u32>> {
    let mut cases = Random::new(1);
    let mut block = || {
        let middle = (cases.next() % 255) as u32;
        let number = |word: u64| {
            let field = middle.saturating_sub((word >> 40) as u32 % 16);
            if word >> 60 == 0 { 0 } else { word as u32 & 0x807f_ffff | field << 23 }
        };
        (0..32).map(|_| number(cases.next())).collect()
    };
    (0..200).map(|_| block()).collect()
}

#[test]
fn blocks_with_a_scale() {
    let lines = lines("blocks");
    assert_eq!(lines.len(), BlockFormat::ALL.len());
    for line in lines {
        let mx: BlockFormat = line[0].parse().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(line.len() - 1, 200, "{mx}");
        for (numbers, expected) in blocks().iter().zip(&line[1..]) {
            let block = mx.quantize(&Format::FP32, numbers);
            let found = digest(std::iter::once(block.scale).chain(block.elements.iter().copied()));
            assert_eq!(found, **expected, "{mx}: {numbers:x?} gives {block:x?}");
            // Dequantized: a power of two times a short number is exact in doubles, and in singles except for the
            // smallest.
            let back = mx.dequantize(Format::FP32, block.scale, &block.elements);
            let scale = to_f64(&Format::E8M0, block.scale);
            for (outcome, &element) in back.iter().zip(&block.elements) {
                let exact = scale * to_f64(&mx.element(), element);
                assert_eq!(f32::from_bits(outcome.bits).to_bits(), (exact as f32).to_bits(), "{mx} {element:#x}");
            }
        }
    }
}

/// Cases that the tables omit: the limits of scales, blocks without numbers, and names.
#[test]
fn ends_of_scales_and_blocks() {
    use refsim::num::Flags;
    let scale = Format::E8M0;
    let tiny = Flags::UNDERFLOW | Flags::INEXACT;
    assert_eq!(ops::mul(scale, 0, 0), Outcome::new(0, tiny), "2^-254 is the smallest");
    assert_eq!(ops::mul(scale, 254, 254), Outcome::new(255, Flags::OVERFLOW | Flags::INEXACT));
    assert_eq!(ops::mul(scale.with_overflow(refsim::num::Overflow::Saturate), 254, 254).bits, 254);
    assert_eq!(ops::neg(scale, 127), Outcome::new(255, Flags::INVALID));
    assert_eq!(ops::sub(scale, 127, 127), Outcome::new(255, Flags::INVALID), "there is no zero");
    assert_eq!(ops::sqrt(scale, 128), Outcome::new(127, Flags::INEXACT), "1.41 is nearer to 1");
    assert_eq!(ops::rcp(scale, 129), Outcome::exact(125));
    assert_eq!(ops::log2(scale, 130), Outcome::new(129, Flags::INEXACT), "3, a tie, goes up");
    assert!(scale.for_registers().is_err() && format("e4m3fn").for_registers().is_ok());
    for (text, is_for_registers) in [("fp16:rst", false), ("s3.12:rod", false), ("n0.8:rod", false), ("fp16:rod", true)]
    {
        assert_eq!(format(text).for_registers().is_ok(), is_for_registers, "{text}");
    }
    let mx: BlockFormat = "mxfp8-e4m3".parse().expect("a block format");
    assert_eq!(mx.quantize(&Format::FP32, &[0; 32]).scale, 0);
    let nan = mx.quantize(&Format::FP32, &[0x3f80_0000, 0x7fc0_0000]);
    assert_eq!((nan.scale, nan.elements, nan.flags), (255, vec![0, 0], Flags::INVALID));
    assert_eq!(mx.dequantize(Format::FP32, 255, &[0x38])[0], Outcome::exact(0x7fc0_0000));
    assert_eq!(mx.dequantize(Format::S3_12, 255, &[0x38])[0], Outcome::new(0, Flags::INVALID));
    assert_eq!(mx.dequantize(Format::FP32, 127, &[0x7f])[0], Outcome::exact(0x7fc0_0000));
    // A third is 85 of 255 units, so it is exact there.
    let thirds = mx.quantize(&format("n3.8"), &[85, 170]);
    assert_eq!(to_f64(&mx.element(), thirds.elements[0]) * 2.0, to_f64(&mx.element(), thirds.elements[1]));
    let unknown = "mxfp5".parse::<BlockFormat>().expect_err("no format").to_string();
    assert!(unknown.starts_with("block format `mxfp5`: expected one of mxfp8-e4m3 "), "{unknown}");
}
