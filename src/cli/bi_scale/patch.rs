//! Patches of a surface by name or from a file of heights.

use std::path::Path;

use crate::bi_scale::texture::{HeightField, MesoMaterial, MesoPatch, MesoTexel, PatchKind};
use crate::cli::transfer::values::BrdfArg;
use crate::cli::{Problem, given, view};
use crate::io::{PictureFile, load_numbers};
use crate::names::did_you_mean;
use crate::options::number;

/// The name of a patch without relief.
const PLAIN: &str = "plain";
/// Longest table of heights that is read, in bytes (1 GiB).
const MAX_BYTES: u64 = 1 << 30;
/// Depth of a picture's white above its black, in edges of the patch.
const PICTURE_DEPTH: f64 = 0.1;
/// Reflectance of heights from a file.
const COLOR: [f32; 3] = [0.5; 3];

/// How a patch is made.
#[derive(Debug, clap::Args)]
pub(super) struct PatchArgs {
    /// How many times as deep the heights are; of a picture white lies a tenth of the patch's edge above black
    /// [default: 1]
    #[arg(long, value_name = "X", value_parser = number::not_negative)]
    relief: Option<f64>,

    /// Color of `plain` and of heights from a file: R,G,B from 0 to 1 [default: 0.5,0.5,0.5, or 1,1,1 with --brdf]
    #[arg(long, value_name = "R,G,B", value_parser = color, allow_hyphen_values = true)]
    color: Option<[f32; 3]>,

    /// Reflectance of `plain` and of heights from a file, times the color; see `crossbar bi-scale precompute --help`
    /// [default: the same in all directions]
    #[arg(long, value_name = "BRDF")]
    brdf: Option<BrdfArg>,
}

fn color(text: &str) -> Result<[f32; 3], String> {
    number::three(text, "R,G,B")
}

impl PatchArgs {
    /// The patch of a name, or of a file of heights.
    pub(super) fn patch(&self, source: &Path) -> miette::Result<MesoPatch> {
        let name = source.to_str().unwrap_or_default();
        if let Ok(kind) = name.parse::<PatchKind>() {
            if self.color.is_some() || self.brdf.is_some() {
                let what = format!("`--color` and `--brdf` are for `plain` and files of heights, found `{name}`");
                return Err(Problem::usage(what, "leave them out").into());
            }
            self.check_relief(kind.patch(1.0).heights().depth())?;
            Ok(kind.patch(self.relief()))
        } else if name == PLAIN {
            given::refuse(
                [("--relief", self.relief.is_some())],
                "patches with heights, found `plain`",
                "leave it out",
            )?;
            Ok(MesoPatch::plain(self.material()?).map_err(refused)?)
        } else {
            self.of_file(source)
        }
    }

    fn relief(&self) -> f64 {
        self.relief.unwrap_or(1.0)
    }

    fn material(&self) -> Result<MesoMaterial, Problem> {
        let color = |default: [f32; 3]| self.color.unwrap_or(default).map(f64::from);
        let material = match self.brdf {
            None => MesoMaterial::diffuse(color(COLOR)),
            Some(BrdfArg(brdf)) => MesoMaterial { color: [0.0; 3], lobe: Some(brdf), lobe_color: color([1.0; 3]) },
        };
        material.check().map_err(refused)?;
        Ok(material)
    }

    /// Heights from a table of numbers, in edges of the patch, or from a picture's mean of channels.
    fn of_file(&self, path: &Path) -> miette::Result<MesoPatch> {
        let name = path.to_str().unwrap_or_default();
        if !path.exists() && path.components().count() == 1 && !name.contains('.') {
            let names: Vec<String> = names().collect();
            let meant = did_you_mean(name, names.iter().map(String::as_str));
            let help = format!("{meant}there are {}; a file needs its ending, as in `{name}.png`", names.join(", "));
            return Err(Problem::usage(format!("there is no patch `{name}`"), help).into());
        }
        let is_table = ["csv", "npy", "txt"]
            .iter()
            .any(|known| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known)));
        let (columns, heights) = if is_table {
            view::require_file(path, 8, "name a smaller table")?;
            let table = load_numbers::<f64>(path, "table of heights", MAX_BYTES)?;
            (table.columns, table.values.iter().map(|height| height * self.relief()).collect())
        } else {
            let file = PictureFile::open(path)?;
            let [side, rows] = [file.size().width, file.size().height].map(|side| side as usize);
            HeightField::check_side(side.max(rows)).map_err(|error| no_heights(path, &error))?;
            view::require_picture(path, &file)?;
            let picture = file.decode()?;
            let linear = picture.linear().map_err(|error| no_heights(path, &error))?;
            let mean = |rgb: &[f32; 3]| rgb.iter().map(|&value| f64::from(value)).sum::<f64>() / 3.0;
            let heights: Vec<f64> = linear.iter().map(|rgb| PICTURE_DEPTH * self.relief() * mean(rgb)).collect();
            (picture.width() as usize, heights)
        };
        let rows = heights.len() / columns.max(1);
        if rows != columns {
            let what = format!("{}: expected as many rows as columns, found {columns} x {rows}", path.display());
            return Err(Problem::usage(what, "cut a square out of it").into());
        }
        let heights = HeightField::new(columns, &heights).map_err(|error| no_heights(path, &error))?;
        let texels = vec![MesoTexel::default(); columns * columns];
        Ok(MesoPatch::new(heights, vec![self.material()?], texels).map_err(refused)?)
    }

    fn check_relief(&self, depth: f64) -> Result<(), Problem> {
        if self.relief() * depth <= HeightField::DEEPEST {
            return Ok(());
        }
        let what =
            format!("expected a patch at most {} edges deep, found {}", HeightField::DEEPEST, self.relief() * depth);
        Err(Problem::usage(what, "lower `--relief`"))
    }
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
