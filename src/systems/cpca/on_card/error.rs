//! Errors of drawing compressed transfer on a card.

use refsim::machine::MachineError;
use thiserror::Error;

use crate::card::{KernelError, MeshError};
use crate::cpca::coherence::CoherenceError;

/// Errors of drawing compressed transfer on a card. Clusters and vertices count from 0.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum PrtCardError {
    /// Numbers of vectors that differ, as the adaptive method leaves them.
    #[error(
        "cluster {cluster} has {found} vectors, expected at most {expected}: the programs have no loops that depend on \
         data, so clusters of adaptive size are evaluated on the host alone"
    )]
    Vectors { cluster: usize, found: usize, expected: usize },
    /// More weights than a vertex has attributes.
    #[error("expected at most {most} vectors, whose weights fit the attributes of a vertex, found {found}")]
    Weights { found: usize, most: usize },
    /// More coefficients of exit radiance than are interpolated.
    #[error("expected at most {most} functions of exit radiance, which fit 7 sets of coordinates, found {found}")]
    Functions { found: usize, most: usize },
    /// Clusters and mesh contradict each other, or a cluster exceeds the constant registers.
    #[error(transparent)]
    Coherence(#[from] CoherenceError),
    /// A number of values per point that makes no matrices from light to exit radiance.
    #[error(
        "expected {channels} x {rows} x n^2 numbers per vertex for light of an order n of 1 to 10, found {found}; \
         channels are 1 or 3"
    )]
    Shape { channels: usize, rows: usize, found: usize },
    /// A light of too low an order.
    #[error("expected light of order {expected} or more, found {found}")]
    LightOrder { expected: usize, found: usize },
    /// A size or a figure that does not fit, or a draw that the card refuses.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The device does not run a language, or refuses a program.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// The card refused a resource or a draw, or could not be opened.
    #[error(transparent)]
    Machine(#[from] MachineError),
}
