//! Classification of a renderer's hit against the exact one.

use num_bigint::BigInt;

use super::exact::integer::whole;
use super::exact::{ExactT, NearestHit, ratio};
use super::{Contact, Hit, Mesh};

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

/// Classifies a hit against the exact first hit (`None`: the ray hits nothing); its t does not matter.
pub fn classify(mesh: &Mesh, nearest: Option<&NearestHit>, found: Option<Hit>) -> HitVerdict {
    match (nearest, found) {
        (None, None) => HitVerdict::Right,
        (Some(_), None) => HitVerdict::Leak,
        (None, Some(_)) => HitVerdict::FalseHit,
        (Some(nearest), Some(hit)) if nearest.ties.contains(&hit.triangle) => HitVerdict::Right,
        (Some(nearest), Some(hit)) => {
            let adjacent = nearest.ties.iter().any(|&right| mesh.contact(right, hit.triangle) != Contact::None);
            HitVerdict::WrongTriangle { adjacent }
        }
    }
}

/// |t - exact|, correctly rounded; infinite for a t that is not finite.
pub fn t_error(exact: &ExactT, t: f32) -> f64 {
    if !t.is_finite() {
        return f64::INFINITY;
    }
    // t = whole / 2^149 exactly; the error is |whole * den - num * 2^149| / (den * 2^149).
    let (num, den) = (exact.numerator() << 149_u8, exact.denominator());
    let difference = whole(t, -149) * BigInt::from(den.clone()) - BigInt::from(num);
    ratio::to_f64(difference.magnitude(), &(den << 149_u8))
}
