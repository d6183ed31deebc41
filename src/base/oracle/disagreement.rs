//! A hit that disagrees with the exact one.

use std::cmp::Reverse;
use std::fmt;

use super::hard::Aim;
use crate::compare::shortest;
use crate::error::InputError;
use crate::geom::{ExactT, Hit, NearestHit, Ray};

/// Kinds of wrong hits, worst first.
///
/// Rounding in a correct intersector can cause the last three kinds: for [`DisagreementKind::Silhouette`] and
/// [`DisagreementKind::Start`], [`Disagreement::right_for`] is a ray within a few ULPs
/// ([`Oracle::with_nearby_ulps`](super::Oracle::with_nearby_ulps)) for which the result is correct. No nearby ray makes
/// a leak correct: at an edge whose two triangles face the same way, every nearby ray hits one of the two.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DisagreementKind {
    /// A triangle id that the mesh does not have.
    NoSuchTriangle,
    /// No hit where there is a surface: a hole.
    Leak,
    /// A triangle behind the first one, which was missed: a hole through which another surface is visible.
    LeakThrough,
    /// A hit where the ray hits nothing.
    FalseHit,
    /// A triangle that the ray hits from behind, although only front sides can be hit.
    BackFace,
    /// A triangle unrelated to the correct one.
    WrongTriangle,
    /// A triangle that shares an edge or a vertex with the correct one.
    WrongNeighbour,
    /// The correct triangle, at a t beyond the tolerance.
    TOff,
    /// A surface missed, or hit, near its silhouette: the result is correct for a ray whose direction differs by a few
    /// ULPs. If a surface was missed in front of another, it suffices that such a ray hits nothing in the first half of
    /// the distance to the other, because distant triangles are smaller than an ULP. If a triangle was hit, it suffices
    /// that such a ray passes near the vertex or edge that the triangle shares with the first one, or near a corner of
    /// the triangle at the same t: at a vertex of the silhouette, triangles that face away tie with triangles in front
    /// of them.
    Silhouette,
    /// A surface missed, or hit, where the ray starts: the result is correct for an origin moved a few ULPs along the
    /// ray.
    Start,
    /// A triangle behind the first one by no more than the tolerance of t.
    NearTie,
}

impl DisagreementKind {
    /// All kinds, worst first.
    pub const ALL: [Self; 11] = [
        Self::NoSuchTriangle,
        Self::Leak,
        Self::LeakThrough,
        Self::FalseHit,
        Self::BackFace,
        Self::WrongTriangle,
        Self::WrongNeighbour,
        Self::TOff,
        Self::Silhouette,
        Self::Start,
        Self::NearTie,
    ];

    /// Returns `true` if an existing surface was missed, for this ray and all nearby rays: a hole.
    pub const fn is_leak(self) -> bool {
        matches!(self, Self::Leak | Self::LeakThrough)
    }

    /// Name: `leak`, `wrong neighbour`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoSuchTriangle => "no such triangle",
            Self::Leak => "leak",
            Self::LeakThrough => "leak through to what is behind",
            Self::FalseHit => "false hit",
            Self::BackFace => "back face",
            Self::WrongTriangle => "wrong triangle",
            Self::WrongNeighbour => "wrong neighbour",
            Self::TOff => "t off",
            Self::Silhouette => "silhouette",
            Self::Start => "start",
            Self::NearTie => "near tie",
        }
    }
}

impl fmt::Display for DisagreementKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Ray with a wrong hit.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
pub struct Disagreement {
    /// Index of the ray among all judged rays.
    pub ray: usize,
    /// Aim of the ray, if known.
    pub aim: Option<Aim>,
    /// Origin of the ray.
    pub origin: [f32; 3],
    /// Direction of the ray.
    pub direction: [f32; 3],
    /// Kind of error.
    pub kind: DisagreementKind,
    /// Exact first hit, if there is one.
    pub expected: Option<NearestHit>,
    /// Hit of the intersector, if there is one.
    pub found: Option<Hit>,
    /// Number of f32 steps between the found t and the exact first t rounded to f32. `None` if only one side has a t,
    /// or a t is not finite.
    pub t_ulps: Option<u64>,
    /// Exact t at which the ray hits the triangle that was found, from either side, if at all.
    pub met_at: Option<ExactT>,
    /// A ray within a few ULPs of this one for which the found triangle, or the miss, is exactly correct. Not searched
    /// for if the triangle does not exist or is the correct one.
    pub right_for: Option<Ray>,
    /// This ray, or a nearby one, that passes within a few ULPs of a feature of the found triangle: the vertex or edge
    /// shared with that ray's first triangle, or a corner at the same t. Only if `right_for` is `None`.
    pub touched_by: Option<Ray>,
    /// Corners of the found triangle, or of the expected one if no triangle was found or its id does not exist.
    pub corners: Option<[[f32; 3]; 3]>,
}

impl Disagreement {
    /// Returns the ray with its original bits.
    pub fn ray(&self) -> Result<Ray, InputError> {
        Ray::new(self.origin, self.direction)
    }

    /// Returns `true` if rounding explains the result: it is correct for a ray within a few ULPs, or it names a
    /// neighbour of the correct triangle and such a ray passes their common edge or vertex, or the two t are equal
    /// within the tolerance.
    pub fn is_rounding(&self) -> bool {
        match self.kind {
            DisagreementKind::Silhouette | DisagreementKind::Start | DisagreementKind::NearTie => true,
            DisagreementKind::WrongNeighbour => self.right_for.is_some() || self.touched_by.is_some(),
            _ => false,
        }
    }

    /// Formats the ray and [`Disagreement::corners`] as Rust source for a test; numbers read back to the same bits.
    pub fn literal(&self) -> String {
        let Self { origin, direction, .. } = self;
        let ray = format!("let ray = Ray::new({origin:?}, {direction:?}).unwrap();");
        let Some(corners) = &self.corners else { return ray };
        format!("{ray} let triangle: [[f32; 3]; 3] = {corners:?};")
    }

    fn write_found(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(Hit { triangle, t }) = self.found else { return f.write_str(", found nothing") };
        write!(f, ", found triangle {triangle} at t = {}", shortest(t))?;
        match self.t_ulps {
            Some(0) | None => {}
            Some(1) => f.write_str(", 1 ULP off")?,
            Some(ulps) => write!(f, ", {ulps} ULPs off")?,
        }
        match &self.met_at {
            Some(met) if self.kind != DisagreementKind::TOff => {
                write!(f, " (the ray meets it at {})", shortest(met.to_f64()))
            }
            None if self.kind != DisagreementKind::NoSuchTriangle => f.write_str(" (the ray does not meet it)"),
            _ => Ok(()),
        }
    }

    /// Sort key, worst first: by kind, then the larger error of t (unknown counts as largest), then the index of the
    /// ray.
    pub(super) fn rank(&self) -> impl Ord + use<> {
        (self.kind, Reverse(self.t_ulps.unwrap_or(u64::MAX)), self.ray)
    }
}

/// Vector displayed in parentheses, with the sign of -0 and enough digits to read back the same bits.
struct ShownVector([f32; 3]);

impl fmt::Display for ShownVector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.map(shortest);
        write!(f, "({x}, {y}, {z})")
    }
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (from, along) = (ShownVector(self.origin), ShownVector(self.direction));
        write!(f, "ray {}", self.ray)?;
        if let Some(aim) = self.aim {
            write!(f, ", {},", aim.words())?;
        }
        write!(f, " from {from} along {along}: {}: expected ", self.kind)?;
        match &self.expected {
            None => f.write_str("nothing")?,
            Some(NearestHit { ties, t, .. }) => {
                let mut names = ties.iter().take(4).map(u32::to_string).collect::<Vec<_>>().join(" or ");
                if ties.len() > 4 {
                    names += &format!(" or {} more", ties.len() - 4);
                }
                write!(f, "triangle {names} at t = {}", shortest(t.to_f64()))?;
            }
        }
        self.write_found(f)?;
        let (ray, what) = match (self.right_for, self.touched_by) {
            (Some(ray), _) => (ray, "right for a ray"),
            (None, Some(ray)) if ray.direction() != self.direction => (ray, "ties with the first hit of a ray"),
            _ => return Ok(()),
        };
        write!(f, "; {what}")?;
        if ray.origin() != self.origin {
            write!(f, " from {}", ShownVector(ray.origin()))?;
        }
        write!(f, " along {}", ShownVector(ray.direction()))
    }
}
