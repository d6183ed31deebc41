//! What was changed in a model so that it can be used, and what is odd about it.

use std::fmt;

use super::error::FilePlace;

/// Something about a model file that its user should know.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum ModelNote {
    /// Reflectances that sum to more than 1 were scaled.
    Scaled { place: FilePlace, material: String, sum: f32 },
    /// Transparency without glass was passed over.
    Opaque { place: FilePlace, material: String, passes: f32 },
    /// A glossy material without an exponent above 0 got one.
    Exponent { place: FilePlace, material: String, exponent: f32 },
    /// Triangles that ran the other way round than their neighbours were turned.
    TurnedRound { triangles: usize },
    /// Triangles without area.
    Degenerate { triangles: usize },
    /// Edges of three triangles or more.
    CrowdedEdges { edges: usize },
}

impl fmt::Display for ModelNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counted = |count: usize, one: &str, more: &str| format!("{count} {}", if count == 1 { one } else { more });
        let triangles = |count: usize| counted(count, "triangle", "triangles");
        match self {
            Self::Scaled { place, material, sum } => {
                write!(
                    f,
                    "{place}: material {material}: `Kd` and `Ks` scaled by 1 / {sum}, to reflect at most all light"
                )
            }
            Self::Opaque { place, material, passes } => {
                write!(f, "{place}: material {material}: taken as opaque; only glass (`illum 6`) lets {passes} pass")
            }
            Self::Exponent { place, material, exponent } => {
                write!(f, "{place}: material {material}: `Ns 0` taken as {exponent}, the widest lobe")
            }
            Self::TurnedRound { triangles: count } => {
                write!(f, "{} turned round, to face as the triangles beside", triangles(*count))
            }
            Self::Degenerate { triangles: count } => write!(f, "{} without area: never hit", triangles(*count)),
            Self::CrowdedEdges { edges } => {
                write!(f, "{} of three triangles or more", counted(*edges, "edge", "edges"))
            }
        }
    }
}
