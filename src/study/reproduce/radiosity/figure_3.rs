//! Figure 3: the residual of Jacobi and of Gauss-Seidel, iteration by iteration.

use super::{Findings, ReproduceError, failed};
use crate::geom::elementary::ln;
use crate::radiosity::rooms::{CornellBox, cornell};
use crate::radiosity::solve::{Options, Solution, Solver};
use crate::radiosity::{FormFactors, Patches, Subdivision, System};
use crate::report::{Chart, Line, Scale, Table};
use crate::study::reproduce::{Modelled, NamedChart, Printed, Row};

/// Patches; the number hardly matters to how fast iterations converge.
const CUT: usize = 400;
/// The residual's length, of the emittance's: far enough that only the slowest part of the error is left.
const TOLERANCE: f64 = 1e-10;
/// Residuals at which iterations are counted.
const SHARES: [f64; 4] = [1e-1, 1e-2, 1e-4, 1e-8];
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

const NOTE: &str = "The light of the room reaches its neighbours in the first few iterations of either method, so early on Jacobi needs \
    about 1.5 times as many; twice holds late, when one slow part of the error is left. The authors' figure begins and ends where \
    its axes do, which the text does not say.";

pub(in crate::study::reproduce) fn findings() -> Result<Findings, ReproduceError> {
    let system = closed_box()?;
    let mut table = Table::new(
        "Iterations until the residual is so small a share of what it was",
        &["channel", "residual", "jacobi", "gauss_seidel", "ratio"],
    );
    let (mut lines, mut late) = (Vec::new(), Vec::new());
    for (channel, name) in CHANNELS.into_iter().enumerate() {
        let both = [Solver::Jacobi, Solver::GaussSeidel].map(|solver| solve(&system, channel, solver));
        let [jacobi, seidel] = both;
        let (jacobi, seidel) = (jacobi?, seidel?);
        for share in SHARES {
            let (j, g) = (needed(&jacobi, share), needed(&seidel, share));
            let ratio = (j as f64 / g.max(1) as f64 * 100.0).round() / 100.0;
            table.push([name.into(), share.into(), j.into(), g.into(), ratio.into()]);
        }
        late.push(slope(&seidel) / slope(&jacobi));
        if channel == 0 {
            lines.push(line("Jacobi", &jacobi));
            lines.push(line("Gauss-Seidel", &seidel));
        }
    }
    let row = |(name, ratio): (&str, f64)| Row {
        what: format!("Jacobi's iterations over Gauss-Seidel's, late, {name}"),
        device: "-",
        printed: Printed { value: 2.0, decimals: 0, unit: "times", place: "section 3.1" },
        rates: None,
        pipeline: Modelled::predicted(ratio),
        note: NOTE.to_owned(),
    };
    Ok(Findings {
        text: vec![
            "A closed Cornell box without blocks, its form factors in closed form and by contour integrals, solved in f64 from 0. No card \
             takes part: equation 4 converges as Jacobi's iteration does. What stands under `pipeline` is the ratio of the two slopes \
             of the plot."
                .to_owned(),
        ],
        rows: CHANNELS.into_iter().zip(late).map(row).collect(),
        tables: vec![table],
        charts: vec![NamedChart {
            name: "radiosity-figure-3",
            chart: Chart {
                title: "Mean squared residual of M B - E, red".to_owned(),
                x: "iterations".to_owned(),
                y: "error".to_owned(),
                y_scale: Scale::Logarithmic,
                lines,
            },
            caption: "Figure 3 of the radiosity paper: both are straight lines, and Gauss-Seidel's is about twice as steep.".to_owned(),
        }],
    })
}

fn closed_box() -> Result<System, ReproduceError> {
    let scene = cornell(CornellBox { blocks: false, open: false });
    let patches = Patches::new(&scene, Subdivision::AtMost(CUT)).map_err(|e| failed("the host")(&e))?;
    let factors = FormFactors::unoccluded(&patches).map_err(|e| failed("the host")(&e))?;
    System::new(factors, patches.reflectances(), patches.emittances()).map_err(|e| failed("the host")(&e))
}

fn solve(system: &System, channel: usize, solver: Solver) -> Result<Solution, ReproduceError> {
    let options = Options { tolerance: TOLERANCE, most_iterations: 1000 };
    system.solve_channel(channel, solver, &options, None).map_err(|e| failed("the host")(&e))
}

/// Iterations until the residual's length is a share of what it was.
fn needed(solution: &Solution, share: f64) -> usize {
    let target = share * share * solution.history[0];
    solution.history.iter().position(|&error| error <= target).unwrap_or(solution.iterations())
}

/// How much the logarithm of the error falls an iteration, over the last half of the plot.
fn slope(solution: &Solution) -> f64 {
    let (half, last) = (solution.iterations() / 2, solution.iterations());
    ln(solution.history[half] / solution.history[last]) / (last - half).max(1) as f64
}

fn line(label: &str, solution: &Solution) -> Line {
    let points = solution.history.iter().enumerate().map(|(k, &error)| (k as f64, error)).collect();
    Line { label: label.to_owned(), points }
}
