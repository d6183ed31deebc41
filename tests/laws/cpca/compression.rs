//! Tests compression against plain loops, closed forms, and properties of every step.

use crate::environment::by_form;
use crate::support::cluster_options;
use crossbar::clustering::{Compression, CpcaForm, CpcaMethod, CpcaOptions, CpcaStepKind, Signal, compress, paper};
use crossbar::linalg::{Matrix, SymmetricEigen};
use crossbar::transfer::synthetic::torus_signal;
use proptest::prelude::*;

/// Methods of compression, in order of decreasing error.
const METHODS: [CpcaMethod; 4] =
    [CpcaMethod::Static, CpcaMethod::Doubling, CpcaMethod::Iterative, CpcaMethod::Adaptive { rounds: 6 }];

const FORMS: [CpcaForm; 2] = [CpcaForm::Affine, CpcaForm::Linear];

fn options(clusters: usize, vectors: usize, method: CpcaMethod) -> CpcaOptions {
    CpcaOptions { method, ..cluster_options(clusters, vectors, 8, 3) }
}

fn compressed(signal: &Signal, options: &CpcaOptions) -> Compression {
    compress(signal, options, |_| ()).expect("compressed")
}

/// Sum of the squares of all numbers of a signal.
fn squares(signal: &Signal) -> f64 {
    signal.values().iter().map(|&value| f64::from(value) * f64::from(value)).sum()
}

/// The sum of squared distances of all points from their mean.
fn energy(signal: &Signal) -> f64 {
    let n = signal.dimension();
    let mean: Vec<f64> = (0..n)
        .map(|j| (0..signal.points()).map(|p| f64::from(signal.point(p)[j])).sum::<f64>() / signal.points() as f64)
        .collect();
    let square = |p: usize| -> f64 {
        signal.point(p).iter().zip(&mean).map(|(&x, m)| (f64::from(x) - m) * (f64::from(x) - m)).sum()
    };
    (0..signal.points()).map(square).sum()
}

/// Returns `true` if two errors are equal up to a negligible fraction of the energy.
fn near(a: f64, b: f64, energy: f64) -> bool {
    (a - b).abs() <= 1e-11 * energy
}

fn check_steps(signal: &Signal, form: CpcaForm, compression: &Compression) {
    let energy = if form == CpcaForm::Linear { squares(signal) } else { energy(signal) };
    for pair in compression.steps.windows(2) {
        let fixed = pair[0].vectors == pair[1].vectors && pair[1].kind != CpcaStepKind::Redistributed;
        let rises = pair[1].squared_error > pair[0].squared_error + 1e-11 * energy;
        assert!(!(fixed && rises), "{:?} after {:?}", pair[1], pair[0]);
    }
    let (last, direct) = (compression.steps.last().expect("steps"), compression.clustering.squared_error(signal));
    assert!(near(last.squared_error, direct, energy), "{last:?} but {direct} by the approximations");
}

/// By default one signal of each size, with `CROSSBAR_FULL=1` three.
#[test]
fn clusters_are_those_of_plain_loops() {
    for (points, dimension, clusters, vectors) in [(500, 4, 12, 2), (700, 9, 10, 4), (300, 25, 6, 3), (90, 40, 5, 6)] {
        for seed in 0..by_form(1, 3) {
            let signal = torus_signal(points, dimension, seed);
            for (method, form) in METHODS.into_iter().flat_map(|method| FORMS.map(|form| (method, form))) {
                let options = CpcaOptions { form, ..options(clusters, vectors, method) };
                let fast = compressed(&signal, &options);
                check_steps(&signal, form, &fast);
                let plain = paper::compress(&signal, &options).expect("compressed");
                let fast = fast.clustering;
                assert_eq!(
                    fast.of_point(),
                    plain.of_point(),
                    "{points} x {dimension}, {method:?}, {form:?}, seed {seed}"
                );
                assert_eq!(fast.form(), form);
                let energy = squares(&signal);
                assert!(near(fast.squared_error(&signal), plain.squared_error(&signal), energy));
                for (a, b) in fast.subspaces().iter().zip(plain.subspaces()) {
                    assert_eq!(a.len(), b.len());
                    assert!(a.mean.iter().zip(&b.mean).all(|(a, b)| (a - b).abs() < 1e-12));
                    assert!(a.eigenvalues.iter().zip(&b.eigenvalues).all(|(a, b)| near(*a, *b, energy)));
                }
            }
        }
    }
}

#[test]
fn ties_go_to_the_lower_cluster() {
    // The numbers are integers, so distances are exact. Point 2 is between the start points.
    let signal = Signal::new(1, vec![0.0, 4.0, 2.0, 0.0, 4.0]).expect("a signal");
    // These seeds draw the points 0 and 1, and 1 and 0.
    for (seed, of_point) in [(1, [0, 1, 0, 0, 1]), (52, [1, 0, 0, 1, 0])] {
        let options = CpcaOptions { vq_iterations: 1, iterations: 1, seed, ..options(2, 0, CpcaMethod::Static) };
        assert_eq!(compressed(&signal, &options).clustering.of_point(), of_point);
        assert_eq!(paper::compress(&signal, &options).expect("compressed").of_point(), of_point);
    }
}

#[test]
fn one_cluster_leaves_the_tail_of_its_eigenvalues() {
    for (points, dimension) in [(200, 12), (20, 30)] {
        let signal = torus_signal(points, dimension, 5);
        let mean: Vec<f64> = (0..dimension)
            .map(|j| (0..points).map(|p| f64::from(signal.point(p)[j])).sum::<f64>() / points as f64)
            .collect();
        let mut products = Matrix::zeros([dimension; 2]).expect("a matrix");
        for i in 0..dimension {
            for j in 0..dimension {
                let residual = |p: usize, j: usize| f64::from(signal.point(p)[j]) - mean[j];
                products.row_mut(i)[j] = (0..points).map(|p| residual(p, i) * residual(p, j)).sum();
            }
        }
        let eigenvalues = SymmetricEigen::new(&products).expect("eigenvalues").values;
        for vectors in 0..dimension {
            for method in METHODS {
                let clustering = compressed(&signal, &options(1, vectors, method)).clustering;
                let tail: f64 = eigenvalues[vectors..].iter().sum();
                let error = clustering.squared_error(&signal);
                assert!(near(error, tail, energy(&signal)), "{vectors} vectors: {error}, expected {tail}");
                for (a, b) in clustering.subspaces()[0].eigenvalues.iter().zip(&eigenvalues) {
                    assert!(near(*a, *b, energy(&signal)));
                }
            }
        }
    }
}

#[test]
fn each_method_leaves_less_error_than_the_one_before() {
    let signal = torus_signal(4000, 25, 2);
    let errors = METHODS.map(|method| compressed(&signal, &options(24, 4, method)).clustering.squared_error(&signal));
    assert!(errors[1] < 0.8 * errors[0] && errors[2] < errors[1] && errors[3] < 0.98 * errors[2], "{errors:?}");
}

#[test]
fn redistributed_vectors_stay_within_the_budget() {
    let signal = torus_signal(900, 16, 4);
    let even = compressed(&signal, &options(15, 3, CpcaMethod::Iterative)).clustering;
    let adaptive = compressed(&signal, &options(15, 3, CpcaMethod::Adaptive { rounds: 9 })).clustering;
    assert_eq!(even.all_weights().len(), 3 * 900);
    assert!(adaptive.all_weights().len() <= 3 * 900);
    let counts: Vec<usize> = adaptive.subspaces().iter().map(|subspace| subspace.len()).collect();
    assert!(counts.iter().any(|&count| count > 3) && counts.iter().any(|&count| count < 3), "{counts:?}");
    // The rest of the budget is too small for one more vector of any cluster.
    let left = 3 * 900 - adaptive.all_weights().len();
    for (cluster, subspace) in adaptive.subspaces().iter().enumerate() {
        let size = adaptive.of_point().iter().filter(|&&of| of as usize == cluster).count();
        assert!(size > left || subspace.len() == 16.min(size - 1), "cluster {cluster} of {size} points");
    }
}

#[test]
fn options_that_do_not_fit_are_refused() {
    let signal = torus_signal(10, 3, 0);
    let changes: [fn(&mut CpcaOptions); 5] = [
        |o| o.clusters = 0,
        |o| o.clusters = 11,
        |o| o.vectors = 4,
        |o| (o.vectors, o.form) = (0, CpcaForm::Linear),
        |o| o.iterations = 0,
    ];
    for change in changes {
        let mut options = options(4, 2, CpcaMethod::Static);
        change(&mut options);
        let error = compress(&signal, &options, |_| ()).expect_err("refused");
        assert_eq!(paper::compress(&signal, &options).expect_err("refused"), error);
    }
}

/// Small signals with many equal numbers: they cause duplicates, ties, clusters without points, and clusters of low
/// rank.
fn coarse_signal() -> impl Strategy<Value = Signal> {
    (1..=5usize, 1..=40usize).prop_flat_map(|(dimension, points)| {
        let scale = prop::sample::select(vec![1.0_f32, 1e-30, 2e37, 1e-3]);
        let offset = prop::sample::select(vec![0.0_f32, 1.0, 1000.0]);
        let values = prop::collection::vec(-3_i8..=3, points * dimension);
        (values, scale, offset).prop_map(move |(values, scale, offset)| {
            let values = values.into_iter().map(|value| scale * (offset * 0.01 + f32::from(value)));
            Signal::new(dimension, values.collect()).expect("a signal")
        })
    })
}

proptest! {
    #[test]
    fn any_signal_is_compressed((signal, clusters, vectors, method, form, seed) in coarse_signal().prop_flat_map(|signal| {
        let (points, dimension) = (signal.points(), signal.dimension());
        (Just(signal), 1..=points, 0..=dimension, prop::sample::select(METHODS.to_vec()), prop::sample::select(FORMS.to_vec()), 0..9_u64)
    })) {
        let form = if vectors == 0 { CpcaForm::Affine } else { form };
        let options = CpcaOptions { method, form, ..cluster_options(clusters, vectors, 5, seed) };
        let compression = compressed(&signal, &options);
        check_steps(&signal, form, &compression);
        let clustering = &compression.clustering;
        prop_assert!(clustering.all_weights().len() <= vectors * signal.points());
        // The vectors are orthonormal, which `new` checks, and their largest components are positive.
        let parts = (clustering.subspaces().to_vec(), clustering.of_point().to_vec(), clustering.all_weights().to_vec());
        let again = crossbar::clustering::Clustering::new(parts.0, parts.1, parts.2);
        prop_assert_eq!(again.as_ref(), Ok(clustering));
        for vector in clustering.subspaces().iter().flat_map(|subspace| subspace.vectors()) {
            let largest = vector.iter().copied().fold(0.0_f64, |a, b| if b.abs() > a.abs() { b } else { a });
            prop_assert!(largest > 0.0);
        }
    }
}
