//! Notes on repairs and defects of a model.

use std::fmt;

use crate::error::FilePlace;
use crate::geom::polygon::PolygonFault;

/// A repair or defect of a model file to report to the user.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum ModelNote {
    /// Reflectances that sum to more than 1 were scaled.
    Scaled { place: FilePlace, material: String, sum: f32 },
    /// Transparency of a material that is not glass was ignored.
    Opaque { place: FilePlace, material: String, passes: f32 },
    /// A glossy material without an exponent above 0 got the default exponent.
    Exponent { place: FilePlace, material: String, exponent: f32 },
    /// No library has a material; its faces are grey.
    Unknown { place: FilePlace, material: String },
    /// Faces of four corners or more that have no certain interior.
    Polygons { fault: PolygonFault, faces: usize, first: String },
    /// Data after the last triangle or element of a file.
    Trailing { bytes: usize, last: &'static str },
    /// Triangles with winding opposite to their neighbours' were flipped.
    TurnedRound { triangles: usize },
    /// Triangles without area.
    Degenerate { triangles: usize },
    /// Edges with three or more triangles.
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
            Self::Unknown { place, material } => {
                write!(f, "{place}: material {material}: in no library, taken as grey")
            }
            Self::Polygons { fault, faces, first } => {
                let cut = match fault {
                    PolygonFault::Crossing | PolygonFault::TooLong => "cut into a fan around the first corner",
                    _ => "cut as seen along an axis near the normal",
                };
                write!(f, "{} {fault}: {cut}; first: {first}", counted(*faces, "face", "faces"))
            }
            Self::Trailing { bytes, last } => {
                write!(f, "{} after the last {last}: passed over", counted(*bytes, "byte", "bytes"))
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
