//! The programs that draw compressed transfer, beside those of [`mod@crate::card::kernels`]: text written here, as the
//! numbers of vectors and of functions decide.

mod exit;
mod vertex;

pub use exit::ExitKernel;
use refsim::isa::Version;

use crate::card::WrittenKernel;
pub use vertex::{VertexKernel, VertexShading};

/// Programs for a few numbers of vectors and functions, by name.
pub fn programs() -> Vec<(String, String)> {
    let mut all = Vec::new();
    let shadings = [1, 4, 6, 7].map(|registers| VertexShading::Glossy { registers });
    for shading in [VertexShading::Diffuse, VertexShading::DiffuseColor].into_iter().chain(shadings) {
        for (vectors, version) in [(0, Version::Vs1_1), (5, Version::Vs1_1), (8, Version::Vs2_0), (20, Version::Vs2_0)]
        {
            let kernel = VertexKernel { shading, vectors, version };
            all.push(kernel.listed());
        }
    }
    all.extend([1, 4, 6, 7].map(|registers| ExitKernel { registers }.listed()));
    all
}
