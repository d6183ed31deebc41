//! The f32 iteration is within its derived bound of the direct solution, and the bound is not vacuous.

use crossbar::linalg::Matrix;
use crossbar::radiosity::card_order::CardSystem;
use crossbar::radiosity::solve::{Options, Problem, Solver, solve};

use super::bound::{ErrorBound, before, bounded_step, contraction};
use super::{cornell, random_system};

fn truth(matrix: &Matrix, right: &[f64]) -> Vec<f64> {
    let problem = Problem { matrix, right_hand_side: right, areas: &vec![1.0; right.len()], start: None };
    solve(Solver::Direct, &problem, &Options::default()).expect("a solution").radiosity
}

/// Checks error <= running bound <= a-priori bound.
fn check(name: &str, card: &CardSystem, systems: &[(Matrix, Vec<f64>)], steps: u32) {
    let value = |b: &crossbar::card::Texels, i: usize, c: usize| {
        f64::from(if systems.len() == 3 { b.texels[i][c] } else { b.texels[i / 4][i % 4] })
    };
    let truths: Vec<Vec<f64>> = systems.iter().map(|(m, e)| truth(m, e)).collect();
    let scaled =
        |(m, e): &(Matrix, Vec<f64>)| e.iter().zip(m.diagonal()).map(|(e, d)| (e / d).abs()).fold(0.0, f64::max);
    let start = |s: &(Matrix, Vec<f64>)| ErrorBound::from_zero(contraction(&s.0), scaled(s));
    let mut running: Vec<ErrorBound> = systems.iter().map(start).collect();
    let mut b = card.zero();
    for step in 0..=steps {
        for (c, truth) in truths.iter().enumerate() {
            let off = truth.iter().enumerate().map(|(i, t)| (value(&b, i, c) - t).abs()).fold(0.0, f64::max);
            assert!(
                off <= running[c].error,
                "{name}, channel {c}, step {step}: off by {off}, bound {}",
                running[c].error
            );
            if step == steps {
                let (g, e) = (running[c].contraction, scaled(&systems[c]));
                let prior = before(card, g, e);
                assert!(running[c].error <= prior + e * 1e-12, "{name}: {} against {prior} before", running[c].error);
                assert!(running[c].error < 3e3 * off.max(1e-7 * e), "{name}: the bound says something");
            }
        }
        let (next, errors) = bounded_step(card, &b);
        assert_eq!(next, card.step(&b), "the rounded results that the bound adds up are those of the step");
        running.iter_mut().zip(errors).for_each(|(bound, error)| bound.advance(error));
        b = next;
    }
}

#[test]
fn the_cornell_box_stays_within_its_bound() {
    let system = cornell(300);
    let systems = [0, 1, 2].map(|c| (system.matrix(c), system.right_hand_side(c)));
    check("RGB", &CardSystem::rgb(&system, 254, 2048).expect("it fits"), &systems, 110);
    for (matrix, right) in systems {
        let card = CardSystem::luminance(matrix.clone(), &right, 254, 2048).expect("it fits");
        check("luminance", &card, &[(matrix, right)], 110);
    }
}

#[test]
fn random_systems_stay_within_their_bounds() {
    for (seed, size, reach) in [(1, 1, 0.5), (2, 9, 0.99), (3, 64, 0.3), (4, 130, 0.9)] {
        let (matrix, right) = random_system(size, reach, seed);
        let card = CardSystem::luminance(matrix.clone(), &right, 11, 2048).expect("it fits");
        let steps = if reach > 0.95 { 2200 } else { 230 };
        check(&format!("{size} rows"), &card, &[(matrix, right)], steps);
    }
}
