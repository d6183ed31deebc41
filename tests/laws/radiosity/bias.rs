//! Half precision darkens a room. Compares by how much, for numbers of patches, packings and roundings, with a
//! prediction from the rounding of the sum.

use crate::support::profile;
use approx::abs_diff_eq;
use crossbar::radiosity::bias::{Accumulator, predicted};
use crossbar::radiosity::on_card::{CardSolver, Fit, Storage};
use crossbar::radiosity::packing::Packing;
use crossbar::radiosity::solve::{Options, Solver};
use refsim::machine::ExecutorKind;

use super::cornell;

/// Darkening of the closed Cornell box in half floats: the mean relative error over patches that do not emit light;
/// returns the measured and the predicted value.
fn darkness(patches: usize, packing: Packing, rounding: &str) -> [f64; 2] {
    let system = cornell(patches);
    let truth = system.solve(Solver::Direct, &Default::default()).expect("a solution").radiosity();
    let mut nv35 = profile("nv35");
    nv35.set_switch("rounding", rounding).expect("a value of the switch");
    let format = nv35.rules.partial.expect("half floats");
    let block = Fit::of(&nv35, packing).expect("a fit").block;
    let accumulator = Accumulator::of(&format, packing, block).expect("a float");
    let expected = predicted(&system, &truth, accumulator).expect("a prediction");
    let mut card = CardSolver::new(nv35, ExecutorKind::Batch, &system, packing, Storage::Fp16).expect("a card");
    let options = Options { tolerance: 0.0, most_iterations: 60 };
    let found = card.solve(&system, &options, &mut |_| ()).expect("a solution").radiosity;
    let grey = |i: &usize| system.emittance()[*i] == [0.0; 3];
    let mean = |off: &dyn Fn(usize, usize) -> f64| {
        let all = (0..truth.len()).filter(grey).flat_map(|i| [0, 1, 2].map(|c| -off(i, c) / truth[i][c]));
        all.clone().sum::<f64>() / all.count() as f64
    };
    [mean(&|i, c| f64::from(found[i][c]) - truth[i][c]), mean(&|i, c| expected[i][c])]
}

const SIZES: [usize; 3] = [60, 120, 240];

/// The prediction is of first order in the loss. Losses also reduce the sums that cause them, so the prediction is too
/// large by about the square of the loss.
fn is_predicted([found, predicted]: [f64; 2]) -> bool {
    abs_diff_eq!(found, predicted, epsilon = 0.1 * predicted + 1.5 * predicted * predicted)
}

#[test]
fn the_room_is_darker_the_more_patches_and_darkest_where_sums_are_truncated() {
    let [nearest, truncated] =
        ["rne", "rtz"].map(|rounding| SIZES.map(|patches| darkness(patches, Packing::Rgb, rounding)));
    for all in [nearest, truncated] {
        assert!(all.iter().all(|&one| one[0] > 0.0 && is_predicted(one)), "{all:?}");
        assert!(all.windows(2).all(|two| two[1][0] > 1.1 * two[0][0]), "{all:?}");
    }
    for (patches, (nearest, truncated)) in SIZES.into_iter().zip(nearest.into_iter().zip(truncated)) {
        assert!(truncated[0] > 4.0 * nearest[0], "{patches}: {nearest:?}, {truncated:?}");
        // Each term loses half a step, which is 2^-10 to 2^-11 of the sum, and light is reflected about twice.
        let per_patch = truncated[0] / patches as f64;
        assert!((1.0 / 4096.0..1.0 / 1024.0).contains(&per_patch), "{per_patch} a patch");
    }
    // Four partial sums lose less than one.
    for (rounding, one) in [("rne", nearest[1][0]), ("rtz", truncated[1][0])] {
        let [four, _] = darkness(SIZES[1], Packing::Luminance, rounding);
        assert!(four.abs() < 0.6 * one, "{rounding}: {four} against {one}");
    }
}
