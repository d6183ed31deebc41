//! Visibility by rays. Rays are cast only in directions whose result is not certain beforehand.

use glam::DVec3;
use rayon::prelude::*;

use super::maps::{Horizon, VisibilityMaps, VisibilitySampling};
use crate::error::InputError;
use crate::geom::Ray;
use crate::geom::vector::{narrow, wide};
use crate::tracer::Caster;
use crate::transfer::error::{cast_error, require};
use crate::transfer::grid::{LIGHT_TEXELS, texel_center};
use crate::transfer::{LocalFrame, Occluders, RayOrigin, SkyPart, Vertices, origins, ray_length};

/// The largest sine of the angle from a light texel's center to one of its fine directions: 3/4 of half a diagonal at
/// the middle of a face is 0.0332, which is rounded up.
const TEXEL_SINE: f64 = 0.034;

/// The fine directions of a vertex in which rays must be cast.
#[derive(Debug, Default)]
struct UndecidedDirections {
    fine: Vec<u32>,
    /// Number of directions above the horizon, including decided ones.
    above: u64,
}

/// Sets the bits of directions that are certainly unblocked, and lists the directions that may be blocked.
fn look(
    (frame, origin): (&LocalFrame, &RayOrigin),
    occluders: &Occluders,
    sampling: VisibilitySampling,
    waiting: &mut Vec<u32>,
    bits: &mut [u64],
) -> UndecidedDirections {
    let skyline = occluders.skyline(wide(origin.at), frame, waiting);
    let (fine_directions, normal) = (sampling.directions(), frame.normal());
    let sees_below = sampling.horizon == Horizon::Geometry;
    let mut asked = UndecidedDirections::default();
    for texel in 0..LIGHT_TEXELS {
        let center = texel_center(texel);
        let height = normal.dot(center);
        if height <= -TEXEL_SINE && !sees_below {
            continue;
        }
        let is_high = height >= TEXEL_SINE && origin.planes.iter().any(|plane| plane.dot(center) >= TEXEL_SINE);
        // The skyline does not cover directions below the plane of the normal.
        let may_be_blocked = height < TEXEL_SINE && sees_below || skyline.may_block(frame.to_local(center), TEXEL_SINE);
        for fine in fine_directions.in_texel(texel) {
            let direction = fine_directions.directions()[fine];
            let is_below = !is_high && normal.dot(direction) <= 0.0;
            if is_below && !sees_below {
                continue;
            }
            if !is_high && origin.is_below_horizon(direction) {
                continue;
            }
            asked.above += 1;
            if is_below || may_be_blocked && skyline.is_marked(SkyPart::of(frame.to_local(direction))) {
                asked.fine.push(fine as u32);
            } else {
                bits[fine / 64] |= 1 << (fine % 64);
            }
        }
    }
    asked
}

/// Like [`look`], but lists all directions above the horizon.
fn look_everywhere(
    (frame, origin): (&LocalFrame, &RayOrigin),
    _: &Occluders,
    sampling: VisibilitySampling,
    _: &mut Vec<u32>,
    _: &mut [u64],
) -> UndecidedDirections {
    let sees_below = sampling.horizon == Horizon::Geometry;
    let is_above =
        |direction: DVec3| (sees_below || frame.normal().dot(direction) > 0.0) && !origin.is_below_horizon(direction);
    let all = (0..).zip(sampling.directions().directions());
    let fine: Vec<u32> = all.filter(|(_, direction)| is_above(**direction)).map(|(fine, _)| fine).collect();
    UndecidedDirections { above: fine.len() as u64, fine }
}

/// The signature of [`look`].
type Look =
    fn((&LocalFrame, &RayOrigin), &Occluders, VisibilitySampling, &mut Vec<u32>, &mut [u64]) -> UndecidedDirections;

/// Number of vertices whose rays are cast together.
const BLOCK: usize = 32;

/// Generator of the rays.
struct Rays<'a> {
    sampling: VisibilitySampling,
    vertices: &'a Vertices,
    origins: Vec<RayOrigin>,
    length: f64,
}

impl Rays<'_> {
    /// The rays of a vertex in some directions, except rays that overflow single precision.
    fn of(&self, vertex: u32, fine: &[u32]) -> (Vec<u32>, Vec<Ray>) {
        let ray = |fine: u32| {
            let direction = self.length * self.sampling.directions().directions()[fine as usize];
            Some((fine, Ray::new(self.origins[vertex as usize].at, narrow(direction)).ok()?))
        };
        fine.iter().filter_map(|&fine| ray(fine)).unzip()
    }
}

impl VisibilityMaps {
    /// [`Self::trace_sampled`] with the default sampling.
    pub fn trace(
        vertices: &Vertices,
        of: &[u32],
        caster: &mut dyn Caster,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, InputError> {
        Self::trace_sampled(vertices, of, VisibilitySampling::default(), caster, done)
    }

    /// Computes the maps of some vertices of a mesh, by any-hit rays in the fine directions. The caster must trace the
    /// mesh from which the vertices were made, and both sides of triangles. A vertex's rays start at an offset from all
    /// triangles on which it lies. `done` is called with the number of finished vertices and their total.
    ///
    /// Rays that certainly hit nothing are not cast, which does not change the result; nor does the number of threads.
    ///
    /// The maps take [`VISIBILITY_BYTES`](super::VISIBILITY_BYTES) per vertex; rays that wait to be cast take at most
    /// 32 vertices times 98,304 directions times 30 bytes, 90 MB.
    pub fn trace_sampled(
        vertices: &Vertices,
        of: &[u32],
        sampling: VisibilitySampling,
        caster: &mut dyn Caster,
        done: &mut dyn FnMut(usize, usize),
    ) -> Result<Self, InputError> {
        Self::traced((vertices, of), sampling, caster, done, look)
    }

    /// Like [`Self::trace_sampled`], but casts every ray: the reference for its tests.
    pub fn trace_all(
        vertices: &Vertices,
        of: &[u32],
        sampling: VisibilitySampling,
        caster: &mut dyn Caster,
    ) -> Result<Self, InputError> {
        Self::traced((vertices, of), sampling, caster, &mut |_, _| (), look_everywhere)
    }

    fn traced(
        (vertices, of): (&Vertices, &[u32]),
        sampling: VisibilitySampling,
        caster: &mut dyn Caster,
        done: &mut dyn FnMut(usize, usize),
        look: Look,
    ) -> Result<Self, InputError> {
        check(vertices, of)?;
        let occluders = Occluders::new(vertices);
        let rays = Rays { sampling, vertices, origins: origins(vertices, &occluders), length: ray_length(vertices) };
        let mut maps = Self::dark(of, sampling);
        let map_words = sampling.words();
        let is_unclear = |vertex: &&u32| !rays.origins[**vertex as usize].is_clear;
        maps.counts.unclear = of.iter().filter(is_unclear).copied().collect();
        for (block, of_block) in of.chunks(BLOCK).enumerate() {
            let words = &mut maps.words_mut()[block * BLOCK * map_words..];
            let asked: Vec<(UndecidedDirections, Vec<Ray>)> = words
                .par_chunks_mut(map_words)
                .zip(of_block)
                .map_init(Vec::new, |waiting, (bits, &vertex)| {
                    let at = (&rays.vertices.frames()[vertex as usize], &rays.origins[vertex as usize]);
                    let mut asked = look(at, &occluders, sampling, waiting, bits);
                    let cast;
                    (asked.fine, cast) = rays.of(vertex, &asked.fine);
                    (asked, cast)
                })
                .collect();
            let all: Vec<Ray> = asked.iter().flat_map(|(_, rays)| rays).copied().collect();
            let mut answers = caster.occluded(&all).map_err(cast_error)?.into_iter();
            for (bits, (asked, _)) in words.chunks_mut(map_words).zip(&asked) {
                for (&fine, _) in asked.fine.iter().zip(answers.by_ref()).filter(|(_, is_blocked)| !is_blocked) {
                    bits[fine as usize / 64] |= 1 << (fine % 64);
                }
            }
            for (asked, rays) in &asked {
                maps.counts.above += asked.above;
                maps.counts.traced += rays.len() as u64;
            }
            done(block * BLOCK + of_block.len(), of.len());
        }
        maps.count_visible();
        Ok(maps)
    }
}

pub(crate) fn check(vertices: &Vertices, of: &[u32]) -> Result<(), InputError> {
    let unknown = of.iter().find(|&&vertex| vertex as usize >= vertices.len());
    let (what, expected) = ("a vertex's number", "one below the number of vertices");
    unknown.map_or(Ok(()), |&vertex| require(false, what, expected, f64::from(vertex)))
}
