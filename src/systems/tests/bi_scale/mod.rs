//! Directions, matrices and biclusters, textures and pixels, and products and pictures on a card.

mod blocks;
mod display;
mod gather;
mod kernels;
mod matrix;
mod texture;

use crossbar_systems::bi_scale::directions::LocalDirections;
use crossbar_systems::bi_scale::texture::BidirectionalTexture;
use refsim::texture::TexelFormat;

const FLOATS: TexelFormat = TexelFormat::Rgba32f;

fn directions(side: usize) -> LocalDirections {
    LocalDirections::new(side).expect("directions")
}

/// A texture whose samples are a function of their index.
fn texture(size: usize, views: usize, lights: usize, value: impl Fn(usize) -> [f32; 3]) -> BidirectionalTexture {
    let count = size * size * views * views * lights * lights;
    let samples = (0..count).map(value).collect();
    BidirectionalTexture::new(size, directions(views), directions(lights), samples).expect("a texture")
}
