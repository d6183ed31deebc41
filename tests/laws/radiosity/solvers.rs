//! All solvers find the same solution; their histories show how fast they converge.

use approx::abs_diff_eq;
use crossbar::radiosity::solve::{Options, Problem, Solver, residual, solve};

use super::{cornell, random_system};

const ALL: [Solver; 5] =
    [Solver::Jacobi, Solver::GaussSeidel, Solver::OverRelaxation(1.2), Solver::Shooting, Solver::Direct];

#[test]
fn all_solvers_agree_on_random_matrices_and_the_cornell_box() {
    let options = Options { tolerance: 1e-12, most_iterations: 5000 };
    let mut systems: Vec<_> = (1..40).map(|size| random_system(size, 0.9, size as u64)).collect();
    let cornell = cornell(200);
    systems.push((cornell.matrix(0), cornell.right_hand_side(0)));
    for (matrix, right) in &systems {
        let areas = vec![1.0; right.len()];
        let problem = Problem { matrix, right_hand_side: right, areas: &areas };
        let truth = solve(Solver::Direct, &problem, &options).expect("a solution").radiosity;
        let size = truth.iter().fold(0.0_f64, |m, b| m.max(b.abs()));
        for solver in ALL {
            let solution = solve(solver, &problem, &options).expect("a solution");
            let off = solution.radiosity.iter().zip(&truth).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(solution.converged && off < 1e-9 * size, "{solver}, {} rows: off by {off}", right.len());
            let last =
                residual(matrix, right, &solution.radiosity).iter().map(|r| r * r).sum::<f64>() / right.len() as f64;
            assert!(
                abs_diff_eq!(last, solution.history[solution.iterations()], epsilon = 1e-6 * last),
                "{solver}: {last}"
            );
        }
    }
}

#[test]
fn shooting_sends_the_brightest_light_first() {
    let system = cornell(250);
    let options = |most_iterations| Options { tolerance: 0.0, most_iterations };
    // After one round of shots most of the light is distributed; one Jacobi step only distributes the emitted light.
    let left = |solver| system.solve_channel(0, solver, &options(1)).expect("a solution").history[1];
    assert!(left(Solver::Shooting) < 0.5 * left(Solver::Jacobi), "{} {}", left(Solver::Shooting), left(Solver::Jacobi));
}

#[test]
fn histories_stop_where_they_are_told() {
    let (matrix, right) = random_system(20, 0.9, 1);
    let problem = Problem { matrix: &matrix, right_hand_side: &right, areas: &[1.0; 20] };
    let few = solve(Solver::Jacobi, &problem, &Options { tolerance: 1e-9, most_iterations: 3 }).expect("a solution");
    assert_eq!((few.iterations(), few.converged), (3, false));
    let enough =
        solve(Solver::Jacobi, &problem, &Options { tolerance: 1e-9, most_iterations: 999 }).expect("a solution");
    let target = 1e-18 * enough.history[0];
    assert!(
        enough.converged
            && enough.history[enough.iterations()] <= target
            && enough.history[enough.iterations() - 1] > target
    );
    let dark = Problem { right_hand_side: &[0.0; 20], ..problem };
    assert_eq!(solve(Solver::GaussSeidel, &dark, &Options::default()).expect("a solution").iterations(), 0);
}

#[test]
fn what_cannot_be_solved_is_refused() {
    let (matrix, right) = random_system(4, 0.9, 1);
    let problem = Problem { matrix: &matrix, right_hand_side: &right, areas: &[1.0; 4] };
    let options = Options::default();
    for step in [0.0, 2.0, -1.0, f64::NAN] {
        assert!(solve(Solver::OverRelaxation(step), &problem, &options).is_err(), "{step}");
    }
    let short = Problem { areas: &[1.0; 3], ..problem };
    assert!(solve(Solver::Jacobi, &short, &options).is_err(), "an area is missing");
    let mut zero = matrix.clone();
    zero.row_mut(2)[2] = 0.0;
    assert!(solve(Solver::Jacobi, &Problem { matrix: &zero, ..problem }, &options).is_err(), "a diagonal with a zero");
    let (runaway, right) = random_system(8, 3.0, 2);
    let problem = Problem { matrix: &runaway, right_hand_side: &right, areas: &[1.0; 8] };
    let options = Options { tolerance: 1e-9, most_iterations: 100_000 };
    assert!(solve(Solver::Jacobi, &problem, &options).is_err(), "no finite residual");
}
