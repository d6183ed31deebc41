//! The programs that draw all-frequency transfer (section 6, "Per-Vertex Computation", last paragraph), beside those of
//! [`mod@crate::card::kernels`]: text written here, as the number of terms decides.

mod layout;
mod product;
mod vertex;

use refsim::isa::Version;

use crate::card::WrittenKernel;

pub use layout::{SetLayout, ViewNumbers};
pub use product::{MapFilter, ProductKernel};
pub use vertex::TransferredVertexKernel;

/// Programs for a few numbers of terms, by name.
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

#[cfg(test)]
mod tests {
    use super::*;
    use refsim::check::check;
    use refsim::device::Profile;

    fn device(name: &str) -> Profile {
        Profile::named(name).expect("a device")
    }

    #[test]
    fn every_program_runs_on_the_cards_of_ps_2_0() {
        for name in ["r300", "r350", "nv35", "gt200", "ideal-fp32"] {
            let profile = device(name);
            for (name, text) in programs() {
                crate::card::checked(&profile, name, &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
            }
        }
    }

    /// Slots of ps_2_0 on the Radeon 9800 for the paper's ten terms: texture reads, arithmetic.
    #[test]
    fn ten_terms_fit_one_pass_of_the_radeon() {
        let layout = SetLayout { terms: 10, channels: 3, view: ViewNumbers::Coordinates };
        let kernel = |filter| ProductKernel { layout, terms_per_texel: 4, filter, side: 32, is_partial: false };
        for (filter, reads, arithmetic) in [(MapFilter::Sampler, 3, 15), (MapFilter::Program, 12, 40)] {
            let program = kernel(filter).checked(&device("r350")).unwrap_or_else(|e| panic!("{e}"));
            let slots = program.facts().slots[0];
            assert_eq!((slots.texture, slots.arithmetic), (reads, arithmetic), "{filter}");
            assert_eq!(kernel(filter).reads() as u32, reads);
        }
        for version in [Version::Vs1_1, Version::Vs2_0] {
            let vertex = TransferredVertexKernel { layout, version };
            let program = vertex.checked(&device("r350")).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(program.facts().slots[0].arithmetic as usize, vertex.slots());
            assert_eq!(program.facts().inputs.count_ones() as usize, vertex.attributes());
        }
        let eleven = ProductKernel { layout: SetLayout { terms: 11, ..layout }, ..kernel(MapFilter::Sampler) };
        let report = check(refsim::asm::assemble(&eleven.text()).expect("a program"), &device("r350"));
        assert!(report.is_err(), "35 numbers need nine sets");
    }
}
