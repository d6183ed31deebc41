//! Options of `crossbar prt render` for bi-scale transfer.

use super::texture_args::TextureArgs;
use super::textures::refuse;
use crate::cli::Problem;

/// Options of bi-scale transfer.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Options of bi-scale transfer")]
pub(in crate::cli::prt) struct BiScaleRenderArgs {
    #[command(flatten)]
    pub(super) textures: TextureArgs,

    /// Draw a picture by rays too, and tell the error apart by its causes; takes milliseconds per pixel. All textures
    /// must be patches
    #[arg(long)]
    pub(super) reference: bool,
}

impl BiScaleRenderArgs {
    /// Refuses all of these for transfer of other kinds.
    pub(in crate::cli::prt) fn refuse(&self) -> Result<(), Problem> {
        refuse(self.textures.given().chain([("--reference", self.reference)]))
    }
}
