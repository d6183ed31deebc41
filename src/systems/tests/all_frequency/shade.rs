//! Products of coded transfer and light.

use crossbar_systems::all_frequency::code::CodeOptions;
use crossbar_systems::all_frequency::shade::{Shader, plain};

use super::coded;

/// Light with zeros in it, for 5 segments.
fn light(coefficients: usize) -> Vec<[f32; 3]> {
    let one = |at: usize| [at % 3, at % 5, 0].map(|value| value as f32 - 1.5);
    (0..5 * coefficients).map(|at| if at % 4 == 1 { [0.0; 3] } else { one(at) }).collect()
}

#[test]
fn radiance_is_that_of_plain_loops() {
    for (rows, coefficients) in [(1, 16), (3, 4), (10, 4)] {
        let coded = coded(rows, coefficients, CodeOptions::default());
        let light = light(coefficients);
        let exact: Vec<[f64; 3]> = light.iter().map(|rgb| rgb.map(f64::from)).collect();
        let expected = plain::transferred(&coded, &exact).expect("radiance");
        let found = Shader::new(&coded).transferred(&light).expect("radiance");
        assert_eq!((found.rows(), found.vertices()), (rows, 40));
        let most = expected.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
        for (vertex, expected) in expected.chunks_exact(rows).enumerate() {
            for (found, expected) in found.of(vertex).iter().flatten().zip(expected.iter().flatten()) {
                // The rounding of f32.
                assert!((f64::from(*found) - expected).abs() < 1e-6 * most, "{vertex}: {found} for {expected}");
            }
        }
    }
}

#[test]
fn multiplications_by_zero_are_not_counted() {
    let coded = coded(10, 16, CodeOptions::default());
    let count = Shader::new(&coded).multiplies(&light(16));
    let (nonzeros, _) = coded.nonzeros();
    // A quarter of the light is black.
    assert!(count.per_cluster > 0 && count.per_cluster < 3 * nonzeros as u64);
    let weights: usize = coded.segments.iter().map(|part| part.weights.len()).sum();
    assert_eq!(count.per_vertex, 3 * 10 * weights as u64);
}

#[test]
fn bits_do_not_depend_on_threads() {
    let coded = coded(10, 16, CodeOptions::default());
    let shader = Shader::new(&coded);
    let radiance = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| shader.transferred(&light(16)).expect("radiance"))
    });
    assert!(radiance.iter().all(|other| *other == radiance[0]));
}

#[test]
fn light_for_fewer_segments_is_refused() {
    let coded = coded(1, 4, CodeOptions::default());
    let error = Shader::new(&coded).transferred(&light(4)[1..]).expect_err("refused");
    assert_eq!(error.to_string(), "expected at least 20 light coefficients, 4 per segment, found 19");
}
