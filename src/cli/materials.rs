//! `crossbar materials`: published media, and the dipole's totals for a medium.

use serde_json::json;

use super::{Out, Problem, Verdict, study};
use crate::error::InputError;
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

Coefficients are per mm, lengths in mm. The dipole is that of Jensen et al. 2001.";

/// Distances of the table, in units of the longest mean free path.
const PATHS: [f64; 6] = [0.0, 0.5, 1.0, 2.0, 5.0, 10.0];
/// Fractions of the light, for each of which a radius is shown.
const FRACTIONS: [f64; 3] = [0.5, 0.9, 0.99];

/// Show scattering media: coefficients, mean free paths, diffuse reflectance by distance
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A published medium; all of them if left out
    name: Option<String>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    match args.name.as_deref() {
        Some(name) => {
            let published = published(name)?;
            study::show(&one(&Shown::new(&published.material()).map_err(refused)?, published), out)
        }
        None => all(out),
    }
}

fn refused(error: InputError) -> Problem {
    Problem::usage(error.to_string(), "coefficients are per mm; `crossbar materials` shows published ones")
}

/// Looks up a published medium by name.
pub(super) fn published(name: &str) -> Result<&'static PublishedMaterial, Problem> {
    named(name).ok_or_else(|| {
        let names = MATERIALS.map(|material| material.name);
        let meant = did_you_mean(name, names);
        let help = format!("{meant}the media are {}", names.join(", "));
        Problem::usage(format!("there is no medium `{name}`"), help)
    })
}

/// A medium with its dipoles and distances.
struct Shown {
    name: String,
    eta: f64,
    dipoles: [Dipole; 3],
    at: [f64; 6],
}

impl Shown {
    fn new(material: &Material) -> Result<Self, InputError> {
        let [red, green, blue] = material.channels.map(|channel| Dipole::new(channel, material.eta));
        let dipoles = [red?, green?, blue?];
        let longest = dipoles.iter().map(Dipole::mean_free_path).fold(0.0, f64::max);
        let at = PATHS.map(|paths| paths * longest);
        Ok(Self { name: material.name.clone(), eta: material.eta, dipoles, at })
    }

    fn each(&self, of: impl Fn(&Dipole) -> f64) -> [f64; 3] {
        self.dipoles.each_ref().map(of)
    }
}

const RGB: [&str; 3] = ["red", "green", "blue"];

/// The published media side by side.
fn all(out: &mut Out) -> miette::Result<Verdict> {
    let columns =
        ["medium", "channel", "sigma'_s (1/mm)", "sigma_a (1/mm)", "eta", "path (mm)", "R_d total", "R_d printed"];
    let mut table = Table::new("Published media", &columns);
    for material in &MATERIALS {
        let shown = Shown::new(&material.material()).map_err(refused)?;
        for (c, dipole) in shown.dipoles.iter().enumerate() {
            let printed = material.reflectance.map_or(Cell::Empty, |figure| Cell::decimals(figure.value[c], 2));
            table.push([
                shown.name.as_str().into(),
                RGB[c].into(),
                dipole.coefficients().sigma_s_prime.into(),
                dipole.coefficients().sigma_a.into(),
                shown.eta.into(),
                Cell::measured(dipole.mean_free_path()),
                Cell::decimals(dipole.total(), 4),
                printed,
            ]);
        }
    }
    if out.json() {
        out.document(&table.json())?;
        return Ok(Verdict::Done);
    }
    out.table(&table)?;
    out.line("")?;
    out.sentence("`crossbar materials NAME` shows lengths, R_d by distance and sources of one.")?;
    Ok(Verdict::Done)
}

/// All findings about one medium.
fn one(shown: &Shown, published: &PublishedMaterial) -> Findings {
    let mut found = Findings::new(shown.name.as_str());
    found.fields(json!({ "name": shown.name, "eta": shown.eta }));
    found.introduce(format!("{}: index of refraction {}", shown.name, shown.eta));
    found.table(FoundTable::from(lengths(shown)).field("lengths"));
    let title = "R_d: exitance at a distance from where a flux of 1 enters, per mm^2";
    let mut table = Table::new(title, &["distance (mm)", "red", "green", "blue"]);
    for &r in &shown.at {
        let [red, green, blue] = shown.each(|dipole| dipole.r_d(r)).map(Cell::measured);
        table.push([r.into(), red, green, blue]);
    }
    found.table(FoundTable::from(table).field("r_d"));
    found.table(FoundTable::from(sources(published)).field("sources"));
    found
}

fn lengths(shown: &Shown) -> Table {
    let mut table = Table::new("Coefficients, lengths and totals", &["quantity", "unit", "red", "green", "blue"]);
    let mut row = |name: &str, unit: &str, values: [f64; 3], cell: fn(f64) -> Cell| {
        let [red, green, blue] = values.map(cell);
        table.push([name.into(), unit.into(), red, green, blue]);
    };
    row("sigma'_s, scattering", "1/mm", shown.each(|dipole| dipole.coefficients().sigma_s_prime), Cell::from);
    row("sigma_a, absorption", "1/mm", shown.each(|dipole| dipole.coefficients().sigma_a), Cell::from);
    row("alpha', albedo", "", shown.each(Dipole::alpha_prime), |value| Cell::decimals(value, 6));
    row("mean free path, z_r", "mm", shown.each(Dipole::mean_free_path), Cell::measured);
    row("diffusion length, 1 / sigma_tr", "mm", shown.each(Dipole::diffusion_length), Cell::measured);
    row("z_v, virtual source", "mm", shown.each(Dipole::z_v), Cell::measured);
    row("R_d, total in closed form", "", shown.each(Dipole::total), |value| Cell::decimals(value, 6));
    row("R_d, integrated", "", shown.each(Dipole::integrated_total), |value| Cell::decimals(value, 6));
    for fraction in FRACTIONS {
        let name = format!("radius that holds {} %", fraction * 100.0);
        row(&name, "mm", shown.each(|dipole| dipole.radius_of(fraction)), Cell::measured);
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
