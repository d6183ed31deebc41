//! The parameters that the options of `crossbar radiosity` make.

use super::args::{Args, FactorsArg, Law};
use super::values::SolverArg;
use crate::cli::{Problem, given};
use crate::radiosity::Subdivision;
use crate::radiosity::form_factor::VisibilityParameters;
use crate::radiosity::on_card::Storage;
use crate::radiosity::packing::Packing;
use crate::radiosity::solve::Solver;
use crate::study::radiosity::{CardMethod, Change, FactorRequirements, Factors, SolveMethod};

pub(super) fn subdivision(args: &Args) -> Subdivision {
    args.per_side.map_or(Subdivision::AtMost(args.patches as usize), Subdivision::PerSide)
}

pub(super) fn requirements(args: &Args) -> Result<FactorRequirements, Problem> {
    let of_rays = [("--strata", args.strata.is_some()), ("--seed", args.seed.is_some())];
    let of_rays = of_rays.map(|(option, given)| (option, given && args.factors != FactorsArg::Rays));
    given::refuse(of_rays, "form factors by rays", "add `--factors rays`, or leave it out")?;
    let of_hemicubes = [("--hemicube", args.hemicube.is_some() && args.factors != FactorsArg::Hemicube)];
    given::refuse(of_hemicubes, "form factors by hemicubes", "add `--factors hemicube`, or leave it out")?;
    let from = match args.factors {
        FactorsArg::Unoccluded => Factors::Unoccluded,
        FactorsArg::Rays => {
            let usual = VisibilityParameters::default();
            let (side, seed) = (args.strata.unwrap_or(usual.side), args.seed.unwrap_or(usual.seed));
            Factors::Rays(VisibilityParameters { side, seed, ..usual })
        }
        FactorsArg::Hemicube => Factors::Hemicube { resolution: args.hemicube.unwrap_or(64) },
    };
    Ok(FactorRequirements {
        from,
        closed: args.require_closed,
        enforce_reciprocity: args.enforce == Some(Law::Reciprocity),
        enforce_closure: args.enforce == Some(Law::Closure),
    })
}

/// Every solver, those on the card in every packing and storage; nothing twice.
pub(super) fn methods(args: &Args) -> Result<Vec<SolveMethod>, Problem> {
    let usual = [SolverArg::Card, SolverArg::Host(Solver::GaussSeidel), SolverArg::Host(Solver::Direct)];
    let solvers = if args.solver.is_empty() { &usual[..] } else { &args.solver };
    let on_card = solvers.contains(&SolverArg::Card);
    let of_the_card = !args.packing.is_empty() || !args.storage.is_empty();
    if of_the_card && !on_card {
        let help = "add `--solver card`, or leave them out";
        return Err(Problem::usage("`--packing` and `--storage` are for the card", help));
    }
    if !on_card && !args.frames.is_empty() {
        let help = "add `--solver card`, or leave it out";
        return Err(Problem::usage("`--frames` shows the iterations of the card", help));
    }
    if !on_card && !args.sweep.is_empty() {
        let help = "add `--solver card`, or leave it out";
        return Err(Problem::usage("`--sweep` turns the switches of the card", help));
    }
    if !on_card && args.factors != FactorsArg::Hemicube {
        given::refuse(args.card.given(), "methods on a card", "add `--solver card`, or leave it out")?;
    }
    let packings = if args.packing.is_empty() { &[Packing::Rgb][..] } else { &args.packing };
    let storages = if args.storage.is_empty() { &[Storage::Fp32][..] } else { &args.storage };
    let mut methods: Vec<SolveMethod> = Vec::new();
    let mut add = |method| {
        if !methods.contains(&method) {
            methods.push(method);
        }
    };
    for solver in solvers {
        match *solver {
            SolverArg::Host(solver) => add(SolveMethod::Host(solver)),
            SolverArg::Card => {
                for (&packing, &storage) in packings.iter().flat_map(|p| storages.iter().map(move |s| (p, s))) {
                    add(SolveMethod::Card(CardMethod { packing, storage }));
                }
            }
        }
    }
    Ok(methods)
}

/// Lights first, then paint.
pub(super) fn changes(args: &Args) -> Vec<Change> {
    let emit = args.emit.iter().cloned().map(|c| Change::Emission { material: c.material, radiance: c.rgb });
    let paint = args.paint.iter().cloned().map(|c| Change::Reflectance { material: c.material, reflectance: c.rgb });
    emit.chain(paint).collect()
}
