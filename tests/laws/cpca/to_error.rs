//! Compression that ends where an error is met: with the first number that does, and the result of that number.

use crossbar::transfer::Signal;
use crossbar::transfer::clustering::{
    Clustering, CpcaError, CpcaForm, CpcaMethod, CpcaOptions, Grown, StartPoints, compress, compress_to_error,
};
use crossbar::transfer::synthetic::torus_signal;

fn options(method: CpcaMethod) -> CpcaOptions {
    let (form, start) = (CpcaForm::Affine, StartPoints::Seed(4));
    CpcaOptions { clusters: 9, vectors: 4, vq_iterations: 4, iterations: 2, method, form, start }
}

/// The clustering, and its error as a share of the signal's squares.
fn compressed(signal: &Signal, options: &CpcaOptions) -> (Clustering, f64) {
    let clustering = compress(signal, options, |_| ()).expect("compressed").clustering;
    let share = clustering.squared_error(signal) / signal.sum_of_squares();
    (clustering, share)
}

#[test]
fn vectors_grow_until_an_error_is_met() {
    let signal = torus_signal(300, 8, 3);
    for method in [CpcaMethod::Static, CpcaMethod::Iterative, CpcaMethod::Doubling] {
        let tried = if method == CpcaMethod::Doubling { vec![0, 1, 2, 4] } else { (0..=4).collect() };
        let of = |vectors| compressed(&signal, &CpcaOptions { vectors, ..options(method) });
        let all: Vec<(Clustering, f64)> = tried.into_iter().map(of).collect();
        for aim in 0..all.len() {
            // Halfway between an error and the next larger one, so that rounding decides nothing.
            let larger = if aim == 0 { 0.999 } else { all[aim - 1].1 };
            let share = 0.5 * (all[aim].1 + larger);
            let first = all.iter().find(|(_, error)| *error <= share).expect("one that meets it");
            let options = CpcaOptions { vectors: 4, ..options(method) };
            let found = compress_to_error(&signal, &options, share, Grown::Vectors, |_| ()).expect("met");
            assert!(found.clustering == first.0, "{method:?} {share}");
        }
    }
}

#[test]
fn clusters_grow_until_an_error_is_met() {
    let signal = torus_signal(300, 8, 3);
    let most = CpcaOptions { vectors: 1, ..options(CpcaMethod::Iterative) };
    let of = |clusters| compressed(&signal, &CpcaOptions { clusters, ..most.clone() });
    for aim in [1, 2, 5, 9] {
        let share = 1.001 * of(aim).1;
        let found = compress_to_error(&signal, &most, share, Grown::Clusters, |_| ()).expect("met").clustering;
        let clusters = found.subspaces().len();
        assert!(clusters <= 9 && found == of(clusters).0, "{aim}: {clusters}");
        assert!(found.squared_error(&signal) <= share * signal.sum_of_squares(), "{aim}: {clusters}");
        assert!(clusters == 1 || of(clusters - 1).1 > share, "{aim}: {clusters}");
    }
}

#[test]
fn errors_that_are_not_met_are_refused() {
    let signal = torus_signal(60, 6, 1);
    let refused = |options: &CpcaOptions, share, grown| compress_to_error(&signal, options, share, grown, |_| ());
    let few = CpcaOptions { clusters: 3, vectors: 1, ..options(CpcaMethod::Iterative) };
    for grown in [Grown::Vectors, Grown::Clusters] {
        let found = refused(&few, 1e-9, grown);
        assert!(matches!(found, Err(CpcaError::NotMet { clusters: 3, vectors: 1, .. })), "{found:?}");
    }
    for share in [0.0, -0.1, 1.0, f64::NAN] {
        let found = refused(&few, share, Grown::Vectors);
        assert!(matches!(found, Err(CpcaError::ErrorShare { .. })), "{share}: {found:?}");
    }
    let adaptive = CpcaOptions { method: CpcaMethod::Adaptive { rounds: 2 }, ..few };
    assert_eq!(refused(&adaptive, 0.1, Grown::Vectors), Err(CpcaError::AdaptiveGoesOn));
}
