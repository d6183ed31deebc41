//! `crossbar all-frequency lighting`: light as coefficients of Haar wavelets.

use std::path::PathBuf;

use serde_json::json;

use crate::cli::Problem;
use crate::cli::study::written;
use crate::cli::transfer::light::{DEFAULT_LIGHT, DistantLightArg, LIGHT};
use crate::io::{write_cube_table, write_file};
use crate::options::number;
use crate::options::one_of::{OneOf, one_of, variants};
use crate::report::{Cell, Findings, Table};
use crate::transfer::grid::{LIGHT_SIDE, Segmentation};
use crate::transfer::light::{HaarLight, TruncationPriority};

const EXAMPLES: &str = "\
Examples:
  crossbar all-frequency lighting --light sky:1,-1,1 --keep 800
      6,144 texels as 24 segments of Haar wavelets; how much energy 800 of the coefficients hold
  crossbar all-frequency lighting --light red-and-blue --segments 6 --keep 200 --by magnitude
      as six segments, one per face of the cube; the 200 coefficients of largest magnitude are kept
  crossbar all-frequency lighting --light disk:1,0,2:5 --keep 40 --out light.csv --json
      what 40 coefficients keep of a small light source, as a table of the cube's texels that `--light light.csv` \
reads";

/// Values of `--by`: measures of importance of coefficients.
fn priorities() -> OneOf<TruncationPriority> {
    let magnitude = ("magnitude", "Magnitude", TruncationPriority::Magnitude);
    one_of([magnitude, ("area", "Magnitude times the solid angle of the wavelet", TruncationPriority::Area)])
}

/// Transform light into Haar wavelets over a cube, and keep the most important coefficients
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = LIGHT)]
    light: DistantLightArg,

    /// Number of squares of the cube, each with its own Haar transform
    #[arg(long, value_name = "N", default_value = "24", value_parser = variants::<Segmentation>())]
    segments: Segmentation,

    /// Number of coefficients to keep [default: all]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=6144))]
    keep: Option<u32>,

    /// Measure of importance for --keep
    #[arg(long, value_name = "WHAT", default_value = "area", value_parser = priorities(), requires = "keep")]
    by: TruncationPriority,

    /// Write the radiances of the cube's texels to this file, which `--light` can read
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let cube = args
        .light
        .distant()?
        .cube()
        .map_err(|error| Problem::usage(error.to_string(), "see `crossbar all-frequency lighting --help`"))?;
    let keep = args.keep.map_or(usize::MAX, |keep| keep as usize);
    let cut = HaarLight::new(&cube, args.segments).truncated(keep, args.by);
    let texels = cut.light.radiances();
    if let Some(path) = &args.out {
        let text = write_cube_table(&texels, LIGHT_SIDE);
        write_file(path, |file| std::io::Write::write_all(file, text.as_bytes())).map_err(Problem::from)?;
    }
    let negative = texels.iter().filter(|rgb| rgb.iter().any(|&value| value < 0.0)).count();
    let mut found = Findings::new("Light as wavelets");
    found.fields(json!({
        "light": args.light.name(), "segments": args.segments.count(), "flux": cube.flux(),
        "nonzero": cut.nonzero, "kept": cut.kept, "energy": cut.energy, "kept_energy": cut.kept_energy,
        "negative_texels": negative,
    }));
    let title = format!("{} in {} segments", args.light.name(), args.segments.count());
    found.table(Table::new(title, &["figure", "value"]).with([
        ["nonzero coefficients, of 6,144".into(), cut.nonzero.into()],
        ["kept coefficients".into(), cut.kept.into()],
        ["energy kept (%)".into(), Cell::measured(100.0 * cut.kept_energy)],
        ["texels below 0 after truncation".into(), negative.into()],
    ]));
    written(&mut found, [("out", args.out.as_deref())]);
    Ok(found)
}
