//! Matrix radiosity: the straight lines of Figure 3.

use crossbar::radiosity::rooms;
use crossbar::radiosity::solve::{Options, Solver};
use crossbar::radiosity::{FormFactors, Patches, Subdivision, System};
use crossbar::scene::Material;

/// The unit cube in the Cornell box's colors, with `n` patches per side and light from the middle of the ceiling.
fn closed_box(n: u32) -> System {
    let paint = |name: &str, albedo| Material::diffuse(name, albedo);
    let [white, red, green] = [[0.725, 0.71, 0.68], [0.63, 0.065, 0.05], [0.14, 0.45, 0.091]];
    let walls = [white, white, red, green, white, white];
    let scene = rooms::cube([0, 1, 2, 3, 4, 5].map(|wall| paint(rooms::WALLS[wall], walls[wall])));
    let patches = Patches::new(&scene, Subdivision::PerSide(n)).expect("patches");
    let mut factors = FormFactors::unoccluded(&patches).expect("factors");
    factors.enforce_closure().expect("closed");
    let lit = patches.list().iter().map(|patch| {
        let [x, y, z] = patch.center().into();
        let middle = z == 1.0 && (x - 0.5).abs() < 0.125 && (y - 0.5).abs() < 0.125;
        if middle { [17.0, 12.0, 4.0] } else { [0.0; 3] }
    });
    let emittance = lit.collect();
    System::new(factors, patches.reflectances(), emittance).expect("a system")
}

/// Figure 3 is a semilog plot, in which both curves are straight lines.
#[test]
fn residuals_fall_by_the_same_factor_each_time() {
    let system = closed_box(6);
    let options = Options { tolerance: 1e-10, most_iterations: 1000 };
    for solver in [Solver::Jacobi, Solver::GaussSeidel] {
        let history = system.solve_channel(0, solver, &options).expect("a solution").history;
        let ratios: Vec<f64> = history.windows(2).skip(6).map(|two| two[1] / two[0]).collect();
        let (least, most) = ratios.iter().fold((1.0_f64, 0.0_f64), |(l, m), &r| (l.min(r), m.max(r)));
        assert!(most < 1.0 && most / least < 1.1, "{solver}: {least} to {most}");
    }
}
