//! Visibility and form factors by rays, against closed forms.

use std::f64::consts::PI;

use approx::assert_abs_diff_eq;
use crossbar::renderer::form_factor::form_factor;
use crossbar::renderer::visibility::visibility;
use crossbar::scene::Scene;

use super::{Builder, FAR, host, white};

/// Two unit squares: the first in z = 0, the second parallel at height 1, fronts to each other. With a third between
/// them if requested.
fn parallel(between: bool) -> Scene {
    let mut builder = Builder::default();
    builder.quad([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], white(0.5));
    builder.quad([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], white(0.5));
    if between {
        builder.quad([-1.0, -1.0, 0.5], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0], white(0.5));
    }
    builder.scene()
}

fn factor(scene: &Scene, a: &[u32], b: &[u32]) -> (f64, f64) {
    let found = form_factor(scene, a, b, 20_000, 3, &mut host(scene)).expect("a factor");
    (found.value, found.variance.sqrt())
}

#[test]
fn parallel_squares() {
    // For sides x = y = 1 at distance 1 (Howell's catalogue, C-11).
    let root = 2.0_f64.sqrt();
    let whole = 0.5 * libm::log(4.0 / 3.0) + 2.0 * root * libm::atan(1.0 / root) - 2.0 * libm::atan(1.0);
    let expected = 2.0 / PI * whole;
    assert_abs_diff_eq!(expected, 0.1998, epsilon = 1e-4);
    let scene = parallel(false);
    for (a, b) in [([0, 1], [2, 3]), ([2, 3], [0, 1])] {
        let (value, spread) = factor(&scene, &a, &b);
        assert!((value - expected).abs() < FAR * spread && spread < 0.002, "{value} {expected} {spread}");
    }
    assert_eq!(factor(&parallel(true), &[0, 1], &[2, 3]).0, 0.0);
    assert_eq!(factor(&scene, &[0, 1], &[0, 1]).0, 0.0, "a plane does not see itself");
    assert_eq!(factor(&scene, &[], &[0, 1]).0, 0.0);
}

#[test]
fn a_box_sees_itself_whole() {
    // From one wall to the five others: nothing is lost.
    let mut builder = Builder::default();
    builder.boxed([0.0; 3], [1.0, 2.0, 1.5], true, &white(0.5));
    let scene = builder.scene();
    let others: Vec<u32> = (2..12).collect();
    let (value, spread) = factor(&scene, &[0, 1], &others);
    assert!((value - 1.0).abs() < FAR * spread, "{value} {spread}");
    // Reciprocity: A_a F(a, b) = A_b F(b, a); wall 0 has an area of 3, wall 4 of 1.5.
    let [(there, s), (back, t)] = [factor(&scene, &[0, 1], &[4, 5]), factor(&scene, &[4, 5], &[0, 1])];
    assert!((3.0 * there - 1.5 * back).abs() < FAR * (9.0 * s * s + 2.25 * t * t).sqrt(), "{there} {back}");
}

#[test]
fn points_see_each_other_or_not() {
    let scene = parallel(true);
    let pairs = [
        [[0.5, 0.5, 0.1], [0.5, 0.5, 0.9]],
        [[0.5, 0.5, 0.6], [0.5, 0.5, 0.9]],
        [[0.5, 0.5, 0.1], [5.0, 5.0, 0.9]],
        [[0.5, 0.5, 0.1], [0.5, 0.5, 0.1]],
        [[0.5, 0.5, 0.1], [0.5, 0.5, 0.5]],
    ];
    // The last ends on the square itself, which counts as seen: the open segment meets nothing.
    let seen = visibility(&pairs, &mut host(&scene)).expect("an answer");
    assert_eq!(seen, [false, true, true, true, true]);
}
