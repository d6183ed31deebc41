//! Compression of signals: fixed bits, independence of threads and vector instructions, and errors.

use crossbar_systems::clustering::{
    AffineSubspace, Clustering, CpcaForm, CpcaMethod, CpcaOptions, Signal, compress, compress_at, paper,
};
use crossbar_systems::transfer::synthetic::torus_signal;
use refsim::exec::batch::SimdLevel;

use crate::geom::random::CounterRng;

#[test]
fn bits_do_not_depend_on_threads_or_vector_instructions() {
    for (points, dimension, clusters) in [(700, 30, 9), (2500, 7, 20), (1200, 150, 1)] {
        let signal = torus_signal(points, dimension, 6);
        let method = CpcaMethod::Adaptive { rounds: 3 };
        let options = CpcaOptions {
            clusters,
            vectors: 3,
            vq_iterations: 4,
            iterations: 4,
            method,
            form: CpcaForm::Affine,
            seed: 2,
        };
        let widest = compress(&signal, &options, |_| ()).expect("compressed");
        for level in SimdLevel::available() {
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
                let again = pool.install(|| compress_at(level, &signal, &options, |_| ())).expect("compressed");
                assert_eq!(again, widest, "{} with {threads} threads", level.name());
            }
        }
    }
}

/// Random signals, some with repeated points, of low rank, or 0.
fn drawn(seed: u64, points: usize, dimension: usize) -> Signal {
    let random = CounterRng::new(seed);
    let draw = |what: u64, range: u64| random.bits(what, 0, 0) % range;
    let waves = torus_signal(points, 1 + draw(2, 40) as usize, seed);
    let mix = |i: u64, j: u64| (random.unit(i, 1, j) - 0.5) * if draw(3, 2) == 0 { 1.0 } else { 1e-3 };
    let noise = [0.0, 1e-5, 0.1][draw(4, 3) as usize];
    let (scale, offset) = [(1.0, 0.0), (1.0, 1e4), (1e-38, 3.0), (1e33, 100.0)][draw(10, 4) as usize];
    let value = |point: usize, j: usize| {
        let point = if draw(5, 3) == 0 { point / 2 } else { point };
        let wave = waves.point(point).iter().enumerate();
        let sum: f64 = wave.map(|(i, &value)| f64::from(value) * mix(i as u64, j as u64)).sum();
        let dark = draw(6, 3) == 0 && point.is_multiple_of(5);
        let noisy = (sum + noise * (random.unit(point as u64, 2, j as u64) - 0.5)) as f32;
        if dark { 0.0 } else { scale * (noisy + offset) }
    };
    let values = (0..points * dimension).map(|at| value(at / dimension, at % dimension)).collect();
    Signal::new(dimension, values).expect("a signal")
}

/// Dimensions that are 0 at all points change no bit of a sum. With them, points are first compared along principal
/// axes; without them, every point is compared with every cluster. If the clusters are equal, no bound has excluded the
/// best one. Clusters have fewer points than dimensions, so that equal matrices are decomposed.
#[test]
fn bounds_along_axes_exclude_no_best_cluster() {
    for seed in 0..120 {
        let random = CounterRng::new(1000 + seed);
        let draw = |what: u64, range: u64| random.bits(what, 0, 0) % range;
        let (points, dimension) = (30 + draw(0, 90) as usize, 120 + draw(1, 8) as usize);
        let signal = drawn(seed, points, dimension);
        let padded = |more: usize| {
            let row = |p: usize| signal.point(p).iter().copied().chain(std::iter::repeat_n(0.0, more));
            Signal::new(dimension + more, (0..points).flat_map(row).collect()).expect("a signal")
        };
        let form = [CpcaForm::Affine, CpcaForm::Linear][draw(7, 2) as usize];
        let methods = [CpcaMethod::Doubling, CpcaMethod::Iterative, CpcaMethod::Adaptive { rounds: 2 }];
        let options = CpcaOptions {
            clusters: 1 + draw(8, 20) as usize,
            vectors: 1 + draw(9, 5) as usize,
            vq_iterations: 3,
            iterations: 3,
            method: methods[draw(11, 3) as usize],
            form,
            seed,
        };
        let plain = compress(&signal, &options, |_| ()).expect("compressed");
        for more in [8, 280] {
            let wide = compress(&padded(more), &options, |_| ()).expect("compressed");
            assert_eq!(wide.steps, plain.steps, "seed {seed}, {more} more");
            let [wide, plain] = [&wide, &plain].map(|of| &of.clustering);
            assert_eq!((wide.of_point(), wide.all_weights()), (plain.of_point(), plain.all_weights()), "seed {seed}");
        }
    }
}

/// The subspace of a cluster has the same bits for any earlier clustering: cached inner products equal new ones.
#[test]
fn the_way_to_a_partition_leaves_no_trace() {
    let signal = torus_signal(90, 100, 2);
    let mut found: Vec<(Vec<u32>, Vec<AffineSubspace>, Vec<usize>)> = Vec::new();
    let mut repeated = 0;
    for seed in 0..60 {
        let (method, form) = (CpcaMethod::Doubling, CpcaForm::Linear);
        let options = CpcaOptions { clusters: 2, vectors: 4, vq_iterations: 9, iterations: 9, method, form, seed };
        let compression = compress(&signal, &options, |_| ()).expect("compressed");
        let moved = compression.steps.iter().map(|step| step.moved).collect();
        let (mut of_point, mut subspaces) =
            (compression.clustering.of_point().to_vec(), compression.clustering.subspaces().to_vec());
        if of_point[0] == 1 {
            of_point.iter_mut().for_each(|of| *of = 1 - *of);
            subspaces.reverse();
        }
        for (_, expected, _) in found.iter().filter(|(other, _, way)| *other == of_point && *way != moved) {
            assert_eq!(*expected, subspaces, "seed {seed}");
            repeated += 1;
        }
        found.push((of_point, subspaces, moved));
    }
    assert!(repeated > 0, "no partition was found in two ways");
}

/// Section 4.3 on eight points (+-3, +-2, +-1) and four (+-5, +-1/2): vectors beyond the budget are skipped, so two
/// vectors in each cluster leave an error of 8. Stopping at the first vector that does not fit would leave 9.
#[test]
fn what_exceeds_the_budget_is_passed_over() {
    let signs = |bits: u32, at: u32| if bits >> at & 1 == 0 { 1.0 } else { -1.0 };
    let eight = (0..8).flat_map(|p| [3.0 * signs(p, 0), 2.0 * signs(p, 1), signs(p, 2), 0.0, 0.0, 0.0]);
    let four = (0..4).flat_map(|p| [1000.0, 0.0, 0.0, 5.0 * signs(p, 0), 0.5 * signs(p, 1), 0.0]);
    let signal = Signal::new(6, eight.chain(four).collect()).expect("a signal");
    let options = CpcaOptions {
        clusters: 2,
        vectors: 2,
        vq_iterations: 3,
        iterations: 3,
        method: CpcaMethod::Adaptive { rounds: 2 },
        form: CpcaForm::Affine,
        // Draws the points 0 and 8.
        seed: 4,
    };
    let found = compress(&signal, &options, |_| ()).expect("compressed").clustering;
    assert_eq!(found.subspaces().iter().map(AffineSubspace::len).collect::<Vec<_>>(), [2, 2]);
    assert!((found.squared_error(&signal) - 8.0).abs() < 1e-9);
    assert_eq!(found.of_point(), paper::compress(&signal, &options).expect("compressed").of_point());
}

/// Each empty cluster, lowest first, gets the point with the largest error (on ties, the lowest), but not a cluster's
/// last point.
#[test]
fn empty_clusters_take_the_worst_points_but_no_last_ones() {
    // Points 0, 1 and 2 are equal, so clusters 1 and 2 are empty at first.
    let signal = Signal::new(1, vec![0.0, 0.0, 0.0, 5.0, 5.0, -3.0, 90.0]).expect("a signal");
    let options = CpcaOptions {
        clusters: 4,
        vectors: 0,
        vq_iterations: 1,
        iterations: 1,
        method: CpcaMethod::Static,
        form: CpcaForm::Affine,
        // Draws the points 0, 1, 2 and 6.
        seed: 1585,
    };
    let found = compress(&signal, &options, |_| ()).expect("compressed").clustering;
    assert_eq!(found.of_point(), [0, 0, 0, 1, 2, 0, 3]);
    assert_eq!(found.of_point(), paper::compress(&signal, &options).expect("compressed").of_point());
    let same = Signal::new(1, vec![4.0; 3]).expect("a signal");
    let options = CpcaOptions { clusters: 3, seed: 11, ..options };
    let found = compress(&same, &options, |_| ()).expect("compressed").clustering;
    assert_eq!(found.of_point(), [0; 3], "points without error stay");
}

fn subspace() -> AffineSubspace {
    AffineSubspace { mean: vec![1.0, 2.0], vectors: vec![0.6, 0.8], eigenvalues: vec![3.0] }
}

#[test]
fn an_approximation_is_the_mean_and_weighted_vectors() {
    let alone = AffineSubspace { mean: vec![-1.0, 0.0], vectors: vec![], eigenvalues: vec![] };
    let clustering = Clustering::new(vec![subspace(), alone], vec![1, 0], vec![10.0]).expect("a clustering");
    let mut point = [0.0; 2];
    clustering.approximation(1, &mut point);
    assert_eq!((point, clustering.weights(0), clustering.weights(1)), ([7.0, 10.0], &[][..], &[10.0][..]));
    let signal = Signal::new(2, vec![-1.0, 2.0, 7.0, 9.0]).expect("a signal");
    assert_eq!(clustering.squared_error(&signal), 4.0 + 1.0);
    assert_eq!(clustering.stored_numbers(), 1 + 2 + 2 + 2);
}

#[test]
fn parts_that_do_not_go_together_are_refused() {
    let new = |change: &dyn Fn(&mut AffineSubspace), of_point, weights| {
        let mut subspace = subspace();
        change(&mut subspace);
        Clustering::new(vec![subspace], of_point, weights).expect_err("refused")
    };
    let same = |_: &mut AffineSubspace| ();
    assert_eq!(
        new(&same, vec![], vec![]).to_string(),
        "expected clusters and points, found 1 clusters and 0 points of 2 numbers"
    );
    assert_eq!(new(&same, vec![1], vec![1.0]).to_string(), "expected a cluster below 1 for point 0, found 1");
    assert_eq!(new(&same, vec![0], vec![]).to_string(), "expected 1 weights, found 0");
    assert_eq!(
        new(&same, vec![0], vec![f64::NAN]).to_string(),
        "expected finite numbers, found other numbers in weight 0"
    );
    let broken = |change: &dyn Fn(&mut AffineSubspace)| new(change, vec![0], vec![1.0]).to_string();
    assert_eq!(
        broken(&|s| s.vectors.push(0.0)),
        "expected a mean of 2 numbers and as many per eigenvalue in cluster 0, found other counts"
    );
    assert_eq!(broken(&|s| s.vectors[0] = 0.7), "expected orthonormal vectors in cluster 0, found other vectors");
    assert_eq!(
        broken(&|s| s.eigenvalues[0] = -1.0),
        "expected eigenvalues of at least 0 in decreasing order in cluster 0, found other eigenvalues"
    );
    assert_eq!(broken(&|s| s.mean[0] = f64::INFINITY), "expected finite numbers, found other numbers in cluster 0");
}

#[test]
fn only_whole_finite_points_are_a_signal() {
    let signal = Signal::new(2, vec![1.0, 2.0, 3.0, 4.0]).expect("a signal");
    assert_eq!((signal.points(), signal.dimension(), signal.point(1)), (2, 2, &[3.0, 4.0][..]));
    assert_eq!(signal.sum(|point| f64::from(signal.point(point)[0])), 4.0);
    assert_eq!(
        Signal::new(2, vec![]).unwrap_err().to_string(),
        "expected at least one point of at least one number, found 0 values at 2 per point"
    );
    assert_eq!(
        Signal::new(0, vec![1.0]).unwrap_err().to_string(),
        "expected at least one point of at least one number, found 1 values at 0 per point"
    );
    assert_eq!(Signal::new(2, vec![1.0; 3]).unwrap_err().to_string(), "expected a multiple of 2 values, found 3");
    let message = Signal::new(2, vec![1.0, 1.0, 1.0, f32::NEG_INFINITY]).unwrap_err().to_string();
    assert_eq!(message, "expected finite numbers, found -inf in component 1 of point 1 (counted from 0)");
}
