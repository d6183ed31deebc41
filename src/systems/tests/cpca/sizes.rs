//! Numbers that follow from sizes: overdraw, registers, batches, host work.

use crossbar_systems::cpca::coherence::overdraw;
use crossbar_systems::cpca::on_card::model::TransferSize;

#[test]
fn overdraw_counts_clusters_of_triangles() {
    let of_point = [0, 0, 1, 2];
    let triangles = [[0, 1, 1], [0, 1, 2], [2, 1, 0], [1, 2, 3], [3, 3, 3]];
    assert_eq!(overdraw(&triangles, &of_point), 1 + 2 + 2 + 3 + 1);
}

const fn size(vertices: usize, [rows, columns]: [usize; 2], clusters: usize, vectors: usize) -> TransferSize {
    TransferSize { vertices, rows, columns, clusters, vectors }
}

/// The sizes of Table 1, with raw and stored numbers in millions, registers per cluster, and clusters per 256 registers
/// and per number of registers that transform, eye and constants leave.
#[test]
fn table_1_follows_from_its_sizes() {
    let rows = [
        (size(49_990, [16, 25], 256, 6), [20.0, 1.017], 28, [9, 8]),
        (size(49_990, [24, 25], 256, 8), [30.0, 1.782], 54, [4, 4]),
        (size(49_990, [25, 25], 256, 8), [31.2, 1.840], 63, [4, 3]),
        (size(48_688, [24, 25], 256, 8), [29.2, 1.772], 54, [4, 4]),
        (size(48_688, [1, 100], 256, 8), [4.87, 0.620], 9, [28, 27]),
        (size(50_060, [16, 25], 256, 6), [20.0, 1.017], 28, [9, 8]),
        (size(58_624, [1, 100], 32, 4), [5.86, 0.250], 5, [51, 50]),
    ];
    for (size, millions, registers, fitting) in rows {
        let found = [size.multiply_adds(size.vertices) / 3, size.stored_numbers()].map(|numbers| numbers as f64 / 1e6);
        for ((found, printed), half_digit) in found.iter().zip(millions).zip([0.05, 0.0005]) {
            assert!((found - printed).abs() <= half_digit, "{size:?}: {found}, {printed}");
        }
        assert_eq!(size.registers_per_cluster(), registers, "{size:?}");
        assert_eq!([256, 250].map(|limit| size.clusters_per_batch(limit)), fitting, "{size:?}");
    }
}

/// Section 6.2 for the bird: 54 constants, 4 clusters per batch, 64 batches; and Figures 10 and 11.
#[test]
fn batches_and_host_work_of_the_bird() {
    let bird = |clusters, vectors| size(48_688, [24, 25], clusters, vectors);
    let batches = |size: TransferSize, registers| size.clusters.div_ceil(size.clusters_per_batch(registers));
    assert_eq!(batches(bird(256, 8), 256), 64);
    for (vectors, registers, clusters, expected) in [(2, 18, 13, 20), (4, 30, 8, 32), (12, 78, 3, 86)] {
        let bird = bird(256, vectors);
        let found = (bird.registers_per_cluster(), bird.clusters_per_batch(250), batches(bird, 250));
        assert_eq!(found, (registers, clusters, expected), "{vectors} vectors");
    }
    let quantised = bird(1792, 0);
    assert_eq!((quantised.registers_per_cluster(), batches(quantised, 250)), (6, 44));
    assert_eq!(bird(1, 20).registers_per_cluster(), 126);
    assert_eq!(bird(1, 20).clusters_per_batch(91), 0, "vs_1_1 has 96 constants");
    let bird = bird(256, 8);
    assert_eq!(bird.uploaded_registers(bird.representatives()), 41_472);
    assert_eq!([bird.representatives(), bird.vertices].map(|count| bird.multiply_adds(count)), [4_147_200, 87_638_400]);
}
