//! Matrix radiosity: what the paper says of its figures, and what follows from it.

use approx::abs_diff_eq;
use crossbar::elementary::ln;
use crossbar::radiosity::packing::Packing;
use crossbar::radiosity::rate::{Timing, timed_iteration};
use crossbar::radiosity::rooms;
use crossbar::radiosity::solve::{Options, Solution, Solver};
use crossbar::radiosity::{FormFactors, Patches, Storage, Subdivision, System};
use crossbar::scene::Material;
use refsim::device::Profile;
use refsim::timing::Bottleneck;

/// The unit cube in the Cornell box's colours, `n` patches a side, light from the middle of the ceiling.
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

/// Iterations until the residual's length is a share of what it was.
fn iterations_to(solution: &Solution, share: f64) -> usize {
    let target = share * share * solution.history[0];
    solution.history.iter().position(|&error| error <= target).expect("far enough")
}

/// Section 3.1 and Figure 3: "about twice as many iterations". Late that is so, early it is not.
#[test]
fn jacobi_takes_up_to_twice_the_iterations_of_gauss_seidel() {
    let system = closed_box(8);
    let deep = Options { tolerance: 1e-12, most_iterations: 1000 };
    for (channel, colour) in ["red", "green", "blue"].into_iter().enumerate() {
        let jacobi = system.solve_channel(channel, Solver::Jacobi, &deep, None).expect("a solution");
        let seidel = system.solve_channel(channel, Solver::GaussSeidel, &deep, None).expect("a solution");
        let ratio = |share: f64| iterations_to(&jacobi, share) as f64 / iterations_to(&seidel, share) as f64;
        let late = rate(&jacobi) / rate(&seidel);
        assert!((1.4..1.85).contains(&ratio(1e-4)), "{colour}: {}", ratio(1e-4));
        assert!((1.8..2.0).contains(&late), "{colour}: {late}");
    }
}

/// Iterations until the residual is smaller by a factor of e, late.
fn rate(solution: &Solution) -> f64 {
    let (early, late) = (iterations_to(solution, 1e-8), iterations_to(solution, 1e-12));
    2.0 * (late - early) as f64 / ln(solution.history[early] / solution.history[late])
}

/// Figure 3 is a semilog plot; both curves are straight lines in it.
#[test]
fn residuals_fall_by_the_same_factor_each_time() {
    let system = closed_box(6);
    let options = Options { tolerance: 1e-10, most_iterations: 1000 };
    for solver in [Solver::Jacobi, Solver::GaussSeidel] {
        let history = system.solve_channel(0, solver, &options, None).expect("a solution").history;
        let ratios: Vec<f64> = history.windows(2).skip(6).map(|two| two[1] / two[0]).collect();
        let (least, most) = ratios.iter().fold((1.0_f64, 0.0_f64), |(l, m), &r| (l.min(r), m.max(r)));
        assert!(most < 1.0 && most / least < 1.1, "{solver}: {least} to {most}");
    }
}

/// Section 3.1: 29.7 iterations a second and 141 MFLOP/s, compute bound, with a tenth of the bandwidth in use. No
/// figure of the model comes from that paper.
#[test]
fn an_iteration_of_1540_patches_on_the_5900_ultra() {
    let timing = Timing { patches: 1540, packing: Packing::Rgb, storage: Storage::Fp32, cache: false };
    let timed = timed_iteration(&Profile::named("nv35").expect("a card"), &timing).expect("an iteration");
    assert_eq!((timed.passes, timed.bottleneck), (7, Bottleneck::Textures));
    assert!(
        abs_diff_eq!(timed.per_s, 31.578, epsilon = 1e-3) && abs_diff_eq!(timed.mflops, 149.779, epsilon = 1e-3),
        "{timed:?}"
    );
    assert!(abs_diff_eq!(timed.per_s / 29.7, 1.0, epsilon = 0.15) && timed.bandwidth < 0.1, "near what is printed");
    // The target is one texel high.
    assert_eq!(timed.filled, 0.5);
}
