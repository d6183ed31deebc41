//! Compressed transfer drawn on a card, compared with a picture that the host interpolates in f64.

use crate::support::{cluster_options, over_hills, profile, vertex_clocks};
use approx::assert_relative_eq;
use crossbar::card::MeshView;
use crossbar::card::frame_time::frame_time;
use crossbar::clustering::{Clustering, compress};
use crossbar::cpca::on_card::model::TransferSize;
use crossbar::cpca::on_card::time::{FrameCounts, host_of_section_7};
use crossbar::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions};
use crossbar::sphere::HarmonicLight;
use crossbar::transfer::brdf::ExitBasis;
use crossbar::transfer::synthetic::{hills, signal_at};
use crossbar::transfer::{Tangents, Vertices};
use refsim::event::Event;
use refsim::machine::ExecutorKind;
use refsim::texture::TexelFormat;
use refsim::timing::host::HostOperation;

const SIZE: [u32; 2] = [44, 36];

struct Hills {
    vertices: Vertices,
    clustering: Clustering,
    basis: ExitBasis,
    light: HarmonicLight,
}

impl Hills {
    fn new(basis: ExitBasis, clusters: usize, vectors: usize) -> Self {
        let vertices = Vertices::new(&hills(8), Tangents::Any).expect("vertices");
        let place = |at: usize| vertices.positions()[at].map(f64::from);
        let signal = signal_at(vertices.len(), basis.len() * 9, 3, place);
        let options = cluster_options(clusters, vectors, 5, 4);
        let clustering = compress(&signal, &options, |_| ()).expect("compressed").clustering;
        let light = HarmonicLight::red_and_blue(3);
        Self { vertices, clustering, basis, light }
    }

    fn transfer(&self, vectors: usize) -> CompressedTransfer<'_> {
        let Self { vertices, clustering, basis, .. } = self;
        CompressedTransfer { vertices, clustering, basis, channels: 1, vectors }
    }
}

/// The work of a frame follows from its sizes, and its time from that work.
#[test]
fn a_frame_is_counted_and_timed() {
    let host = host_of_section_7().expect("a host");
    let work = HostOperation::MultiplyAdd;
    let head = TransferSize { vertices: 50_060, rows: 25, columns: 25, clusters: 0, vectors: 0 };
    let uncompressed = host.time_of(work, head.multiply_adds(head.vertices) as u64).seconds();
    assert_relative_eq!(1.0 / uncompressed, 2.9, max_relative = 1e-9);
    let r300 = profile("r300");
    let frame = |vectors: usize| {
        let hills = Hills::new(ExitBasis::without_1_0(5).expect("order 5"), 9, vectors);
        let options = PrtCardOptions::default();
        let transfer = hills.transfer(vectors);
        let mut card = PrtCard::new(r300.clone(), ExecutorKind::Batch, transfer, &options).expect("a card");
        let view = MeshView { camera: over_hills(SIZE), exposure: 0.5, format: TexelFormat::Bgra8 };
        let (texels, log) = card.logged_view(&hills.light, &view).expect("a frame");
        assert!(texels.texels == card.view_texels(&hills.light, &view).expect("a frame").texels);
        let time = frame_time(&r300, &log, &host).expect("a time");
        let (size, groups) = (card.size(), card.superclusters().count());
        let triangles = hills.vertices.triangles();
        let drawn = card.superclusters().overdraw(&hills.clustering, triangles);
        assert_eq!(time.calls, 1 + 3 * groups);
        assert_eq!(time.triangles, triangles.len() as u64 + 3 * drawn);
        // Clusters of few vertices have fewer vectors, whose products cost nothing.
        let parts: usize = hills.clustering.subspaces().iter().map(|subspace| subspace.len() + 1).sum();
        assert_eq!(time.products, host.time_of(work, (3 * parts * hills.clustering.dimension()) as u64));
        let most = (3 * parts * 6 + 5 + 5) as u64;
        assert!((most / 2..=most).contains(&time.constants), "{} of {most} constants", time.constants);
        let vertices = hills.vertices.len() as u64;
        assert!((4 * vertices..=9 * drawn + 3 * triangles.len() as u64).contains(&time.vertices_run));
        assert!(time.frame >= time.host.max(time.draws) && time.host >= time.products, "{time:?}");
        assert!(time.frame <= time.host + time.draws + time.state + time.draws, "{time:?}");
        // Estimated from sizes alone, vertices and constants take the same time; only the pixels' time is missing.
        let draws = || log.iter().filter_map(|event| if let Event::Draw(draw) = event { Some(draw) } else { None });
        let of_groups = draws().skip(1).map(|draw| draw.vertices_run[1]).sum::<u64>();
        let counts = FrameCounts {
            size,
            triangles: triangles.len() as u64,
            drawn,
            groups: groups as u64,
            run_per_triangle: of_groups as f64 / (3 * drawn) as f64,
        };
        let estimate = frame_time(&r300, &counts.log(), &host).expect("a time");
        assert!(vectors > 2 || estimate.products == time.products, "clusters of full rank");
        assert_eq!(estimate.triangles, time.triangles);
        assert!(estimate.draws <= time.draws, "{estimate:?} {time:?}");
        let [estimated, drawn] = [&counts.log(), &log].map(|log| vertex_clocks(&r300, log));
        assert_relative_eq!(estimated, drawn, max_relative = 0.02);
        (time, parts < size.representatives())
    };
    let [(few, _), (many, is_low)] = [2, 8].map(frame);
    assert!(is_low && many.frame > few.frame, "{few:?} {many:?}");
}
