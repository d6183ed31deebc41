//! The page of a picture.

use super::args::Args;
use crate::cli::words::counted;
use crate::picture::{Picture, RgbImage};
use crate::report::{Findings, NamedPicture};
use crate::scene::Camera;

pub(super) fn page(args: &Args, camera: &Camera, image: RgbImage, layers: Picture, caption: &str) -> Findings {
    let mut found = Findings::new(format!("A picture of {}", args.scene.display()));
    found.taken_from(camera.world_to_camera());
    found.pictures(vec![NamedPicture::new("picture", image, caption)]);
    found.paragraph("layers.exr has the numbers: depth along the view (Z) and triangle of what each pixel shows.");
    found.keep_layers("layers", layers);
    found
}

/// Number of covered pixels, and the path of the picture.
pub(super) fn hits_line(hits: usize, pixels: usize, args: &Args) -> String {
    format!("{} of {} pixels hit; written to {}", counted(hits), counted(pixels), args.out.display())
}
