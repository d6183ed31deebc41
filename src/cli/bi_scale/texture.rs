//! `crossbar bi-scale texture`: bidirectional textures of patches.

use std::path::PathBuf;
use std::time::Instant;

use serde_json::json;

use super::patch::patch_of;
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::texture::{BidirectionalTexture, TextureSampling, write_bidirectional_texture};
use crate::cli::study::written;
use crate::cli::words::counted;
use crate::cli::{Problem, ProgressBar};
use crate::io::write_file;
use crate::options::number;
use crate::picture::{RgbImage, display, png, rgb8};
use crate::report::Findings;

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale texture mail --texels 16 --directions 4 --views 4 --out mail.npy --sheet mail.png
      rings of wire, seen from 16 views and lit from 16 directions; a picture of those lit from each
  crossbar bi-scale texture bumps --texels 16 --directions 4 --views 4 --out bumps.npy --json
      the figures as JSON

The file is an array of NumPy's of the shape (views, lights, size, size, 3): docs/papers/bi_scale.md says what its numbers are. \
`crossbar bi-scale render --texture` also reads textures from elsewhere if they have this shape.";

/// Make a bidirectional texture of a patch of heights: its response by place, view and light
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// bumps, mail, tiles, bricks, weave, plain; or heights of a square patch that repeats: a table (.csv, .npy) in
    /// edges of the patch, or a picture
    #[arg(value_name = "PATCH")]
    source: PathBuf,

    /// Texels per side; the paper uses 32 and 64
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = number::whole::<u32>(1..=1024))]
    texels: u32,

    /// Light directions per side of the square that is mapped to the hemisphere, as for transfer
    #[arg(long, value_name = "K", default_value_t = 8, value_parser = number::whole::<u8>(1..=64))]
    directions: u8,

    /// View directions per side of such a square
    #[arg(long, value_name = "K", default_value_t = 12, value_parser = number::whole::<u8>(1..=64))]
    views: u8,

    /// The file to write
    #[arg(long, value_name = "B.npy")]
    out: PathBuf,

    /// Write a picture of the view nearest to the normal, lit from each direction: a layer of the paper's Figure 4
    #[arg(long, value_name = "S.png")]
    sheet: Option<PathBuf>,
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let directions = |side: u8| {
        LocalDirections::new(side.into())
            .map_err(|error| Problem::usage(error.to_string(), "see `crossbar bi-scale texture --help`"))
    };
    let (view, light) = (directions(args.views)?, directions(args.directions)?);
    let (views, lights) = (view.directions().len(), light.directions().len());
    let size = args.texels as usize;
    let nearest = view.nearest(glam::DVec3::Z);
    let patch = patch_of(&args.source)?;
    let bar = ProgressBar::new("views", 1).quicker("fewer `--views` or `--texels`");
    let start = Instant::now();
    let sampling = TextureSampling { size, view, light, samples: 1 };
    let texture = patch
        .texture(&sampling, &mut |done, of| bar.show("views".to_owned(), done as u64, of as u64))
        .map_err(|error| Problem::usage(error.to_string(), "see `crossbar bi-scale texture --help`"))?;
    let seconds = start.elapsed().as_secs_f64();
    drop(bar);
    write_file(&args.out, |out| write_bidirectional_texture(&texture, out)).map_err(Problem::from)?;
    if let Some(path) = &args.sheet {
        let image = png(&sheet(&texture, nearest))?;
        write_file(path, |out| out.write_all(&image)).map_err(Problem::from)?;
    }
    let (mean, largest) =
        (mean_reflectance(&texture), texture.samples().iter().flatten().fold(0.0_f32, |a, b| a.max(*b)));
    let (depth, bytes) = (patch.heights().depth(), views * lights * size * size * 12);
    let mut found = Findings::new("Bidirectional texture");
    found.fields(json!({
        "views": views, "lights": lights, "size": size, "depth": depth, "bytes": bytes, "bytes_of_8_bits": bytes / 4, "mean_reflectance": mean, "largest": largest,
        "seconds": seconds,
    }));
    found.print(format!("patch     {size} x {size} texels, {depth:.3} of its edge deep"));
    let texels = counted(bytes / 12);
    found.print(format!("samples   {views} views x {lights} directions of light, {texels} texels"));
    let [red, green, blue] = mean.map(|mean| format!("{mean:.3}"));
    found.print(format!("mean      {red}, {green}, {blue} of light from everywhere, over all texels and views"));
    found.print(format!("bytes     {} as written; {} with 8 bits per channel", counted(bytes), counted(bytes / 4)));
    written(&mut found, [("out", Some(args.out.as_path())), ("sheet", args.sheet.as_deref())]);
    Ok(found)
}

/// Mean radiance over texels and views, under uniform light of radiance 1.
fn mean_reflectance(texture: &BidirectionalTexture) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for sample in texture.samples() {
        (0..3).for_each(|channel| sum[channel] += f64::from(sample[channel]));
    }
    // Each sample covers 2 pi / M of the hemisphere.
    let of_texel = texture.samples().len() as f64 / std::f64::consts::TAU;
    sum.map(|sum| sum / of_texel)
}

/// A view's picture of the patch per light direction, placed by direction in the square, from the lower edge up.
fn sheet(texture: &BidirectionalTexture, view: usize) -> RgbImage {
    let (side, size) = (texture.light().side(), texture.size());
    let width = side * size;
    // A white Lambert surface lit along its normal appears white; brighter lobes are clipped.
    let scale = std::f64::consts::PI;
    let pixel = |at: usize| {
        let (x, y) = (at % width, width - 1 - at / width);
        let light = y / size * side + x / size;
        let texel = y % size * size + x % size;
        texture.patch(view, light)[texel].map(|value| display::encode(f64::from(value) * scale))
    };
    rgb8(width as u32, width as u32, (0..width * width).map(pixel))
}
