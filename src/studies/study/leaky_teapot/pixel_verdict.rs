//! Verdicts of the leak map: color and name.

use strum::VariantArray as _;

use crate::geom::classify::HitVerdict;
use crate::report::Legend;
use crate::report::palette::{Color, okabe_ito};

/// Verdict on a pixel, in ascending order of severity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, strum::VariantArray)]
pub enum PixelVerdict {
    /// Correct miss.
    Nothing,
    /// Correct triangle.
    Right,
    /// Wrong triangle that touches the correct one.
    WrongNeighbour,
    /// Wrong triangle that does not touch the correct one.
    WrongTriangle,
    /// Hit where there is no surface.
    FalseHit,
    /// Miss where there is a surface.
    Leak,
}

impl PixelVerdict {
    /// Converts a ray's verdict; `surface` is `true` if the ray hits in exact arithmetic.
    pub const fn of(verdict: HitVerdict, surface: bool) -> Self {
        match verdict {
            HitVerdict::Right if surface => Self::Right,
            HitVerdict::Right => Self::Nothing,
            HitVerdict::WrongTriangle { adjacent: true } => Self::WrongNeighbour,
            HitVerdict::WrongTriangle { adjacent: false } => Self::WrongTriangle,
            HitVerdict::FalseHit => Self::FalseHit,
            HitVerdict::Leak => Self::Leak,
        }
    }

    /// Color in the map: errors have colors of Okabe and Ito, which readers with any color vision can distinguish from
    /// each other and from the greys of correct pixels.
    pub const fn color(self) -> Color {
        match self {
            Self::Nothing => [16, 18, 22],
            Self::Right => [74, 77, 82],
            Self::WrongNeighbour => okabe_ito::YELLOW,
            Self::WrongTriangle => okabe_ito::REDDISH_PURPLE,
            Self::FalseHit => okabe_ito::SKY_BLUE,
            Self::Leak => okabe_ito::VERMILION,
        }
    }

    /// Returns `true` if the pixel's hit is not the exact one.
    pub const fn is_error(self) -> bool {
        !matches!(self, Self::Nothing | Self::Right)
    }

    /// Name of the verdict.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Nothing => "right: no hit, no surface",
            Self::Right => "right: the exact triangle",
            Self::WrongNeighbour => "a wrong triangle that touches the right one",
            Self::WrongTriangle => "a wrong triangle that does not touch the right one",
            Self::FalseHit => "a false hit: a hit where there is no surface",
            Self::Leak => "a leak: no hit where there is a surface",
        }
    }

    /// Legend of the map, worst verdict first.
    pub(super) fn legend() -> Legend {
        Self::VARIANTS.iter().rev().map(|verdict| (verdict.color(), verdict.words().to_owned())).collect()
    }
}
