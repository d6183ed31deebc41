//! The host model: a single scale, calibrated with one figure.

use proptest::prelude::*;
use refsim::timing::Picoseconds;
use refsim::timing::host::{CPU_ONLY_RAYS_PER_SECOND, HostCounts, HostError, HostModel, HostOperation, HostWeights};

/// Artificial counts of a run without a card.
fn counts() -> HostCounts {
    HostCounts::default()
        .with(HostOperation::RayGenerated, 1000)
        .with(HostOperation::OctreeCell, 12_000)
        .with(HostOperation::RayTriangleTest, 9000)
        .with(HostOperation::Shade, 700)
}

#[test]
fn the_run_of_the_calibration_takes_its_printed_time() {
    let model = HostModel::calibrate(&counts(), 1000, CPU_ONLY_RAYS_PER_SECOND).expect("good counts");
    // 1000 / 135,812 s = 7,363,119,606.5... ps
    assert_eq!(model.time_of_all(&counts()), Picoseconds(7_363_119_607));
    // 40 + 300 + 450 + 70 units per ray are 860,000 in total.
    assert!((model.picoseconds_a_unit() - 8561.766).abs() < 1e-3, "{}", model.picoseconds_a_unit());
    assert_eq!(model.time_of(HostOperation::RayTriangleTest, 1), Picoseconds(428_089));
    assert_eq!(model.time_of(HostOperation::RayTriangleTest, 0), Picoseconds::ZERO);
}

#[test]
fn a_round_figure_by_hand() {
    // Ten tests of weight 50 in ten rays at 1000 rays per second: 10 ms for 500 units.
    let counts = HostCounts::default().with(HostOperation::RayTriangleTest, 10);
    let model = HostModel::calibrate(&counts, 10, 1000).expect("good counts");
    assert_eq!(model.time_of(HostOperation::RayTriangleTest, 1), Picoseconds(1_000_000_000));
    assert_eq!(model.time_of(HostOperation::OctreeCell, 1), Picoseconds(500_000_000));
    assert_eq!(model.time_of(HostOperation::OctreeCell, u64::MAX), Picoseconds(u64::MAX), "no wrapping");
}

#[test]
fn nothing_to_calibrate_on_is_an_error() {
    let none = HostCounts::default();
    assert!(HostModel::calibrate(&none, 1000, 1).is_err());
    assert!(HostModel::calibrate(&counts(), 0, 1).is_err());
    assert!(HostModel::calibrate(&counts(), 1, 0).is_err());
    let mut weightless = HostWeights::default();
    for row in weightless.rows() {
        *weightless.figure_mut(&row.key).expect("every row can be changed") = 0;
    }
    let nothing = HostError { weight: 0, rays: 1, rays_per_second: 1 };
    assert_eq!(HostModel::calibrate_with(weightless, &counts(), 1, 1), Err(nothing));
}

fn some_counts() -> impl Strategy<Value = HostCounts> {
    proptest::collection::vec(0..1_000_000_000_u64, HostOperation::ALL.len()).prop_map(|counts| {
        let mut all = HostCounts::default();
        for (operation, count) in HostOperation::ALL.iter().zip(counts) {
            all.add(*operation, count);
        }
        all
    })
}

proptest! {
    #[test]
    fn whatever_the_weights_the_calibrated_run_takes_its_time(
        counts in some_counts(), rays in 1..1_000_000_000_u64, rate in 1..1_000_000_000_u64, factor in 1..100_u64
    ) {
        let printed = Picoseconds(u64::try_from((u128::from(rays) * 1_000_000_000_000).div_ceil(rate.into())).unwrap_or(u64::MAX));
        let mut weights = HostWeights::default();
        *weights.figure_mut("host.octree-cell").expect("a key") *= factor;
        prop_assume!(counts != HostCounts::default());
        let model = HostModel::calibrate_with(weights, &counts, rays, rate).expect("good counts");
        prop_assert_eq!(model.time_of_all(&counts), printed);
    }

    #[test]
    fn more_work_takes_longer(a in some_counts(), b in some_counts()) {
        let model = HostModel::calibrate(&counts(), 1000, CPU_ONLY_RAYS_PER_SECOND).expect("good counts");
        let mut both = a;
        both += b;
        let (a, b, both) = (model.time_of_all(&a), model.time_of_all(&b), model.time_of_all(&both));
        // Each time is rounded up once.
        prop_assert!(both <= a + b && a + b <= both + Picoseconds(1));
    }
}
