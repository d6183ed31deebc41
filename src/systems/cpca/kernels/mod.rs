//! The programs that draw compressed transfer. Their text is generated from the numbers of vectors and functions;
//! [`mod@crate::card::kernels`] has the others.

mod exit;
mod vertex;

pub use exit::ExitKernel;
use refsim::isa::Version;

use crate::card::WrittenKernel;
pub use vertex::{VertexKernel, VertexShading};

/// Programs for some numbers of vectors and functions, with their names.
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
