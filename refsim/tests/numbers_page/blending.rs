//! Tests of the section "Blending": exact fractions in fixed-point targets, singles in float targets.

use super::formats::Words;
use super::texels::{Channel, Class, component, table};
use super::{Random, clean, probes};
use refsim::num::Format;
use refsim::output::{BlendEquation, BlendFactor, BlendOp, BlendState, blend_texel};
use refsim::texture::TargetRounding;

const OPERATIONS: [BlendOp; 5] =
    [BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max];

/// Operations on numbers in blend equations.
trait Number: Copy + PartialOrd {
    fn of(n: i64) -> Self;
    fn add(self, b: Self) -> Self;
    fn sub(self, b: Self) -> Self;
    fn mul(self, b: Self) -> Self;
}

impl Number for f32 {
    fn of(n: i64) -> Self {
        n as f32
    }
    fn add(self, b: Self) -> Self {
        self + b
    }
    fn sub(self, b: Self) -> Self {
        self - b
    }
    fn mul(self, b: Self) -> Self {
        self * b
    }
}

/// A fraction with a positive denominator.
#[derive(Clone, Copy, Debug)]
struct Fraction(i128, i128);

impl PartialEq for Fraction {
    fn eq(&self, other: &Self) -> bool {
        self.0 * other.1 == other.0 * self.1
    }
}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        (self.0 * other.1).partial_cmp(&(other.0 * self.1))
    }
}

impl Number for Fraction {
    fn of(n: i64) -> Self {
        Self(n.into(), 1)
    }
    fn add(self, b: Self) -> Self {
        Self(self.0 * b.1 + b.0 * self.1, self.1 * b.1)
    }
    fn sub(self, b: Self) -> Self {
        self.add(Self(-b.0, b.1))
    }
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0, self.1 * b.1)
    }
}

fn blend<N: Number>(equation: &BlendEquation, s: [N; 4], d: [N; 4], i: usize) -> N {
    let term = |value: N, factor: BlendFactor| {
        let by = |f: N| Some(value.mul(f));
        match factor {
            BlendFactor::Zero => None,
            BlendFactor::One => Some(value),
            BlendFactor::SrcColor => by(s[i]),
            BlendFactor::InvSrcColor => by(N::of(1).sub(s[i])),
            BlendFactor::SrcAlpha => by(s[3]),
            BlendFactor::InvSrcAlpha => by(N::of(1).sub(s[3])),
            BlendFactor::DestAlpha => by(d[3]),
            BlendFactor::InvDestAlpha => by(N::of(1).sub(d[3])),
            BlendFactor::DestColor => by(d[i]),
            BlendFactor::InvDestColor => by(N::of(1).sub(d[i])),
            BlendFactor::SrcAlphaSat if i == 3 => Some(value),
            BlendFactor::SrcAlphaSat => {
                let free = N::of(1).sub(d[3]);
                by(if free < s[3] { free } else { s[3] })
            }
        }
    };
    match equation.op {
        BlendOp::Min => return if d[i] < s[i] { d[i] } else { s[i] },
        BlendOp::Max => return if s[i] < d[i] { d[i] } else { s[i] },
        _ => {}
    }
    let (from, to) = (term(s[i], equation.source), term(d[i], equation.destination));
    let (plus, minus) = match equation.op {
        BlendOp::Subtract => (from, to),
        BlendOp::ReverseSubtract => (to, from),
        _ => {
            return match (from, to) {
                (Some(a), Some(b)) => a.add(b),
                (one, None) | (None, one) => one.unwrap_or(N::of(0)),
            };
        }
    };
    match (plus, minus) {
        (Some(a), Some(b)) => a.sub(b),
        (Some(a), None) => a,
        (None, Some(b)) => N::of(0).sub(b),
        (None, None) => N::of(0),
    }
}

/// Code of an exact fraction in a channel.
fn store(channel: &Channel, Fraction(n, d): Fraction, truncate: bool) -> i64 {
    let half = 1i128 << (channel.bits - 1);
    let (least, scale) = match (channel.class, n < 0) {
        (Class::Unsigned, _) => (0, 2 * half - 1),
        (Class::Split, true) => (-d, 16),
        (Class::Split, false) => (-d, 15),
        _ => (-d, half - 1),
    };
    let clamped = n.clamp(least, d);
    let size = (2 * clamped.abs() * scale + if truncate { 0 } else { d }) / (2 * d);
    (if clamped < 0 { -size } else { size }) as i64
}

#[test]
fn blending_is_the_equation_of_the_page() {
    let mut r = Random::new(4);
    for (format, bytes, channels) in table() {
        let is_float = channels.iter().all(|c| matches!(c.class, Class::Float(..)));
        let widest = channels.iter().map(|c| c.bits).max().expect("a channel");
        for _ in 0..probes(600) {
            let raw = (u128::from(r.next()) << 64 | u128::from(r.next())) & u128::MAX >> (128 - 8 * bytes);
            let mut equation = || BlendEquation {
                source: r.of(BlendFactor::ALL),
                destination: r.of(BlendFactor::ALL),
                op: r.of(&OPERATIONS),
            };
            let state = BlendState { color: equation(), alpha: equation() };
            let color = [0; 4].map(|_| r.single());
            let (rounding, truncate) = r.of(&[(TargetRounding::Nearest, false), (TargetRounding::Truncate, true)]);
            let of = |i: usize| if i == 3 { &state.alpha } else { &state.color };
            let code = |channel: &Channel| {
                let i = channel.component();
                if is_float {
                    let d = [0, 1, 2, 3].map(|i| match component(&channels, i) {
                        Ok(c) => single(c, raw),
                        Err(n) => n as f32,
                    });
                    return channel.store(blend(of(i), color, d, i), truncate);
                }
                let read = |c: &Channel, raw: u128| {
                    let (n, d) = c.fraction(raw, true);
                    Fraction(n.into(), d.into())
                };
                let d = [0, 1, 2, 3].map(|i| component(&channels, i).map_or_else(Fraction::of, |c| read(c, raw)));
                // The component's channel, or else an unsigned channel as wide as the target's widest.
                let s = [0, 1, 2, 3].map(|i| {
                    let own = channels.iter().find(|c| c.component() == i);
                    let c = own.copied().unwrap_or(Channel { class: Class::Unsigned, bits: widest, ..channels[0] });
                    read(&c, c.place(c.store(color[i], truncate)))
                });
                store(channel, blend(of(i), s, d, i), truncate)
            };
            let expected = channels.iter().fold(0, |raw, c| raw | c.place(code(c)));
            let found = blend_texel(format, raw, Format::FP32, color.map(clean), &state, rounding);
            assert_eq!(found, expected, "{format}: {color:?} over {raw:#x}, {state:?}, {rounding:?}");
        }
    }
}

/// A float channel as a single: exact.
fn single(channel: &Channel, raw: u128) -> f32 {
    let Class::Float(x, y) = channel.class else { panic!("{channel:?}") };
    Words::float(x, y).value(channel.code(raw) as u32) as f32
}
