//! Vector instruction sets of the host that the batch executor uses. All levels give the same bits; the narrower level
//! exists so that one machine can test this.

use multiversion::multiversion;
use multiversion::target::match_target;

/// A set of vector instructions; each level includes the previous levels.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SimdLevel {
    /// Instructions that every processor of the target has (SSE2 on x86-64).
    Baseline,
    /// AVX2 and FMA.
    Avx2,
}

impl SimdLevel {
    /// All levels, narrowest first.
    pub const ALL: [SimdLevel; 2] = [Self::Baseline, Self::Avx2];

    /// The levels that this processor has, narrowest first; never empty.
    pub fn available() -> Vec<SimdLevel> {
        Self::ALL.into_iter().filter(|level| level.is_available()).collect()
    }

    /// The widest level that this processor has.
    pub fn widest() -> SimdLevel {
        Self::ALL.into_iter().rfind(|level| level.is_available()).unwrap_or(Self::Baseline)
    }

    /// Lower-case name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
        }
    }

    #[cfg(target_arch = "x86_64")]
    fn is_available(self) -> bool {
        self == Self::Baseline || (is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"))
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn is_available(self) -> bool {
        self == Self::Baseline
    }

    /// Runs `work` compiled for this level, or for the supported part of it. The closure, and functions that it calls,
    /// must be `#[inline(always)]`: others are compiled for the baseline.
    #[inline(always)]
    pub fn run<R>(self, work: impl FnOnce() -> R) -> R {
        let work = match self {
            Self::Baseline => work,
            Self::Avx2 => match avx2(work) {
                Ok(done) => return done,
                Err(work) => work,
            },
        };
        work()
    }
}

/// Runs `work` with AVX2 and FMA; on a processor without them, returns it. That version contains no copy of `work`, so
/// each level is compiled once.
#[multiversion(targets("x86_64+avx2+fma"))]
fn avx2<R, F: FnOnce() -> R>(work: F) -> Result<R, F> {
    match_target! {
        "x86_64+avx2" => Ok(work()),
        _ => Err(work),
    }
}
