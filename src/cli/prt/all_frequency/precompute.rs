//! `crossbar prt precompute --kind all-frequency`: what the vertices of a model see.

use std::path::Path;

use serde_json::json;

use crate::cli::prt::model::{load, refused, vertices};
use crate::cli::prt::values::{HatsArg, TangentsArg};
use crate::cli::words::counted;
use crate::cli::{Out, Problem, ProgressBar, memory};
use crate::io::{NumberTable, load_numbers};
use crate::prt::all_frequency::Reflectance;
use crate::prt::all_frequency::factor::ProductFactors;
use crate::prt::all_frequency::hats::HatWidth;
use crate::prt::all_frequency::visibility::VISIBILITY_BYTES;
use crate::prt::file::save_all_frequency;
use crate::sphere::ParabolicMap;
use crate::study::prt::SightOfModel;

/// Longest array of factors, in bytes.
const MAX_FACTORS: u64 = 256 << 20;
/// Memory of rays that wait to be cast, and of the tree, in bytes.
const RAYS: u64 = 128 << 20;

pub(in crate::cli::prt) fn run(
    (model, tangents): (&Path, TangentsArg),
    factors: Option<&Path>,
    hats: HatsArg,
    path: &Path,
    out: &mut Out,
) -> miette::Result<()> {
    let reflectance = factors.map(load_factors).transpose()?.map_or(Reflectance::Diffuse, Reflectance::Factored);
    let model = load(model, tangents.0)?;
    let vertices = vertices(&model, tangents.0)?;
    let maps = (VISIBILITY_BYTES + 200) as u64 * vertices.len() as u64;
    let what = format_args!("visibility of {} vertices, {VISIBILITY_BYTES} bytes each", vertices.len());
    memory::require(what, maps + RAYS + 100 * model.mesh.len() as u64, "name a model of fewer vertices")?;
    let hats = if hats == HatsArg::One { HatWidth::OneTexel } else { HatWidth::TwoTexels };
    let bar = ProgressBar::new("", 1);
    let sight = SightOfModel { mesh: &model.mesh, vertices: &vertices, hats, reflectance };
    let (file, census) = sight.run(&mut |what, done, of| bar.show(what.to_owned(), done, of)).map_err(refused)?;
    save_all_frequency(&file, path).map_err(Problem::from)?;
    drop(bar);
    let counts = file.visibility.as_ref().map(|maps| maps.counts.clone()).unwrap_or_default();
    let terms = file.reflectance.terms();
    if out.json() {
        return Ok(out.document(&json!({
            "out": path, "vertices": vertices.len(), "unused_vertices": vertices.unused, "terms": terms,
            "replaced_tangents": vertices.replaced_tangents, "omega": census.omega(),
            "segments_below_horizon": { "least": census.least_below, "mean": census.mean_below() },
            "segments_shadowed": census.shadowed, "segments_nonempty": census.nonempty,
            "directions_above": counts.above, "rays_traced": counts.traced, "directions_visible": counts.visible,
            "unclear_vertices": counts.unclear,
        }))?);
    }
    out.line(format_args!("vertices  {}, {terms} terms of reflectance", counted(vertices.len())))?;
    let [above, traced, visible] = [counts.above, counts.traced, counts.visible].map(|count| counted(count as usize));
    out.sentence(format_args!(
        "rays      {traced} traced; {visible} of {above} directions above the horizon see light"
    ))?;
    out.sentence(format_args!(
        "segments  {:.1} % hold transfer; of 24, at least {} and on average {:.2} lie below the horizon",
        100.0 * census.omega(),
        census.least_below,
        census.mean_below()
    ))?;
    for (count, what) in [
        (vertices.unused, "vertices of the model belong to no triangle and were left out"),
        (vertices.replaced_tangents.len(), "vertices had no tangent across their normal and got any"),
        (counts.unclear.len(), "vertices lie on triangles that face each other"),
    ] {
        if count > 0 {
            out.sentence(format_args!("note      {} {what}", counted(count)))?;
        }
    }
    out.line(format_args!("written   {}", path.display()))?;
    Ok(())
}

/// What `crossbar prt factor` wrote into a folder.
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
        return Err(Problem::usage(what, "name a folder that `crossbar prt factor` wrote").into());
    }
    Ok(ProductFactors::new(terms, map(&view, view_table)?, map(&light, light_table)?))
}

fn map(path: &Path, table: NumberTable) -> Result<(ParabolicMap, Vec<f64>), Problem> {
    let texels = table.values.len() / table.columns.max(1);
    let wrong = |expected: &str, found: String| {
        let what = format!("{}: expected {expected}, found {found}", path.display());
        Problem::usage(what, "name a folder that `crossbar prt factor` wrote")
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
    Ok((ParabolicMap::new(side), table.values.into_iter().map(f64::from).collect()))
}
