//! `crossbar all-frequency lighting`: light as coefficients of Haar wavelets.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde_json::json;

use super::file::FileOfModel;
use crate::all_frequency::transfer::transfer_of;
use crate::cli::study::written;
use crate::cli::transfer::light::LightArgs;
use crate::cli::{Problem, given, view};
use crate::error::InputError;
use crate::io::{write_cube_table, write_file};
use crate::options::one_of::variants;
use crate::report::{Cell, Findings, Table};
use crate::sphere::turn_around_z;
use crate::transfer::grid::{LIGHT_SIDE, Segmentation};
use crate::transfer::light::{CubeLight, Decimation, HaarLight, LightTruncation, TruncationPriority};
use crate::transfer::linear_basis::LinearBasis;

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency lighting --light sky:1,-1,1 --keep 800
      6,144 texels as 24 segments of Haar wavelets; how much energy 800 of the coefficients hold
  crossbar all-frequency lighting --light red-and-blue --segments 6 --keep 200 --by magnitude --frames 8
      six faces instead; how much of the light flickers as it turns in 8 steps
  crossbar all-frequency lighting --light disk:1,0,2:5 --keep 40 --out light.csv --json
      what is left of a small source, as a table of the cube's texels, which `--light light.csv` draws with
  crossbar all-frequency lighting --keep 200 --by transfer --transfer docs/examples/step_all.npz --model docs/examples/step.obj
      the coefficients that this model answers to most";

/// Measure of importance of coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ByArg {
    /// Magnitude
    Magnitude,
    /// Magnitude times the solid angle of the wavelet
    Area,
    /// Magnitude times the mean response of the vertices of --transfer
    Transfer,
}

/// Take light into Haar wavelets over a cube, and leave the most important coefficients
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    #[command(flatten)]
    light: LightArgs,

    /// Squares that have a Haar transform each
    #[arg(long, value_name = "N", default_value = "24", value_parser = variants::<Segmentation>())]
    segments: Segmentation,

    /// Coefficients that are kept [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=6144))]
    keep: Option<u32>,

    /// Measure of importance for --keep
    #[arg(long, value_enum, value_name = "WHAT", default_value = "area", requires = "keep")]
    by: ByArg,

    /// Transfer for `--by transfer`: a .npz file with visibility, as `crossbar all-frequency precompute` writes it
    #[arg(long, value_name = "X.npz", requires = "model")]
    transfer: Option<PathBuf>,

    /// The model that it was made from
    #[arg(long, value_name = "MODEL", requires = "transfer")]
    model: Option<PathBuf>,

    /// Turn it around z in so many steps, and measure the flicker of what is kept
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=720))]
    frames: u32,

    /// Write the coefficients that are kept to this file, a line each: segment, number in it, red, green and blue
    #[arg(long, value_name = "FILE.csv")]
    coefficients: Option<PathBuf>,

    /// Write the radiances of the cube's texels to this file, as `--light` reads them
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let light = args.light.distant()?;
    let cube = |turns: f64| light.cube(&turn_around_z(turns), Decimation::SolidAngle).map_err(refused);
    let first = cube(0.0)?;
    let truncation = Truncation::new(args)?;
    let cut = truncation.of(&first)?;
    let texels = cut.light.radiances();
    if let Some(path) = &args.out {
        let text = write_cube_table(&texels, LIGHT_SIDE);
        write_file(path, |file| std::io::Write::write_all(file, text.as_bytes())).map_err(Problem::from)?;
    }
    if let Some(path) = &args.coefficients {
        write_coefficients(&cut.light, path)?;
    }
    let negative = texels.iter().filter(|rgb| rgb.iter().any(|&value| value < 0.0)).count();
    let frames: Vec<CubeLight> =
        (0..args.frames).map(|frame| cube(f64::from(frame) / f64::from(args.frames))).collect::<Result<_, _>>()?;
    let flicker = if frames.is_empty() { None } else { Some(truncation.flicker(&frames)?) };
    let mut found = Findings::new("Light as wavelets");
    found.fields(json!({
        "light": args.light.name(), "segments": args.segments.count(), "flux": first.flux(),
        "nonzero": cut.nonzero, "kept": cut.kept, "energy": cut.energy, "kept_energy": cut.kept_energy,
        "negative_texels": negative, "flicker": flicker,
    }));
    let title = format!("{} in {} segments", args.light.name(), args.segments.count());
    let mut table = Table::new(title, &["figure", "value"]);
    table.push(["not 0, of 6,144".into(), cut.nonzero.into()]);
    table.push(["kept".into(), cut.kept.into()]);
    table.push(["energy kept (%)".into(), Cell::measured(100.0 * cut.kept_energy)]);
    table.push(["texels below 0 after that".into(), negative.into()]);
    if let Some(flicker) = flicker {
        table.push(["flicker of a frame (% of the light)".into(), Cell::measured(100.0 * flicker)]);
    }
    found.table(table);
    written(&mut found, [("coefficients", args.coefficients.as_deref()), ("out", args.out.as_deref())]);
    Ok(found)
}

impl Args {
    /// The mean response of the model's vertices to each coefficient, for `--by transfer`.
    fn responses(&self) -> miette::Result<Option<Vec<f64>>> {
        let (Some(path), Some(model)) = (&self.transfer, &self.model) else {
            if self.by == ByArg::Transfer {
                let what = "`--by transfer` asks for the response of a model, found none";
                return Err(Problem::usage(what, "add `--transfer X.npz --model MODEL`").into());
            }
            return Ok(None);
        };
        let others = [("--transfer", self.by != ByArg::Transfer)];
        given::refuse(others, "`--by transfer`", "add `--keep N --by transfer`, or leave it out")?;
        let faces = [("--segments", self.segments == Segmentation::Faces)];
        given::refuse(faces, "other priorities than `--by transfer`, whose segments are 24", "leave it out")?;
        view::require_file(path, 3, "name a smaller file")?;
        let FileOfModel { file, vertices, .. } = FileOfModel::load(path, model)?;
        let maps = file.visibility.as_ref().ok_or_else(|| {
            let what = format!("{}: expected visibility, found coded transfer alone", path.display());
            Problem::usage(what, "name a file that `crossbar all-frequency precompute` wrote")
        })?;
        let hats = LinearBasis::new(file.hats);
        let responses = transfer_of(&vertices, maps, &hats, &file.reflectance).mean_responses();
        Ok(Some(responses.map_err(crate::cli::transfer::model::refused)?))
    }
}

/// How light is truncated.
struct Truncation {
    segmentation: Segmentation,
    by: ByArg,
    keep: usize,
    responses: Option<Vec<f64>>,
}

impl Truncation {
    fn new(args: &Args) -> miette::Result<Self> {
        let (segmentation, by) = (args.segments, args.by);
        let keep = args.keep.map_or(usize::MAX, |keep| keep as usize);
        Ok(Self { segmentation, by, keep, responses: args.responses()? })
    }

    /// Truncates a light.
    fn of(&self, cube: &CubeLight) -> Result<LightTruncation, Problem> {
        let priority = match (&self.responses, self.by) {
            (Some(responses), _) => TruncationPriority::Transfer(responses),
            (None, ByArg::Area) => TruncationPriority::Area,
            (None, _) => TruncationPriority::Magnitude,
        };
        HaarLight::new(cube, self.segmentation).truncated(self.keep, priority).map_err(refused)
    }

    /// The root mean square change, from frame to frame, of what truncation takes away, as a share of the light's own
    /// root mean square: 0 if everything is kept.
    fn flicker(&self, frames: &[CubeLight]) -> Result<f64, Problem> {
        let lost = |cube: &CubeLight| -> Result<Vec<f64>, Problem> {
            let kept = self.of(cube)?.light.radiances();
            let pairs = cube.texels().as_flattened().iter().zip(kept.as_flattened());
            Ok(pairs.map(|(all, kept)| all - kept).collect())
        };
        let lost: Vec<Vec<f64>> = frames.iter().map(lost).collect::<Result<_, _>>()?;
        let (mut changes, mut squares) = (0.0, 0.0);
        for (frame, cube) in frames.iter().enumerate() {
            let next = &lost[(frame + 1) % lost.len()];
            changes += lost[frame].iter().zip(next).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            squares += cube.texels().as_flattened().iter().map(|value| value * value).sum::<f64>();
        }
        Ok(if squares > 0.0 { (changes / squares).sqrt() } else { 0.0 })
    }
}

/// A line per coefficient that is not 0 in all channels.
fn write_coefficients(light: &HaarLight, path: &Path) -> Result<(), Problem> {
    let len = light.segmentation().len();
    write_file(path, |out| {
        writeln!(out, "segment,coefficient,r,g,b")?;
        let all = light.coefficients().into_iter().enumerate();
        for (at, [r, g, b]) in all.filter(|(_, rgb)| *rgb != [0.0; 3]) {
            writeln!(out, "{},{},{r},{g},{b}", at / len, at % len)?;
        }
        Ok(())
    })
    .map_err(Problem::from)
}

fn refused(error: InputError) -> Problem {
    Problem::usage(error.to_string(), "see `crossbar all-frequency lighting --help`")
}
