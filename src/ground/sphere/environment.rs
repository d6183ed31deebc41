//! Distant light from pictures of the whole sphere, and radiance lookups in such pictures.

use glam::DVec3;
use rayon::prelude::*;

use super::harmonics::{MAX_ORDER, function_count, harmonics};
use super::layout::{EnvironmentLayout, LayoutGrid};
use super::light::HarmonicLight;
use crate::error::{InputError, input_error};
use crate::picture::Picture;
use crate::quadrature::{GaussPoint, gauss_legendre};

impl HarmonicLight {
    /// Projects a picture of the whole sphere, with constant radiance over each pixel. Its shape determines its layout.
    /// Pixels that show no direction are not read.
    pub fn from_picture(order: usize, picture: &Picture) -> Result<Self, InputError> {
        let (grid, pixels) = read(picture)?;
        Ok(Self::projected(project(&grid, order, &pixels)))
    }
}

/// Picture of the whole sphere for lookups of radiance by direction: constant over each pixel.
#[derive(Debug)]
pub struct EnvironmentPicture {
    grid: LayoutGrid,
    pixels: Vec<[f32; 3]>,
}

impl EnvironmentPicture {
    /// Reads a picture, whose shape determines its layout. Pixels that show no direction are not read.
    pub fn new(picture: &Picture) -> Result<Self, InputError> {
        let (grid, pixels) = read(picture)?;
        Ok(Self { grid, pixels })
    }

    /// Radiance in a unit direction: red, green and blue.
    pub fn radiance(&self, direction: DVec3) -> [f64; 3] {
        self.pixels[self.grid.pixel(direction)].map(f64::from)
    }
}

fn read(picture: &Picture) -> Result<(LayoutGrid, Vec<[f32; 3]>), InputError> {
    let [width, height] = [picture.width(), picture.height()];
    let layout = EnvironmentLayout::of(width, height).ok_or_else(|| {
        input_error!("crossbar::sphere::shape" =>
            "expected a lat-long picture (width twice the height), an angular probe (a square), a cube cross (4:3 \
             or 3:4, of whole squares) or a cube strip (1:6), found {width}x{height}")
    })?;
    let pixels = picture.linear()?;
    let grid = LayoutGrid::new(layout, width as usize, height as usize);
    check(&pixels, width as usize, |column, row| grid.shows(column, row))?;
    Ok((grid, pixels))
}

/// Checks that all texels that show a direction are finite.
fn check(pixels: &[[f32; 3]], columns: usize, shows: impl Fn(usize, usize) -> bool) -> Result<(), InputError> {
    for (at, pixel) in pixels.iter().enumerate() {
        let (column, row) = (at % columns, at / columns);
        for (channel, &found) in ["red", "green", "blue"].into_iter().zip(pixel) {
            if !found.is_finite() && shows(column, row) {
                return Err(input_error!("crossbar::sphere::texel" =>
                    "expected finite radiance, found {found} in channel {channel} of the pixel in column {column}, \
                     row {row} (counted from 0, the top left)"));
            }
        }
    }
    Ok(())
}

/// Projects a function that is constant over each texel; texels have three channels, row by row.
///
/// The solid angle is exact; the mean of a harmonic over a texel is computed by a Gauss rule, with more points where
/// texels are large. Rows are summed one by one, then added in order: the bits do not depend on the number of threads.
fn project(grid: &LayoutGrid, order: usize, pixels: &[[f32; 3]]) -> [Vec<f64>; 3] {
    let (count, [columns, rows]) = (function_count(order), grid.size());
    let rule = rule_for((columns * rows).isqrt());
    let of_row = |row: usize| {
        let mut sums = [[0.0; MAX_ORDER * MAX_ORDER]; 3];
        let [mut y, mut of_texel] = [[0.0; MAX_ORDER * MAX_ORDER]; 2];
        for column in 0..columns {
            let solid_angle = grid.solid_angle(column, row);
            let color = pixels[row * columns + column];
            if solid_angle > 0.0 && color != [0.0; 3] {
                texel(grid, [column, row], &rule, order, &mut y, &mut of_texel);
                for (sums, radiance) in sums.iter_mut().zip(color) {
                    let scale = solid_angle * f64::from(radiance);
                    sums[..count].iter_mut().zip(&of_texel).for_each(|(sum, mean)| *sum += scale * mean);
                }
            }
        }
        sums
    };
    let by_row: Vec<[[f64; MAX_ORDER * MAX_ORDER]; 3]> = (0..rows).into_par_iter().map(of_row).collect();
    std::array::from_fn(|channel| (0..count).map(|i| by_row.iter().map(|row| row[channel][i]).sum()).collect())
}

fn texel(
    grid: &LayoutGrid,
    texel: [usize; 2],
    rule: &[GaussPoint],
    order: usize,
    y: &mut [f64; MAX_ORDER * MAX_ORDER],
    means: &mut [f64; MAX_ORDER * MAX_ORDER],
) {
    let count = function_count(order);
    means.fill(0.0);
    let mut whole = 0.0;
    for &(v, row_weight) in rule {
        for &(u, weight) in rule {
            let (direction, density) = grid.at(texel, u, v);
            let weight = row_weight * weight * density;
            harmonics(order, direction, &mut y[..count]);
            means[..count].iter_mut().zip(y.iter()).for_each(|(mean, y)| *mean += weight * y);
            whole += weight;
        }
    }
    if whole > 0.0 {
        means[..count].iter_mut().for_each(|mean| *mean /= whole);
    } else {
        // A sliver at the rim of a probe may contain no point of the rule.
        harmonics(order, grid.at(texel, 0.5, 0.5).0, &mut means[..count]);
    }
}

fn rule_for(side: usize) -> Vec<GaussPoint> {
    gauss_legendre(match side {
        0..24 => 8,
        24..96 => 5,
        96..384 => 3,
        _ => 2,
    })
}
