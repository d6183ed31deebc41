//! `crossbar all-frequency precompute`: visibility at the vertices of a model.

use std::path::{Path, PathBuf};

use miette::IntoDiagnostic;
use refsim::machine::ExecutorKind;
use serde_json::json;

use super::file::path_from;
use crate::all_frequency::Reflectance;
use crate::all_frequency::factor::ProductFactors;
use crate::all_frequency::file::save_all_frequency;
use crate::cli::model_name::transfer_model_help;
use crate::cli::study::written;
use crate::cli::transfer::model::{load, note_vertices, refused, vertices};
use crate::cli::transfer::values::TangentsArg;
use crate::cli::words::counted;
use crate::cli::{Problem, ProgressBar};
use crate::geom::{Mesh, Sides};
use crate::io::{NumberTable, load_numbers, write_file, write_obj};
use crate::options::number;
use crate::report::Findings;
use crate::scene::built::ground::{ground_of, on_ground};
use crate::sphere::ParabolicMap;
use crate::study::caster::CasterOptions;
use crate::study::prt::{FoundSight, SightOfModel};
use crate::transfer::linear_basis::BasisWidth;
use crate::transfer::{Tangents, Vertices};

/// Maximum size of an array of factors, in bytes.
const MAX_FACTORS: u64 = 256 << 20;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency precompute docs/examples/step.obj --out step.npz
      what each vertex sees, for light of all frequencies on a diffuse surface
  crossbar all-frequency precompute docs/examples/step.obj --ground 24 --out step.npz
      the same on a ground, which `crossbar all-frequency render` and `card` draw with their `--ground`

The file holds 98,304 bits per vertex: `crossbar all-frequency compress` makes transfer of them.";

/// Compute what each vertex of a model sees, for light of all frequencies
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    // Names come from the one list of built models, `meshes`.
    #[arg(value_name = "MODEL", help = transfer_model_help())]
    model: PathBuf,

    /// Output of `crossbar all-frequency factor`: view_factors.npy and light_factors.npy in a folder [default: the one
    /// term of a diffuse surface]
    #[arg(long, value_name = "DIR")]
    reflectance: Option<PathBuf>,

    /// Put the model on a diffuse ground of N x N vertices; the paper has 192. Written beside --out, with the endings
    /// ground.npz and ground.obj: the ground's own file and its model
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(2..=1024))]
    ground: Option<u32>,

    /// Where the tangents of local frames come from: `any`, `texture` (a file's materials are not read then), or an
    /// axis X,Y,Z
    #[arg(long, value_name = "FROM", default_value = "any", allow_hyphen_values = true)]
    tangents: TangentsArg,

    /// The file to write
    #[arg(long, value_name = "X.npz")]
    out: PathBuf,

    #[command(flatten)]
    caster: CasterOptions,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let (tangents, path) = (args.tangents.0, args.out.as_path());
    let caster = args.caster.choose(ExecutorKind::Batch.into())?;
    let reflectance =
        args.reflectance.as_deref().map(load_factors).transpose()?.map_or(Reflectance::Diffuse, Reflectance::Factored);
    let model = load(&args.model, tangents)?;
    let vertices = vertices(&model, tangents)?;
    let ground = args.ground.map(|side| Ground::new(&model.mesh, side)).transpose()?;
    let bar = ProgressBar::new("", 1).quicker("a model of fewer vertices");
    let sight = SightOfModel {
        scene: ground.as_ref().map_or(&model.mesh, |ground| &ground.scene),
        vertices: &vertices,
        hats: BasisWidth::TwoTexels,
        reflectance,
        ground: ground.as_ref().map(|ground| &ground.vertices),
    };
    let mut caster = caster.open_judged(sight.scene, Sides::Both)?;
    let (found, mut below) = sight.run(&mut caster, &mut |what, done, of| bar.show(what.to_owned(), done, of))?;
    save_all_frequency(&found.file, path).map_err(Problem::from)?;
    let [ground_path, ground_mesh] = ["ground.npz", "ground.obj"].map(|ending| path.with_extension(ending));
    if let (Some(ground), Some(below)) = (&ground, &mut below) {
        below.file.model = Some(path_from(&ground_path, &ground_mesh).into_diagnostic()?);
        save_all_frequency(&below.file, &ground_path).map_err(Problem::from)?;
        write_file(&ground_mesh, |file| write_obj(&ground.mesh, file)).map_err(Problem::from)?;
    }
    drop(bar);
    let mut findings = findings(&found, path);
    note_vertices(&mut findings, &vertices, &[]);
    caster.record().iter().for_each(|record| record.report(&mut findings));
    let below = below.map(|below| {
        let mut below = self::findings(&below, &ground_path);
        written(&mut below, [("model", Some(ground_mesh.as_path()))]);
        findings.print("ground    below the model, diffuse".to_owned());
        below.printed_lines().iter().for_each(|line| findings.print(line.clone()));
        below.plain_document()
    });
    findings.field("ground", json!(below));
    Ok(findings)
}

/// A ground below a model.
struct Ground {
    mesh: Mesh,
    vertices: Vertices,
    /// The model on it.
    scene: Mesh,
}

impl Ground {
    fn new(model: &Mesh, side: u32) -> miette::Result<Self> {
        let mesh = ground_of(model, side);
        let vertices = Vertices::new(&mesh, Tangents::Any).map_err(refused)?;
        let help = "name a model of fewer triangles, or a smaller ground";
        let (scene, _) = on_ground(model, side).map_err(|error| Problem::usage(error.to_string(), help))?;
        Ok(Self { mesh, vertices, scene })
    }
}

fn findings(sight: &FoundSight, path: &Path) -> Findings {
    let FoundSight { file, census } = sight;
    let counts = file.visibility.as_ref().map(|maps| maps.counts.clone()).unwrap_or_default();
    let terms = file.reflectance.terms();
    let mut found = Findings::new("Visibility");
    found.fields(json!({
        "vertices": file.mesh.vertices, "terms": terms, "omega": census.omega(),
        "segments_below_horizon": { "least": census.least_below, "mean": census.mean_below() },
        "segments_shadowed": census.shadowed, "segments_nonempty": census.nonempty,
        "directions_above": counts.above, "rays_traced": counts.traced, "directions_visible": counts.visible,
        "unclear_vertices": counts.unclear,
    }));
    found.print(format!("vertices  {}, {terms} terms of reflectance", counted(file.mesh.vertices as usize)));
    let [above, traced, visible] = [counts.above, counts.traced, counts.visible].map(|count| counted(count as usize));
    found.print(format!("rays      {traced} traced; {visible} of {above} directions above the horizon see light"));
    found.print(format!(
        "segments  {:.1} % hold transfer; of 24, at least {} and on average {:.2} lie below the horizon",
        100.0 * census.omega(),
        census.least_below,
        census.mean_below()
    ));
    if !counts.unclear.is_empty() {
        let count = counted(counts.unclear.len());
        found.print(format!("note      {count} vertices lie on triangles that face each other"));
    }
    written(&mut found, [("out", Some(path))]);
    found
}

/// Reads the factors that `crossbar all-frequency factor` wrote into a folder.
fn load_factors(folder: &Path) -> miette::Result<ProductFactors> {
    let [view, light] = ["view_factors.npy", "light_factors.npy"].map(|name| folder.join(name));
    let table = |path: &Path| load_numbers(path, "array of factors", MAX_FACTORS);
    let (view_table, light_table) = (table(&view)?, table(&light)?);
    let terms = view_table.columns;
    if light_table.columns != terms {
        let what = format!(
            "{}: expected {terms} terms as in {}, found {}",
            light.display(),
            view.display(),
            light_table.columns
        );
        return Err(Problem::usage(what, "name a folder that `crossbar all-frequency factor` wrote").into());
    }
    Ok(ProductFactors::new(terms, map(&view, view_table)?, map(&light, light_table)?))
}

fn map(path: &Path, table: NumberTable<f64>) -> Result<(ParabolicMap, Vec<f64>), Problem> {
    let texels = table.values.len() / table.columns.max(1);
    let wrong = |expected: &str, found: String| {
        let what = format!("{}: expected {expected}, found {found}", path.display());
        Problem::usage(what, "name a folder that `crossbar all-frequency factor` wrote")
    };
    let side = texels.isqrt();
    if side == 0 || side * side != texels || table.columns == 0 {
        return Err(wrong("a row for each texel of a square map", format!("{texels} rows of {}", table.columns)));
    }
    if table.columns > 1024 {
        return Err(wrong("at most 1024 terms", table.columns.to_string()));
    }
    if let Some(value) = table.values.iter().find(|value| !value.is_finite()) {
        return Err(wrong("finite numbers", value.to_string()));
    }
    Ok((ParabolicMap::new(side), table.values))
}
