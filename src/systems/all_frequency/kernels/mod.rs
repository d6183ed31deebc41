//! The programs that draw all-frequency transfer (section 6, "Per-Vertex Computation", last paragraph). Their text is
//! generated from the number of terms; [`mod@crate::card::kernels`] has the others.

mod layout;
mod product;
mod vertex;

use refsim::isa::Version;

use crate::card::WrittenKernel;

pub use layout::{SetLayout, ViewNumbers};
pub use product::{MapFilter, ProductKernel};
pub use vertex::TransferredVertexKernel;

/// Programs for some numbers of terms, with their names.
pub fn programs() -> Vec<(String, String)> {
    let mut all = Vec::new();
    let (two, three) = (ViewNumbers::Coordinates, ViewNumbers::Vector);
    for (terms, channels, view) in
        [(10, 3, two), (4, 3, two), (3, 3, two), (9, 3, three), (10, 1, three), (7, 1, two), (1, 1, three)]
    {
        let layout = SetLayout { terms, channels, view };
        for version in [Version::Vs2_0, Version::Vs1_1] {
            all.push(TransferredVertexKernel { layout, version }.listed());
        }
        for (terms_per_texel, filter, side) in
            [(4, MapFilter::Sampler, 32), (2, MapFilter::Sampler, 32), (4, MapFilter::Program, 32)]
        {
            for is_partial in [false, true] {
                let kernel = ProductKernel { layout, terms_per_texel, filter, side, is_partial };
                all.push(kernel.listed());
            }
        }
    }
    all
}
