//! What a pixel of the leak map says: its colour, its rank and its words, in one place.

use strum::VariantArray as _;

use crate::geom::classify::HitVerdict;
use crate::report::Legend;
use crate::report::palette::{Color, okabe_ito};

/// What is said of a pixel, from the least to the worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, strum::VariantArray)]
pub enum PixelVerdict {
    /// Rightly nothing.
    Nothing,
    /// The right triangle.
    Right,
    /// A wrong triangle that touches the right one.
    WrongNeighbour,
    /// A wrong triangle that does not.
    WrongTriangle,
    /// A hit where no surface is.
    FalseHit,
    /// No hit where the surface is.
    Leak,
}

impl PixelVerdict {
    /// A verdict on a ray; `surface`: whether it truly hits.
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

    /// Its colour in the map: what is wrong has colours of Okabe and Ito, which no reader confuses with each other or
    /// with the greys of what is right.
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

    /// How much a pixel matters where the map is shown smaller: 0 for what is right.
    pub const fn rank(self) -> u8 {
        match self {
            Self::Nothing | Self::Right => 0,
            Self::WrongNeighbour => 1,
            Self::WrongTriangle => 2,
            Self::FalseHit => 3,
            Self::Leak => 4,
        }
    }

    /// What it says, in words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Nothing => "nothing there",
            Self::Right => "right",
            Self::WrongNeighbour => "a wrong triangle that touches the right one",
            Self::WrongTriangle => "a wrong triangle that does not touch the right one",
            Self::FalseHit => "a false hit: a hit where no surface is",
            Self::Leak => "a leak: no hit where the surface is",
        }
    }

    /// The map's legend, the worst first.
    pub(super) fn legend() -> Legend {
        Self::VARIANTS.iter().rev().map(|verdict| (verdict.color(), verdict.words().to_owned())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::palette::{contrast, least_distance};

    #[test]
    fn colours_differ_for_every_reader() {
        let colors: Vec<Color> = PixelVerdict::VARIANTS.iter().map(|verdict| verdict.color()).collect();
        assert!(least_distance(&colors) > 20.0, "{}", least_distance(&colors));
        // What is wrong is brighter than what is right, for readers without colours too.
        for verdict in PixelVerdict::VARIANTS.iter().filter(|verdict| verdict.rank() > 0) {
            assert!(contrast(verdict.color(), PixelVerdict::Right.color()) > 2.0, "{verdict:?}");
        }
    }

    #[test]
    fn the_worst_has_the_highest_rank() {
        let ranks: Vec<u8> = PixelVerdict::VARIANTS.iter().map(|verdict| verdict.rank()).collect();
        assert!(ranks.is_sorted() && ranks == [0, 0, 1, 2, 3, 4]);
    }
}
