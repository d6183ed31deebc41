//! The end of an iteration on a card: a fixed point, a cycle, or the maximum number of iterations.

use crossbar::radiosity::on_card::{CardSolution, CardSolver, Cycle, Storage};
use crossbar::radiosity::packing::Packing;
use crossbar::radiosity::solve::Options;
use crossbar::radiosity::{FormFactors, System};

use super::{card, cornell, random_system};

/// Options with a tolerance of 0, which no iteration meets unless it reaches a fixed point.
const ENDLESS: Options = Options { tolerance: 0.0, most_iterations: 400 };

/// A random room of a few patches.
fn small(size: usize, seed: u64) -> System {
    let (matrix, right) = random_system(size, 0.9, seed);
    let mut factors = crossbar::linalg::Matrix::zeros([size; 2]).expect("small");
    for i in 0..size {
        let diagonal = matrix.row(i)[i];
        for j in (0..size).filter(|&j| j != i) {
            factors.row_mut(i)[j] = -matrix.row(i)[j] / diagonal;
        }
    }
    let factors = FormFactors::from_values(vec![1.0; size], factors).expect("factors");
    let emittance = right.iter().map(|&e| [e, 3.0 * e, 17.0 * e]).collect();
    System::new(factors, vec![[0.9, 0.7, 0.3]; size], emittance).expect("a system")
}

/// All states of a card, up to the first repetition; and the iteration at which the repeated state first occurred.
fn orbit(mut card: CardSolver) -> (Vec<Vec<[f32; 3]>>, usize) {
    let mut states = Vec::<Vec<[f32; 3]>>::new();
    loop {
        let here = card.read().expect("radiosities");
        if let Some(first) = states.iter().position(|earlier| bits(earlier) == bits(&here)) {
            return (states, first);
        }
        states.push(here);
        card.iterate().expect("an iteration");
    }
}

fn bits(state: &[[f32; 3]]) -> Vec<u32> {
    state.iter().flatten().map(|x| x.to_bits()).collect()
}

/// The cycle of an orbit, found by comparing all states with each other.
fn by_hand((states, entered): &(Vec<Vec<[f32; 3]>>, usize)) -> Cycle {
    let cycle = &states[*entered..];
    let (mut changing, mut largest_change) = (0, 0.0_f64);
    for (k, state) in cycle.iter().enumerate() {
        let next = &cycle[(k + 1) % cycle.len()];
        let pairs = || state.iter().flatten().zip(next.iter().flatten()).map(|(&a, &b)| (f64::from(a), f64::from(b)));
        changing = changing.max(pairs().filter(|(a, b)| a != b).count());
        let share = pairs().filter(|(a, b)| a != b).map(|(a, b)| (a - b).abs() / a.abs().max(b.abs()));
        largest_change = share.fold(largest_change, f64::max);
    }
    Cycle { entered: *entered as u32, period: cycle.len() as u32, changing, largest_change }
}

#[test]
fn cycles_and_fixed_points_are_found() {
    let mut periods = std::collections::BTreeMap::new();
    let small = (1..=6).flat_map(|size| (0..12).map(move |seed| small(size, 100 * size as u64 + seed)));
    let single = small.map(|system| (system, Packing::Rgb, Storage::Fp32));
    let half = [(Packing::Rgb, 40), (Packing::Luminance, 40), (Packing::Rgb, 90)];
    let half = half.map(|(packing, patches)| (cornell(patches), packing, Storage::Fp16));
    for (number, (system, packing, storage)) in single.chain(half).enumerate() {
        let expected = by_hand(&orbit(card(&system, packing, storage)));
        let found = card(&system, packing, storage).solve(&system, &ENDLESS, &mut |_| ()).expect("a solution");
        if found.converged {
            // At a fixed point the residual is exactly 0.
            assert_eq!(found.history.last().map(|last| last.1), Some([0.0; 3]));
            continue;
        }
        assert_eq!(found.cycle, Some(expected), "system {number}");
        assert_eq!(found.iterations(), expected.entered + expected.period, "the first state that comes back");
        assert_eq!(expected.is_fixed_point(), expected.changing == 0);
        *periods.entry((storage == Storage::Fp16, expected.period)).or_insert(0) += 1;
    }
    let longer = |is_half: bool| periods.keys().any(|&(of, period)| of == is_half && period > 1);
    assert!(longer(false) && longer(true) && periods.contains_key(&(false, 1)), "both kinds occur: {periods:?}");
}

#[test]
fn few_iterations_find_no_cycle() {
    let system = cornell(40);
    let solve = |options: Options| -> CardSolution {
        card(&system, Packing::Luminance, Storage::Fp16).solve(&system, &options, &mut |_| ()).expect("a solution")
    };
    let entered = solve(ENDLESS).cycle.expect("a cycle").entered;
    let few = solve(Options { most_iterations: entered, ..ENDLESS });
    assert_eq!((few.cycle, few.converged, few.iterations()), (None, false, entered));
}
