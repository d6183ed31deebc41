//! The Haar transform is an orthonormal change of basis.

use crossbar::geom::random::CounterRng;
use crossbar::transfer::grid::Segmentation;
use crossbar::transfer::haar::Haar;
use crossbar::transfer::light::{CubeLight, HaarLight};

use super::close;

fn random(seed: u64, count: usize) -> Vec<f64> {
    let random = CounterRng::new(seed);
    (0..count as u64).map(|at| 2.0 * random.unit(at, 0, 0) - 1.0).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn lengths_and_products_stay_and_the_inverse_takes_back() {
    for side in [1, 2, 4, 8, 16, 32, 64] {
        let mut haar = Haar::new(side);
        for seed in 0..8 {
            let [a, b] = [seed, 100 + seed].map(|seed| random(seed, side * side));
            let [mut ha, mut hb] = [a.clone(), b.clone()];
            haar.forward(&mut ha);
            haar.forward(&mut hb);
            // Sums of side^2 products of at most 1: one rounding per addition, and the roundings of the transform.
            let bound = (side * side) as f64 * f64::EPSILON * (dot(&a, &a) + dot(&b, &b));
            close(dot(&ha, &ha), dot(&a, &a), bound, "Parseval");
            close(dot(&ha, &hb), dot(&a, &b), bound, "a product");
            haar.inverse(&mut ha);
            // A level adds four numbers: two roundings of values of at most 4, then halved; the inverse is bounded in
            // the same way.
            let bound = 8.0 * f64::EPSILON * f64::from(side.ilog2()) * side as f64;
            assert!(ha.iter().zip(&a).all(|(found, a)| (found - a).abs() <= bound), "side {side}, seed {seed}");
        }
    }
}

#[test]
fn a_constant_has_one_coefficient() {
    for side in [1, 2, 16, 32] {
        let mut square = vec![0.75; side * side];
        Haar::new(side).forward(&mut square);
        assert_eq!(square[0], 0.75 * side as f64);
        assert!(square[1..].iter().all(|value| *value == 0.0));
    }
    let light = CubeLight::constant([1.0, 2.0, 0.0]).expect("a light");
    for segmentation in [Segmentation::Quarters, Segmentation::Faces] {
        let haar = HaarLight::new(&light, segmentation);
        assert_eq!((haar.nonzero(), haar.energy()), (segmentation.count(), 5.0 * 6144.0));
        assert_eq!(haar.radiances(), light.texels());
    }
}
