//! Bi-scale transfer: light times biclusters on every executor.

use crossbar::bi_scale::bicluster::{BiclusterOptions, bicluster};
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::bi_scale::on_card::{GatherCard, LightFormat};
use crossbar::bi_scale::product::Gather;
use crossbar::geom::random::CounterRng;
use refsim::device::Profile;

use crate::system::executors;

#[test]
fn products_are_the_same_everywhere_and_the_hosts() {
    let random = CounterRng::new(4);
    let columns = 60;
    let mut matrix = SparseMatrix::new(columns, 2).expect("columns");
    for row in 0..150_u64 {
        let value = |column: u64| if random.unit(row / 4, column, 0) < 0.3 { 4 - (row * column % 3) as i32 } else { 0 };
        let entries = (0..columns as u32).map(|index| MatrixEntry { index, value: value(index.into()) });
        let entries: Vec<MatrixEntry> = entries.filter(|entry| entry.value != 0).collect();
        matrix.push_row(&entries).expect("a row");
    }
    let found = bicluster(&matrix, BiclusterOptions::default(), &mut |_| ()).expect("biclusters");
    let light: Vec<[f32; 3]> =
        (0..columns as u64).map(|k| [0, 1, 2].map(|channel| random.unit(k, channel, 1) as f32)).collect();
    let host: Vec<[u32; 3]> = Gather::new(&found).multiply(&light).iter().map(|rgb| rgb.map(f32::to_bits)).collect();
    for (device, format) in [
        ("gt200", LightFormat::Fp32),
        ("gt200", LightFormat::Bytes),
        ("ideal-fp32", LightFormat::Fp32),
        ("ideal-fp16", LightFormat::Fp16),
    ] {
        let mut reference = None;
        for (executor, how) in executors() {
            let what = format!("{device}, {format}, {executor}");
            let mut profile = Profile::named(device).expect("a device");
            // Sums that go on from pass to pass.
            profile.limits.instructions = Some(60);
            let mut card = GatherCard::new(profile, how, &found, format).unwrap_or_else(|e| panic!("{what}: {e}"));
            let local = card.multiply(&light).unwrap_or_else(|e| panic!("{what}: {e}"));
            let bits: Vec<[u32; 3]> = local.iter().map(|rgb| rgb.map(f32::to_bits)).collect();
            if format == LightFormat::Fp32 {
                assert!(bits == host, "{what}: differs from the host");
            }
            assert!(reference.get_or_insert_with(|| bits.clone()) == &bits, "{what}: differs from the scalar executor");
        }
    }
}
