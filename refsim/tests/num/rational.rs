//! Rounding by its definition: finds the neighbors of an exact value among all numbers of a short format.
//!
//! Uses no shifts, sticky bits or significands. The exact value is given by its comparison with any fraction, so square
//! roots work like quotients.

use std::cmp::Ordering;

use refsim::num::{Denormals, Encoding, Flags, Format, FormatKind, Outcome, Overflow, Rounding, Tininess};

/// A fraction `n / d` with `d > 0`, reduced by factors of two only.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Q {
    pub(crate) n: i128,
    pub(crate) d: i128,
}

impl Q {
    pub(crate) fn new(n: i128, d: i128) -> Q {
        assert!(d != 0, "a fraction needs a denominator");
        let twos = n.trailing_zeros().min(d.trailing_zeros());
        let (n, d) = (n >> twos, d >> twos);
        if d < 0 { Q { n: -n, d: -d } } else { Q { n, d } }
    }

    /// `n * 2^k`.
    pub(crate) fn scaled(n: i128, k: i32) -> Q {
        if k >= 0 { Q::new(n << k, 1) } else { Q::new(n, 1 << -k) }
    }

    pub(crate) fn cmp(self, other: Q) -> Ordering {
        (self.n * other.d).cmp(&(other.n * self.d))
    }

    pub(crate) fn add(self, other: Q) -> Q {
        Q::new(self.n * other.d + other.n * self.d, self.d * other.d)
    }

    pub(crate) fn mul(self, other: Q) -> Q {
        Q::new(self.n * other.n, self.d * other.d)
    }

    pub(crate) fn halved(self) -> Q {
        Q::new(self.n, 2 * self.d)
    }

    pub(crate) fn negated(self) -> Q {
        Q { n: -self.n, d: self.d }
    }

    pub(crate) fn abs(self) -> Q {
        Q { n: self.n.abs(), d: self.d }
    }

    pub(crate) fn floor(self) -> i128 {
        self.n.div_euclid(self.d)
    }
}

/// Magnitude of the `i`th non-negative number of a format; numbers after the last finite float continue its sequence.
pub(crate) fn magnitude(f: &Format, i: u32) -> Q {
    match f.kind {
        FormatKind::Fixed { frac_bits, .. } => Q::scaled(i.into(), -i32::from(frac_bits)),
        FormatKind::Normalized { frac_bits, .. } => Q::new(i.into(), (1 << frac_bits) - 1),
        FormatKind::Float { exp_bits, man_bits } => {
            let bias = (1 << (exp_bits - 1)) - i32::from(f.encoding != Encoding::UnsignedZero);
            let (field, man) = ((i >> man_bits).cast_signed(), i128::from(i & ((1 << man_bits) - 1)));
            let hidden = if field == 0 { 0 } else { 1 << man_bits };
            Q::scaled(hidden + man, field.max(1) - bias - i32::from(man_bits))
        }
    }
}

/// Returns `true` if a value between two neighbors rounds to the upper one. `against` compares the value with a
/// fraction.
fn up(rounding: Rounding, negative: bool, low: Q, high: Q, low_even: bool, against: &impl Fn(Q) -> Ordering) -> bool {
    match rounding {
        Rounding::TowardZero => false,
        Rounding::Down => negative,
        Rounding::Up => !negative,
        Rounding::Odd => low_even,
        Rounding::Stochastic(_) => unreachable!("`tables` has it"),
        Rounding::NearestEven | Rounding::NearestAway => match against(low.add(high).halved()) {
            Ordering::Less => false,
            Ordering::Greater => true,
            Ordering::Equal => rounding == Rounding::NearestAway || !low_even,
        },
    }
}

/// The last index below `end` whose magnitude does not exceed the value.
fn below(f: &Format, end: u64, against: &impl Fn(Q) -> Ordering) -> u64 {
    let (mut low, mut high) = (0, end);
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        let candidate = match f.kind {
            FormatKind::Fixed { .. } | FormatKind::Normalized { .. } => unit(f, middle),
            FormatKind::Float { .. } => magnitude(f, middle as u32),
        };
        if against(candidate).is_lt() { high = middle } else { low = middle }
    }
    low
}

/// Rounds a positive magnitude.
pub(crate) fn round(f: &Format, tininess: Tininess, negative: bool, against: impl Fn(Q) -> Ordering) -> Outcome {
    if f.is_fixed() { round_fixed(f, negative, &against) } else { round_float(f, tininess, negative, &against) }
}

/// `steps` fixed-point steps, within the range or beyond.
fn unit(f: &Format, steps: u64) -> Q {
    Q::new(steps.into(), 1).mul(magnitude(f, 1))
}

fn round_fixed(f: &Format, negative: bool, against: &impl Fn(Q) -> Ordering) -> Outcome {
    let unit = |i: u64| unit(f, i);
    let range = 1u64 << f.width();
    let mut end = range;
    // Values that wrap in these tests are below 2^40, and saturating values need no exact index beyond it.
    while end < 1 << 40 && against(unit(end)).is_ge() {
        end *= 2;
    }
    let low = below(f, end, against);
    let inexact = against(unit(low)).is_ne();
    let whole =
        low + u64::from(inexact && up(f.rounding, negative, unit(low), unit(low + 1), low.is_multiple_of(2), against));
    let end = range / 2 - u64::from(!negative);
    if whole <= end {
        let bits = if negative { (range - whole) as u32 } else { whole as u32 } & f.mask();
        return Outcome::new(bits, if inexact { Flags::INEXACT } else { Flags::empty() });
    }
    let bits = match (f.overflow, negative) {
        (Overflow::Wrap, true) => (range - whole % range) as u32 & f.mask(),
        (Overflow::Wrap, false) => (whole % range) as u32,
        _ => f.extreme(negative),
    };
    Outcome::new(bits, Flags::OVERFLOW | Flags::INEXACT)
}

fn round_float(f: &Format, tininess: Tininess, negative: bool, against: &impl Fn(Q) -> Ordering) -> Outcome {
    let FormatKind::Float { exp_bits, man_bits } = f.kind else { unreachable!("a float") };
    let sign = if negative { f.sign_bit() } else { 0 };
    // Number of patterns per sign that are numbers, and the number of them in complete exponent fields.
    let (numbers, fields) = match f.encoding {
        Encoding::Ieee => (((1 << exp_bits) - 1) << man_bits, ((1 << exp_bits) - 1) << man_bits),
        Encoding::Finite if 1 + exp_bits + man_bits > 6 => {
            ((1 << (exp_bits + man_bits)) - 1, 1 << (exp_bits + man_bits))
        }
        _ => (1 << (exp_bits + man_bits), 1 << (exp_bits + man_bits)),
    };
    let beyond = against(magnitude(f, fields)).is_ge();
    let low = below(f, numbers.into(), against) as u32;
    let (here, next) = (magnitude(f, low), magnitude(f, low + 1));
    let inexact = against(here).is_ne();
    let rounded = low + u32::from(inexact && up(f.rounding, negative, here, next, low.is_multiple_of(2), against));
    if against(magnitude(f, numbers)).is_ge() || rounded == numbers {
        let infinite = match (f.overflow, f.rounding) {
            (Overflow::Saturate, _) => false,
            (Overflow::Nv30, _) => beyond,
            (_, Rounding::TowardZero | Rounding::Odd) => false,
            (_, Rounding::Down) => negative,
            (_, Rounding::Up) => !negative,
            _ => true,
        };
        let bits = if infinite { unbounded(f, negative) } else { sign | (numbers - 1) };
        return Outcome::new(bits, Flags::OVERFLOW | Flags::INEXACT);
    }
    let sign = if rounded == 0 && f.encoding == Encoding::UnsignedZero { 0 } else { sign };
    let mut flags = if inexact { Flags::INEXACT } else { Flags::empty() };
    let normal = magnitude(f, 1 << man_bits);
    if inexact && against(normal).is_lt() {
        // The number before the smallest normal one, with an unbounded exponent.
        let before = normal.add(magnitude(f, 1).halved().negated());
        let reaches = tininess == Tininess::After
            && against(before).is_gt()
            && up(f.rounding, negative, before, normal, false, against);
        flags.set(Flags::UNDERFLOW, !reaches);
    }
    if f.denormals == Denormals::Flush && rounded != 0 && rounded < 1 << man_bits {
        let zero = if f.encoding == Encoding::UnsignedZero { 0 } else { sign };
        return Outcome::new(zero, Flags::UNDERFLOW | Flags::INEXACT);
    }
    Outcome::new(sign | rounded, flags)
}

/// Bits of an infinity converted to the format: infinity, NaN, or the largest number.
pub(crate) fn unbounded(f: &Format, negative: bool) -> u32 {
    let sign = if negative { f.sign_bit() } else { 0 };
    match f.encoding {
        Encoding::Ieee => sign | f.infinity(false).expect("IEEE 754 has infinities"),
        Encoding::Finite if f.width() > 6 => f.sign_bit() - 1,
        Encoding::Finite => sign | (f.sign_bit() - 1),
        Encoding::UnsignedZero | Encoding::Scale => f.sign_bit(),
    }
}
