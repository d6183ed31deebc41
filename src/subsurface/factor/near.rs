//! Factors of near texels: both parts are divided until their pieces are far.

use glam::DVec3;

use super::face_map::{FaceMap, Window};
use super::kernel::Kernel;
use super::moments::{Covariance, Moments};
use super::surface::SurfaceMoments;

/// Texels are halved at most this often along a side.
const MAX_HALVINGS: u32 = 4;
/// Where more halvings than this are needed, texels exceed the mean free path so far that nearly all light stays in its
/// texel: two will do.
const HOPELESS: u32 = 6;

/// A piece of the surface under one texel. Areas of all pieces of a texel of one size are equal.
#[derive(Clone, Copy)]
struct Piece<'a> {
    face: &'a FaceMap,
    window: Window,
    moments: Moments,
}

impl<'a> Piece<'a> {
    fn of_texel(surface: &'a SurfaceMoments, texel: usize) -> Self {
        let (face, window) = surface.window(texel);
        Self { face, window, moments: surface.level(0)[texel] }
    }

    fn quarters(&self) -> [Self; 4] {
        let area = 0.25 * self.moments.area;
        let windows = self.window.quarters();
        if self.window.is_bent() {
            return windows.map(|window| Self { face: self.face, window, moments: self.face.moments(window, area) });
        }
        // Quarters of a parallelogram are alike.
        let first = self.face.moments(windows[0], area);
        let steps = [DVec3::ZERO, self.face.step(&windows[0], &windows[1]), self.face.step(&windows[0], &windows[2])];
        let offsets = [steps[0], steps[1], steps[2], steps[1] + steps[2]];
        std::array::from_fn(|k| {
            let moments = Moments { point: first.point + offsets[k], ..first };
            Self { face: self.face, window: windows[k], moments }
        })
    }
}

/// The mean of R_d over the pairs of points of two texels' parts, by Morton index. The same bits in either order.
pub(super) fn texel_mean<const N: usize>(
    surface: &SurfaceMoments,
    kernel: &Kernel<N>,
    one: usize,
    other: usize,
) -> [f64; N] {
    let [a, b] = [one.min(other), one.max(other)].map(|texel| Piece::of_texel(surface, texel));
    let needed = kernel.halvings(a.moments.radius_squared + b.moments.radius_squared);
    let halvings = if needed > HOPELESS { 2 } else { needed.min(MAX_HALVINGS) };
    piece_mean(kernel, &a, &b, halvings, one == other)
}

fn piece_mean<const N: usize>(
    kernel: &Kernel<N>,
    a: &Piece<'_>,
    b: &Piece<'_>,
    halvings: u32,
    is_same: bool,
) -> [f64; N] {
    let (p, q) = (&a.moments, &b.moments);
    let covariance: Covariance = p.covariance.plus(&q.covariance);
    let apart = q.point - p.point;
    if let Some(mean) = kernel.mean(apart, &covariance, p.radius_squared + q.radius_squared) {
        return mean;
    }
    if halvings == 0 {
        // Light that does not leave a piece is that within a disc of its area; what does comes from its middle. So
        // light that one piece loses by this the next one gets.
        return if is_same { kernel.disc(p.area) } else { kernel.at(apart.length_squared()) };
    }
    let from = a.quarters();
    let to = if is_same { from } else { b.quarters() };
    let mut sum = [0.0; N];
    for (i, a) in from.iter().enumerate() {
        for (j, b) in to.iter().enumerate() {
            let mean = piece_mean(kernel, a, b, halvings - 1, is_same && i == j);
            sum.iter_mut().zip(mean).for_each(|(sum, mean)| *sum += mean);
        }
    }
    sum.map(|sum| sum / 16.0)
}
