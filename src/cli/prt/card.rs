//! `crossbar prt card`: compressed transfer on an emulated card.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use refsim::isa::Version;
use refsim::texture::TexelFormat;

use super::light::LightArgs;
use super::model::{FileOfModel, clusters_of, light_order};
use crate::cli::card::CardArgs;
use crate::cli::memory::{self, MemoryNeed};
use crate::cli::scene_name::EyeArgs;
use crate::cli::size::Size;
use crate::cli::study::StudyArgs;
use crate::cli::{model_name, number};
use crate::prt::on_card::{PrtCardOptions, WeightFormat};
use crate::study::prt::OnCard;

const EXAMPLES: &str = "\
Examples:
  crossbar prt card docs/examples/step_small.prt --model docs/examples/step.obj --size 64x48
      on the Radeon 9700: picture, how far it is off the host's, modelled time of a frame
  crossbar prt card docs/examples/step_small.prt --model docs/examples/step.obj --device r350 --weights unorm8 --target-format rgba16 --size 64x48
      on the Radeon 9800, with weights of 8 bits, into 16 bits per channel
  crossbar prt card docs/examples/step_small.prt --model docs/examples/step.obj --sweep --size 64x48
      weights, maps, arithmetic and targets made coarse one after the other: what shows

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, with --sweep precision.csv. docs/papers/cpca.md explains \
all of it.";

/// What a vertex holds weights in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WeightsArg {
    /// Single precision
    Fp32,
    /// Half precision
    Fp16,
    /// 16 bits of the range of the cluster's weights on a vector
    Unorm16,
    /// 8 bits of it
    Unorm8,
}

/// A vertex language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum VertexArg {
    #[value(name = "vs_1_1")]
    Vs1_1,
    #[value(name = "vs_2_0")]
    Vs2_0,
}

/// Draw a model under distant light on an emulated card, from clusters
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// Clusters of transfer, as `crossbar prt compress` writes them
    #[arg(value_name = "FILE.prt")]
    file: PathBuf,

    /// The model that the file was made from, as given to `crossbar prt precompute`
    #[arg(long, value_name = "MODEL")]
    model: PathBuf,

    #[command(flatten)]
    light: LightArgs,

    /// What vertices hold weights in
    #[arg(long, value_enum, value_name = "F", default_value = "fp32")]
    weights: WeightsArg,

    /// Texels along a side of the maps of harmonics; the paper has 32
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u32).range(1..=4096))]
    map: u32,

    /// Format of these maps [default: rgba16s where the card has it, else rgba8s]
    #[arg(long, value_name = "F")]
    map_format: Option<TexelFormat>,

    /// Format of the picture
    #[arg(long, value_name = "F", default_value = "bgra8")]
    target_format: TexelFormat,

    /// The language of the vertex program [default: vs_2_0 where the card has it]
    #[arg(long, value_enum, value_name = "V")]
    vertex: Option<VertexArg>,

    /// Draw each cluster alone
    #[arg(long)]
    alone: bool,

    /// Make one thing after the other coarse
    #[arg(long)]
    sweep: bool,

    #[command(flatten)]
    card: CardArgs,

    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    size: Size,

    #[command(flatten)]
    eye: EyeArgs,

    /// What radiance is multiplied by; 1 is white [default: auto-exposure, the model at 18 % grey on average]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    exposure: Option<f64>,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/prt-card")]
    out: PathBuf,
}

impl Args {
    fn options(&self, formats: &[String]) -> PrtCardOptions {
        let has = formats.iter().any(|format| format == TexelFormat::Rgba16Snorm.name());
        let weights = match self.weights {
            WeightsArg::Fp32 => WeightFormat::Fp32,
            WeightsArg::Fp16 => WeightFormat::Fp16,
            WeightsArg::Unorm16 => WeightFormat::Unorm16,
            WeightsArg::Unorm8 => WeightFormat::Unorm8,
        };
        let vertex = |arg| if arg == VertexArg::Vs1_1 { Version::Vs1_1 } else { Version::Vs2_0 };
        PrtCardOptions {
            superclusters: !self.alone,
            vertex_version: self.vertex.map(vertex),
            map_side: self.map as usize,
            map_format: self.map_format.unwrap_or(if has { TexelFormat::Rgba16Snorm } else { TexelFormat::Rgba8Snorm }),
            weights,
        }
    }
}

impl StudyArgs for Args {
    type Study = OnCard;
    const COMMAND: &'static str = "prt card";

    fn folder(&self) -> Option<&Path> {
        Some(&self.out)
    }

    fn inputs(&self) -> Vec<&Path> {
        [Some(self.file.as_path()), self.light.file()]
            .into_iter()
            .flatten()
            .chain(model_name::named_file(&self.model))
            .collect()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        const PER_PIXEL: u64 = 400;
        Ok(Some(MemoryNeed {
            what: format!("pictures of {} pixels", self.size),
            bytes: memory::of_pixels(self.size.width, self.size.height, PER_PIXEL, 0),
            help: "ask for a smaller `--size`",
        }))
    }

    fn study(&self) -> miette::Result<OnCard> {
        let profile = self.card.profile("r300")?;
        let FileOfModel { mut file, model, vertices, .. } = FileOfModel::load(&self.file, &self.model)?;
        let clustering = clusters_of(&mut file, &self.file)?;
        let light_order = light_order(&file)?;
        Ok(OnCard {
            model: self.model.display().to_string(),
            camera: self.eye.framing(&model.mesh, self.size)?,
            light: self.light.of_order(light_order)?,
            light_name: self.light.name(),
            exposure: self.exposure,
            options: self.options(&profile.limits.texture_formats),
            switches: self.card.switches(),
            executor: self.card.executor()?,
            format: self.target_format,
            sweep: self.sweep,
            mesh: model.mesh,
            meaning: file.meaning,
            profile,
            vertices,
            clustering,
        })
    }
}
