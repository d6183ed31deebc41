//! Results for ranges of vertices, and their concatenation.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::cpca::transfer::RayAnswers;
use crate::split::Concatenate;
use crate::transfer::visibility::VisibilityMaps;

impl Concatenate for VisibilityMaps {
    fn are_of(&self, range: &Range<usize>) -> bool {
        self.are_of(range)
    }

    fn append(&mut self, next: Self) {
        self.append(next);
    }
}

/// Ray hits for the vertices of a range, and their matrices of direct light.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct VertexTransfer {
    pub(super) answers: RayAnswers,
    /// Per channel: matrices of the vertices, and matrices of the light that enters below the surface, if any.
    pub(super) channels: Vec<(Vec<f32>, Vec<f32>)>,
}

impl Concatenate for VertexTransfer {
    fn are_of(&self, range: &Range<usize>) -> bool {
        self.answers.range() == *range
    }

    fn append(&mut self, next: Self) {
        self.answers.append(next.answers);
        for ((direct, entering), more) in self.channels.iter_mut().zip(next.channels) {
            direct.extend(more.0);
            entering.extend(more.1);
        }
    }
}
