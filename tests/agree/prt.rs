//! Compressed transfer: pictures of every kind of card on every executor. That the vertex programs give the host's sums
//! is proved beside them.

use crossbar::card::MeshView;
use crossbar::clustering::{Clustering, CpcaForm, CpcaMethod, CpcaOptions, StartPoints, compress};
use crossbar::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions};
use crossbar::scene::Camera;
use crossbar::sphere::HarmonicLight;
use crossbar::transfer::brdf::ExitBasis;
use crossbar::transfer::synthetic::{hills, signal_at};
use crossbar::transfer::{Tangents, Vertices};
use refsim::device::Profile;
use refsim::texture::TexelFormat;

use crate::system::{bits, executors};

/// Compressed transfer of hills, 4 coefficients of light.
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

/// Pictures from above and at a grazing angle, where hills hide each other and map reads leave the rim.
fn agrees(hills: &Hills, device: &str, format: TexelFormat, options: &PrtCardOptions) {
    let Hills { vertices, clustering, basis, vectors } = hills;
    let transfer =
        CompressedTransfer { vertices, clustering, basis, channels: 1, vectors: *vectors, superclusters: None };
    let light = HarmonicLight::red_and_blue(2);
    let cameras = [[0.5, -1.4, 2.6], [2.2, -1.9, 0.45]]
        .map(|eye| Camera::new(eye, [0.0; 3], [0.0, 0.0, 1.0], 0.45, 29, 23).expect("a camera"));
    let mut reference = None;
    for (executor, how) in executors() {
        let what = format!("{} functions, {vectors} vectors, {device}, {format:?}, {executor}", basis.len());
        let profile = Profile::named(device).expect("a device");
        let mut card = PrtCard::new(profile, how, transfer, options).unwrap_or_else(|e| panic!("{what}: {e}"));
        let seen = cameras.map(|camera| {
            let view = MeshView { camera, exposure: 0.8, format };
            let picture = card.view_texels(&light, &view).unwrap_or_else(|e| panic!("{what}: {e}"));
            let lit = picture.texels.iter().filter(|texel| texel[..3].iter().any(|&value| value > 0.0)).count();
            assert!(lit > 20, "{what}: {lit} pixels with light");
            bits(&picture)
        });
        assert!(reference.get_or_insert_with(|| seen.clone()) == &seen, "{what}: differs from the scalar executor");
    }
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
