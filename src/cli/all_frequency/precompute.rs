//! `crossbar all-frequency precompute`: visibility at the vertices of a model.

use std::fmt::Display;
use std::io;
use std::ops::Range;
use std::path::{Component, Path, PathBuf, absolute};

use miette::IntoDiagnostic;
use serde_json::json;

use crate::all_frequency::Reflectance;
use crate::all_frequency::factor::ProductFactors;
use crate::all_frequency::file::{AllFrequencyFile, save_all_frequency};
use crate::cli::study::written;
use crate::cli::transfer::model::{ModelArgs, note_rays, note_vertices, refused};
use crate::cli::words::counted;
use crate::cli::{Problem, ProgressBar};
use crate::error::InputError;
use crate::geom::{Mesh, Sides};
use crate::io::{NumberTable, load_numbers, write_file, write_obj};
use crate::options::number;
use crate::report::Findings;
use crate::scene::built::ground::{ground_of, on_ground};
use crate::sphere::ParabolicMap;
use crate::transfer::file::MeshDigest;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::{SegmentCensus, VisibilityMaps};
use crate::transfer::{Tangents, Vertices};

/// Maximum size of an array of factors, in bytes.
const MAX_FACTORS: u64 = 256 << 20;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency precompute docs/examples/step.obj --out step.npz
      which directions each vertex sees, for light of all frequencies on a diffuse surface
  crossbar all-frequency precompute docs/examples/step.obj --ground 24 --out step.npz
      the same with a ground below the model, which `crossbar all-frequency render` and `card` draw with `--ground`

The file holds 98,304 bits of visibility per vertex, from which `crossbar all-frequency compress` computes the \
transfer.";

/// Compute what each vertex of a model sees, for light of all frequencies
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    #[command(flatten)]
    of: ModelArgs,

    /// A folder that `crossbar all-frequency factor` wrote, with view_factors.npy and light_factors.npy [default: a
    /// diffuse surface, which has one term]
    #[arg(long, value_name = "DIR")]
    reflectance: Option<PathBuf>,

    /// Put the model on a diffuse ground of N x N vertices; N is 192 in the paper. The ground's own file and model
    /// are written beside --out, with the endings ground.npz and ground.obj
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(2..=1024))]
    ground: Option<u32>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let path = args.of.out.as_path();
    let ground_model = path.with_extension("ground.obj");
    // No argument names this file, and the other two files would be written before it.
    let is_model = matches!((args.of.model.canonicalize(), ground_model.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if args.ground.is_some() && is_model {
        let what = format!("the model of the ground, {}, would overwrite the model", ground_model.display());
        return Err(Problem::usage(what, "give another `--out`").into());
    }
    let reflectance =
        args.reflectance.as_deref().map(load_factors).transpose()?.map_or(Reflectance::Diffuse, Reflectance::Factored);
    let (caster, model, vertices) = args.of.load(None)?;
    let ground = args.ground.map(|side| Ground::new(&model.mesh, side)).transpose()?;
    let joined = ground.as_ref().map(|ground| vertices.joined(&ground.vertices));
    let (count, all) = (vertices.len() as u32, joined.as_ref().unwrap_or(&vertices));
    let bar = ProgressBar::new("", 1).quicker("a model of fewer vertices");
    let scene = ground.as_ref().map_or(&model.mesh, |ground| &ground.scene);
    let mut caster = caster.open_judged(scene, Sides::Both)?;
    let mut maps = |of: Range<u32>| -> Result<VisibilityMaps, InputError> {
        let of: Vec<u32> = of.collect();
        let mut done = |done: usize, of: usize| bar.show("visibility".to_owned(), done as u64, of as u64);
        VisibilityMaps::trace(all, &of, &mut caster, &mut done)
    };
    let (of_model, of_ground) = (maps(0..count)?, maps(count..all.len() as u32)?);
    drop(bar);
    let mut found = Findings::new("Visibility");
    write_sight(&vertices, of_model, reflectance, (path, None), &mut found)?;
    note_vertices(&mut found, &vertices, &[]);
    caster.record().iter().for_each(|record| record.report(&mut found));
    let below = ground.as_ref().map(|ground| -> miette::Result<_> {
        let path = path.with_extension("ground.npz");
        let name = path_from(&path, &ground_model).into_diagnostic()?;
        let (maps, mut below) = (of_ground.counted_from(count), Findings::new("Visibility"));
        write_sight(&ground.vertices, maps, Reflectance::Diffuse, (&path, Some(name)), &mut below)?;
        write_file(&ground_model, |file| write_obj(&ground.mesh, file)).map_err(Problem::from)?;
        written(&mut below, [("model", Some(ground_model.as_path()))]);
        found.print("ground    below the model, diffuse".to_owned());
        below.printed_lines().iter().for_each(|line| found.print(line.clone()));
        Ok(below.plain_document())
    });
    let below = below.transpose()?;
    found.field("ground", json!(below));
    Ok(found)
}

struct Ground {
    mesh: Mesh,
    vertices: Vertices,
    scene: Mesh,
}

impl Ground {
    fn new(model: &Mesh, side: u32) -> miette::Result<Self> {
        let mesh = ground_of(model, side);
        let vertices = Vertices::new(&mesh, Tangents::Any).map_err(refused)?;
        let help = "give a model with fewer triangles, or choose a smaller `--ground`";
        let (scene, _) = on_ground(model, side).map_err(|error| Problem::usage(error.to_string(), help))?;
        Ok(Self { mesh, vertices, scene })
    }
}

/// Writes the visibility at the vertices of a model or its ground to a file, which may name its model.
fn write_sight(
    vertices: &Vertices,
    maps: VisibilityMaps,
    reflectance: Reflectance,
    (path, model): (&Path, Option<String>),
    found: &mut Findings,
) -> Result<(), Problem> {
    let (hats, terms, counts) = (BasisWidth::TwoTexels, reflectance.terms(), maps.counts.clone());
    let census = SegmentCensus::new(vertices, &maps, &LinearBasis::new(hats));
    let mesh = MeshDigest::new(vertices);
    let file = AllFrequencyFile { mesh, hats, reflectance, visibility: Some(maps), coded: None, model };
    save_all_frequency(&file, path)?;
    found.fields(json!({
        "vertices": vertices.len(), "terms": terms, "omega": census.omega(),
        "segments_below_horizon": { "least": census.least_below, "mean": census.mean_below() },
        "segments_shadowed": census.shadowed, "segments_nonempty": census.nonempty,
    }));
    found.print(format!("vertices  {}, {terms} terms of reflectance", counted(vertices.len())));
    note_rays(found, &counts);
    found.print(format!(
        "segments  {:.1} % have nonzero transfer; of the 24 segments, at least {} and on average {:.2} lie below a \
         vertex's horizon",
        100.0 * census.omega(),
        census.least_below,
        census.mean_below()
    ));
    if !counts.unclear.is_empty() {
        let count = counted(counts.unclear.len());
        found.print(format!("note      {count} vertices lie on triangles that face each other"));
    }
    written(found, [("out", Some(path))]);
    Ok(())
}

/// Relative path from a file's folder to another file.
pub(super) fn path_from(file: &Path, to: &Path) -> io::Result<String> {
    let [file, to] = [absolute(file)?, absolute(to)?];
    let (from, to) = (file.parent().unwrap_or(&file).components(), to.components());
    let shared = from.clone().zip(to.clone()).take_while(|(a, b)| a == b).count();
    let up = from.skip(shared).map(|_| Component::ParentDir);
    Ok(up.chain(to.skip(shared)).collect::<PathBuf>().to_string_lossy().into_owned())
}

/// Reads the factors that `crossbar all-frequency factor` wrote into a folder.
fn load_factors(folder: &Path) -> miette::Result<ProductFactors> {
    let [view, light] = ["view_factors.npy", "light_factors.npy"].map(|name| folder.join(name));
    let table = |path: &Path| load_numbers(path, "array of factors", MAX_FACTORS);
    let (view_table, light_table) = (table(&view)?, table(&light)?);
    let terms = view_table.columns;
    if light_table.columns != terms {
        let expected = format!("{terms} terms as in {}", view.display());
        return Err(no_factors(&light, &expected, light_table.columns).into());
    }
    Ok(ProductFactors::new(terms, map(&view, view_table)?, map(&light, light_table)?))
}

fn no_factors(path: &Path, expected: &str, found: impl Display) -> Problem {
    let what = format!("{}: expected {expected}, found {found}", path.display());
    Problem::usage(what, "give a folder that `crossbar all-frequency factor` wrote")
}

fn map(path: &Path, table: NumberTable<f64>) -> Result<(ParabolicMap, Vec<f64>), Problem> {
    let NumberTable { columns, values } = table;
    let texels = values.len() / columns.max(1);
    let side = texels.isqrt();
    if side == 0 || side * side != texels || columns == 0 {
        let found = format!("{texels} rows of {columns}");
        return Err(no_factors(path, "a row for each texel of a square map", found));
    }
    if columns > 1024 {
        return Err(no_factors(path, "at most 1024 terms", columns));
    }
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => Err(no_factors(path, "finite numbers", value)),
        None => Ok((ParabolicMap::new(side), values)),
    }
}
