//! What the options of `crossbar radiosity` ask for.

use std::str::FromStr;

use clap::ValueEnum;

use super::{Args, FactorsArg, Law};
use crate::cli::{Problem, number};
use crate::radiosity::Subdivision;
use crate::radiosity::form_factor::VisibilityParameters;
use crate::radiosity::on_card::Storage;
use crate::radiosity::packing::Packing;
use crate::radiosity::solve::{Solver, UnknownSolver};
use crate::scene::Color;
use crate::study::radiosity::{CardMethod, Change, FactorRequirements, Factors, SolveMethod};

/// On the card, or a solver of the host.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SolverArg {
    Card,
    Host(Solver),
}

impl FromStr for SolverArg {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        if name == "card" {
            return Ok(Self::Card);
        }
        name.parse()
            .map(Self::Host)
            .map_err(|e: UnknownSolver| e.to_string().replacen("expected ", "expected `card`, ", 1))
    }
}

/// How elements lie in texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum PackingArg {
    /// One element per texel: red, green and blue at once
    Rgb,
    /// Four elements per texel, one channel after the other
    Luminance,
}

/// What registers, textures and targets hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum StorageArg {
    /// Single precision
    Fp32,
    /// Half precision
    Fp16,
}

/// A color for a material.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MaterialColor {
    material: String,
    rgb: Color,
}

/// `light=17,12,4`
pub(super) fn light_of(text: &str) -> Result<MaterialColor, String> {
    let color = color_of(text)?;
    let shines = color.rgb.iter().all(|&c| c >= 0.0);
    if shines { Ok(color) } else { Err(format!("expected radiances of at least 0, found `{text}`")) }
}

/// `wall=0.7,0.7,0.6`
pub(super) fn paint_of(text: &str) -> Result<MaterialColor, String> {
    let color = color_of(text)?;
    let reflects = color.rgb.iter().all(|c| (0.0..1.0).contains(c));
    if reflects { Ok(color) } else { Err(format!("expected reflectances of at least 0 and below 1, found `{text}`")) }
}

fn color_of(text: &str) -> Result<MaterialColor, String> {
    let wrong = || format!("expected MATERIAL=R,G,B as in light=17,12,4; found `{text}`");
    let (material, channels) = text.split_once('=').ok_or_else(wrong)?;
    let rgb = number::three(channels, "R,G,B")?;
    Ok(MaterialColor { material: material.to_owned(), rgb })
}

pub(super) fn subdivision(args: &Args) -> Subdivision {
    args.per_side.map_or(Subdivision::AtMost(args.patches as usize), Subdivision::PerSide)
}

pub(super) fn requirements(args: &Args) -> FactorRequirements {
    let from = match args.factors {
        FactorsArg::Unoccluded => Factors::Unoccluded,
        FactorsArg::Rays => {
            Factors::Rays(VisibilityParameters { side: args.strata, seed: args.seed, ..Default::default() })
        }
        FactorsArg::Hemicube => Factors::Hemicube { resolution: args.hemicube },
    };
    FactorRequirements {
        from,
        closed: args.require_closed,
        enforce_reciprocity: args.enforce == Some(Law::Reciprocity),
        enforce_closure: args.enforce == Some(Law::Closure),
    }
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
    let packings = if args.packing.is_empty() { &[PackingArg::Rgb][..] } else { &args.packing };
    let storages = if args.storage.is_empty() { &[StorageArg::Fp32][..] } else { &args.storage };
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
                    add(SolveMethod::Card(CardMethod { packing: packing.into(), storage: storage.into() }));
                }
            }
        }
    }
    Ok(methods)
}

impl From<PackingArg> for Packing {
    fn from(arg: PackingArg) -> Self {
        match arg {
            PackingArg::Rgb => Self::Rgb,
            PackingArg::Luminance => Self::Luminance,
        }
    }
}

impl From<StorageArg> for Storage {
    fn from(arg: StorageArg) -> Self {
        match arg {
            StorageArg::Fp32 => Self::Fp32,
            StorageArg::Fp16 => Self::Fp16,
        }
    }
}

/// Lights first, then paint.
pub(super) fn changes(args: &Args) -> Vec<Change> {
    let emit = args.emit.iter().cloned().map(|c| Change::Emission { material: c.material, radiance: c.rgb });
    let paint = args.paint.iter().cloned().map(|c| Change::Reflectance { material: c.material, reflectance: c.rgb });
    emit.chain(paint).collect()
}
