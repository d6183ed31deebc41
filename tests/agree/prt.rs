//! Draws compressed transfer with every kind of card on every executor. Other tests compare the sums of the vertex
//! programs with sums of the host.

use crossbar::clustering::{Clustering, CpcaForm, CpcaMethod, CpcaOptions, StartPoints, compress};
use crossbar::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions};
use crossbar::sphere::HarmonicLight;
use crossbar::transfer::brdf::ExitBasis;
use crossbar::transfer::synthetic::{hills, signal_at};
use crossbar::transfer::{Tangents, Vertices};
use refsim::texture::TexelFormat;

use crate::rules::profile;
use crate::system::pictures_agree;

/// Compressed transfer of a mesh of hills, with 4 light coefficients.
struct Hills {
    vertices: Vertices,
    clustering: Clustering,
    basis: ExitBasis,
    vectors: usize,
}

impl Hills {
    fn new(basis: ExitBasis, clusters: usize, vectors: usize) -> Self {
        let vertices = Vertices::new(&hills(6), Tangents::Any).expect("vertices");
        let place = |at: usize| vertices.positions()[at].map(f64::from);
        let signal = signal_at(vertices.len(), basis.len() * 4, 7, place);
        let (method, start) = (CpcaMethod::Iterative, StartPoints::Seed(2));
        let options =
            CpcaOptions { clusters, vectors, vq_iterations: 3, iterations: 3, method, form: CpcaForm::Affine, start };
        let clustering = compress(&signal, &options, |_| ()).expect("compressed").clustering;
        Self { vertices, clustering, basis, vectors }
    }
}

fn agrees(hills: &Hills, device: &str, format: TexelFormat, options: &PrtCardOptions) {
    let Hills { vertices, clustering, basis, vectors } = hills;
    let transfer =
        CompressedTransfer { vertices, clustering, basis, channels: 1, vectors: *vectors, superclusters: None };
    let light = HarmonicLight::red_and_blue(2);
    pictures_agree(
        &format!("{} functions, {vectors} vectors, {device}, {format:?}", basis.len()),
        format,
        |executor| PrtCard::new(profile(device), executor, transfer, options),
        |card, view| card.view_texels(&light, view),
    );
}

#[test]
fn diffuse_pictures_are_the_same_everywhere() {
    let options = PrtCardOptions::default();
    let hills = Hills::new(ExitBasis::Radiance, 5, 3);
    for (device, format) in [
        ("r300", TexelFormat::Bgra8),
        ("r350", TexelFormat::Rgba16),
        ("nv25", TexelFormat::Bgra8),
        ("r200", TexelFormat::Bgra8),
        ("gt200", TexelFormat::Rgba16f),
        ("ideal-fp32", TexelFormat::Rgba32f),
    ] {
        agrees(&hills, device, format, &options);
    }
    let apart = PrtCardOptions { superclusters: false, ..options };
    agrees(&hills, "r300", TexelFormat::Bgra8, &apart);
}

#[test]
fn glossy_pictures_are_the_same_everywhere() {
    let options = PrtCardOptions::default();
    for (basis, vectors) in [
        (ExitBasis::of_order(4), 6),
        (ExitBasis::without_1_0(5).expect("order 5"), 8),
        (ExitBasis::of_order(5), 2),
        (ExitBasis::of_order(2), 0),
    ] {
        let hills = Hills::new(basis, 4, vectors);
        agrees(&hills, "r300", TexelFormat::Bgra8, &options);
        agrees(&hills, "ideal-fp32", TexelFormat::Rgba32f, &PrtCardOptions { superclusters: false, ..options });
    }
    let hills = Hills::new(ExitBasis::of_order(3), 6, 4);
    agrees(&hills, "r350", TexelFormat::Rgba16, &PrtCardOptions { map_side: 16, ..options });
    let in_8_bits = PrtCardOptions { map_format: TexelFormat::Rgba8Snorm, ..options };
    agrees(&hills, "nv35", TexelFormat::Bgra8, &in_8_bits);
}
