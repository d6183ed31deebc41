//! A pixel by ray tracing, as in the paper's reference pictures, and with the approximations of transfer introduced one
//! by one, so that the error of a picture can be attributed to its causes.
//!
//! Exact here means: light in 128 x 128 texels per face, each visible or not from the pixel's point, and the patch of
//! heights evaluated at the exact directions. Sums are in f64, in the order of directions.

use glam::DVec3;

use super::pixel::ShadedPixel;
use crate::bi_scale::paper;
use crate::bi_scale::texture::{BidirectionalTexture, GridSamples, MesoPatch, SeenPoint};
use crate::geom::Ray;
use crate::geom::vector::{narrow, wide};
use crate::tracer::HostTracer;
use crate::tracer::offset::SurfacePoint;
use crate::transfer::LocalFrame;
use crate::transfer::grid::{FINE_DIRECTIONS, FineDirections, LIGHT_TEXELS, light_texel, texel_center};
use crate::transfer::visibility::{Horizon, VisibilitySampling};

/// Approximations of transfer; each step includes the previous ones.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TracedRung {
    /// No approximation.
    Exact,
    /// Light is constant over each of the 6 x 32 x 32 texels.
    Light,
    /// A texel's visibility is the mean over its 2^m x 2^m directions.
    Visibility,
    /// A texel's light arrives from the local direction nearest to its center.
    Directions,
    /// The patch is sampled at the texture's views and interpolated between them.
    Views,
    /// The patch is also sampled at texels and interpolated between them: it is a texture.
    Texture,
}

impl TracedRung {
    /// All steps, in order.
    pub const ALL: [Self; 6] =
        [Self::Exact, Self::Light, Self::Visibility, Self::Directions, Self::Views, Self::Texture];
}

const RUNGS: usize = TracedRung::ALL.len();

/// A light at the resolutions of ray tracing and of transfer.
#[derive(Clone, Copy, Debug)]
pub struct TracedLight<'a> {
    /// Radiance in each fine direction, 6 x 128 x 128.
    pub fine: &'a [[f64; 3]],
    /// Radiance of each light texel, 6 x 32 x 32.
    pub texels: &'a [[f64; 3]],
}

/// A point of a mesh and its pixel's frame.
#[derive(Clone, Copy, Debug)]
pub struct TracedPoint {
    /// The point on its triangle.
    pub point: SurfacePoint,
    /// The pixel's local frame.
    pub frame: LocalFrame,
}

/// A mesh that casts shadows.
#[derive(Debug)]
pub struct TracedScene<'a> {
    /// Tracer that hits both sides of the mesh's triangles.
    pub tracer: &'a HostTracer,
    /// A ray length that reaches beyond the mesh from all of its points.
    pub length: f64,
    /// Sampling of visibility for transfer.
    pub sampling: VisibilitySampling,
}

impl TracedScene<'_> {
    /// Visibility of light from a point, one bool per direction of a sampling; false where the texel has no light.
    fn sees_light(&self, of: &TracedPoint, directions: &FineDirections, texels: &[[f64; 3]]) -> Vec<bool> {
        let origin = of.point.lifted(of.point.normal, 0.0);
        let sees = |direction: DVec3| {
            let is_above = self.sampling.horizon == Horizon::Geometry || of.frame.normal().dot(direction) > 0.0;
            if !is_above || of.point.normal.dot(direction) <= 0.0 {
                return false;
            }
            let ray = Ray::new(origin, narrow(self.length * direction));
            ray.is_ok_and(|ray| !self.tracer.occluded_before(&ray, 1.0).0)
        };
        let mut found = vec![false; directions.directions().len()];
        let lit = texels.iter().enumerate().filter(|(_, radiance)| **radiance != [0.0; 3]);
        for number in lit.flat_map(|(texel, _)| directions.in_texel(texel)) {
            found[number] = sees(directions.directions()[number]);
        }
        found
    }

    /// The pixel's radiance for every step, in the order of [`TracedRung::ALL`]. Panics if the light does not have one
    /// radiance per direction or texel.
    pub fn rungs(
        &self,
        of: &TracedPoint,
        pixel: &ShadedPixel,
        (patch, texture): (&MesoPatch, &BidirectionalTexture),
        light: TracedLight<'_>,
    ) -> [[f64; 3]; RUNGS] {
        assert_eq!((light.fine.len(), light.texels.len()), (FINE_DIRECTIONS, LIGHT_TEXELS), "radiance of each");
        let (fine, coarse) = (FineDirections::get(), self.sampling.directions());
        let [sees, sees_coarsely] = [fine, coarse].map(|directions| self.sees_light(of, directions, light.texels));
        let seen = patch.seen(pixel.place, pixel.view);
        let mut rungs = [[0.0; 3]; RUNGS];
        let mut add = |rung: TracedRung, b: [f64; 3], radiance: [f64; 3], solid_angle: f64| {
            let into = &mut rungs[rung as usize];
            (0..3).for_each(|channel| into[channel] += b[channel] * radiance[channel] * solid_angle);
        };
        // The patch's response integrated over each texel, and each texel's solid angle.
        let mut of_texel = vec![[0.0; 3]; LIGHT_TEXELS];
        let mut solid_angles = vec![0.0; LIGHT_TEXELS];
        for (number, &direction) in fine.directions().iter().enumerate() {
            let (texel, solid_angle) = (light_texel(number), fine.solid_angles()[number]);
            solid_angles[texel] += solid_angle;
            if light.texels[texel] == [0.0; 3] {
                continue;
            }
            let b = patch.reflected(&seen, of.frame.to_local(direction));
            if sees[number] {
                add(TracedRung::Exact, b, light.fine[number], solid_angle);
                add(TracedRung::Light, b, light.texels[texel], solid_angle);
            }
            (0..3).for_each(|channel| of_texel[texel][channel] += b[channel] * solid_angle);
        }
        let directions = texture.light();
        let of_view = |seen: &SeenPoint| -> Vec<[f64; 3]> {
            directions.directions().iter().map(|&direction| patch.reflected(seen, direction)).collect()
        };
        let responses = of_view(&seen);
        let mut local = vec![[0.0; 3]; responses.len()];
        for (texel, &radiance) in light.texels.iter().enumerate() {
            let open = coarse.in_texel(texel).filter(|&number| sees_coarsely[number]).count();
            let share = open as f64 / coarse.in_texel(texel).count() as f64;
            add(TracedRung::Visibility, of_texel[texel], radiance, share);
            let nearest = directions.nearest(of.frame.to_local(texel_center(texel)));
            add(TracedRung::Directions, responses[nearest], radiance, share * solid_angles[texel]);
            (0..3).for_each(|channel| local[nearest][channel] += radiance[channel] * share * solid_angles[texel]);
        }
        let around = GridSamples::of_view(texture.view(), pixel.view);
        for (view, weight) in around.numbers.into_iter().zip(around.weights).filter(|(_, weight)| *weight > 0.0) {
            let responses = of_view(&patch.seen(pixel.place, texture.view().directions()[view]));
            for (b, &arriving) in responses.into_iter().zip(&local) {
                add(TracedRung::Views, b, arriving, weight);
            }
        }
        let own = ShadedPixel { corners: [0; 3], weights: [1.0, 0.0, 0.0], ..*pixel };
        rungs[TracedRung::Texture as usize] = paper::radiance(texture, &local, &own);
        rungs
    }
}

impl TracedPoint {
    /// The point of a triangle at these barycentric weights; `None` if the triangle is degenerate.
    pub fn new(corners: [[f32; 3]; 3], weights: [f64; 3], frame: LocalFrame) -> Option<Self> {
        let point = SurfacePoint::of(corners.map(wide), DVec3::from(weights), crate::tracer::offset::SINGLE)?;
        Some(Self { point, frame })
    }
}
