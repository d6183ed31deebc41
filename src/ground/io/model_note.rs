//! Notes on repairs and defects of a model.

use crate::error::FilePlace;
use crate::geom::polygon::PolygonFault;

/// A repair or defect of a model file to report to the user.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum ModelNote {
    /// Reflectances that sum to more than 1 were scaled.
    #[error("{place}: material {material}: `Kd` and `Ks` scaled by 1 / {sum}, to reflect at most all light")]
    Scaled { place: FilePlace, material: String, sum: f32 },
    /// Transparency of a material that is not glass was ignored.
    #[error("{place}: material {material}: read as opaque; only glass (`illum 6`) lets {passes} pass")]
    Opaque { place: FilePlace, material: String, passes: f32 },
    /// A glossy material without an exponent above 0 got the default exponent.
    #[error("{place}: material {material}: `Ns 0` read as {exponent}, the widest lobe")]
    Exponent { place: FilePlace, material: String, exponent: f32 },
    /// No library has a material; its faces are grey.
    #[error("{place}: material {material}: in no library, read as grey")]
    Unknown { place: FilePlace, material: String },
    /// Faces of four corners or more that have no certain interior.
    #[error("{} {fault}: {}; first: {first}", counted(.faces, "face"), cut(.fault))]
    Polygons { fault: PolygonFault, faces: usize, first: String },
    /// Data after the last triangle or element of a file.
    #[error("{} after the last {last}: ignored", counted(.bytes, "byte"))]
    Trailing { bytes: usize, last: &'static str },
    /// Triangles with winding opposite to their neighbours' were flipped.
    #[error("{} flipped, to face like the neighbours", counted(.triangles, "triangle"))]
    TurnedRound { triangles: usize },
    /// Triangles without area.
    #[error("{} without area: never hit", counted(.triangles, "triangle"))]
    Degenerate { triangles: usize },
    /// Edges with three or more triangles.
    #[error("{} of three triangles or more", counted(.edges, "edge"))]
    CrowdedEdges { edges: usize },
}

fn counted(count: &usize, one: &str) -> String {
    format!("{count} {one}{}", if *count == 1 { "" } else { "s" })
}

fn cut(fault: &PolygonFault) -> &'static str {
    match fault {
        PolygonFault::Crossing | PolygonFault::TooLong => "cut into a fan around the first corner",
        _ => "cut as seen along an axis near the normal",
    }
}
