//! `crossbar cpca precompute`: transfer at the vertices of a model.

use clap::ValueEnum;
use serde_json::json;

use crate::cli::materials::published;
use crate::cli::model_name::Model;
use crate::cli::study::written;
use crate::cli::transfer::model::{ModelArgs, note_vertices};
use crate::cli::transfer::values::brdf;
use crate::cli::words::{counted, measured};
use crate::cli::{Problem, ProgressBar, given};
use crate::cpca::transfer::{Incident, ScatteringOptions, TransferCounts};
use crate::geom::Sides;
use crate::options::number;
use crate::options::one_of::{OneOf, one_of};
use crate::report::Findings;
use crate::scene::Material;
use crate::study::prt::{ExitRadiance, Precomputation, Precomputed, Scatterer};
use crate::subsurface::Dipole;
use crate::transfer::Vertices;
use crate::transfer::brdf::{Brdf, ExitBasis};
use crate::transfer::file::save_prt;

const EXAMPLES: &str = "\
Examples:
  crossbar cpca precompute docs/examples/step.obj --out step.npz
      diffuse transfer with shadows, for light of order 5 and the materials of the file
  crossbar cpca precompute docs/examples/step.obj --kind glossy --rows 24 --brdf phong:0.2,0.6,20 --bounces 2 --out step.npz
      matrices of 24 x 25 numbers, with two bounces and one glossy material
  crossbar cpca precompute transfer-bird --kind glossy --brdf ward:0.1,0.3,0.1,0.4 --tangents texture --out bird.npz
      the stand-in for the paper's bird, with an anisotropic material along the texture; takes about a minute
  crossbar cpca precompute docs/examples/step.obj --brdf lambert:0 --material marble --mm-per-unit 10 --channels rgb --out step.npz
      light that scatters below the surface, in three channels

The file holds a matrix of 32-bit floats per vertex: `crossbar cpca compress` makes it smaller. The file is \
written at the end: an interrupted run leaves no file and cannot be resumed.";

/// Order of incident radiance in harmonics, as in the paper.
const INCIDENT_ORDER: usize = 5;
/// The solid angle, in steradians, below which scattering vertices count as one point.
const SOLID_ANGLE: f64 = 0.05;

/// Kind of transfer at a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum KindArg {
    /// A vector per vertex: the same radiance in all directions
    Diffuse,
    /// A matrix per vertex: radiance by direction
    Glossy,
}

/// Precompute how each vertex of a model transfers distant light
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    #[command(flatten)]
    of: ModelArgs,

    /// Kind of transfer at a vertex
    #[arg(long, value_enum, value_name = "KIND", default_value = "diffuse")]
    kind: KindArg,

    /// Order n of the light, which has n x n functions
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = number::whole::<u8>(1..=10))]
    order: u8,

    /// Number of functions of exit radiance, for --kind glossy: a square such as 16 or 25, or one less than a square
    /// (such as 24), which omits the function l = 1, m = 0 [default: 25]
    #[arg(long, value_name = "COUNT", value_parser = rows)]
    rows: Option<ExitBasis>,

    /// One reflectance for the whole model: lambert:A, phong:A,S,EXPONENT, cook-torrance:A,S,ROUGHNESS,F0,
    /// schlick:A,S,ROUGHNESS,ISOTROPY,F0, ward:A,S,X,Y or ashikhmin-shirley:A,S,U,V with albedo A and specular
    /// reflectance S [default: the model's materials]
    #[arg(long, value_name = "BRDF", value_parser = brdf)]
    brdf: Option<Brdf>,

    /// A published medium below the surface, which adds scattered light: see `crossbar materials`
    #[arg(long, value_name = "NAME", requires = "mm_per_unit")]
    material: Option<String>,

    /// Millimeters per unit of the model, for --material
    #[arg(long, value_name = "MM", value_parser = number::positive, requires = "material")]
    mm_per_unit: Option<f64>,

    /// Channels of transfer
    #[arg(long, value_name = "C", default_value = "scalar", value_parser = channels_of())]
    channels: &'static [usize],

    /// Size D of the quadrature over each hemisphere, 18 to 255. From 40 on, it has D / 2 + 1 rings of D + 2
    /// directions at different heights; below 40, rings of D + 1 directions, each ring at one height
    #[arg(long, value_name = "D", default_value_t = 44, value_parser = number::whole::<u16>(18..=255))]
    degree: u16,

    /// Number of interreflections before the reflection towards the eye
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = number::whole::<u32>(0..=100))]
    bounces: u32,
}

/// Values of `--channels`: the channels of transfer; red, green and blue are 0, 1 and 2.
fn channels_of() -> OneOf<&'static [usize]> {
    let scalar = ("scalar", "One channel, with the reflectances of green", &[1][..]);
    one_of([scalar, ("rgb", "Red, green and blue", &[0, 1, 2])])
}

/// Functions of exit radiance by their number: all functions of an order, or all but (1, 0).
fn rows(text: &str) -> Result<ExitBasis, String> {
    let count: usize = text.trim().parse().unwrap_or(0);
    let basis = (1..=10).find_map(|order| match order * order {
        all if all == count => Some(ExitBasis::of_order(order)),
        all if all == count + 1 => ExitBasis::without_1_0(order).ok(),
        _ => None,
    });
    basis.ok_or_else(|| {
        format!("expected a square from 1 to 100, or one less than a square from 4 on (without l = 1, m = 0), found `{text}`")
    })
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let exit = exit(args)?;
    let scatterer = scatterer(args)?;
    let (caster, model, vertices) = args.of.load(None)?;
    let precomputation = Precomputation {
        mesh: &model.mesh,
        vertices: &vertices,
        channels: channels(args, &model)?,
        exit,
        order: usize::from(args.order),
        degree: usize::from(args.degree),
        bounces: args.bounces,
        scatterer,
    };
    let bar = ProgressBar::new("", 1).quicker("a lower `--degree` or `--order`, fewer `--bounces`");
    let mut caster = caster.open_judged(&model.mesh, Sides::Both)?;
    let found = precomputation.run_by(&mut caster, &mut |what, done, of| bar.show(what.to_owned(), done, of))?;
    save_prt(&found.file, &args.of.out).map_err(Problem::from)?;
    let mut findings = findings(args, &vertices, &found);
    if let Some(record) = caster.record() {
        let host = precomputation.run(&mut |what, done, of| bar.show(format!("{what} of the host"), done, of))?;
        let (differing, off) = found.off(&host);
        record.report(&mut findings);
        findings.field("off_host", json!({ "coefficients": differing, "relative_rms": off }));
        let [differing, off] = [counted(differing as usize), measured(off)];
        findings.print(format!(
            "engine: {differing} coefficients differ from those by the host's rays; the relative RMS difference is \
             {off}"
        ));
    }
    Ok(findings)
}

fn exit(args: &Args) -> Result<ExitRadiance, Problem> {
    if args.kind == KindArg::Diffuse {
        given::refuse([("--rows", args.rows.is_some())], "glossy transfer", "remove `--rows`, or add `--kind glossy`")?;
        return Ok(ExitRadiance::Diffuse);
    }
    let incident = Incident::Harmonics { order: INCIDENT_ORDER, inverse: true };
    let basis = args.rows.clone().unwrap_or_else(|| ExitBasis::of_order(5));
    Ok(ExitRadiance::Glossy { basis, least_squares: true, incident })
}

fn scatterer(args: &Args) -> miette::Result<Option<Scatterer>> {
    let (Some(name), Some(mm_per_unit)) = (&args.material, args.mm_per_unit) else { return Ok(None) };
    let medium = published(name)?.material();
    let dipole = |channel: usize| Dipole::new(medium.channels[channel], medium.eta);
    let dipoles = dipole(0).and_then(|red| Ok([red, dipole(1)?, dipole(2)?]));
    let dipoles = dipoles.map_err(|error| Problem::usage(error.to_string(), "see `crossbar materials`"))?;
    Ok(Some(Scatterer { dipoles, options: ScatteringOptions { mm_per_unit, solid_angle: SOLID_ANGLE } }))
}

/// For each channel, a BRDF of each material.
fn channels(args: &Args, model: &Model) -> Result<Vec<(usize, Vec<Brdf>)>, Problem> {
    let brdf = |channel: usize, material: &Material| {
        let of_surface = || Brdf::of_surface(&material.surface, channel);
        args.brdf.map_or_else(of_surface, Ok).map_err(|error| {
            let what = format!("material `{}`: {error}", material.name);
            Problem::usage(what, "give a `--brdf` for the whole model")
        })
    };
    let of = |&channel: &usize| {
        let brdfs: Result<Vec<Brdf>, Problem> =
            model.materials.iter().map(|material| brdf(channel, material)).collect();
        brdfs.map(|brdfs| (channel, brdfs))
    };
    args.channels.iter().map(of).collect()
}

fn findings(args: &Args, vertices: &Vertices, made: &Precomputed) -> Findings {
    let dimension = made.file.meaning.dimension().unwrap_or(0);
    let TransferCounts { rays, traced, blocked, below_horizon, from_behind, dark, buried, unclear } = &made.counts;
    let mut found = Findings::new("Transfer");
    found.fields(json!({
        "vertices": vertices.len(), "numbers_per_vertex": dimension,
        "directions": made.directions, "rays": rays, "rays_traced": traced, "rays_blocked": blocked,
        "rays_below_horizon": below_horizon, "rays_from_behind": from_behind, "dark_vertices": dark,
        "buried_vertices": buried, "unclear_vertices": unclear, "bounces": made.bounces,
    }));
    found.print(format!("vertices  {}, {} numbers each", counted(vertices.len()), counted(dimension)));
    let [rays, traced, blocked] = [rays, traced, blocked].map(|&count| counted(count as usize));
    let directions = made.directions;
    found.print(format!("rays      {rays}: {directions} directions per vertex; {traced} traced, {blocked} blocked"));
    for (channel, shares) in made.bounces.iter().enumerate().filter(|(_, shares)| !shares.is_empty()) {
        let shares: Vec<String> = shares.iter().map(|share| measured(*share)).collect();
        found.print(format!(
            "bounces   channel {channel}: RMS of {} relative to the direct transfer",
            shares.join(", ")
        ));
    }
    let more = [
        (buried.len(), "vertices lie inside a solid: all their rays are blocked, mostly from behind"),
        (dark.len() - buried.len().min(dark.len()), "more vertices see no sky at all"),
        (unclear.len(), "vertices lie on triangles that face each other"),
    ];
    note_vertices(&mut found, vertices, &more);
    written(&mut found, [("out", Some(args.of.out.as_path()))]);
    found
}
