//! Surface patches, by name or from a height file.

use std::path::Path;

use crate::bi_scale::texture::{HeightField, MesoMaterial, MesoPatch, MesoTexel, PatchKind};
use crate::cli::{Problem, given};
use crate::io::{load_numbers, load_picture};

/// The name of a patch without relief.
const PLAIN: &str = "plain";
/// Maximum length of a table of heights, in bytes (1 GiB).
const MAX_BYTES: u64 = 1 << 30;
/// Height of white above black in a picture, in edges of the patch.
const PICTURE_DEPTH: f64 = 0.1;
/// Reflectance of `plain` and of patches from a file.
const COLOR: [f64; 3] = [0.5; 3];

/// Loads a patch by its name, or from a file of heights.
pub(super) fn patch_of(source: &Path) -> miette::Result<MesoPatch> {
    let name = source.to_str().unwrap_or_default();
    if let Ok(kind) = name.parse::<PatchKind>() {
        return Ok(kind.patch(1.0));
    }
    if name == PLAIN { Ok(MesoPatch::plain(material()?).map_err(refused)?) } else { of_file(source) }
}

fn material() -> Result<MesoMaterial, Problem> {
    let material = MesoMaterial::diffuse(COLOR);
    material.check().map_err(refused)?;
    Ok(material)
}

/// Heights from a table of numbers, in edges of the patch, or from the mean of a picture's channels.
fn of_file(path: &Path) -> miette::Result<MesoPatch> {
    let names: Vec<String> = names().collect();
    given::require_file(path, "patch", &names.iter().map(String::as_str).collect::<Vec<_>>(), "png")?;
    let is_table = ["csv", "npy", "txt"]
        .iter()
        .any(|known| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known)));
    let (columns, heights) = if is_table {
        let table = load_numbers::<f64>(path, "table of heights", MAX_BYTES)?;
        (table.columns, table.values)
    } else {
        let picture = load_picture(path)?;
        let [side, rows] = [picture.width(), picture.height()].map(|side| side as usize);
        HeightField::check_side(side.max(rows)).map_err(|error| no_heights(path, &error))?;
        let linear = picture.linear().map_err(|error| no_heights(path, &error))?;
        let mean = |rgb: &[f32; 3]| rgb.iter().map(|&value| f64::from(value)).sum::<f64>() / 3.0;
        let heights: Vec<f64> = linear.iter().map(|rgb| PICTURE_DEPTH * mean(rgb)).collect();
        (picture.width() as usize, heights)
    };
    let rows = heights.len() / columns.max(1);
    if rows != columns {
        let what = format!("{}: expected as many rows as columns, found {columns} x {rows}", path.display());
        return Err(Problem::usage(what, "cut a square out of it").into());
    }
    let heights = HeightField::new(columns, &heights).map_err(|error| no_heights(path, &error))?;
    let texels = vec![MesoTexel::default(); columns * columns];
    Ok(MesoPatch::new(heights, vec![material()?], texels).map_err(refused)?)
}

/// The names of patches.
pub(super) fn names() -> impl Iterator<Item = String> {
    PatchKind::ALL.iter().map(PatchKind::to_string).chain([PLAIN.to_owned()])
}

fn refused(error: impl std::fmt::Display) -> Problem {
    Problem::usage(error.to_string(), "see `crossbar bi-scale texture --help`")
}

fn no_heights(path: &Path, error: &dyn std::fmt::Display) -> Problem {
    Problem::usage(format!("{}: {error}", path.display()), "see `crossbar bi-scale texture --help`")
}
