//! `crossbar leaky-teapot`: the study of the Ray Engine's leaks.

use std::collections::BTreeSet;
use std::path::PathBuf;

use miette::IntoDiagnostic as _;
use refsim::num::Format;

use super::executor::DeviceExecutor;
use super::model_name;
use super::scene_name::EyeArgs;
use super::study::{StudyArgs, StudyFiles};
use super::{Problem, view};
use crate::geom::teapot::teapot;
use crate::io::load_rays;
use crate::options::Size;
use crate::options::number;
use crate::options::one_of::{OneOf, one_of};
use crate::ray_engine::{EdgeRule, RayBatch};
use crate::scene::Camera;
use crate::study::configuration::Configuration;
use crate::study::leaky_teapot::{LeakyTeapotOptions, Parameters};

const EXAMPLES: &str = "\
Examples:
  crossbar leaky-teapot
      Figure 4 of the Ray Engine paper, with a study of its leaks, in out/leaky-teapot/index.html
  crossbar leaky-teapot --size 256x256 --format s3.12 --format e5m10:rtz --format fp32 --out formats
      number formats that you choose, on a device without limits
  crossbar leaky-teapot --device r300 --device nv35 --json
      two cards with their default switches; the rows as JSON on standard output
  crossbar leaky-teapot --size 256x256 --device r200 --device r300 --kernel paper --kernel shared-edges
      two cards with the paper's program, and with a program whose edges cannot leak
  crossbar leaks --mesh docs/examples/step.obj --size 128x128 --device r200 --out leaks
      your own model on a Radeon 8500: `leaks` is another name for this command
  crossbar leaks --mesh docs/examples/teapot.obj --rays docs/examples/rays.csv --device r200 --device r300 --out leaks
      your own rays, as for `crossbar intersect`, on two cards

With both --device and --format, every device runs in every format; its other settings do not change.
Written to --out: index.html (self-contained), rows.csv, edges.csv, programs.csv, study.json, and for each row NAME: \
NAME.png (shaded), NAME-map.png (wrong pixels by kind), NAME.exr (t and triangle). \
Rows with the same bits share these files: see same_bits in study.json.";

/// Rows that also run with shared edges, if no options choose rows.
const CURED: [&str; 5] = ["r200", "r200-rounding-rne", "fp16", "fp24", "fp32"];

/// Trace the teapot, or your own model, in several number formats, and compare with exact arithmetic: leaks, false
/// hits, wrong triangles
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true, visible_alias = "leaks")]
pub(super) struct Args {
    /// A model instead of the teapot: a Wavefront OBJ, PLY, STL or glTF file, a scene file (.toml), or a
    /// built-in scene or mesh
    #[arg(long, value_name = "MODEL", conflicts_with = "tessellation")]
    mesh: Option<PathBuf>,

    /// Rays instead of a camera's rays: a CSV file, as `crossbar intersect` reads it
    #[arg(long, value_name = "R.csv", requires = "mesh",
          conflicts_with_all = ["size", "eye", "target", "tan_half_height"])]
    rays: Option<PathBuf>,

    /// Size of the pictures, in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    size: Size,

    #[command(flatten)]
    eye: EyeArgs,

    /// Quads along each side of each of the 32 Bezier patches
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = number::whole::<u32>(1..=64))]
    tessellation: u32,

    /// A card to run on; may be repeated [default: r200, unchanged and with each of its open switches changed]
    #[arg(long, value_name = "D")]
    device: Vec<String>,

    /// A number format to compute in; may be repeated [default: fp16, fp24 and fp32]
    #[arg(long, value_name = "F")]
    format: Vec<String>,

    /// The program: the paper's, whose edges leak, or a program that evaluates each edge once for both of its
    /// triangles; may be repeated [default: paper; without --device and --format, also five rows with shared edges]
    #[arg(long, value_name = "K", value_parser = kernels())]
    kernel: Vec<EdgeRule>,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/leaky-teapot")]
    out: PathBuf,

    #[command(flatten)]
    options: LeakyTeapotOptions,

    /// Executor; all executors give the same bits
    #[arg(long, value_enum, default_value = "batch")]
    executor: DeviceExecutor,
}

impl StudyArgs for Args {
    type Study = Parameters;
    const QUICKER: &'static str = "a smaller `--size` or `--tessellation`";

    fn files(&self) -> StudyFiles<'_> {
        let model = self.mesh.as_deref().map(model_name::named_file).unwrap_or_default();
        StudyFiles::new(Some(&self.out), model.into_iter().chain(self.rays.as_deref()).collect())
    }

    fn study(&self) -> miette::Result<Parameters> {
        let Size { width, height } = self.size;
        let mesh = match &self.mesh {
            Some(path) => model_name::mesh(path)?,
            None => teapot(self.tessellation).into_diagnostic()?,
        };
        let (view, listed) = match &self.rays {
            Some(path) => {
                let (view, count) = Parameters::of_list(&load_rays(path)?);
                (view, Some(count))
            }
            None => {
                let camera = match self.mesh.is_none() && self.eye.is_default() {
                    true => Camera::teapot(width, height).into_diagnostic()?,
                    false => self.eye.framing(&mesh, self.size)?,
                };
                (RayBatch::new(width, height, camera.rays()).into_diagnostic()?, None)
            }
        };
        let configurations = configurations(self)?;
        let asks_for = |kernel| self.kernel.contains(&kernel) || (self.kernel.is_empty() && kernel == EdgeRule::Paper);
        let mut shared = if asks_for(EdgeRule::SharedEdges) { configurations.clone() } else { Vec::new() };
        if self.kernel.is_empty() && self.device.is_empty() && self.format.is_empty() {
            shared.extend(configurations.iter().filter(|row| CURED.contains(&row.label.as_str())).cloned());
        }
        Ok(Parameters {
            model: self.mesh.as_ref().map(|path| path.display().to_string()),
            mesh,
            view,
            listed,
            configurations: if asks_for(EdgeRule::Paper) { configurations } else { Vec::new() },
            shared,
            executor: self.executor.open()?,
            options: self.options,
        })
    }
}

/// Values of `--kernel`: the programs.
fn kernels() -> OneOf<EdgeRule> {
    let paper = ("paper", "The paper's equations, evaluated separately for each triangle", EdgeRule::Paper);
    let shared = ("shared-edges", "Each edge evaluated once, for both of its triangles", EdgeRule::SharedEdges);
    one_of([paper, shared])
}

fn configurations(args: &Args) -> miette::Result<Vec<Configuration>> {
    let (devices, formats) = (&args.device, &args.format);
    for text in formats {
        text.parse().and_then(Format::for_registers).map_err(view::bad_format)?;
    }
    let all = if devices.is_empty() && formats.is_empty() {
        let of_formats = Configuration::each(&[], &["fp16", "fp24", "fp32"].map(str::to_owned))?;
        [Configuration::device_under_each_switch("r200")?, of_formats].concat()
    } else {
        Configuration::each(devices, formats)?
    };
    let mut labels = BTreeSet::new();
    if let Some(row) = all.iter().find(|row| !labels.insert(&row.label)) {
        let what = format!("expected different rows, found `{}` twice", row.label);
        return Err(Problem::usage(what, "give each `--device` and each `--format` only once").into());
    }
    Ok(all)
}
