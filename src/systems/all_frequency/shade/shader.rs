//! Coded transfer laid out for rendering.
//!
//! All sums are in f32 in a fixed order. A representative's sum runs over the light's coefficients, a vertex's sum over
//! its segments and their representatives. Threads and vector instructions change no bit.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::{Multiplies, TransferredRadiance, check_light};
use crate::all_frequency::code::{BLOCK_ROWS, CodedTransfer, SparseColumn, SparseRows};
use crate::error::InputError;

/// Numbers processed together by vector instructions.
const LANES: usize = 8;
/// Vertices per parallel task.
const VERTICES: usize = 256;

/// Coded transfer laid out for rendering.
#[derive(Clone, Debug)]
pub struct Shader {
    rows: usize,
    coefficients: usize,
    segments: Vec<ShaderSegment>,
    /// The start of each vertex's entries, followed by the end of the last vertex's entries.
    begins: Vec<u32>,
    entries: Vec<Entry>,
    weights: Vec<i16>,
    representatives: usize,
}

/// The representatives of a segment.
#[derive(Clone, Debug)]
struct ShaderSegment {
    segment: usize,
    representatives: SparseRows,
    /// For each representative, the product of its step and its weights' step.
    steps: Vec<f32>,
}

/// The part of a vertex that belongs to one segment.
#[derive(Clone, Copy, Debug)]
struct Entry {
    /// The index of the cluster's first representative among the representatives of all segments.
    first: u32,
    /// The index of its first weight, and the number of weights.
    weights: u32,
    count: u32,
}

impl Shader {
    /// Lays out coded transfer.
    pub fn new(transfer: &CodedTransfer) -> Self {
        let mut entries: Vec<Vec<Entry>> = vec![Vec::new(); transfer.vertices];
        let (mut weights, mut total) = (Vec::new(), 0);
        for part in &transfer.segments {
            let firsts = part.firsts();
            let mut at = weights.len();
            weights.extend_from_slice(&part.weights);
            for (&vertex, &cluster) in part.vertices.iter().zip(&part.cluster_of) {
                let cluster = usize::from(cluster);
                let count = usize::from(part.counts[cluster]);
                let first = (total + firsts[cluster]) as u32;
                entries[vertex as usize].push(Entry { first, weights: at as u32, count: count as u32 });
                at += count;
            }
            total += part.representatives.rows();
        }
        let mut begins = vec![0];
        begins.extend(entries.iter().scan(0, |end, entries| {
            *end += entries.len() as u32;
            Some(*end)
        }));
        let segments = transfer.segments.iter().map(|part| ShaderSegment {
            segment: part.segment,
            representatives: part.representatives.clone(),
            steps: part.representative_steps.iter().zip(&part.weight_steps).map(|(a, b)| a * b).collect(),
        });
        Self {
            rows: transfer.rows,
            coefficients: transfer.coefficients,
            segments: segments.collect(),
            begins,
            entries: entries.concat(),
            weights,
            representatives: total,
        }
    }

    /// Numbers per vertex or representative: 3 per row, plus one because a store writes 4, padded to a multiple of
    /// [`LANES`].
    fn stride(&self) -> usize {
        (3 * self.rows + 1).next_multiple_of(LANES)
    }

    /// T_p of all vertices under a light, given by its coefficients (red, green, blue), segment by segment.
    pub fn transferred(&self, light: &[[f32; 3]]) -> Result<TransferredRadiance, InputError> {
        Ok(self.weighted(&self.per_cluster(light)?))
    }

    /// M^i L for all representatives, times the steps of representative and weights: step 2 of section 6.
    pub fn per_cluster(&self, light: &[[f32; 3]]) -> Result<Vec<f32>, InputError> {
        let last = self.segments.last().map(|part| part.segment);
        check_light(light.len(), self.coefficients, last)?;
        let stride = self.stride();
        let mut products = vec![0.0; self.representatives * stride];
        let (mut tasks, mut rest) = (Vec::new(), &mut products[..]);
        for part in &self.segments {
            let light = &light[part.segment * self.coefficients..][..self.coefficients];
            for (block, steps) in part.representatives.blocks().zip(part.steps.chunks(BLOCK_ROWS)) {
                let (into, others) = rest.split_at_mut(steps.len() * stride);
                rest = others;
                tasks.push((block, steps, light, into));
            }
        }
        let level = SimdLevel::widest();
        tasks.into_par_iter().for_each(|(block, steps, light, into)| {
            level.run(
                #[inline(always)]
                || times(block, light, stride, steps, into),
            );
        });
        Ok(products)
    }

    /// The weighted sums of the products of [`Shader::per_cluster`]: step 3 of section 6.
    pub fn weighted(&self, products: &[f32]) -> TransferredRadiance {
        let (stride, level) = (self.stride(), SimdLevel::widest());
        let mut values = vec![0.0; (self.begins.len() - 1) * stride];
        values.par_chunks_mut(VERTICES * stride).enumerate().for_each(|(task, values)| {
            level.run(
                #[inline(always)]
                || {
                    for (into, range) in values.chunks_exact_mut(stride).zip(self.begins[task * VERTICES..].windows(2))
                    {
                        for entry in &self.entries[range[0] as usize..range[1] as usize] {
                            let weights = &self.weights[entry.weights as usize..][..entry.count as usize];
                            let products = products[entry.first as usize * stride..].chunks_exact(stride);
                            for (&weight, product) in weights.iter().zip(products) {
                                add_scaled(f32::from(weight), product, into);
                            }
                        }
                    }
                },
            );
        });
        TransferredRadiance { rows: self.rows, stride, values }
    }

    /// Number of multiplications for rendering under a light.
    pub fn multiplies(&self, light: &[[f32; 3]]) -> Multiplies {
        let lit = |segment: usize, column: usize| {
            let at = segment * self.coefficients + column % self.coefficients;
            light.get(at).is_some_and(|rgb| *rgb != [0.0; 3])
        };
        let of_segment = |part: &ShaderSegment| -> u64 {
            let columns = part.representatives.blocks().flat_map(Iterator::enumerate);
            columns.filter(|&(at, _)| lit(part.segment, at)).map(|(_, (rows, _))| rows.len() as u64).sum()
        };
        Multiplies {
            per_cluster: 3 * self.segments.iter().map(of_segment).sum::<u64>(),
            per_vertex: 3 * (self.rows * self.weights.len()) as u64,
        }
    }
}

/// Adds the products of a block's rows with light to `into`, `stride` numbers each. Columns with black light are
/// skipped.
#[inline(always)]
fn times<'a>(
    block: impl Iterator<Item = SparseColumn<'a>>,
    light: &[[f32; 3]],
    stride: usize,
    steps: &[f32],
    into: &mut [f32],
) {
    for (column, (rows, values)) in block.enumerate() {
        let [r, g, b] = light[column % light.len()];
        if [r, g, b] == [0.0; 3] {
            continue;
        }
        // The fourth number is 0, so it adds 0 to the first number of the next row.
        let (light, at) = ([r, g, b, 0.0], 3 * (column / light.len()));
        for (&row, &value) in rows.iter().zip(values) {
            let into = &mut into[usize::from(row) * stride + at..][..4];
            (0..4).for_each(|c| into[c] += f32::from(value) * light[c]);
        }
    }
    for (row, step) in into.chunks_exact_mut(stride).zip(steps) {
        row.iter_mut().for_each(|value| *value *= step);
    }
}

#[inline(always)]
fn add_scaled(scale: f32, from: &[f32], into: &mut [f32]) {
    let (from, into) = (from.as_chunks::<LANES>().0, into.as_chunks_mut::<LANES>().0);
    for (into, from) in into.iter_mut().zip(from) {
        (0..LANES).for_each(|lane| into[lane] += scale * from[lane]);
    }
}
