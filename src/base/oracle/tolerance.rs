//! Tolerance of t.

use std::fmt;

use crate::geom::ExactT;
use crate::geom::classify::t_error;

/// Tolerance of t with respect to the exact t. A t within either limit is accepted.
///
/// ```
/// # extern crate crossbar_base as crossbar;
/// use crossbar::oracle::Tolerance;
///
/// let tolerance = Tolerance::ulps(4).or_absolute(1e-6);
/// assert_eq!(tolerance.to_string(), "t within 4 ULPs or 1e-6");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Maximum number of f32 steps from the exact t rounded to f32. 0: correctly rounded; `u32::MAX`: any t.
    pub ulps: u32,
    /// Maximum distance from the exact t, in multiples of the ray's direction. It is for t near 0, where f32 steps are
    /// tiny.
    pub absolute: f64,
}

impl Tolerance {
    /// Accepts any t: only triangles are judged.
    pub const ANY_T: Self = Self::ulps(u32::MAX);

    /// Accepts t within this many steps of f32.
    pub const fn ulps(ulps: u32) -> Self {
        Self { ulps, absolute: 0.0 }
    }

    /// Also accepts t within this distance, in multiples of the ray's direction.
    pub const fn or_absolute(self, absolute: f64) -> Self {
        Self { absolute, ..self }
    }

    pub(super) fn allows(self, t: f32, exact: &ExactT, ulps: Option<u64>) -> bool {
        self.ulps == u32::MAX
            || ulps.is_some_and(|ulps| ulps <= u64::from(self.ulps))
            || (self.absolute > 0.0 && t_error(exact, t) <= self.absolute)
    }
}

impl fmt::Display for Tolerance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.ulps {
            u32::MAX => return f.write_str("any t"),
            1 => f.write_str("t within 1 ULP")?,
            ulps => write!(f, "t within {ulps} ULPs")?,
        }
        if self.absolute > 0.0 { write!(f, " or {:e}", self.absolute) } else { Ok(()) }
    }
}
