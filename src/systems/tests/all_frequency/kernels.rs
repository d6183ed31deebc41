//! Layouts of interpolated numbers, and the programs that read them.

use std::collections::BTreeSet;

use crossbar_systems::all_frequency::kernels::{
    MapFilter, ProductKernel, SetLayout, TransferredVertexKernel, ViewNumbers, programs,
};
use refsim::check::check;
use refsim::isa::Version;

use crate::card::{WrittenKernel, checked};
use crate::device;

#[test]
fn every_number_has_a_place_of_its_own() {
    for (terms, channels, view) in
        [(10, 3, ViewNumbers::Coordinates), (9, 3, ViewNumbers::Vector), (7, 1, ViewNumbers::Vector)]
    {
        let layout = SetLayout { terms, channels, view };
        let of_view = (0..view.count()).map(|component| (layout.view_set(), component));
        let of_terms = (0..terms).flat_map(|term| (0..channels).map(move |channel| (term, channel)));
        let places: BTreeSet<_> = of_view.chain(of_terms.map(|(term, channel)| layout.place(term, channel))).collect();
        assert_eq!(places.len(), layout.numbers());
        assert!(places.iter().all(|&(set, component)| 4 * set + component < layout.numbers()));
    }
}

/// "30 numbers and the 2 coordinates fill eight sets"; a view vector would need one number more.
#[test]
fn ten_terms_of_three_channels_fill_eight_sets() {
    let layout = |view| SetLayout { terms: 10, channels: 3, view };
    assert_eq!(layout(ViewNumbers::Coordinates).numbers(), 32);
    assert_eq!(layout(ViewNumbers::Coordinates).sets(), 8);
    assert_eq!(layout(ViewNumbers::Vector).sets(), 9);
    assert_eq!(SetLayout { channels: 1, ..layout(ViewNumbers::Vector) }.sets(), 4);
}

#[test]
fn every_program_runs_on_the_cards_of_ps_2_0() {
    for name in ["r300", "r350", "nv35", "gt200", "ideal-fp32"] {
        let profile = device(name);
        for (name, text) in programs() {
            checked(&profile, name, &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
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
