//! Gauss-Legendre rules on [0, 1]: n points integrate polynomials up to degree 2 n - 1 exactly.

use crate::elementary;

/// Point and weight; the weights of a rule sum to 1.
pub type GaussPoint = (f64, f64);

/// Rule with three points.
pub const THREE: [GaussPoint; 3] = rule(&[(0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0)]);

/// Rule with five points.
pub const FIVE: [GaussPoint; 5] = rule(&[
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 128.0 / 225.0),
]);

/// Rule with eight points.
pub const EIGHT: [GaussPoint; 8] = rule(&[
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
]);

/// Rule with sixteen points.
pub const SIXTEEN: [GaussPoint; 16] = rule(&[
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_096),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_894),
    (0.865_631_202_387_831_8, 0.095_158_511_682_492_79),
    (0.755_404_408_355_003, 0.124_628_971_255_533_88),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_74),
    (0.458_016_777_657_227_37, 0.169_156_519_395_002_54),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_58),
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
]);

/// Maximum number of points of a rule by [`gauss_legendre`].
pub const MAX_POINTS: usize = 1024;

/// Number of steps of Newton's method: started at the asymptotic roots, it is exact except for the last bits after
/// three steps; the other two steps are a reserve.
const NEWTON_STEPS: usize = 5;

/// Computes the rule with 1 to [`MAX_POINTS`] points on [0, 1], by Newton's method on the roots of the Legendre
/// polynomial. Panics if there are no points, or more than [`MAX_POINTS`].
pub fn gauss_legendre(points: usize) -> Vec<GaussPoint> {
    assert!((1..=MAX_POINTS).contains(&points), "1 to {MAX_POINTS} points");
    let polynomial = |x: f64| legendre_polynomials(x).nth(points).unwrap_or_default();
    // Roots come in pairs of opposite sign; this finds the negative root of each pair.
    let negative = |i: usize| {
        let turns = (i as f64 + 0.75) / (points as f64 + 0.5) / 2.0;
        let mut x = if 2 * i + 1 == points { 0.0 } else { -elementary::on_circle(turns)[0] };
        for _ in 0..NEWTON_STEPS {
            let [value, slope] = polynomial(x);
            x -= value / slope;
        }
        let [_, slope] = polynomial(x);
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    let mut rule = vec![(0.0, 0.0); points];
    for i in 0..points.div_ceil(2) {
        let (x, weight) = negative(i);
        rule[i] = (0.5 + 0.5 * x, 0.5 * weight);
        rule[points - 1 - i] = (0.5 - 0.5 * x, 0.5 * weight);
    }
    rule
}

/// Legendre polynomials of degree 0, 1, 2 and so on at x, each with its derivative.
pub fn legendre_polynomials(x: f64) -> impl Iterator<Item = [f64; 2]> {
    let ([mut now, mut next], [mut slope, mut next_slope]) = ([1.0, x], [0.0, 1.0]);
    (1_usize..).map(move |l| {
        let (found, odd) = ([now, slope], (2 * l + 1) as f64);
        [slope, next_slope] = [next_slope, slope + odd * next];
        [now, next] = [next, (odd * x * next - l as f64 * now) / (l + 1) as f64];
        found
    })
}

/// Sixteen points of an interval with weights that sum to its length.
pub fn integral_points(from: f64, to: f64) -> [GaussPoint; 16] {
    SIXTEEN.map(|(x, weight)| (from + (to - from) * x, (to - from) * weight))
}

/// Integral of a function from `from` to `to` by sixteen points.
pub fn integral(from: f64, to: f64, value: impl Fn(f64) -> f64) -> f64 {
    integral_points(from, to).iter().map(|&(x, weight)| weight * value(x)).sum()
}

/// Integral from 0 to `to` of a function that varies fast near 0, by sixteen points in each of `panels` intervals. The
/// first begins at 0; each is half as long as the next.
pub fn graded_integral(to: f64, panels: u32, value: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    let mut end = to;
    for _ in 1..panels {
        sum += integral(0.5 * end, end, &value);
        end *= 0.5;
    }
    sum + integral(0.0, end, &value)
}

/// A rule on [0, 1] from the non-negative half of a symmetric rule on [-1, 1], outermost point first.
const fn rule<const N: usize>(half: &[GaussPoint]) -> [GaussPoint; N] {
    let (mut nodes, mut i) = ([(0.0, 0.0); N], 0);
    while i < half.len() {
        let (x, weight) = half[i];
        nodes[i] = (0.5 - 0.5 * x, 0.5 * weight);
        nodes[N - 1 - i] = (0.5 + 0.5 * x, 0.5 * weight);
        i += 1;
    }
    nodes
}
