//! The rays of all vertices: blocked or not, and their hits.

use rayon::prelude::*;

use crate::error::InputError;
use crate::geom::{Hit, Ray};
use crate::sphere::DirectionRule;
use crate::tracer::Caster;
use crate::transfer::error::cast_error;
use crate::transfer::{FrontHit, Occluders, Shooter, VertexRays, Vertices, ones, origins};

/// Number of vertices whose rays are traced together.
const BLOCK: usize = 64;

/// Numbers of rays, and vertices with defects.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TransferCounts {
    /// Number of rays: vertices times directions.
    pub rays: u64,
    /// Number of rays that the caster traced; all others are certainly unblocked, or point below the geometric horizon.
    pub traced: u64,
    /// Number of blocked rays.
    pub blocked: u64,
    /// Blocked rays below the geometric horizon: behind all triangles on which the vertex lies.
    pub below_horizon: u64,
    /// Blocked rays that end at the back of a triangle, which is black; counted only if hits are kept.
    pub from_behind: u64,
    /// Vertices whose rays are all blocked.
    pub dark: Vec<u32>,
    /// Dark vertices more than half of whose rays first hit the back of a triangle: they lie inside an object.
    pub buried: Vec<u32>,
    /// Vertices on triangles that face each other so that no ray origin is in front of all of them.
    pub unclear: Vec<u32>,
}

/// Results of one ray per vertex and direction; directions are a hemisphere rule in the vertex's local frame.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedRays {
    rule: DirectionRule,
    vertices: usize,
    /// Number of 64-bit words per vertex.
    words: usize,
    blocked: Vec<u64>,
    hits: Vec<Vec<FrontHit>>,
    keeps_hits: bool,
    counts: TransferCounts,
}

impl TracedRays {
    /// Traces the directions of a rule over the hemisphere from each vertex. The caster must trace the mesh from which
    /// the vertices were made, and both sides of triangles. Interreflection needs `keep_hits`, which takes 16 bytes per
    /// blocked ray.
    ///
    /// Rays that certainly hit nothing are not cast, which does not change the result; nor does the number of threads.
    pub fn trace(
        vertices: &Vertices,
        rule: DirectionRule,
        caster: &mut dyn Caster,
        keep_hits: bool,
    ) -> Result<Self, InputError> {
        let words = rule.len().div_ceil(64);
        let occluders = Occluders::new(vertices);
        let origins = origins(vertices, &occluders);
        let unclear = (0..vertices.len()).filter(|&vertex| !origins[vertex].is_clear);
        let counts = TransferCounts {
            rays: (vertices.len() * rule.len()) as u64,
            unclear: unclear.map(|vertex| vertex as u32).collect(),
            ..TransferCounts::default()
        };
        let shooter = Shooter::new(vertices, &rule, &origins, &occluders);
        let blocked = vec![0; words * vertices.len()];
        let (hits, keeps_hits, vertices) = (Vec::new(), keep_hits, vertices.len());
        let mut traced = Self { rule, vertices, words, blocked, hits, keeps_hits, counts };
        traced.shadows(&shooter, caster)?;
        traced.hits(&shooter, caster)?;
        Ok(traced)
    }

    /// The rule whose directions were traced.
    pub fn rule(&self) -> &DirectionRule {
        &self.rule
    }

    /// Numbers of rays, and vertices with defects.
    pub fn counts(&self) -> &TransferCounts {
        &self.counts
    }

    /// True if the ray of a vertex in a direction is blocked. Panics if there is no such vertex or direction.
    pub fn is_blocked(&self, vertex: usize, direction: usize) -> bool {
        assert!(direction < self.rule.len(), "a direction of the rule");
        self.words(vertex)[direction / 64] >> (direction % 64) & 1 != 0
    }

    /// The number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.vertices
    }

    /// True if [`Self::trace`] was called with `keep_hits`.
    pub fn keeps_hits(&self) -> bool {
        self.keeps_hits
    }

    /// The hits of a vertex's rays on front faces.
    pub(crate) fn front_hits(&self, vertex: usize) -> &[FrontHit] {
        self.hits.get(vertex).map_or(&[], Vec::as_slice)
    }

    /// The blocked directions of a vertex, in increasing order.
    pub(crate) fn blocked_directions(&self, vertex: usize) -> impl Iterator<Item = usize> + '_ {
        self.words(vertex).iter().enumerate().flat_map(|(word, &bits)| ones(bits).map(move |bit| 64 * word + bit))
    }

    /// One bit per direction of a vertex, set if the direction is blocked.
    fn words(&self, vertex: usize) -> &[u64] {
        &self.blocked[vertex * self.words..(vertex + 1) * self.words]
    }

    fn shadows(&mut self, shooter: &Shooter<'_>, caster: &mut dyn Caster) -> Result<(), InputError> {
        let Self { vertices, words, blocked, counts, .. } = self;
        let words = *words;
        for (first, blocked) in (0..*vertices).step_by(BLOCK).zip(blocked.chunks_mut(BLOCK * words)) {
            let asked: Vec<VertexRays> = blocked
                .par_chunks_mut(words)
                .enumerate()
                .map_init(Vec::new, |waiting, (at, bits)| shooter.shadow_rays(first + at, waiting, bits))
                .collect();
            let rays: Vec<Ray> = asked.iter().flat_map(|asked| &asked.rays).copied().collect();
            let mut answers = caster.occluded(&rays).map_err(cast_error)?.into_iter();
            counts.traced += rays.len() as u64;
            for (bits, asked) in blocked.chunks_mut(words).zip(&asked) {
                for (&direction, is_blocked) in asked.directions.iter().zip(answers.by_ref()) {
                    bits[direction as usize / 64] |= u64::from(is_blocked) << (direction % 64);
                }
                counts.below_horizon += asked.below_horizon;
            }
        }
        counts.blocked = blocked.par_iter().map(|bits| u64::from(bits.count_ones())).sum();
        let all = self.rule.len() as u32;
        let of_vertex = blocked.chunks(words).map(|bits| bits.iter().map(|word| word.count_ones()).sum::<u32>());
        let dark = (0..).zip(of_vertex).filter(|&(_, blocked)| blocked == all);
        counts.dark = dark.map(|(vertex, _)| vertex).collect();
        Ok(())
    }

    /// Finds the hits of blocked rays: for all vertices if hits are kept, otherwise only for dark vertices, to find the
    /// buried ones.
    fn hits(&mut self, shooter: &Shooter<'_>, caster: &mut dyn Caster) -> Result<(), InputError> {
        let wanted: Vec<u32> = match self.keeps_hits() {
            true => (0..self.vertices as u32).collect(),
            false => self.counts().dark.clone(),
        };
        for block in wanted.chunks(BLOCK) {
            let asked: Vec<(Vec<u32>, Vec<Ray>)> = block
                .par_iter()
                .map(|&vertex| shooter.rays(vertex as usize, self.blocked_directions(vertex as usize)))
                .collect();
            let rays: Vec<Ray> = asked.iter().flat_map(|(_, rays)| rays).copied().collect();
            let mut answers = caster.cast(&rays).map_err(cast_error)?.into_iter();
            let answered: Vec<Vec<Option<Hit>>> =
                asked.iter().map(|(_, rays)| answers.by_ref().take(rays.len()).collect()).collect();
            let found: Vec<(Vec<FrontHit>, u64)> = asked
                .par_iter()
                .zip(&answered)
                .map(|((directions, rays), hits)| shooter.front_hits(directions, rays, hits))
                .collect();
            let Self { rule, counts, hits, keeps_hits, .. } = self;
            for (&vertex, (front, behind)) in block.iter().zip(found) {
                if counts.dark.binary_search(&vertex).is_ok() && 2 * behind > rule.len() as u64 {
                    counts.buried.push(vertex);
                }
                if *keeps_hits {
                    counts.from_behind += behind;
                    hits.push(front);
                }
            }
        }
        Ok(())
    }
}

/// The origin of each vertex's rays, for tests.
#[doc(hidden)]
pub fn ray_origins(vertices: &Vertices) -> Vec<[f32; 3]> {
    origins(vertices, &Occluders::new(vertices)).into_iter().map(|origin| origin.at).collect()
}
