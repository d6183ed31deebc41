//! Physical properties: furnaces, energy, changed light.

use approx::abs_diff_eq;
use crossbar::radiosity::form_factor::VisibilityParameters;
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::solve::{Options, Solver};
use crossbar::radiosity::{FormFactors, Patches, Subdivision, System, display};

use super::{cornell, tracer};

const EXACT: Options = Options { tolerance: 1e-13, most_iterations: 2000 };

#[test]
fn a_white_furnace_is_as_bright_everywhere() {
    for reflectance in [0.0, 0.25, 0.5, 0.96875] {
        let patches = Patches::new(&rooms::furnace(reflectance), Subdivision::PerSide(5)).expect("patches");
        let mut factors = FormFactors::unoccluded(&patches).expect("factors");
        factors.enforce_closure().expect("closed");
        let exact: Vec<[f64; 3]> = vec![[1.0 - f64::from(reflectance); 3]; factors.len()];
        let system = System::new(factors, patches.reflectances(), exact).expect("a system");
        for solver in
            [Solver::Jacobi, Solver::GaussSeidel, Solver::OverRelaxation(1.1), Solver::Shooting, Solver::Direct]
        {
            let solution = system.solve_channel(1, solver, &EXACT).expect("a solution");
            let off = solution.radiosity.iter().map(|b| (b - 1.0).abs()).fold(0.0, f64::max);
            // Row sums are within 1e-13 of 1, amplified by 1 / (1 - rho).
            assert!(off < 3e-13 / (1.0 - f64::from(reflectance)), "{solver} at {reflectance}: off by {off}");
        }
    }
}

#[test]
fn what_is_emitted_is_absorbed_or_leaves() {
    let emitted = |system: &System| -> f64 {
        system.factors().areas().iter().zip(system.emittance()).map(|(area, e)| area * e[0]).sum()
    };
    let closed = cornell(250);
    let solution = closed.solve(Solver::Direct, &EXACT).expect("a solution").radiosity();
    assert!(closed.energy_balance_error(&solution).iter().all(|left| left.abs() < 1e-12 * emitted(&closed)));
    // An open room also conserves energy: its row sums determine the light that leaves.
    let scene = rooms::cornell(CornellBox { blocks: true, open: true });
    let patches = Patches::new(&scene, Subdivision::AtMost(250)).expect("patches");
    let seen =
        FormFactors::with_visibility(&patches, &mut tracer(&scene), VisibilityParameters::default(), &mut |_, _| ());
    let factors = seen.expect("factors");
    let sums = factors.summary();
    assert!(sums.escaping > 0.1 && sums.most < 1.05 && sums.least >= 0.0, "{sums:?}");
    let open = System::new(factors, patches.reflectances(), patches.emittances()).expect("a system");
    let solution = open.solve(Solver::GaussSeidel, &EXACT).expect("a solution").radiosity();
    assert!(
        open.energy_balance_error(&solution).iter().all(|left| left.abs() < 1e-11 * emitted(&open)),
        "{:?}",
        open.energy_balance_error(&solution)
    );
    let wrong: Vec<[f64; 3]> = solution.iter().map(|b| b.map(|x| 1.01 * x)).collect();
    assert!(open.energy_balance_error(&wrong).iter().all(|left| left.abs() > 1e-3), "a wrong solution shows");
}

#[test]
fn corners_share_what_meets_there() {
    let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(4)).expect("patches");
    let even = display::at_corners(&patches, &[[0.25, 0.5, 1.0]; 96]);
    assert!(even.iter().flatten().all(|corner| *corner == [0.25, 0.5, 1.0]));
    // A radiosity that increases linearly along x: values at inner corners of the floor lie on the line.
    let slope: Vec<[f64; 3]> = patches.list().iter().map(|p| [p.center()[0]; 3]).collect();
    let corners = display::at_corners(&patches, &slope);
    for (patch, values) in patches.list().iter().zip(&corners).filter(|(p, _)| p.normal()[2] == 1.0) {
        for (corner, value) in patch.corners().iter().zip(values) {
            if (0.1..0.9).contains(&corner[0]) {
                assert!(abs_diff_eq!(value[0], corner[0], epsilon = 1e-12), "{corner:?}: {value:?}");
            }
        }
    }
    // Walls of other materials, or across an edge, contribute nothing.
    let mut floor_only = vec![[0.0; 3]; 96];
    floor_only[..16].fill([1.0; 3]);
    assert!(display::at_corners(&patches, &floor_only)[16..].iter().flatten().all(|corner| *corner == [0.0; 3]));
}
