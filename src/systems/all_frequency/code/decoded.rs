//! Decoding of a coded segment.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use super::CodedSegment;
use crate::transfer::Signal;

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

    /// Decodes the transfer of all vertices: `into` is called with the index of each vertex within the segment and its
    /// numbers, from several threads.
    pub fn decode(&self, into: impl Fn(usize, &[f64]) + Sync) {
        let (codes, columns) = (self.representatives.decode(), self.representatives.columns());
        let (firsts, begins) = (self.firsts(), self.weight_begins());
        (0..self.vertices.len()).into_par_iter().for_each_init(
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
                into(at, sum);
            },
        );
    }

    /// Vertex by vertex the decoded weights of its cluster's representatives.
    pub fn decoded_weights(&self) -> impl Iterator<Item = Vec<f64>> + '_ {
        let (firsts, begins) = (self.firsts(), self.weight_begins());
        self.cluster_of.iter().zip(begins).map(move |(&cluster, begin)| {
            let weights = &self.weights[begin..][..usize::from(self.counts[usize::from(cluster)])];
            let steps = &self.weight_steps[firsts[usize::from(cluster)]..];
            weights.iter().zip(steps).map(|(&weight, &step)| f64::from(weight) * f64::from(step)).collect()
        })
    }

    /// The decoded transfer of one vertex, by its index within the segment.
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn decoded(&self, at: usize) -> Vec<f64> {
        let (codes, columns) = (self.representatives.decode(), self.representatives.columns());
        let first = self.firsts()[usize::from(self.cluster_of[at])];
        let mut sum = vec![0.0; columns];
        for (weight, row) in self.decoded_weights().nth(at).into_iter().flatten().zip(first..) {
            let weight = weight * f64::from(self.representative_steps[row]);
            let codes = &codes[row * columns..][..columns];
            sum.iter_mut().zip(codes).for_each(|(sum, &code)| *sum += weight * f64::from(code));
        }
        sum
    }

    /// Squared differences from the original transfer, vertex by vertex.
    ///
    /// # Panics
    /// If the signal has another number of points or dimensions.
    pub fn squared_errors(&self, signal: &Signal) -> Vec<f64> {
        let shape = (self.vertices.len(), self.representatives.columns());
        assert_eq!((signal.points(), signal.dimension()), shape, "the signal's shape");
        let errors: Vec<AtomicU64> = (0..signal.points()).map(|_| AtomicU64::new(0)).collect();
        self.decode(|at, decoded| {
            let differences = decoded.iter().zip(signal.point(at)).map(|(a, &b)| a - f64::from(b));
            let square: f64 = differences.map(|difference| difference * difference).sum();
            errors[at].store(square.to_bits(), Ordering::Relaxed);
        });
        errors.into_iter().map(|bits| f64::from_bits(bits.into_inner())).collect()
    }
}
