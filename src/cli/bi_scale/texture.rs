//! `crossbar bi-scale texture`: bidirectional textures of patches.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde_json::json;
use strum::VariantNames as _;

use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::texture::{
    BidirectionalTexture, HeightField, MesoMaterial, MesoPatch, MesoTexel, PatchKind, write_bidirectional_texture,
};
use crate::cli::study::written;
use crate::cli::words::counted;
use crate::cli::{Problem, ProgressBar, given};
use crate::error::InputError;
use crate::io::{load_numbers, load_picture, write_file};
use crate::options::number;
use crate::picture::{RgbImage, display, png, rgb8};
use crate::report::Findings;

const EXAMPLES: &str = "\
Examples:
  crossbar bi-scale texture mail --texels 16 --directions 4 --views 4 --out mail.npy --sheet mail.png
      rings of wire, seen from 16 views and lit from 16 directions; and a picture of the rings lit from each direction
  crossbar bi-scale texture bumps --texels 16 --directions 4 --views 4 --out bumps.npy --json
      the figures as JSON

The file is a NumPy array of shape (views, lights, size, size, 3): docs/papers/bi_scale.md explains its numbers. \
`crossbar bi-scale render --texture` also reads textures from elsewhere if they have this shape.";

/// Make a bidirectional texture of a patch of heights: how it reflects light, by place, view and light
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// bumps, mail, tiles, bricks, weave, plain; or the heights of a square patch that repeats: a table (.csv, .npy)
    /// in units of the patch's edge, or a picture
    #[arg(value_name = "PATCH")]
    source: PathBuf,

    /// Texels per side; the paper uses 32 and 64
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = number::whole::<u32>(1..=1024))]
    texels: u32,

    /// Light directions per side of the square that is mapped to the hemisphere, as for transfer
    #[arg(long, value_name = "K", default_value_t = 8, value_parser = number::whole::<u8>(1..=64))]
    directions: u8,

    /// View directions per side of the square that is mapped to the hemisphere
    #[arg(long, value_name = "K", default_value_t = 12, value_parser = number::whole::<u8>(1..=64))]
    views: u8,

    /// The file to write
    #[arg(long, value_name = "B.npy")]
    out: PathBuf,

    /// Write a picture of the view nearest to the normal, lit from each direction: a layer of the paper's Figure 4
    #[arg(long, value_name = "S.png")]
    sheet: Option<PathBuf>,
}

const PLAIN: &str = "plain";
/// Maximum length of a table of heights, in bytes (1 GiB).
const MAX_BYTES: u64 = 1 << 30;
/// Height of white above black in a picture, in edges of the patch.
const PICTURE_DEPTH: f64 = 0.1;
/// Reflectance of `plain` and of patches from a file.
const COLOR: [f64; 3] = [0.5; 3];

fn refused(error: impl Display) -> Problem {
    Problem::usage(error.to_string(), "see `crossbar bi-scale texture --help`")
}

pub(super) fn run(args: &Args) -> miette::Result<Findings> {
    let view = LocalDirections::new(args.views.into())?;
    let light = LocalDirections::new(args.directions.into())?;
    let (views, lights) = (view.directions().len(), light.directions().len());
    let size = args.texels as usize;
    let nearest = view.nearest(glam::DVec3::Z);
    let patch = patch_of(&args.source)?;
    let bar = ProgressBar::new("views", 1).quicker("fewer `--views` or `--texels`");
    let start = Instant::now();
    let mut done = |done: usize, of: usize| bar.show("views".to_owned(), done as u64, of as u64);
    let texture = patch.texture(size, &view, &light, &mut done).map_err(refused)?;
    let seconds = start.elapsed().as_secs_f64();
    drop(bar);
    write_file(&args.out, |out| write_bidirectional_texture(&texture, out)).map_err(Problem::from)?;
    if let Some(path) = &args.sheet {
        let image = png(&sheet(&texture, nearest))?;
        write_file(path, |out| out.write_all(&image)).map_err(Problem::from)?;
    }
    let mean = mean_reflectance(&texture);
    let largest = texture.samples().iter().flatten().fold(0.0_f32, |a, b| a.max(*b));
    let (depth, bytes) = (patch.heights().depth(), views * lights * size * size * 12);
    let mut found = Findings::new("Bidirectional texture");
    found.fields(json!({
        "views": views, "lights": lights, "size": size, "depth": depth, "bytes": bytes, "bytes_of_8_bits": bytes / 4,
        "mean_reflectance": mean, "largest": largest, "seconds": seconds,
    }));
    found.print(format!("patch     {size} x {size} texels, depth {depth:.3} of its edge"));
    let texels = counted(bytes / 12);
    found.print(format!("samples   {views} views x {lights} directions of light, {texels} texels"));
    let [red, green, blue] = mean.map(|mean| format!("{mean:.3}"));
    found.print(format!(
        "mean      {red}, {green}, {blue} of uniform light is reflected, on average over all texels and views"
    ));
    found.print(format!("bytes     {} as written; {} with 8 bits per channel", counted(bytes), counted(bytes / 4)));
    written(&mut found, [("out", Some(args.out.as_path())), ("sheet", args.sheet.as_deref())]);
    Ok(found)
}

fn patch_of(source: &Path) -> miette::Result<MesoPatch> {
    let name = source.to_str().unwrap_or_default();
    if let Ok(kind) = name.parse::<PatchKind>() {
        return Ok(kind.patch(1.0));
    }
    let material = MesoMaterial::diffuse(COLOR);
    if name == PLAIN {
        return Ok(MesoPatch::plain(material).map_err(refused)?);
    }
    given::require_file(source, "patch", &[PatchKind::VARIANTS, &[PLAIN]].concat(), "png")?;
    let heights = heights(source)?;
    let texels = vec![MesoTexel::default(); heights.side() * heights.side()];
    Ok(MesoPatch::new(heights, vec![material], texels).map_err(refused)?)
}

/// Heights from a table of numbers, in edges of the patch, or from the mean of a picture's channels.
fn heights(path: &Path) -> miette::Result<HeightField> {
    let no_heights = |error: InputError| refused(format!("{}: {error}", path.display()));
    let ends = |known: &str| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known));
    let (columns, heights) = if ["csv", "npy", "txt"].into_iter().any(ends) {
        let table = load_numbers::<f64>(path, "table of heights", MAX_BYTES)?;
        (table.columns, table.values)
    } else {
        let picture = load_picture(path)?;
        HeightField::check_side(picture.width().max(picture.height()) as usize).map_err(no_heights)?;
        let mean = |rgb: &[f32; 3]| rgb.iter().map(|&value| f64::from(value)).sum::<f64>() / 3.0;
        let linear = picture.linear().map_err(no_heights)?;
        (picture.width() as usize, linear.iter().map(|rgb| PICTURE_DEPTH * mean(rgb)).collect())
    };
    let rows = heights.len() / columns.max(1);
    if rows != columns {
        let what = format!("{}: expected as many rows as columns, found {columns} x {rows}", path.display());
        return Err(Problem::usage(what, "cut a square out of the table").into());
    }
    Ok(HeightField::new(columns, &heights).map_err(no_heights)?)
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
