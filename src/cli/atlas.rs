//! `crossbar atlas`: maps a mesh to a square texture.

use std::path::PathBuf;

use super::model_name;
use super::scene_name::EyeArgs;
use super::study::{StudyArgs, StudyFiles};
use crate::atlas::{MAX_SIDE, require_side};
use crate::options::Size;
use crate::options::number;
use crate::study::atlas::{AtlasStudy, no_atlas};

const EXAMPLES: &str = "\
Examples:
  crossbar atlas docs/examples/teapot.obj --side 256
      how evenly the texels are distributed over the faces, and how connected and compact the clusters are
  crossbar atlas stanford-bunny --side 512 --out out/bunny
      pictures of the atlas and the mesh, colored by face and by the clusters of some levels; a file of the mesh with \
texture coordinates

The side is a power of two, up to 8192; every face needs at least one texel.
Written to --out: index.html (self-contained), study.json, evenness.csv, levels.csv, mesh.csv, faces.png and level_N.png \
(the atlas), model_*.png (the mesh in the same colors), atlas.obj and atlas.mtl (each face split into two triangles, \
with texture coordinates), faces.csv (each face's rectangle). docs/atlas.md explains these files.";

/// Map a mesh into a square of texels, with clusters of faces for every level: the multiresolution meshed atlas
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A Wavefront OBJ, PLY, STL or glTF file, a scene file (.toml), a built-in scene, or a stand-in for a model
    /// of the paper: stanford-bunny, stand-in-dolphin, stand-in-head
    #[arg(value_name = "MODEL")]
    model: PathBuf,

    /// Texels along a side of the atlas: a power of two
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = number::whole::<u32>(1..=MAX_SIDE))]
    side: u32,

    /// Size of the pictures of the mesh, in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", allow_hyphen_values = true, requires = "out")]
    size: Size,

    /// Folder for the pictures, the tables, the page and the mesh [default: write nothing]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl StudyArgs for Args {
    type Study = AtlasStudy;
    const QUICKER: &'static str = "a smaller `--side`";

    fn files(&self) -> StudyFiles<'_> {
        StudyFiles::new(self.out.as_deref(), model_name::named_file(&self.model))
    }

    fn study(&self) -> miette::Result<AtlasStudy> {
        require_side(self.side).map_err(no_atlas)?;
        let mesh = model_name::mesh(&self.model)?;
        let camera = match self.out {
            Some(_) if !mesh.is_empty() => Some(EyeArgs::default().framing(&mesh, self.size)?),
            _ => None,
        };
        Ok(AtlasStudy { name: self.model.display().to_string(), mesh, side: self.side, camera })
    }
}
