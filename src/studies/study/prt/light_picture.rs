//! Picture of a distant light, shown with the pictures that it lights.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use rayon::prelude::*;

use crate::elementary::sin_cos;
use crate::error::InputError;
use crate::picture::Picture;
use crate::report::NamedPicture;
use crate::transfer::grid::{LIGHT_MAP, LIGHT_SIDE};

/// Width of the picture in pixels, twice its height.
const WIDTH: u32 = 320;
/// Linear value of the median non-black pixel.
const MIDDLE_GREY: f64 = 0.18;

/// Lat-long picture of the radiance from every direction, in the layout that `--light` reads: its middle is +y, its
/// right is +x, and up is +z. The median non-black pixel is 18 % grey.
pub(in crate::study) fn light_picture(
    name: impl Into<String>,
    light: &str,
    radiance: impl Fn(DVec3) -> [f64; 3] + Sync,
) -> Result<NamedPicture, InputError> {
    let height = WIDTH / 2;
    let pixel = |at: u32| {
        let [column, row] = [at % WIDTH, at / WIDTH].map(|center| f64::from(center) + 0.5);
        let (sine, cosine) = sin_cos(row * PI / f64::from(height));
        let (x, y) = sin_cos((column / f64::from(WIDTH) - 0.5) * TAU);
        radiance(DVec3::new(sine * x, sine * y, cosine)).map(|channel| channel.max(0.0))
    };
    let colors: Vec<[f64; 3]> = (0..WIDTH * height).into_par_iter().map(pixel).collect();
    let mut bright: Vec<f64> =
        colors.iter().map(|color| color.iter().sum::<f64>() / 3.0).filter(|&l| l > 0.0).collect();
    bright.sort_by(f64::total_cmp);
    let exposure = bright.get(bright.len() / 2).map_or(1.0, |median| MIDDLE_GREY / median);
    let single: Vec<[f32; 3]> = colors.iter().map(|color| color.map(|channel| channel as f32)).collect();
    let caption = format!("the light, {light}: its middle is +y, its right +x, up +z");
    Ok(NamedPicture::new(name, Picture::rgb(WIDTH, height, &single).display(exposure)?, caption))
}

/// Radiance of the texels of a cube of light by direction, for [`light_picture`].
pub(in crate::study) fn of_texels(texels: &[[f64; 3]]) -> impl Fn(DVec3) -> [f64; 3] + Sync {
    |direction| {
        let [face, column, row] = LIGHT_MAP.texel_of(direction);
        texels[(face * LIGHT_SIDE + row) * LIGHT_SIDE + column]
    }
}
