//! Coded transfer in fewer bits: what a precision study compares.

use super::coded::steps;
use super::quantise::quantise;
use super::{CodeOptions, CodedSegment, CodedTransfer, SparseRows};
use crate::error::InputError;

impl CodedTransfer {
    /// The decoded numbers, coded again. A number that is rounded twice has an error of up to half a step of each code.
    ///
    /// # Errors
    /// [`InputError`].
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

    /// Weight by weight the representative that it weighs.
    pub(in crate::all_frequency) fn representative_of_weight(&self) -> Vec<usize> {
        let firsts = self.firsts();
        let of_vertex = |&cluster: &u16| {
            let first = firsts[usize::from(cluster)];
            first..first + usize::from(self.counts[usize::from(cluster)])
        };
        self.cluster_of.iter().flat_map(of_vertex).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::all_frequency::code::ScaleOf;
    use crate::all_frequency::compressed::tests::sample;

    /// Coded again as it is, nothing changes but by the rounding of steps; in fewer bits a number moves by half a step.
    #[test]
    fn numbers_stay_within_half_a_step() {
        for scale in [ScaleOf::Representative, ScaleOf::Segment] {
            let fine = CodeOptions { scale, ..CodeOptions::default() };
            let coded = CodedTransfer::new(&sample(3, 16), fine).expect("coded");
            assert_eq!(coded.recoded(fine).expect("coded"), coded, "{scale:?}");
            for bits in [4, 8, 12] {
                let options = CodeOptions { representative_bits: bits, weight_bits: bits, scale };
                let coarse = coded.recoded(options).expect("coded");
                for (fine, coarse) in coded.segments.iter().zip(&coarse.segments) {
                    let (columns, rows) = (fine.representatives.columns(), fine.representatives.rows());
                    let codes = [fine, coarse].map(|part| part.representatives.decode());
                    for row in 0..rows {
                        let steps = [fine, coarse].map(|part| f64::from(part.representative_steps[row]));
                        let rows = codes.each_ref().map(|codes| &codes[row * columns..(row + 1) * columns]);
                        for (&fine, &coarse) in rows[0].iter().zip(rows[1]) {
                            let [a, b] = [f64::from(fine) * steps[0], f64::from(coarse) * steps[1]];
                            assert!((a - b).abs() <= steps[1] * (0.5 + 1e-9), "{bits} bits: {a} to {b}");
                        }
                    }
                    for (at, row) in fine.representative_of_weight().into_iter().enumerate() {
                        let of = |part: &CodedSegment| f64::from(part.weights[at]) * f64::from(part.weight_steps[row]);
                        let step = f64::from(coarse.weight_steps[row]);
                        assert!((of(fine) - of(coarse)).abs() <= step * (0.5 + 1e-9), "weight {at}, {bits} bits");
                    }
                }
            }
        }
        let none = CodeOptions { weight_bits: 1, ..CodeOptions::default() };
        assert!(CodedTransfer::new(&sample(1, 4), CodeOptions::default()).expect("coded").recoded(none).is_err());
    }
}
