//! Tests of the section "Texels": the channel table parsed from the page, values as fractions, stores.

use super::formats::Words;
use super::{PAGE, Random, probes};
use refsim::num::Format;
use refsim::texture::{ChannelValue, SignedTexelMinimum, TargetRounding, TexelFormat, decode, encode};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Class {
    Unsigned,
    Signed,
    Split,
    /// Exponent and mantissa bits.
    Float(i32, i32),
}

/// A channel; its letter is `r`, `g`, `b`, `a` or `l`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Channel {
    pub(crate) class: Class,
    pub(crate) letter: char,
    pub(crate) from: u32,
    pub(crate) bits: u32,
}

impl Channel {
    /// Index of the component that the channel stores.
    pub(crate) fn component(&self) -> usize {
        "rgbal".find(self.letter).expect("a letter") % 4
    }

    pub(crate) fn code(&self, raw: u128) -> i64 {
        (raw >> self.from & ((1 << self.bits) - 1)) as i64
    }

    /// Numerator and denominator.
    pub(crate) fn fraction(&self, raw: u128, clamp: bool) -> (i64, i64) {
        let (code, half) = (self.code(raw), 1i64 << (self.bits - 1));
        let signed = if code >= half { code - 2 * half } else { code };
        match self.class {
            Class::Unsigned => (code, 2 * half - 1),
            Class::Signed if signed == -half && clamp => (-1, 1),
            Class::Signed => (signed, half - 1),
            Class::Split if signed < 0 => (signed, 16),
            Class::Split => (signed, 15),
            Class::Float(..) => panic!("a float"),
        }
    }

    /// Code of a single.
    pub(crate) fn store(&self, x: f32, truncate: bool) -> i64 {
        let round = |x: f64| if truncate { x.floor() } else { (x + 0.5).floor() };
        let half = 1i64 << (self.bits - 1);
        let signed = |below: i64, above: i64| {
            let scale = if x < 0.0 { below } else { above };
            let size = round(f64::from(x.abs().min(1.0)) * scale as f64) as i64;
            if x < 0.0 { -size } else { size }
        };
        let code = match self.class {
            Class::Float(x_bits, y_bits) => {
                return Words::float(x_bits, y_bits).round(if x.is_nan() { f64::NAN } else { x.into() }).0.into();
            }
            _ if x.is_nan() => 0,
            Class::Unsigned => round(f64::from(x.clamp(0.0, 1.0)) * (2 * half - 1) as f64) as i64,
            Class::Signed => signed(half - 1, half - 1),
            Class::Split => signed(16, 15),
        };
        code & (2 * half - 1)
    }

    pub(crate) fn place(&self, code: i64) -> u128 {
        (code as u128 & ((1 << self.bits) - 1)) << self.from
    }
}

/// The table of formats: name, bytes, channels.
pub(crate) fn table() -> Vec<(TexelFormat, usize, Vec<Channel>)> {
    let rows = PAGE.lines().skip_while(|l| !l.starts_with("| format | bytes |")).skip(2);
    let mut out = Vec::new();
    for row in rows.take_while(|l| l.starts_with('|')) {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let names = cells[0].split(' ').map(|name| name.trim_matches('`'));
        for (name, list) in names.zip(cells[2].split(';').cycle()) {
            let channels = list.split(',').map(|text| channel(text.trim())).collect();
            out.push((name.parse().expect(name), cells[1].parse().expect(row), channels));
        }
    }
    out
}

fn channel(text: &str) -> Channel {
    let words: Vec<&str> = text.split(' ').collect();
    let (class, letter, range) = match words.as_slice() {
        ["signed", letter, range] => (Class::Signed, letter, range),
        ["split", letter, range] => (Class::Split, letter, range),
        ["fp16", letter, range] => (Class::Float(5, 10), letter, range),
        ["fp24", letter, range] => (Class::Float(7, 16), letter, range),
        ["fp32", letter, range] => (Class::Float(8, 23), letter, range),
        [letter, range] => (Class::Unsigned, letter, range),
        other => panic!("{other:?}"),
    };
    let (from, to) = range.split_once('-').expect(text);
    let (from, to): (u32, u32) = (from.parse().expect(text), to.parse().expect(text));
    Channel { class, letter: letter.chars().next().expect(text), from, bits: to - from + 1 }
}

/// Source of a component in a read: a channel, or a constant.
pub(crate) fn component(channels: &[Channel], component: usize) -> Result<&Channel, i64> {
    let has = |letter: char| channels.iter().find(|c| c.letter == letter);
    if let Some(found) = has(['r', 'g', 'b', 'a'][component]).or_else(|| has('l').filter(|_| component < 3)) {
        return Ok(found);
    }
    // Alpha-only formats have color 0; all other missing components are 1.
    Err(i64::from(!channels.iter().all(|c| c.letter == 'a')))
}

fn same(found: ChannelValue, channel: &Channel, raw: u128, clamp: bool) -> bool {
    match (found, channel.class) {
        (ChannelValue::Float { bits, .. }, Class::Float(..)) => i64::from(bits) == channel.code(raw),
        (ChannelValue::Ratio { numerator, denominator }, _) => {
            let (n, d) = channel.fraction(raw, clamp);
            numerator * d == n * i64::from(denominator)
        }
        _ => false,
    }
}

#[test]
fn every_format_is_in_the_table() {
    let mut listed: Vec<TexelFormat> = table().iter().map(|row| row.0).collect();
    listed.sort_unstable();
    let mut all = TexelFormat::ALL.to_vec();
    all.sort_unstable();
    assert_eq!(listed, all);
}

#[test]
fn texels_are_read_and_stored_as_the_table_says() {
    let mut r = Random::new(3);
    for (format, bytes, channels) in table() {
        assert_eq!(format.bytes(), bytes, "{format}");
        for _ in 0..probes(400) {
            let mask = u128::MAX >> (128 - 8 * bytes);
            let raw = (u128::from(r.next()) << 64 | u128::from(r.next())) & mask;
            for (minimum, clamp) in [(SignedTexelMinimum::Clamp, true), (SignedTexelMinimum::BelowMinusOne, false)] {
                for (i, found) in decode(format, raw, minimum).0.into_iter().enumerate() {
                    let is_same = match component(&channels, i) {
                        Ok(channel) => same(found, channel, raw, clamp),
                        Err(0) => found == ChannelValue::ZERO,
                        Err(_) => found == ChannelValue::ONE,
                    };
                    assert!(is_same, "{format}, component {i} of {raw:#x}: {found:?}");
                }
            }
            let color = [0; 4].map(|_| r.single());
            for (rounding, truncate) in [(TargetRounding::Nearest, false), (TargetRounding::Truncate, true)] {
                let stored = channels.iter().map(|c| c.place(c.store(color[c.component()], truncate)));
                let expected = stored.fold(0, |raw, more| raw | more);
                let found = encode(format, Format::FP32, color.map(super::clean), rounding);
                assert_eq!(found, expected, "{format}: {color:?}, {rounding:?}");
            }
        }
    }
}
