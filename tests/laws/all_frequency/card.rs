//! All-frequency transfer on a card: the triangles that pixels show, the error of each precision against f64, and the
//! time of a frame.

use crate::support::{over_hills, profile, vertex_clocks};
use approx::assert_relative_eq;
use crossbar::all_frequency::Reflectance;
use crossbar::all_frequency::factor::{FactorSampling, Factorization, Lobe, Supersamples};
use crossbar::all_frequency::kernels::ViewNumbers;
use crossbar::all_frequency::on_card::reference::pixel_of_products;
use crossbar::all_frequency::on_card::time::{FactoredFrame, TABLE_1, host_of_table_1, streamed_bytes};
use crossbar::all_frequency::on_card::{FactoredCard, ProductOptions, ProductPlace, TransferredMesh, VertexColors};
use crossbar::all_frequency::shade::{Multiplies, TransferredRadiance};
use crossbar::card::frame_time::frame_time;
use crossbar::card::{MeshView, seen_pixels};
use crossbar::study::prt::{factored_precision, variants_table};
use crossbar::transfer::synthetic::{hills, signal_at};
use crossbar::transfer::{Tangents, Vertices};
use refsim::machine::{Executor, ExecutorKind};
use refsim::texture::TexelFormat;
use refsim::timing::host::HostOperation;
use refsim::timing::{Level, Model};

const SIZE: [u32; 2] = [48, 40];

struct Hills {
    vertices: Vertices,
    reflectance: Reflectance,
    transferred: TransferredRadiance,
}

impl Hills {
    fn new() -> Self {
        let sampling = FactorSampling { side: 16, supersamples: Supersamples::NONE, ..FactorSampling::default() };
        let table = sampling.table(&Lobe::cook_torrance(0.4, 0.5), &mut |_, _| ()).expect("a table");
        let reflectance = Reflectance::Factored(Factorization::new(&table, 10).expect("terms").factors(10));
        let vertices = Vertices::new(&hills(8), Tangents::Any).expect("vertices");
        let place = |at: usize| vertices.positions()[at].map(f64::from);
        let signal = signal_at(vertices.len(), 30, 5, place);
        let transferred = TransferredRadiance::new(10, signal.values().as_chunks().0.to_vec());
        Self { vertices, reflectance, transferred }
    }

    fn mesh(&self) -> TransferredMesh<'_> {
        let Self { vertices, reflectance, transferred } = self;
        TransferredMesh { vertices, reflectance, colors: &[[0.8, 0.7, 0.6]], transferred }
    }
}

/// The error quadruples for every two bits less; fp24 is nearer to f64 than fp16, 16 bits nearer than 8 on each card.
#[test]
fn what_is_coarser_is_farther_off() {
    let hills = Hills::new();
    let executor = Executor::from(ExecutorKind::Batch);
    let ways = factored_precision(&[hills.mesh()], &executor, over_hills(SIZE), 2.5, &mut |_| ()).expect("pictures");
    let seen = seen_pixels(&profile("r350"), hills.vertices.geometry(), &over_hills(SIZE)).expect("pixels");
    let brightest = seen.iter().flatten().flat_map(|seen| {
        let (view, eye) = (ViewNumbers::Coordinates, over_hills(SIZE).eye());
        pixel_of_products(&hills.mesh(), view, eye, seen.corners, seen.weights).map(|value| 2.5 * value)
    });
    let brightest = brightest.fold(0.0, f64::max);
    assert!((0.5..2.0).contains(&brightest), "{brightest}");
    let table = variants_table(&ways);
    assert_eq!(table.rows().len(), ways.len());
    let rms = |choice: &str| {
        let way = ways.iter().find(|way| way.choice == choice).unwrap_or_else(|| panic!("{choice}"));
        way.errors.off_255ths[0]
    };
    assert!(rms("fp32 throughout") < 1e-3);
    for [coarse, fine] in [["8", "10"], ["10", "12"], ["12", "14"], ["14", "16"]] {
        let ratio = rms(coarse) / rms(fine);
        assert!((2.5..6.0).contains(&ratio), "{coarse} against {fine} bits: {ratio}");
    }
    assert!(rms("fp32 throughout") < rms("ideal-fp24") && 16.0 * rms("ideal-fp24") < rms("ideal-fp16"));
    assert!(rms("r350: signed 16 bits, program") < rms("r350: signed 16 bits, sampler"));
    assert!(4.0 * rms("r350: signed 16 bits, sampler") < rms("r350: signed 8 bits, sampler"));
    assert!(rms("nv35: signed 16 bits, sampler, fp32") < rms("nv35: signed 16 bits, sampler, fp16"));
    let mut products = ways.iter().filter(|way| way.axis != "vertex colors");
    assert!(products.all(|way| way.below_zero > Some(0)), "truncated factors have negative lobes");
}

/// One rate of the host fits the paper's times for six models.
#[test]
fn the_host_is_that_of_table_1() {
    let bunny = TABLE_1[0].multiplies();
    assert_eq!([bunny.per_cluster / 100_000, bunny.per_vertex / 100_000], [937, 741]);
    // Printed frame rates without drawing: one rate of the host fits all six models within a factor of 2.
    let host = host_of_table_1().expect("a host");
    for model in TABLE_1 {
        let work = model.multiplies().per_cluster + model.multiplies().per_vertex;
        let rate = 1.0 / host.time_of(HostOperation::MultiplyAdd, work).seconds();
        let ratio = 10.0 * rate / model.frames_in_ten_seconds[1] as f64;
        assert!((0.5..2.0).contains(&ratio), "{}: {ratio}", model.name);
    }
}

/// The work of a frame follows from its sizes, and its time from that work: 30 floats per vertex cross the bus.
#[test]
fn a_frame_is_counted_and_timed() {
    let hills = Hills::new();
    let (vertices, triangles) = (hills.vertices.len() as u64, hills.vertices.triangles().len() as u64);
    let (r350, host) = (profile("r350"), host_of_table_1().expect("a host"));
    let steps = Multiplies { per_cluster: 300_000, per_vertex: 200_000 };
    let per_channel = ProductOptions { is_pass_per_channel: true, ..ProductOptions::default() };
    for (place, bytes, passes) in [
        (ProductPlace::Vertices(VertexColors::Bytes), 4, 1),
        (ProductPlace::Pixels(ProductOptions::default()), 120, 1),
        (ProductPlace::Pixels(per_channel), 120, 3),
    ] {
        assert_eq!(streamed_bytes(&place, 10), bytes);
        let mut card = FactoredCard::new(r350.clone(), ExecutorKind::Batch, &[hills.mesh()], place).expect("a card");
        let view = MeshView { camera: over_hills(SIZE), exposure: 0.5, format: TexelFormat::Bgra8 };
        let (texels, _, log) = card.logged_view(&view, steps).expect("a frame");
        assert!(texels.texels == card.view_texels(&view).expect("a frame").texels);
        let time = frame_time(&r350, &log, &host).expect("a time");
        let multiplied = host.time_of(HostOperation::MultiplyAdd, 500_000 + 30 * vertices);
        let sent = host.time_of(HostOperation::VertexSent, vertices);
        assert_eq!(time.products, multiplied + sent, "{place:?}");
        assert_eq!((time.calls, time.triangles), (passes, passes as u64 * triangles));
        let model = Model::new(Level::Pipeline, &r350).expect("a model");
        assert_eq!(time.uploads, model.upload(bytes as u64 * vertices));
        assert!(time.frame >= time.host && time.host >= time.products, "{time:?}");
        // Estimated from sizes alone, the host and the vertices take the same time; only the pixels' time is missing.
        let run_per_triangle = time.vertices_run as f64 / time.triangles as f64;
        let frame = FactoredFrame { vertices, triangles, terms: 10, host: steps, run_per_triangle };
        let estimate = frame_time(&r350, &frame.log(&place), &host).expect("a time");
        assert_eq!(
            (estimate.products, estimate.uploads, estimate.vertices_run),
            (time.products, time.uploads, time.vertices_run)
        );
        let [estimated, drawn] = [&frame.log(&place), &log].map(|log| vertex_clocks(&r350, log));
        assert_relative_eq!(estimated, drawn, max_relative = 0.02);
    }
}
