//! The end of an iteration on a card: a fixed point, a cycle, or the maximum number of iterations.

use crate::support::profile;
use crossbar::radiosity::card_order::CardSystem;
use crossbar::radiosity::on_card::{CardOptions, CardSolution, CardSolver, Cycle, Storage};
use crossbar::radiosity::packing::{self, Packing};
use crossbar::radiosity::{FormFactors, System};
use refsim::machine::ExecutorKind;

use super::{cornell, random_system};

/// Options with a tolerance of 0, which no iteration meets unless it reaches a fixed point.
const ENDLESS: CardOptions = CardOptions { tolerance: 0.0, most_iterations: 400, check_every: 1 };

fn card(system: &System, packing: Packing, storage: Storage) -> CardSolver {
    CardSolver::new(profile("nv35"), ExecutorKind::Batch, system, packing, storage).expect("a card")
}

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

/// All states of the host's loop, in the order of the card's passes, up to the first repetition; and the iteration at
/// which the repeated state first occurred.
fn orbit(system: &System) -> (Vec<Vec<[f32; 3]>>, usize) {
    let host = CardSystem::rgb(system, 254, 4096).expect("it fits");
    let (mut state, mut states) = (host.zero(), Vec::<Vec<[f32; 3]>>::new());
    loop {
        let here = packing::from_rgb_vector(&state);
        if let Some(first) = states.iter().position(|earlier| bits(earlier) == bits(&here)) {
            return (states, first);
        }
        states.push(here);
        state = host.step(&state);
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
fn cycles_and_fixed_points_are_those_of_the_hosts_loop() {
    let mut periods = std::collections::BTreeMap::new();
    for size in 1..=6 {
        for seed in 0..12 {
            let system = small(size, 100 * size as u64 + seed);
            let expected = by_hand(&orbit(&system));
            let found = card(&system, Packing::Rgb, Storage::Fp32).solve(&system, &ENDLESS, &mut |_| ());
            let found = found.expect("a solution");
            if found.converged {
                // At a fixed point the residual is exactly 0.
                assert_eq!(found.history.last().map(|last| last.1), Some([0.0; 3]));
                continue;
            }
            assert_eq!(found.cycle, Some(expected), "{size} patches, seed {seed}");
            assert_eq!(found.iterations(), expected.entered + expected.period, "the first state that comes back");
            assert_eq!(expected.is_fixed_point(), expected.changing == 0);
            *periods.entry(expected.period).or_insert(0) += 1;
        }
    }
    assert!(periods[&1] > 0 && periods.keys().any(|&period| period > 1), "both kinds occur: {periods:?}");
}

/// For half floats the host's loop is not a reference, so the card's own states are compared with each other.
#[test]
fn half_floats_go_round_too() {
    let mut longest = 0;
    for (packing, patches) in [(Packing::Rgb, 40), (Packing::Luminance, 40), (Packing::Rgb, 90)] {
        let system = cornell(patches);
        let solution = card(&system, packing, Storage::Fp16).solve(&system, &ENDLESS, &mut |_| ()).expect("a solution");
        let Some(cycle) = solution.cycle else { panic!("{packing:?}, {patches} patches: {}", solution.iterations()) };
        let mut other = card(&system, packing, Storage::Fp16);
        let mut states = vec![other.read().expect("zeros")];
        for _ in 0..solution.iterations() {
            other.iterate().expect("an iteration");
            states.push(other.read().expect("radiosities"));
        }
        let last = states.pop().expect("the state that comes back");
        assert_eq!(bits(&last), bits(&solution.radiosity));
        assert_eq!(states.iter().position(|state| bits(state) == bits(&last)), Some(cycle.entered as usize));
        assert_eq!(by_hand(&(states, cycle.entered as usize)), cycle, "{packing:?}, {patches} patches");
        longest = longest.max(cycle.period);
    }
    assert!(longest > 1, "one of them goes round");
}

#[test]
fn rare_looks_find_the_same_period_and_few_iterations_none() {
    let system = cornell(40);
    let solve = |options: CardOptions| -> CardSolution {
        card(&system, Packing::Luminance, Storage::Fp16).solve(&system, &options, &mut |_| ()).expect("a solution")
    };
    let often = solve(ENDLESS).cycle.expect("a cycle");
    let rarely = solve(CardOptions { check_every: 7, ..ENDLESS }).cycle.expect("a cycle");
    assert_eq!(
        (rarely.period, rarely.changing, rarely.largest_change),
        (often.period, often.changing, often.largest_change)
    );
    assert!(rarely.entered >= often.entered && rarely.entered.is_multiple_of(7));
    let few = solve(CardOptions { most_iterations: often.entered, ..ENDLESS });
    assert_eq!((few.cycle, few.converged, few.iterations()), (None, false, often.entered));
}
