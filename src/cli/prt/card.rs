//! `crossbar prt card`: compressed transfer on an emulated card.

use std::path::{Path, PathBuf};

use refsim::isa::Version;
use refsim::texture::TexelFormat;

use super::bi_scale::card_args::BiScaleCardArgs;
use super::card_values::{FilterArg, RadianceArg, VertexArg, WayArg, WeightsArg};
use super::light::LightArgs;
use super::model::{FileOfModel, clusters_of, light_order};
use super::values::KindArg;
use crate::all_frequency::kernels::MapFilter;
use crate::all_frequency::on_card::{ProductOptions, ProductPlace, RadianceFormat, VertexColors};
use crate::cli::card::CardArgs;
use crate::cli::memory::{self, MemoryNeed};
use crate::cli::scene_name::EyeArgs;
use crate::cli::size::Size;
use crate::cli::study::StudyArgs;
use crate::cli::{Problem, model_name, number};
use crate::cpca::on_card::{PrtCardOptions, WeightFormat};
use crate::study::prt::OnCard;
use refsim::device::Profile;

const EXAMPLES: &str = "\
Examples:
  crossbar prt card docs/examples/step_small.prt --model docs/examples/step.obj --size 64x48
      on the Radeon 9700: picture, how far it is off the host's, modelled time of a frame
  crossbar prt card docs/examples/step_small.prt --model docs/examples/step.obj --device r350 --weights unorm8 --target-format rgba16 --size 64x48
      on the Radeon 9800, with weights of 8 bits, into 16 bits per channel
  crossbar prt card docs/examples/step_small.prt --model docs/examples/step.obj --sweep --size 64x48
      weights, maps, arithmetic and targets made coarse one after the other: what shows
  crossbar prt card docs/examples/step_all_small.prt --model docs/examples/step.obj --way colors --size 64x48
      transfer of all frequencies on the Radeon 9800, colors of vertices interpolated as its authors did
  crossbar prt card docs/examples/step_all_small.prt --model docs/examples/step.obj --original docs/examples/step_all.prt --sweep --size 64x48
      bits of representatives, weights and maps, arithmetic; what of it shows, and what compression costs
  crossbar prt card docs/examples/court_biclusters.prt --model docs/examples/court.obj --texture tiles --texture-size 8 --texture-views 4 --repeat 4 --size 64x48
      bi-scale transfer on the GeForce GTX 280: light times biclusters, then a bidirectional texture pass by pass

Written to --out: index.html (self-contained), pictures, card.exr, timeline.json, with --sweep precision.csv, for transfer of all \
frequencies and bi-scale transfer blame.csv. docs/papers/cpca.md, all_frequency.md and bi_scale.md explain all of it.";

/// Draw a model under distant light on an emulated card, from clusters
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(in crate::cli) struct Args {
    /// Clusters of transfer, as `crossbar prt compress` writes them
    #[arg(value_name = "FILE.prt")]
    file: PathBuf,

    /// The model that the file was made from, as given to `crossbar prt precompute`
    #[arg(long, value_name = "MODEL")]
    pub(super) model: PathBuf,

    /// What the file must hold [default: whatever it holds]
    #[arg(long, value_enum, value_name = "KIND")]
    pub(super) kind: Option<KindArg>,

    #[command(flatten)]
    pub(super) light: LightArgs,

    /// What vertices hold weights in [default: fp32]
    #[arg(long, value_enum, value_name = "F")]
    weights: Option<WeightsArg>,

    /// Texels along a side of the maps of harmonics; the paper has 32 [default: 32]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    map: Option<u32>,

    /// Format of these maps, or of those of reflectance factors [default: rgba16s where the card has it, else rgba8s;
    /// of factors rg16s before rgba8s]
    #[arg(long, value_name = "F")]
    map_format: Option<TexelFormat>,

    /// What the card makes of transfer of all frequencies [default: products]
    #[arg(long, value_enum, value_name = "WAY")]
    way: Option<WayArg>,

    /// Who interpolates between texels of reflectance factors, for transfer of all frequencies [default: sampler]
    #[arg(long, value_enum, value_name = "WHO")]
    filter: Option<FilterArg>,

    /// What vertices hold transferred radiance in, for transfer of all frequencies [default: fp32]
    #[arg(long, value_enum, value_name = "F")]
    radiance: Option<RadianceArg>,

    /// Draw a channel per pass, for transfer of all frequencies
    #[arg(long)]
    pass_per_channel: bool,

    /// Ask for the card's partial precision, for transfer of all frequencies
    #[arg(long)]
    partial: bool,

    /// Light coefficients that are kept, those of largest area times magnitude, for transfer of all frequencies
    /// [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=6144))]
    pub(super) keep: Option<u32>,

    /// A file with visibility of the same model, to say what compression costs, for transfer of all frequencies
    #[arg(long, value_name = "X.prt")]
    pub(super) original: Option<PathBuf>,

    /// Format of the picture
    #[arg(long, value_name = "F", default_value = "bgra8")]
    pub(super) target_format: TexelFormat,

    /// The language of the vertex program [default: vs_2_0 where the card has it]
    #[arg(long, value_enum, value_name = "V")]
    vertex: Option<VertexArg>,

    /// Draw each cluster alone
    #[arg(long)]
    alone: bool,

    /// Make one thing after the other coarse
    #[arg(long)]
    pub(super) sweep: bool,

    #[command(flatten)]
    pub(super) card: CardArgs,

    /// Pixels of the pictures
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true)]
    pub(super) size: Size,

    #[command(flatten)]
    pub(super) eye: EyeArgs,

    /// What radiance is multiplied by; 1 is white [default: auto-exposure, the model at 18 % grey on average]
    #[arg(long, value_name = "X", value_parser = number::positive)]
    pub(super) exposure: Option<f64>,

    /// Where to write pictures, tables and the page
    #[arg(long, value_name = "DIR", default_value = "out/prt-card")]
    pub(super) out: PathBuf,

    #[command(flatten)]
    pub(super) bi_scale: BiScaleCardArgs,
}

impl Args {
    fn options(&self, formats: &[String]) -> PrtCardOptions {
        let has = formats.iter().any(|format| format == TexelFormat::Rgba16Snorm.name());
        let weights = match self.weights {
            None | Some(WeightsArg::Fp32) => WeightFormat::Fp32,
            Some(WeightsArg::Fp16) => WeightFormat::Fp16,
            Some(WeightsArg::Unorm16) => WeightFormat::Unorm16,
            Some(WeightsArg::Unorm8) => WeightFormat::Unorm8,
        };
        PrtCardOptions {
            superclusters: !self.alone,
            vertex_version: self.vertex_version(),
            map_side: self.map.unwrap_or(32) as usize,
            map_format: self.map_format.unwrap_or(if has { TexelFormat::Rgba16Snorm } else { TexelFormat::Rgba8Snorm }),
            weights,
        }
    }

    fn vertex_version(&self) -> Option<Version> {
        self.vertex.map(|arg| if arg == VertexArg::Vs1_1 { Version::Vs1_1 } else { Version::Vs2_0 })
    }

    /// The file to draw.
    pub(super) fn file(&self) -> &Path {
        &self.file
    }

    /// The way to draw transfer of all frequencies.
    pub(super) fn place(&self, profile: &Profile) -> Result<ProductPlace, Problem> {
        self.bi_scale.refuse()?;
        let of_others = [("--weights", self.weights.is_some()), ("--map", self.map.is_some()), ("--alone", self.alone)];
        refuse(of_others, "transfer of low frequency, found all frequencies")?;
        if self.way == Some(WayArg::Colors) {
            let of_products = [
                ("--map-format", self.map_format.is_some()),
                ("--filter", self.filter.is_some()),
                ("--radiance", self.radiance.is_some()),
                ("--pass-per-channel", self.pass_per_channel),
                ("--partial", self.partial),
                ("--vertex", self.vertex.is_some()),
            ];
            refuse(of_products, "`--way products`, found `--way colors`")?;
            return Ok(ProductPlace::Vertices(VertexColors::Bytes));
        }
        let has = |format: &TexelFormat| profile.limits.texture_formats.iter().any(|name| name == format.name());
        let fractions = [TexelFormat::Rgba16Snorm, TexelFormat::Rg16Snorm].into_iter().find(has);
        Ok(ProductPlace::Pixels(ProductOptions {
            map_format: self.map_format.or(fractions).unwrap_or(TexelFormat::Rgba8Snorm),
            filter: if self.filter == Some(FilterArg::Program) { MapFilter::Program } else { MapFilter::Sampler },
            radiance: if self.radiance == Some(RadianceArg::Fp16) {
                RadianceFormat::Fp16
            } else {
                RadianceFormat::Fp32
            },
            is_pass_per_channel: self.pass_per_channel,
            is_partial: self.partial,
            vertex_version: self.vertex_version(),
            ..ProductOptions::default()
        }))
    }

    /// Refuses what is for transfer of other kinds than bi-scale.
    pub(super) fn refuse_others(&self) -> Result<(), Problem> {
        refuse(
            [
                ("--weights", self.weights.is_some()),
                ("--map", self.map.is_some()),
                ("--map-format", self.map_format.is_some()),
                ("--way", self.way.is_some()),
                ("--filter", self.filter.is_some()),
                ("--radiance", self.radiance.is_some()),
                ("--pass-per-channel", self.pass_per_channel),
                ("--partial", self.partial),
                ("--keep", self.keep.is_some()),
                ("--original", self.original.is_some()),
                ("--vertex", self.vertex.is_some()),
                ("--alone", self.alone),
            ],
            "transfer of other kinds, found bi-scale transfer",
        )
    }

    /// Whether the card sums over representatives.
    pub(super) fn sums_on_card(&self) -> bool {
        self.way == Some(WayArg::Sums)
    }

    /// Refuses what is for transfer of all frequencies alone.
    fn refuse_all_frequency(&self) -> Result<(), Problem> {
        self.bi_scale.refuse()?;
        let of_others = [
            ("--way", self.way.is_some()),
            ("--filter", self.filter.is_some()),
            ("--radiance", self.radiance.is_some()),
            ("--pass-per-channel", self.pass_per_channel),
            ("--partial", self.partial),
            ("--keep", self.keep.is_some()),
            ("--original", self.original.is_some()),
        ];
        refuse(of_others, "transfer of all frequencies, found low frequency")
    }

    /// Memory of the pictures.
    pub(super) fn pictures(&self) -> MemoryNeed {
        const PER_PIXEL: u64 = 400;
        MemoryNeed {
            what: format!("pictures of {} pixels", self.size),
            bytes: memory::of_pixels(self.size.width, self.size.height, PER_PIXEL, 0),
            help: "ask for a smaller `--size`",
        }
    }
}

/// Refuses the first option that was given.
fn refuse<const N: usize>(options: [(&str, bool); N], what: &str) -> Result<(), Problem> {
    match options.into_iter().find(|(_, given)| *given) {
        Some((option, _)) => Err(Problem::usage(format!("`{option}` is for {what}"), "leave it out")),
        None => Ok(()),
    }
}

impl StudyArgs for Args {
    type Study = OnCard;
    const COMMAND: &'static str = "prt card";

    fn folder(&self) -> Option<&Path> {
        Some(&self.out)
    }

    fn inputs(&self) -> Vec<&Path> {
        [Some(self.file.as_path()), self.original.as_deref(), self.light.file()]
            .into_iter()
            .flatten()
            .chain(model_name::named_file(&self.model))
            .collect()
    }

    fn memory(&self) -> miette::Result<Option<MemoryNeed>> {
        Ok(Some(self.pictures()))
    }

    fn study(&self) -> miette::Result<OnCard> {
        self.refuse_all_frequency()?;
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
