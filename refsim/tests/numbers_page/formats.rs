//! Tests of the section "Formats": the value of every pattern, and single roundings, in exact doubles.

use super::{Random, power, probes};
use refsim::num::{Flags, Format, ops};

/// A format parsed from its string.
pub(crate) struct Words {
    /// Integer and fraction bits, or exponent and mantissa bits.
    layout: (i32, i32),
    fixed: bool,
    /// Fixed point in units of `1 / (2^F - 1)`.
    normalized: bool,
    /// Suffix of the encoding: empty, `fn` or `fnuz`.
    encoding: &'static str,
    rounding: &'static str,
    overflow: &'static str,
    flush: bool,
}

impl Words {
    pub(crate) fn float(exponent: i32, mantissa: i32) -> Self {
        Self {
            layout: (exponent, mantissa),
            fixed: false,
            normalized: false,
            encoding: "",
            rounding: "rne",
            overflow: "inf",
            flush: false,
        }
    }

    fn random(r: &mut Random) -> Self {
        let rounding = r.of(&["rne", "rna", "rtz", "rdn", "rup", "rod"]);
        if r.coin() {
            let normalized = r.coin();
            let layout = match normalized {
                true => r.of(&[(3, 8), (0, 8), (7, 8), (13, 2), (2, 5)]),
                false => r.of(&[(3, 12), (1, 10), (0, 8), (0, 15), (7, 0), (15, 16)]),
            };
            let overflow = r.of(&["sat", "wrap"]);
            return Self { layout, fixed: true, normalized, encoding: "", rounding, overflow, flush: false };
        }
        let layout = r.of(&[(5, 10), (7, 16), (8, 23), (4, 3), (2, 1), (8, 7)]);
        let overflow = r.of(&["inf", "sat", "nvovf"]);
        let encoding = if layout.0 == 8 { "" } else { r.of(&["", "fn", "fnuz"]) };
        Self { layout, fixed: false, normalized: false, encoding, rounding, overflow, flush: r.coin() }
    }

    fn text(&self) -> String {
        let ((a, b), rules) = (self.layout, format!("{}:{}", self.rounding, self.overflow));
        match (self.fixed, self.flush) {
            (true, _) if self.normalized => format!("n{a}.{b}:{rules}"),
            (true, _) => format!("s{a}.{b}:{rules}"),
            (false, true) => format!("e{a}m{b}{}:{rules}:ftz", self.encoding),
            (false, false) => format!("e{a}m{b}{}:{rules}", self.encoding),
        }
    }

    /// The pattern of NaN; a format with NaN but no infinity has only this NaN.
    fn nan(&self) -> Option<u32> {
        let (a, b) = self.layout;
        match self.encoding {
            "fnuz" => Some(1 << (a + b)),
            "fn" if 1 + a + b <= 6 => None,
            "fn" => Some((1 << (a + b)) - 1),
            _ => Some(((1 << a) - 1) << b | 1 << (b - 1)),
        }
    }

    fn bias(&self) -> i32 {
        let (a, _) = self.layout;
        if self.encoding == "fnuz" { 1 << (a - 1) } else { (1 << (a - 1)) - 1 }
    }

    /// Rounds a number of units to an integer.
    fn whole(&self, x: f64) -> f64 {
        match self.rounding {
            "rne" => x.round_ties_even(),
            "rna" => x.round(),
            "rtz" => x.trunc(),
            "rup" => x.ceil(),
            "rod" if x.floor() % 2.0 == 0.0 => x.ceil(),
            _ => x.floor(),
        }
    }

    /// Rounds a number once; returns pattern and flags.
    pub(crate) fn round(&self, x: f64) -> (u32, Flags) {
        self.round_quotient(x, 1.0)
    }

    /// Rounds `x / d` once, where `d` is the denominator of a format's numbers: only integer quotients are exact.
    fn round_quotient(&self, x: f64, d: f64) -> (u32, Flags) {
        let (a, b) = self.layout;
        if self.fixed {
            let one = if self.normalized { power(b) - 1.0 } else { power(b) };
            let (top, units) = (power(a + b), x * one / d);
            let (width, kept) = (1 + a + b, self.whole(units));
            let mask = u32::MAX >> (32 - width);
            let pattern = |k: f64| (k as i64 as u32) & mask;
            if x.is_nan() {
                return (0, Flags::INVALID);
            }
            if kept < -top || kept > top - 1.0 {
                let end = if kept < 0.0 { -top } else { top - 1.0 };
                let wraps = self.overflow == "wrap" && kept.is_finite();
                let kept = if wraps { kept.rem_euclid(2.0 * top) } else { end };
                return (pattern(kept), Flags::OVERFLOW | Flags::INEXACT);
            }
            return (pattern(kept), if kept == units { Flags::empty() } else { Flags::INEXACT });
        }
        let x = x / d;
        let bias = self.bias();
        // The largest finite pattern, its exponent and its value.
        let infinity = ((1u32 << a) - 1) << b;
        let (largest, most) = match self.encoding {
            "" => (infinity - 1, bias),
            "fn" if self.nan().is_some() => ((1 << (a + b)) - 2, bias + 1),
            "fn" => ((1 << (a + b)) - 1, bias + 1),
            _ => ((1 << (a + b)) - 1, bias - 1),
        };
        let end = self.value(largest);
        let sign = u32::from(x.is_sign_negative()) << (a + b);
        let zero = if self.encoding == "fnuz" { 0 } else { sign };
        let unbounded = if self.encoding.is_empty() { sign | infinity } else { self.nan().unwrap_or(sign | largest) };
        if x.is_nan() {
            return self.nan().map_or((0, Flags::INVALID), |nan| (nan, Flags::empty()));
        }
        if x.is_infinite() && self.encoding.is_empty() {
            return (unbounded, Flags::empty());
        }
        if x.is_infinite() {
            let bits = if self.overflow == "sat" { sign | largest } else { unbounded };
            return (bits, Flags::OVERFLOW | Flags::INEXACT);
        }
        // Exponent of a double, from its exponent field.
        let exponent = |x: f64| if x == 0.0 { -5000 } else { ((x.to_bits() >> 52 & 0x7ff) as i32) - 1023 };
        let at = |least: i32| {
            let unit = power(exponent(x).max(least) - b);
            self.whole(x / unit) * unit
        };
        let (rounded, least) = (at(1 - bias), 1 - bias);
        if rounded.abs() > end {
            let huge = x.abs() >= power(most + 1);
            let infinite = match (self.overflow, self.rounding) {
                ("sat", _) | (_, "rtz" | "rod") if self.overflow != "nvovf" => false,
                ("nvovf", _) => huge,
                (_, "rdn") => sign != 0,
                (_, "rup") => sign == 0,
                _ => true,
            };
            let bits = if infinite { unbounded } else { sign | largest };
            return (bits, Flags::OVERFLOW | Flags::INEXACT);
        }
        let mut flags = if rounded == x { Flags::empty() } else { Flags::INEXACT };
        if rounded != x && at(-4000).abs() < power(least) {
            flags |= Flags::UNDERFLOW;
        }
        let magnitude = rounded.abs();
        if self.flush && magnitude != 0.0 && magnitude < power(least) {
            return (zero, Flags::UNDERFLOW | Flags::INEXACT);
        }
        let sign = if magnitude == 0.0 { zero } else { sign };
        let field = exponent(magnitude).max(least - 1) - least + 1;
        let mantissa = match field {
            0 => magnitude / power(least - b),
            _ => magnitude / power(exponent(magnitude) - b) - power(b),
        };
        (sign | (field as u32) << b | mantissa as u32, flags)
    }

    /// The denominator of the format's numbers.
    fn divisor(&self) -> f64 {
        if self.normalized { power(self.layout.1) - 1.0 } else { 1.0 }
    }

    /// Value of a pattern, times [`Self::divisor`].
    pub(crate) fn value(&self, bits: u32) -> f64 {
        let (a, b) = self.layout;
        if self.fixed {
            let spare = 31 - a - b;
            let code = f64::from((bits << spare).cast_signed() >> spare);
            return if self.normalized { code } else { code * power(-b) };
        }
        let (bias, field) = (self.bias(), (bits >> b & ((1 << a) - 1)).cast_signed());
        let mantissa = f64::from(bits & ((1 << b) - 1));
        let one = if self.encoding == "fnuz" { bits } else { bits & ((1 << (a + b)) - 1) };
        if !self.encoding.is_empty() && self.nan() == Some(one & ((2 << (a + b)) - 1)) {
            return f64::NAN;
        }
        let magnitude = match field {
            0 if self.flush => 0.0,
            0 => mantissa * power(1 - bias - b),
            _ if field == (1 << a) - 1 && self.encoding.is_empty() => {
                if mantissa == 0.0 {
                    f64::INFINITY
                } else {
                    f64::NAN
                }
            }
            _ => (mantissa + power(b)) * power(field - bias - b),
        };
        let signed = self.encoding != "fnuz" || magnitude != 0.0;
        if bits >> (a + b) & 1 == 1 && signed { -magnitude } else { magnitude }
    }
}

#[test]
fn one_rounding_into_every_format() {
    let mut r = Random::new(1);
    for probe in 0..probes(60_000) {
        let (from, into) = (Words::random(&mut r), Words::random(&mut r));
        let [source, target]: [Format; 2] = [&from, &into].map(|w| w.text().parse().unwrap());
        let bits = match probe % 4 {
            0 => r.next() as u32 & source.mask(),
            _ => ops::convert(&Format::FP32, source, r.single().to_bits()).bits,
        };
        let value = from.value(bits);
        let (expected, mut flags) = into.round_quotient(value, from.divisor());
        let mut bits_expected = expected;
        if value.is_infinite() && into.fixed {
            (bits_expected, flags) = (into.round(value).0, Flags::OVERFLOW | Flags::INEXACT);
        }
        if value.is_nan() {
            let quiet = !from.encoding.is_empty() || bits & 1 << (from.layout.1 - 1) != 0;
            let none = into.fixed || into.nan().is_none();
            flags = if none || !quiet { Flags::INVALID } else { Flags::empty() };
        }
        if value.is_nan() && !into.fixed {
            bits_expected = into.nan().unwrap_or(0);
        }
        let found = ops::convert(&source, target, bits);
        let place = format!("{bits:#x} of {} into {}", from.text(), into.text());
        assert_eq!((found.bits, found.flags), (bits_expected, flags), "{place}: {value} / {}", from.divisor());
    }
}
