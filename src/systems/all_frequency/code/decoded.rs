//! Decoding of a coded segment, and recoding it with fewer bits for a precision study.

use rayon::prelude::*;

use super::coded::steps;
use super::quantise::quantise;
use super::{CodeOptions, CodedSegment, CodedTransfer, SparseRows};
use crate::clustering::Signal;
use crate::error::InputError;

impl CodedSegment {
    /// The index of each vertex's first weight.
    fn weight_begins(&self) -> Vec<usize> {
        let mut begin = 0;
        let next = self.cluster_of.iter().map(|&cluster| {
            begin += usize::from(self.counts[usize::from(cluster)]);
            begin - usize::from(self.counts[usize::from(cluster)])
        });
        next.collect()
    }

    /// Decodes the transfer of each vertex, and passes its index within the segment and its numbers to `of`, in
    /// several threads.
    pub fn decode<T: Send>(&self, of: impl Fn(usize, &[f64]) -> T + Sync) -> Vec<T> {
        let (codes, columns) = (self.representatives.decode(), self.representatives.columns());
        let (firsts, begins) = (self.firsts(), self.weight_begins());
        let vertices = (0..self.vertices.len()).into_par_iter().map_init(
            || vec![0.0; columns],
            |sum, at| {
                let cluster = usize::from(self.cluster_of[at]);
                let weights = &self.weights[begins[at]..][..usize::from(self.counts[cluster])];
                sum.fill(0.0);
                for (&weight, row) in weights.iter().zip(firsts[cluster]..) {
                    let steps = f64::from(self.weight_steps[row]) * f64::from(self.representative_steps[row]);
                    let weight = f64::from(weight) * steps;
                    let codes = &codes[row * columns..][..columns];
                    sum.iter_mut().zip(codes).for_each(|(sum, &code)| *sum += weight * f64::from(code));
                }
                of(at, sum)
            },
        );
        vertices.collect()
    }

    /// Squared differences from the original transfer, vertex by vertex. Panics if the signal has another number of
    /// points or dimensions.
    pub fn squared_errors(&self, signal: &Signal) -> Vec<f64> {
        let shape = (self.vertices.len(), self.representatives.columns());
        assert_eq!((signal.points(), signal.dimension()), shape, "the signal's shape");
        self.decode(|at, decoded| {
            let differences = decoded.iter().zip(signal.point(at)).map(|(a, &b)| a - f64::from(b));
            differences.map(|difference| difference * difference).sum()
        })
    }
}

impl CodedTransfer {
    /// Codes the decoded numbers again. A number's error is then up to half a step of each code.
    pub fn recoded(&self, options: CodeOptions) -> Result<Self, InputError> {
        options.check()?;
        let segments = self.segments.iter().map(|part| part.recoded(options)).collect();
        Ok(Self { options, segments, ..*self })
    }
}

impl CodedSegment {
    fn recoded(&self, options: CodeOptions) -> Self {
        let columns = self.representatives.columns();
        let of_steps = |steps: &[f32]| steps.iter().map(|&step| f64::from(step)).collect::<Vec<_>>();
        let [old_rows, old_weights] = [&self.representative_steps, &self.weight_steps].map(|steps| of_steps(steps));
        let codes = self.representatives.decode();
        let value = |code: i16, step: f64| f64::from(code) * step;
        let most = |row: &[i16], step| row.iter().fold(0.0_f64, |most, &code| most.max(value(code, step).abs()));
        let largest: Vec<f64> =
            codes.chunks_exact(columns).zip(&old_rows).map(|(row, &step)| most(row, step)).collect();
        let representative_steps = steps(&largest, options.representative_bits, options.scale);
        let rows = codes.chunks_exact(columns).zip(old_rows.iter().zip(&representative_steps));
        let recoded: Vec<i16> =
            rows.flat_map(|(row, (&old, &new))| row.iter().map(move |&code| quantise(value(code, old), new))).collect();

        let of_weight = self.representative_of_weight();
        let mut largest = vec![0.0_f64; old_weights.len()];
        for (&weight, &row) in self.weights.iter().zip(&of_weight) {
            largest[row] = largest[row].max(value(weight, old_weights[row]).abs());
        }
        let weight_steps = steps(&largest, options.weight_bits, options.scale);
        let weights = self.weights.iter().zip(&of_weight);
        let weights = weights.map(|(&weight, &row)| quantise(value(weight, old_weights[row]), weight_steps[row]));
        Self {
            representatives: SparseRows::encode(&recoded, columns),
            representative_steps,
            weights: weights.collect(),
            weight_steps,
            ..self.clone()
        }
    }

    pub(in crate::all_frequency) fn representative_of_weight(&self) -> Vec<usize> {
        let firsts = self.firsts();
        let of_vertex = |&cluster: &u16| {
            let first = firsts[usize::from(cluster)];
            first..first + usize::from(self.counts[usize::from(cluster)])
        };
        self.cluster_of.iter().flat_map(of_vertex).collect()
    }
}
