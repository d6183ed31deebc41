//! `crossbar materials`: published media, and the dipole's totals for a medium.

use serde_json::json;

use super::{Out, Problem, Verdict, study};
use crate::names::did_you_mean;
use crate::report::{Cell, Findings, FoundTable, Table};
use crate::subsurface::materials::{MATERIALS, PublishedFigure, PublishedMaterial, named};
use crate::subsurface::{Dipole, Material};

const EXAMPLES: &str = "\
Examples:
  crossbar materials
      the published media: coefficients, mean free paths, diffuse reflectances
  crossbar materials marble
      lengths and reflectances of marble, and the source of its coefficients
  crossbar materials ketchup --json
      the same for ketchup, as JSON

Coefficients are per mm, lengths in mm. The dipole is the model of Jensen et al. 2001.";

/// Distances of the table, in units of the longest mean free path.
const PATHS: [f64; 6] = [0.0, 0.5, 1.0, 2.0, 5.0, 10.0];
const FRACTIONS: [f64; 3] = [0.5, 0.9, 0.99];

/// Show scattering media: coefficients, mean free paths, diffuse reflectance by distance
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A published medium [default: all media]
    name: Option<String>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    match args.name.as_deref() {
        Some(name) => study::show(&one(published(name)?)?, out),
        None => all(out),
    }
}

/// The dipoles of a medium for red, green and blue.
fn dipoles(material: &Material) -> Result<[Dipole; 3], Problem> {
    let [red, green, blue] = material.channels.map(|channel| {
        let help = "coefficients are per mm; `crossbar materials` shows published ones";
        Dipole::new(channel, material.eta).map_err(|error| Problem::usage(error.to_string(), help))
    });
    Ok([red?, green?, blue?])
}

pub(super) fn published(name: &str) -> Result<&'static PublishedMaterial, Problem> {
    named(name).ok_or_else(|| {
        let names = MATERIALS.map(|material| material.name);
        let meant = did_you_mean(name, names);
        let help = format!("{meant}the media are {}", names.join(", "));
        Problem::usage(format!("there is no medium `{name}`"), help)
    })
}

const RGB: [&str; 3] = ["red", "green", "blue"];

fn all(out: &mut Out) -> miette::Result<Verdict> {
    let columns =
        ["medium", "channel", "sigma'_s (1/mm)", "sigma_a (1/mm)", "eta", "path (mm)", "R_d total", "R_d printed"];
    let mut table = Table::new("Published media", &columns);
    for material in &MATERIALS {
        let medium = material.material();
        for (c, dipole) in dipoles(&medium)?.iter().enumerate() {
            let printed = material.reflectance.map_or(Cell::Empty, |figure| Cell::decimals(figure.value[c], 2));
            table.push([
                medium.name.as_str().into(),
                RGB[c].into(),
                dipole.coefficients().sigma_s_prime.into(),
                dipole.coefficients().sigma_a.into(),
                medium.eta.into(),
                Cell::measured(dipole.mean_free_path()),
                Cell::decimals(dipole.total(), 4),
                printed,
            ]);
        }
    }
    out.listing(&table, &["`crossbar materials NAME` shows the lengths, R_d by distance and sources of a medium."])?;
    Ok(Verdict::Done)
}

fn one(published: &PublishedMaterial) -> Result<Findings, Problem> {
    let (medium, dipoles) = (published.material(), dipoles(&published.material())?);
    let mut found = Findings::new(medium.name.as_str());
    found.fields(json!({ "name": medium.name, "eta": medium.eta }));
    found.introduce(format!("{}: index of refraction {}", medium.name, medium.eta));
    found.table(FoundTable::from(lengths(&dipoles)).field("lengths"));
    let title = "R_d: exitance per mm^2, by the distance from the point where a flux of 1 enters";
    let mut table = Table::new(title, &["distance (mm)", "red", "green", "blue"]);
    let longest = dipoles.iter().map(Dipole::mean_free_path).fold(0.0, f64::max);
    for r in PATHS.map(|paths| paths * longest) {
        let rgb = dipoles.each_ref().map(|dipole| Cell::measured(dipole.r_d(r)));
        table.push([r.into()].into_iter().chain(rgb));
    }
    found.table(FoundTable::from(table).field("r_d"));
    found.table(FoundTable::from(sources(published)).field("sources"));
    Ok(found)
}

fn lengths(dipoles: &[Dipole; 3]) -> Table {
    let mut table = Table::new("Coefficients, lengths and totals", &["quantity", "unit", "red", "green", "blue"]);
    let mut row = |name: &str, unit: &str, of: &dyn Fn(&Dipole) -> Cell| {
        table.push([name.into(), unit.into()].into_iter().chain(dipoles.each_ref().map(of)));
    };
    row("sigma'_s, scattering", "1/mm", &|dipole| dipole.coefficients().sigma_s_prime.into());
    row("sigma_a, absorption", "1/mm", &|dipole| dipole.coefficients().sigma_a.into());
    row("alpha', albedo", "", &|dipole| Cell::decimals(dipole.alpha_prime(), 6));
    row("mean free path, z_r", "mm", &|dipole| Cell::measured(dipole.mean_free_path()));
    row("diffusion length, 1 / sigma_tr", "mm", &|dipole| Cell::measured(dipole.diffusion_length()));
    row("z_v, virtual source", "mm", &|dipole| Cell::measured(dipole.z_v()));
    row("R_d, total in closed form", "", &|dipole| Cell::decimals(dipole.total(), 6));
    row("R_d, integrated", "", &|dipole| Cell::decimals(dipole.integrated_total(), 6));
    for fraction in FRACTIONS {
        let name = format!("radius that holds {} %", fraction * 100.0);
        row(&name, "mm", &|dipole| Cell::measured(dipole.radius_of(fraction)));
    }
    table
}

fn sources(material: &PublishedMaterial) -> Table {
    let mut table = Table::new("Sources", &["figure", "value", "confidence", "source"]);
    let list = |figure: PublishedFigure<[f64; 3]>| figure.value.map(|value| value.to_string()).join(", ");
    let mut row = |name: &str, value: String, confidence: &str, source: &str| {
        table.push([name.into(), value.into(), confidence.into(), source.into()]);
    };
    for (name, figure) in [("sigma'_s", material.sigma_s_prime), ("sigma_a", material.sigma_a)] {
        row(name, list(figure), figure.confidence.word(), figure.source);
    }
    row("eta", material.eta.value.to_string(), material.eta.confidence.word(), material.eta.source);
    if let Some(figure) = material.reflectance {
        row("R_d printed", list(figure), figure.confidence.word(), figure.source);
    }
    table
}
