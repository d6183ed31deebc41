//! Figure 3: the residual of Jacobi and of Gauss-Seidel, iteration by iteration.

use super::{EntryFindings, RunResult, Shared, StudyError};
use crate::elementary::ln;
use crate::radiosity::rooms::{CornellBox, cornell};
use crate::radiosity::solve::{Options, Solution, Solver};
use crate::radiosity::{FormFactors, Patches, Subdivision, System};
use crate::report::{Cell, Chart, NamedChart, Scale, Series, Table};
use crate::study::reproduce::{Dependence, Method, PaperRow, Setting, Sweep, paper_row, paragraph};

/// Number of patches; it hardly affects the rate of convergence.
const CUT: usize = 400;
/// Norm of the residual relative to the emittance's norm: small enough that only the slowest component of the error is
/// left.
const TOLERANCE: f64 = 1e-10;
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Residual at which iterations are compared: the error is no longer visible. The paper does not state its criterion of
/// convergence.
const CONVERGED: f64 = 1e-4;
/// Residuals at which iterations are counted, for the sweep.
const RESIDUALS: [f64; 9] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
const HOW: &str = "The scene is a closed Cornell box without blocks. Form factors are computed in closed form and by contour integrals; the \
    iterations run in f64 and start from zero. No card is emulated: equation 4 converges as Jacobi's iteration does. The paper's \"about twice as \
    many iterations to converge\" has two readings: the ratio of the iterations until the residual falls to {} of its first value, and the ratio of \
    the slopes of the plotted lines over their last half. The row has both, for each channel. Figure 2 of the paper is a picture of a solution: \
    `crossbar radiosity` draws one.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let system = closed_box()?;
    let mut table = Table::of(
        "Iterations until the residual falls to a share of its first value",
        "channel residual jacobi gauss_seidel ratio",
    );
    let (mut lines, mut late, mut both) = (Vec::new(), Vec::new(), Vec::new());
    for (channel, name) in CHANNELS.into_iter().enumerate() {
        let [jacobi, seidel] = [Solver::Jacobi, Solver::GaussSeidel].map(|solver| solve(&system, channel, solver));
        let (jacobi, seidel) = (jacobi?, seidel?);
        for share in RESIDUALS {
            let (j, g) = (needed(&jacobi, share), needed(&seidel, share));
            table.push([name.into(), share.into(), j.into(), g.into(), Cell::ratio(ratio(&jacobi, &seidel, share))]);
        }
        late.push(slope(&seidel) / slope(&jacobi));
        if channel == 0 {
            lines.push(line("Jacobi", &jacobi));
            lines.push(line("Gauss-Seidel", &seidel));
        }
        both.push((jacobi, seidel));
    }
    Ok(EntryFindings {
        text: vec![paragraph(HOW, &[&CONVERGED.to_string()])],
        rows: vec![row(&both, late)?],
        questions: vec!["the residual at which the authors stopped counting, and the ranges of their figure's axes."],
        tables: vec![table],
        charts: vec![NamedChart {
            name: "radiosity-figure-3".into(),
            chart: Chart {
                title: "Mean squared residual of M B - E, red".to_owned(),
                x: "iterations".to_owned(),
                y: "error".to_owned(),
                y_scale: Scale::Logarithmic,
                lines,
                ..Chart::default()
            },
            caption: "Figure 3 of the radiosity paper prints no points; both of its curves are straight lines.".into(),
        }],
        ..EntryFindings::default()
    })
}

/// Row for the ratio of iterations down to a residual in the first channel; the other channels and the late slopes are
/// readings. The sweep over the residual may explain it if all channels lie within the bound.
fn row(channels: &[(Solution, Solution)], late: Vec<f64>) -> Result<PaperRow, StudyError> {
    let ratios = |share: f64| channels.iter().map(move |(jacobi, seidel)| ratio(jacobi, seidel, share));
    let first = ratios(CONVERGED).next().unwrap_or(f64::NAN);
    let row = paper_row("radiosity/jacobi-over-gauss-seidel", ("-", Method::Solver), (first, Dependence::Counted))?;
    let mut rows = [row.with_readings(ratios(CONVERGED).skip(1).chain(late))];
    let twice = rows[0].target.value;
    let farthest = |one: &f64, other: &f64| (one - twice).abs().total_cmp(&(other - twice).abs());
    let setting = |share: f64| Setting {
        at: share.to_string(),
        values: vec![ratios(share).max_by(farthest).unwrap_or(f64::NAN)],
    };
    let sweep = Sweep {
        name: "residual at which iterations end",
        parameter: "residual",
        settings: RESIDUALS.map(setting).into(),
    };
    sweep.explain(&mut rows);
    let [row] = rows;
    Ok(row)
}

/// Ratio of Jacobi's iterations to Gauss-Seidel's, down to a residual.
fn ratio(jacobi: &Solution, seidel: &Solution, share: f64) -> f64 {
    needed(jacobi, share) as f64 / needed(seidel, share).max(1) as f64
}

fn closed_box() -> Result<System, StudyError> {
    let scene = cornell(CornellBox { blocks: false, open: false });
    let patches = Patches::new(&scene, Subdivision::AtMost(CUT)).on("the host")?;
    let factors = FormFactors::unoccluded(&patches).on("the host")?;
    System::new(factors, patches.reflectances(), patches.emittances()).on("the host")
}

fn solve(system: &System, channel: usize, solver: Solver) -> Result<Solution, StudyError> {
    let options = Options { tolerance: TOLERANCE, most_iterations: 1000 };
    system.solve_channel(channel, solver, &options).on("the host")
}

/// Iterations until the residual's norm falls to a fraction of its initial value.
fn needed(solution: &Solution, share: f64) -> usize {
    let target = share * share * solution.history[0];
    solution.history.iter().position(|&error| error <= target).unwrap_or(solution.iterations())
}

/// Decrease of the logarithm of the error per iteration, over the last half of the plot.
fn slope(solution: &Solution) -> f64 {
    let (half, last) = (solution.iterations() / 2, solution.iterations());
    ln(solution.history[half] / solution.history[last]) / (last - half).max(1) as f64
}

fn line(label: &str, solution: &Solution) -> Series {
    let points = solution.history.iter().enumerate().map(|(k, &error)| (k as f64, error)).collect();
    Series { label: label.to_owned(), points }
}
