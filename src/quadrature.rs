//! Gauss-Legendre rules on [0, 1]: n points integrate polynomials up to degree 2 n - 1 exactly.

/// A point and its weight; weights sum to 1.
pub type GaussPoint = (f64, f64);

/// Three points.
pub const THREE: [GaussPoint; 3] =
    rule([(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)]);

/// Five points.
pub const FIVE: [GaussPoint; 5] = rule([
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
]);

/// Eight points.
pub const EIGHT: [GaussPoint; 8] = rule([
    (-0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
    (-0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (-0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (-0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
]);

/// A rule on [-1, 1] mapped to [0, 1].
const fn rule<const N: usize>(table: [GaussPoint; N]) -> [GaussPoint; N] {
    let mut nodes = table;
    let mut i = 0;
    while i < N {
        nodes[i] = (0.5 + 0.5 * table[i].0, 0.5 * table[i].1);
        i += 1;
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;

    #[test]
    fn powers_are_integrated_exactly_up_to_their_degree() {
        for rule in [&THREE[..], &FIVE, &EIGHT] {
            for power in 0..2 * rule.len() {
                let value = |x: f64| (0..power).fold(1.0, |product, _| product * x);
                let sum: f64 = rule.iter().map(|&(x, weight)| weight * value(x)).sum();
                let exact = 1.0 / (power + 1) as f64;
                assert!(abs_diff_eq!(sum, exact, epsilon = 4e-16), "{} points, degree {power}: {sum}", rule.len());
            }
        }
    }
}
