//! Errors of computing transfer.

use thiserror::Error;

use crate::linalg::MatrixError;
use crate::tracer::CastError;
use crate::transfer::SignalError;
use crate::transfer::brdf::BrdfError;

/// Errors of computing transfer.
#[non_exhaustive]
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum TransferError {
    /// A mesh without triangles.
    #[error("expected a mesh of at least one triangle, found none")]
    NoTriangles,
    /// Neither the file nor the triangles around a vertex give a normal.
    #[error(
        "vertex {vertex} (counted from 0) has no normal: none is given, and its triangles have no area or cancel out; \
         remove them or give a normal"
    )]
    NoNormal { vertex: usize },
    /// Tangents were to come from texture coordinates.
    #[error("the mesh has no texture coordinates to take tangents from; name an axis for the tangents instead")]
    NoTextureCoordinates,
    /// An axis without a direction.
    #[error("expected an axis of finite length above 0 for the tangents, found {found:?}")]
    Axis { found: [f64; 3] },
    /// Not one material per triangle.
    #[error("expected one material per triangle, {triangles}, found {found}")]
    Materials { triangles: usize, found: usize },
    /// A material that no response was given for.
    #[error("triangle {triangle} has material {material}, expected one below {responses} (counted from 0)")]
    Material { triangle: usize, material: u32, responses: usize },
    /// Responses, rays or transfer with different numbers of something.
    #[error("expected equal numbers of {what}, found {} and {}", found[0], found[1])]
    Differ { what: &'static str, found: [usize; 2] },
    /// Exit bases of different functions.
    #[error(
        "expected one exit basis for all materials, or one that holds the other's functions, found bases of {} and {} \
         functions",
        found[0],
        found[1]
    )]
    ExitBases { found: [usize; 2] },
    /// A figure out of range.
    #[error("expected {expected} for {what}, found {found}")]
    OutOfRange { what: &'static str, expected: &'static str, found: f64 },
    /// Interreflection needs to know what rays hit.
    #[error("the rays were traced without keeping hits, which bounces need; trace them with `keep_hits`")]
    NoHits,
    /// Figures that make no BRDF.
    #[error(transparent)]
    Brdf(#[from] BrdfError),
    /// A matrix too large.
    #[error(transparent)]
    Matrix(#[from] MatrixError),
    /// A response that is not finite.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// The ray caster failed.
    #[error(transparent)]
    Cast(#[from] CastError),
}
