//! Units of time: clocks of a unit, and picoseconds on the common time axis.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Mul, Sub};

const PICO: u128 = 1_000_000_000_000;

/// Number of clocks of one unit; [`Hertz`] gives their duration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Clocks(pub u64);

/// Time since the start of a run, or a duration: whole picoseconds, up to 213 days.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Picoseconds(pub u64);

/// A rate per second, of clocks, bytes, pixels or operations; never 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Hertz(u64);

impl Hertz {
    /// 1 per second.
    pub const ONE: Self = Self(1);

    /// Creates a rate; returns `None` for 0.
    pub const fn new(per_second: u64) -> Option<Self> {
        if per_second == 0 { None } else { Some(Self(per_second)) }
    }

    /// The rate per second.
    pub const fn per_second(self) -> u64 {
        self.0
    }

    /// Duration of `count` operations, rounded up to a picosecond; saturates.
    pub fn time_of(self, count: u64) -> Picoseconds {
        let exact = (u128::from(count) * PICO).div_ceil(u128::from(self.0));
        Picoseconds(u64::try_from(exact).unwrap_or(u64::MAX))
    }
}

impl Picoseconds {
    /// Zero duration.
    pub const ZERO: Self = Self(0);

    /// Returns the time in seconds, for display.
    pub fn seconds(self) -> f64 {
        self.0 as f64 / PICO as f64
    }

    /// Duration from `self` to `later`; zero if `later` is earlier.
    #[must_use]
    pub fn until(self, later: Self) -> Self {
        Self(later.0.saturating_sub(self.0))
    }
}

impl Add for Picoseconds {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
}

impl Sub for Picoseconds {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0.saturating_sub(other.0))
    }
}

impl AddAssign for Picoseconds {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sum for Picoseconds {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::ZERO, Add::add)
    }
}

impl Add for Clocks {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
}

impl AddAssign for Clocks {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<u64> for Clocks {
    type Output = Self;

    fn mul(self, times: u64) -> Self {
        Self(self.0.saturating_mul(times))
    }
}
