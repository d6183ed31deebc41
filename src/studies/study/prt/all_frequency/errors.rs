//! Error of coded transfer relative to the raw matrices.

use crate::all_frequency::Reflectance;
use crate::all_frequency::code::CodedTransfer;
use crate::all_frequency::transfer::transfer_of;
use crate::error::InputError;
use crate::study::ProgressFn;
use crate::transfer::Vertices;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::VisibilityMaps;

/// Errors of coded transfer per vertex of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CodedErrors {
    /// The squared error.
    pub squared_errors: Vec<f64>,
    /// Sum of squares of the raw matrix.
    pub squares: Vec<f64>,
}

/// Recomputes the raw matrices segment by segment. An empty segment has its raw matrix's sum of squares as its error.
/// Panics if the coded transfer belongs to other vertices or another reflectance.
pub fn coded_errors(
    (vertices, maps): (&Vertices, &VisibilityMaps),
    hats: BasisWidth,
    reflectance: &Reflectance,
    coded: &CodedTransfer,
    progress: &mut ProgressFn<'_>,
) -> Result<CodedErrors, InputError> {
    assert_eq!((coded.vertices, coded.rows), (vertices.len(), reflectance.terms()), "coded transfer of these vertices");
    let hats = LinearBasis::new(hats);
    let transfer = transfer_of(vertices, maps, &hats, reflectance);
    let none = vec![0.0; vertices.len()];
    let mut found = CodedErrors { squared_errors: none.clone(), squares: none };
    for segment in transfer.segments() {
        let segment = segment?;
        progress("segments", segment.segment as u64, 24);
        let squares = |point: usize| -> f64 {
            segment.signal.point(point).iter().map(|&value| f64::from(value) * f64::from(value)).sum()
        };
        let part =
            coded.segments.iter().find(|part| part.segment == segment.segment && part.vertices == segment.vertices);
        let errors = part.map(|part| part.squared_errors(&segment.signal));
        for (point, &vertex) in segment.vertices.iter().enumerate() {
            let squares = squares(point);
            found.squares[vertex as usize] += squares;
            found.squared_errors[vertex as usize] += errors.as_ref().map_or(squares, |errors| errors[point]);
        }
    }
    Ok(found)
}
