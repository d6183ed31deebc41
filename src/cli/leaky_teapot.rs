//! `crossbar leaky-teapot`: the main job.

use std::path::PathBuf;

use miette::IntoDiagnostic as _;
use refsim::num::Format;

use super::executor::{DeviceExecutor, GpuArgs};
use super::size::Size;
use super::{Out, Problem, Progress, Verdict, memory, view};
use crate::geom::exact::Sides;
use crate::geom::teapot::teapot;
use crate::io::atomic::FileSet;
use crate::ray_engine::RayBatch;
use crate::report::Provenance;
use crate::scene::Camera;
use crate::study::configuration::Configuration;
use crate::study::leaky_teapot::{Parameters, run as run_study};
use crate::study::leaky_teapot_report::{files, tables};

const EXAMPLES: &str = "\
Examples:
  crossbar leaky-teapot
      Figure 4 of the Ray Engine paper and the study behind it, in out/leaky-teapot/index.html
  crossbar leaky-teapot --size 256x256 --format s3.12 --format e5m10:rtz --format fp32 --out formats
      number formats of your own choice, on a device without limits
  crossbar leaky-teapot --device r300 --device nv35 --json
      two cards as they are, the rows as JSON on standard output

With --device and --format both, every device runs in every format. Written to --out: index.html (self-contained), rows.csv,
edges.csv, study.json, and a row NAME: NAME.png (shaded), NAME-map.png (what is wrong where), NAME.exr (t and triangle).";

/// Trace the teapot in each number format, against exact arithmetic
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    size: Size,

    /// Quads along each side of each of the 32 Bezier patches
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=64))]
    tessellation: u32,

    /// A card to run on; may be repeated [default: r200, as it is and under each of its open switches]
    #[arg(long, value_name = "D")]
    device: Vec<String>,

    /// A number format to compute in; may be repeated [default: fp16, fp24 and fp32]
    #[arg(long, value_name = "F")]
    format: Vec<String>,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/leaky-teapot")]
    out: PathBuf,

    /// Rays aimed at each edge that two triangles share, for the second table; 0 leaves the table out
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(0..=64))]
    rays_per_edge: u32,

    /// Seed of the points on the edges
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,

    /// Which faces can be hit
    #[arg(long, value_enum, default_value = "front")]
    sides: view::SidesArg,

    /// Every ray against every triangle; without it, buckets of 32 x 32 rays meet the triangles near them
    #[arg(long)]
    all_pairs: bool,

    /// Which executor computes; the bits are the same
    #[arg(long, value_enum, default_value = "batch")]
    executor: DeviceExecutor,

    #[command(flatten)]
    gpu: GpuArgs,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let configurations = configurations(args)?;
    require_memory(args, configurations.len() as u64)?;
    let mesh = teapot(args.tessellation).into_diagnostic()?;
    let Size { width, height } = args.size;
    let camera = Camera::teapot(width, height).into_diagnostic()?;
    let rays = RayBatch::new(width, height, camera.rays()).into_diagnostic()?;
    let provenance = provenance(args, &configurations);
    // Before the long work, so that a folder that cannot be written is found out at once.
    let folder = FileSet::new(&args.out).map_err(Problem::from)?;
    let bar = Progress::new("tracing", configurations.len() as u64 + 1);
    let parameters = Parameters {
        mesh,
        view: rays,
        sides: Sides::from(args.sides),
        configurations,
        rays_per_edge: args.rays_per_edge,
        seed: args.seed,
        executor: args.executor.open(&args.gpu)?,
        all_pairs: args.all_pairs,
    };
    let outcome = run_study(&parameters, &|_| bar.advance(1))?;
    drop(bar);
    let written = files(&parameters, &outcome, &provenance)?;
    view::write_folder(folder, &written)?;
    let [rows, edges] = tables(&outcome);
    if out.json() {
        out.document(&serde_json::json!({
            "provenance": provenance, "rows": rows.json(), "edges": edges.json(), "out": args.out,
        }))?;
        return Ok(Verdict::Done);
    }
    out.line(rows.title())?;
    out.line(rows.text())?;
    if args.rays_per_edge > 0 {
        out.line("")?;
        out.line(edges.title())?;
        out.line(edges.text())?;
    }
    out.line("")?;
    out.line(format_args!("pictures and tables: {}", args.out.join("index.html").display()))?;
    Ok(Verdict::Done)
}

/// What the rays, the truth about them and the files of every row take.
fn require_memory(args: &Args, rows: u64) -> Result<(), Problem> {
    const PER_PIXEL: u64 = 350;
    const PER_PIXEL_AND_ROW: u64 = 50;
    const PER_TRIANGLE: u64 = 450;
    const PER_AIMED_RAY: u64 = 350;
    let triangles = 64 * u64::from(args.tessellation).pow(2);
    // Two triangles share an edge, and as many rays as three edges have go to corners at most.
    let aimed = (triangles * 3 / 2).saturating_mul(u64::from(args.rays_per_edge) + 1) * PER_AIMED_RAY;
    let fixed = triangles * PER_TRIANGLE + aimed;
    let need = memory::of_pixels(args.size.width, args.size.height, PER_PIXEL + rows * PER_PIXEL_AND_ROW, fixed);
    let help = "ask for a smaller `--size` or `--tessellation`, fewer `--rays-per-edge` or fewer rows";
    memory::require(format_args!("a study of {} pixels in {rows} rows", args.size), need, help)
}

fn configurations(args: &Args) -> miette::Result<Vec<Configuration>> {
    let formats: Vec<(&str, Format)> = args
        .format
        .iter()
        .map(|text| Ok((text.as_str(), text.parse::<Format>().map_err(view::bad_format)?)))
        .collect::<miette::Result<_>>()?;
    let mut all = Vec::new();
    match (args.device.is_empty(), formats.is_empty()) {
        (true, true) => {
            all.extend(Configuration::device_under_each_switch("r200")?);
            for format in ["fp16", "fp24", "fp32"] {
                all.push(Configuration::format(format)?);
            }
        }
        (true, false) => {
            for (text, _) in formats {
                all.push(Configuration::format(text)?);
            }
        }
        (false, true) => {
            for device in &args.device {
                all.push(Configuration::device(device)?);
            }
        }
        (false, false) => {
            for device in &args.device {
                for (_, format) in &formats {
                    all.push(Configuration::device_in_format(device, *format)?);
                }
            }
        }
    }
    Ok(all)
}

fn provenance(args: &Args, configurations: &[Configuration]) -> Provenance {
    let mut command = format!("crossbar leaky-teapot --size {} --tessellation {}", args.size, args.tessellation);
    for device in &args.device {
        command.push_str(&format!(" --device {device}"));
    }
    for format in &args.format {
        command.push_str(&format!(" --format {format}"));
    }
    command.push_str(&format!(" --rays-per-edge {} --seed {} --sides {}", args.rays_per_edge, args.seed, args.sides));
    if args.all_pairs {
        command.push_str(" --all-pairs");
    }
    let mut provenance = Provenance::new(command);
    provenance.seed = Some(args.seed);
    for configuration in configurations {
        if !provenance.profiles.contains(&configuration.profile.name) {
            provenance.profiles.push(configuration.profile.name.clone());
        }
        provenance.switches.extend(configuration.switch.clone());
    }
    provenance
}
