//! Classification of a renderer's hit against the exact one.

use num_bigint::BigUint;

use super::exact::integer::whole;
use super::exact::{ExactT, NearestHit, ratio};
use super::{Contact, Mesh};

/// First hit of a ray as reported by a renderer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The triangle that was hit; `None` for a miss.
    pub triangle: Option<u32>,
    /// Ray parameter t of the hit; ignored if `triangle` is `None`.
    pub t: f32,
}

/// Verdict on a hit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HitVerdict {
    /// Correct: the first triangle, a triangle hit at exactly the same t, or a correct miss.
    Right,
    /// No hit where there is a surface: a hole.
    Leak,
    /// A hit where there is no surface.
    FalseHit,
    /// A hit of a triangle behind the first.
    WrongTriangle {
        /// `true` if it shares an edge or a vertex with a first triangle.
        adjacent: bool,
    },
}

/// Error of t against the exact value. Both errors are infinite for a t that is not finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TError {
    /// |t - exact|, correctly rounded.
    pub absolute: f64,
    /// |t - exact| / exact, correctly rounded; 0 if both t are zero, infinite if only the exact t is zero.
    pub relative: f64,
}

/// Verdict with the error of t if both sides hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// Verdict on the hit.
    pub verdict: HitVerdict,
    /// Error against the exact first t, for [`HitVerdict::Right`] hits and [`HitVerdict::WrongTriangle`].
    pub t_error: Option<TError>,
}

/// Classifies a candidate against the exact first hit (`None`: the ray hits nothing).
pub fn classify(mesh: &Mesh, nearest: Option<&NearestHit>, candidate: Candidate) -> Judgement {
    let (verdict, t_error) = match (nearest, candidate.triangle) {
        (None, None) => (HitVerdict::Right, None),
        (Some(_), None) => (HitVerdict::Leak, None),
        (None, Some(_)) => (HitVerdict::FalseHit, None),
        (Some(nearest), Some(found)) => {
            let verdict = if nearest.ties.contains(&found) {
                HitVerdict::Right
            } else {
                let adjacent = nearest.ties.iter().any(|&right| mesh.contact(right, found) != Contact::None);
                HitVerdict::WrongTriangle { adjacent }
            };
            (verdict, Some(t_error(&nearest.t, candidate.t)))
        }
    };
    Judgement { verdict, t_error }
}

/// Computes the error of t against an exact value, exactly and rounded once.
pub fn t_error(exact: &ExactT, t: f32) -> TError {
    if !t.is_finite() {
        return TError { absolute: f64::INFINITY, relative: f64::INFINITY };
    }
    // t = whole / 2^149 exactly; the error is |whole * den - num * 2^149| / (den * 2^149).
    let magnitude = whole(t, -149).into_parts().1;
    let (num, den) = (exact.numerator() << 149_u8, exact.denominator());
    let scaled = &magnitude * den;
    let difference = if t < 0.0 {
        scaled + &num
    } else if scaled > num {
        scaled - &num
    } else {
        &num - scaled
    };
    let none = BigUint::default();
    let absolute = ratio::to_f64(&difference, &(den << 149_u8));
    let relative = if difference == none {
        0.0
    } else if num == none {
        f64::INFINITY
    } else {
        ratio::to_f64(&difference, &num)
    };
    TError { absolute, relative }
}
