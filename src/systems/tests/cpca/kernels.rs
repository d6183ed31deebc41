//! Vertex and pixel programs on the devices that support them.

use crossbar_systems::cpca::kernels::{VertexKernel, VertexShading, programs};
use refsim::isa::Version;

use crate::card::{WrittenKernel, checked};
use crate::device;

#[test]
fn every_program_runs_on_the_radeons() {
    for name in ["r300", "r350", "nv35", "gt200", "ideal-fp32"] {
        let profile = device(name);
        for (name, text) in programs() {
            checked(&profile, name, &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        }
    }
    for name in ["nv20", "nv25", "r200"] {
        let kernel = VertexKernel { shading: VertexShading::DiffuseColor, vectors: 8, version: Version::Vs1_1 };
        kernel.checked(&device(name)).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn slots_are_counted_as_the_device_counts_them() {
    for registers in 1..=7 {
        let shading = VertexShading::Glossy { registers };
        for version in [Version::Vs1_1, Version::Vs2_0] {
            let (slots, constants) = if version == Version::Vs1_1 { (128, 96) } else { (256, 256) };
            let kernel = |vectors| VertexKernel { shading, vectors, version };
            let fits = |&vectors: &usize| {
                let (kernel, needed) = (kernel(vectors), registers * (vectors + 1));
                kernel.slots() <= slots && kernel.first() + needed <= constants && vectors <= kernel.most_vectors()
            };
            let most = (0..64).filter(fits).max().expect("at least one");
            kernel(most).checked(&device("r300")).unwrap_or_else(|e| panic!("{e}"));
            let refused = kernel(most + 1).checked(&device("r300"));
            assert!(refused.is_err(), "{}: {most} vectors are not the most", kernel(most).name());
        }
    }
    // Pure principal components in Figure 10: 20 vectors of 24 functions.
    let kernel = |version| VertexKernel { shading: VertexShading::Glossy { registers: 6 }, vectors: 20, version };
    kernel(Version::Vs2_0).checked(&device("r300")).unwrap_or_else(|e| panic!("{e}"));
    assert!(kernel(Version::Vs1_1).checked(&device("r300")).is_err());
}
