//! Exact fractions of big integers, and a check that a pattern is the nearest to a fraction.

use num_bigint::BigInt;
use refsim::num::{Format, Unpacked, unpack};

/// `n / d`, d > 0.
#[derive(Clone, Debug)]
pub(crate) struct Rational {
    pub(crate) n: BigInt,
    pub(crate) d: BigInt,
}

impl Rational {
    pub(crate) fn new(n: impl Into<BigInt>, d: impl Into<BigInt>) -> Self {
        Self { n: n.into(), d: d.into() }
    }

    /// The value of a finite pattern.
    pub(crate) fn of(format: Format, bits: u32) -> Option<Self> {
        let Unpacked::Finite { sign, sig, exp, den } = unpack(&format, bits) else { return None };
        let n = BigInt::from(sig) * if sign { -1 } else { 1 };
        Some(if exp >= 0 {
            Self::new(n << exp.unsigned_abs(), den)
        } else {
            Self::new(n, BigInt::from(den) << exp.unsigned_abs())
        })
    }

    pub(crate) fn of_f32(value: f32) -> Self {
        Self::of(Format::FP32, value.to_bits()).expect("finite")
    }

    pub(crate) fn add(&self, o: &Self) -> Self {
        Self::new(&self.n * &o.d + &o.n * &self.d, &self.d * &o.d)
    }

    pub(crate) fn sub(&self, o: &Self) -> Self {
        self.add(&Self::new(-o.n.clone(), o.d.clone()))
    }

    pub(crate) fn mul(&self, o: &Self) -> Self {
        Self::new(&self.n * &o.n, &self.d * &o.d)
    }

    pub(crate) fn floor(&self) -> BigInt {
        let q = &self.n / &self.d;
        if BigInt::from(0) > self.n && &q * &self.d != self.n { q - 1 } else { q }
    }

    fn abs(&self) -> Self {
        Self::new(BigInt::from(self.n.magnitude().clone()), self.d.clone())
    }

    fn less(&self, o: &Self) -> bool {
        &self.n * &o.d < &o.n * &self.d
    }
}

/// Asserts that no other pattern of the format is closer to the value; ties must go to even patterns.
pub(crate) fn assert_nearest(format: Format, bits: u32, exact: &Rational, what: &str) {
    let error = |b: u32| Rational::of(format, b).map(|r| r.sub(exact).abs());
    let own = error(bits).unwrap_or_else(|| panic!("{what}: {bits:#x} is not finite"));
    for other in [bits.wrapping_sub(1) & format.mask(), bits.wrapping_add(1) & format.mask()] {
        let Some(rest) = error(other) else { continue };
        assert!(!rest.less(&own), "{what}: {other:#x} is nearer than {bits:#x}");
        assert!(own.less(&rest) || bits & 1 == 0, "{what}: tie of {bits:#x} and {other:#x} not to even");
    }
}
