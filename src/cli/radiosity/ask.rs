//! What the options of `crossbar radiosity` ask for.

use std::fmt::Write as _;
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
use crate::study::radiosity::{CardWay, Change, Factors, Way, Wishes};

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
    /// One texel an element: red, green and blue at once
    Rgb,
    /// Four elements a texel, a channel after the other
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

/// A colour for a material.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Colour {
    material: String,
    rgb: Color,
}

/// `light=17,12,4`
pub(super) fn light_of(text: &str) -> Result<Colour, String> {
    let colour = colour_of(text)?;
    let shines = colour.rgb.iter().all(|&c| c >= 0.0);
    if shines { Ok(colour) } else { Err(format!("expected radiances of at least 0, found `{text}`")) }
}

/// `wall=0.7,0.7,0.6`
pub(super) fn paint_of(text: &str) -> Result<Colour, String> {
    let colour = colour_of(text)?;
    let reflects = colour.rgb.iter().all(|c| (0.0..1.0).contains(c));
    if reflects { Ok(colour) } else { Err(format!("expected reflectances of at least 0 and below 1, found `{text}`")) }
}

fn colour_of(text: &str) -> Result<Colour, String> {
    let wrong = || format!("expected MATERIAL=R,G,B as in light=17,12,4; found `{text}`");
    let (material, channels) = text.split_once('=').ok_or_else(wrong)?;
    let rgb = number::three(channels, "R,G,B")?;
    Ok(Colour { material: material.to_owned(), rgb })
}

pub(super) fn subdivision(args: &Args) -> Subdivision {
    args.per_side.map_or(Subdivision::AtMost(args.patches as usize), Subdivision::PerSide)
}

pub(super) fn wishes(args: &Args) -> Wishes {
    let from = match args.factors {
        FactorsArg::Unoccluded => Factors::Unoccluded,
        FactorsArg::Rays => {
            Factors::Rays(VisibilityParameters { side: args.strata, seed: args.seed, ..Default::default() })
        }
        FactorsArg::Hemicube => Factors::Hemicube { resolution: args.hemicube },
    };
    Wishes {
        from,
        closed: args.require_closed,
        enforce_reciprocity: args.enforce == Some(Law::Reciprocity),
        enforce_closure: args.enforce == Some(Law::Closure),
    }
}

/// Every solver, those on the card in every packing and storage; nothing twice.
pub(super) fn ways(args: &Args) -> Result<Vec<Way>, Problem> {
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
    let mut ways: Vec<Way> = Vec::new();
    for solver in solvers {
        match *solver {
            SolverArg::Host(solver) => ways.push(Way::Host(solver)),
            SolverArg::Card => ways.extend(packings.iter().flat_map(|&packing| {
                let way = move |&storage: &StorageArg| {
                    Way::Card(CardWay { packing: packing.into(), storage: storage.into() })
                };
                storages.iter().map(way)
            })),
        }
    }
    let mut once: Vec<Way> = Vec::new();
    for way in ways {
        if !once.contains(&way) {
            once.push(way);
        }
    }
    Ok(once)
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

fn word(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned())
}

/// The options as they would have to be given again, defaults filled in.
pub(super) fn spelled(args: &Args) -> String {
    let mut text = format!(" --factors {}", word(args.factors));
    // Writing to a string cannot fail.
    let mut add = |option: std::fmt::Arguments<'_>| write!(text, " {option}").unwrap_or_default();
    match args.factors {
        FactorsArg::Unoccluded => (),
        FactorsArg::Rays => add(format_args!("--strata {} --seed {}", args.strata, args.seed)),
        FactorsArg::Hemicube => add(format_args!("--hemicube {}", args.hemicube)),
    }
    if let Some(x) = args.require_closed {
        add(format_args!("--require-closed {x}"));
    }
    if let Some(law) = args.enforce {
        add(format_args!("--enforce {}", word(law)));
    }
    for solver in &args.solver {
        match solver {
            SolverArg::Card => add(format_args!("--solver card")),
            SolverArg::Host(solver) => add(format_args!("--solver {solver}")),
        }
    }
    for packing in &args.packing {
        add(format_args!("--packing {}", word(*packing)));
    }
    for storage in &args.storage {
        add(format_args!("--storage {}", word(*storage)));
    }
    add(format_args!("--device {}", args.device));
    for (name, value) in &args.switch {
        add(format_args!("--switch {name}={value}"));
    }
    if let Some(x) = args.tolerance {
        add(format_args!("--tolerance {x}"));
    }
    if let Some(n) = args.iterations {
        add(format_args!("--iterations {n}"));
    }
    for (option, colours) in [("emit", &args.emit), ("paint", &args.paint)] {
        for Colour { material, rgb: [r, g, b] } in colours {
            add(format_args!("--{option} {material}={r},{g},{b}"));
        }
    }
    for (option, numbers) in [("frames", &args.frames), ("sweep", &args.sweep)] {
        if !numbers.is_empty() {
            let numbers: Vec<String> = numbers.iter().map(ToString::to_string).collect();
            add(format_args!("--{option} {}", numbers.join(",")));
        }
    }
    add(format_args!("--size {}", args.size));
    if let Some(view) = &args.view {
        add(format_args!("--view {view}"));
    }
    let up = (args.eye.up != [0.0, 0.0, 1.0]).then_some(args.eye.up);
    for (option, point) in [("eye", args.eye.eye), ("target", args.eye.target), ("up", up)] {
        if let Some([x, y, z]) = point {
            add(format_args!("--{option} {x},{y},{z}"));
        }
    }
    if args.eye.eye.is_some() || args.eye.target.is_some() {
        add(format_args!("--tan-half-height {}", args.eye.tan_half_height));
    }
    if let Some(x) = args.exposure {
        add(format_args!("--exposure {x}"));
    }
    text
}
