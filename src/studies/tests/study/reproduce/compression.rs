//! Tools of entries about compression: interpolation of their curves, and errors by the number of vectors.

use crossbar_studies::study::reproduce::tested::{crossings, reaching};
use crossbar_systems::clustering::{CpcaForm, CpcaMethod, CpcaOptions, compress};
use crossbar_systems::transfer::synthetic::signal_at;

/// Halfway between storages 1 and 4 on a logarithmic scale, at 2, the first curve has the error 8.
#[test]
fn curves_are_compared_at_equal_storage() {
    let before = vec![(1.0, 16.0), (4.0, 4.0), (16.0, 1.0)];
    for (curve, expected) in [
        (vec![(2.0, 9.0), (8.0, 1.0), (32.0, 0.1)], [1, 1]),
        (vec![(2.0, 7.0), (8.0, 3.0)], [0, 0]),
        (vec![(2.0, 8.000_000_001), (8.0, 1.999_999_999)], [1, 1]),
        (vec![(2.0, 7.999_999_999), (8.0, 2.000_000_001)], [0, 0]),
        // The curves have no storage in common.
        (vec![(32.0, 0.1)], [0, 0]),
    ] {
        assert_eq!(crossings(&[before.clone(), curve.clone()]), expected, "{curve:?}");
    }
}

#[test]
fn vectors_are_interpolated_by_logarithms() {
    let curve = [16.0, 4.0, 1.0];
    assert_eq!([16.0, 4.0, 1.0, 0.5, 20.0].map(|error| reaching(&curve, error)), [0.0, 1.0, 2.0, 2.0, 0.0]);
    assert!((reaching(&curve, 2.0) - 1.5).abs() < 1e-12);
}

/// Two ways to compute errors agree with separate compressions for each number of vectors: section 4.1's formula, in
/// which a dropped vector adds its squared singular value, and the steps of one compression.
#[test]
fn errors_by_vectors_are_those_of_compressions() {
    let signal = signal_at(300, 12, 7, |at| [0.1 * at as f64, (at % 7) as f64, (at % 11) as f64]);
    let of = |vectors: usize, method| {
        let options = CpcaOptions {
            clusters: 5,
            vectors,
            vq_iterations: 20,
            iterations: 20,
            method,
            form: CpcaForm::Affine,
            seed: 1,
        };
        compress(&signal, &options, |_| ()).expect("compressed")
    };
    let near = |found: f64, expected: f64| (found - expected).abs() <= 1e-9 * expected.max(1.0);
    let most = of(4, CpcaMethod::Static).clustering;
    for vectors in 0..4 {
        let subspaces = most.subspaces().iter();
        let dropped: f64 = subspaces.flat_map(|subspace| subspace.eigenvalues.iter().skip(vectors)).sum();
        let error = of(vectors, CpcaMethod::Static).clustering.squared_error(&signal);
        assert!(near(most.squared_error(&signal) + dropped, error), "{vectors} vectors");
    }
    let steps = of(2, CpcaMethod::Iterative).steps;
    for vectors in 0..=2 {
        let last = steps.iter().rev().find(|step| step.vectors == vectors).expect("a step");
        let error = of(vectors, CpcaMethod::Iterative).clustering.squared_error(&signal);
        assert!(near(last.squared_error, error), "{vectors} vectors");
    }
}
