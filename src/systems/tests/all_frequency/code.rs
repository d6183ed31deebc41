//! Coding of transfer as integers of a few bits.

use crossbar_systems::all_frequency::code::{CodeOptions, CodeSize, CodedSegment, ScaleOf, SparseRows};
use crossbar_systems::all_frequency::compressed::CompressedSegment;
use crossbar_systems::clustering::{AffineSubspace, Clustering};

use super::{coded, sample};
use crate::geom::random::CounterRng;

/// The representative of each weight.
fn representative_of_weight(part: &CodedSegment) -> Vec<usize> {
    let firsts = firsts(part);
    let of_vertex = |&cluster: &u16| {
        let first = firsts[usize::from(cluster)];
        first..first + usize::from(part.counts[usize::from(cluster)])
    };
    part.cluster_of.iter().flat_map(of_vertex).collect()
}

/// The index of each cluster's first representative.
fn firsts(part: &CodedSegment) -> Vec<usize> {
    (0..part.counts.len()).map(|at| part.counts[..at].iter().map(|&count| usize::from(count)).sum()).collect()
}

/// The root mean square weight on each representative.
fn mean_weights(part: &CompressedSegment) -> Vec<f64> {
    let clustering = &part.clustering;
    let mean = |cluster: usize, vector: usize| {
        let of_cluster = clustering.of_point().iter().enumerate().filter(|(_, of)| **of as usize == cluster);
        let weights: Vec<f64> = of_cluster.map(|(point, _)| clustering.weights(point)[vector]).collect();
        let squares: f64 = weights.iter().map(|weight| weight * weight).sum();
        (squares / weights.len().max(1) as f64).sqrt()
    };
    let clusters = clustering.subspaces().iter().enumerate();
    clusters.flat_map(|(k, subspace)| (0..subspace.len()).map(move |vector| mean(k, vector))).collect()
}

/// Coding a segment again with equal bits changes it only by the rounding of steps; with fewer bits, a number moves by
/// at most half a step.
#[test]
fn numbers_stay_within_half_a_step() {
    for scale in [ScaleOf::Representative, ScaleOf::Segment] {
        let fine = CodeOptions { scale, ..CodeOptions::default() };
        let coded = coded(3, 16, fine);
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
                for (at, row) in representative_of_weight(fine).into_iter().enumerate() {
                    let of = |part: &CodedSegment| f64::from(part.weights[at]) * f64::from(part.weight_steps[row]);
                    let step = f64::from(coarse.weight_steps[row]);
                    assert!((of(fine) - of(coarse)).abs() <= step * (0.5 + 1e-9), "weight {at}, {bits} bits");
                }
            }
        }
    }
    let none = CodeOptions { weight_bits: 1, ..CodeOptions::default() };
    assert!(coded(1, 4, CodeOptions::default()).recoded(none).is_err());
}

#[test]
fn decoded_transfer_is_as_near_as_the_steps() {
    let transfer = sample(3, 16);
    for scale in [ScaleOf::Representative, ScaleOf::Segment] {
        for bits in [8, 12, 16] {
            let options = CodeOptions { representative_bits: bits, weight_bits: bits, scale };
            for (part, code) in transfer.iter().zip(&coded(3, 16, options).segments) {
                code.decode(|point, decoded| {
                    let mut expected = vec![0.0; 48];
                    part.clustering.approximation(point, &mut expected);
                    let bound = bound(part, code, point);
                    for (a, b) in decoded.iter().zip(&expected) {
                        assert!((a - b).abs() <= bound, "{bits} bits, {scale:?}: {a} for {b}, {bound}");
                    }
                });
            }
        }
    }
}

/// Error bound: half a step of each factor, plus rounding in sums of about 4 terms.
fn bound(part: &CompressedSegment, code: &CodedSegment, point: usize) -> f64 {
    let first = firsts(code)[part.clustering.of_point()[point] as usize];
    let terms = part.clustering.weights(point).iter().enumerate().map(|(k, weight)| {
        let steps = [&code.representative_steps, &code.weight_steps].map(|steps| 0.5 * f64::from(steps[first + k]));
        // Representatives have length 1, so none of their numbers exceeds 1.
        weight.abs() * steps[0] + steps[1] * (1.0 + steps[0])
    });
    terms.sum::<f64>() * (1.0 + 1e-9) + 1e-12
}

/// Representatives times the sizes of their weights become multiples of the step, within half a step or clamped to 16
/// bits; a coarser step leaves fewer numbers.
#[test]
fn an_absolute_step_is_that_of_numbers_with_weights_of_about_1() {
    let transfer = sample(3, 16);
    let mut nonzeros = Vec::new();
    for halves in [4, 10, 16] {
        let step = 1.0 / f64::from(1_u32 << halves);
        for part in &transfer {
            let coded = CodedSegment::code_in_steps(part, step, CodeOptions::default()).expect("coded");
            let sizes = mean_weights(part);
            let codes = coded.representatives.decode();
            let rows = part
                .clustering
                .subspaces()
                .iter()
                .flat_map(|cluster| cluster.vectors())
                .zip(codes.chunks_exact(coded.representatives.columns()));
            for ((row, codes), size) in rows.zip(sizes) {
                for (value, &code) in row.iter().zip(codes) {
                    let (value, found) = (value * size, f64::from(code) * step);
                    let is_cut = code == i16::MAX || code == i16::MIN;
                    // The step of a representative is stored in single precision.
                    assert!(is_cut || (found - value).abs() <= step * 0.51 + 1e-6 * value.abs(), "{value} {found}");
                }
            }
            nonzeros.push(coded.representatives.nonzeros());
        }
    }
    let of_steps: Vec<usize> = nonzeros.chunks(2).map(|parts| parts.iter().sum()).collect();
    assert!(of_steps[0] < of_steps[1] && of_steps[1] <= of_steps[2], "{of_steps:?}");
    let none = CodeOptions { weight_bits: 1, ..CodeOptions::default() };
    assert!(CodedSegment::code_in_steps(&transfer[0], 1.0, none).is_err());
}

#[test]
fn sizes_are_counted_by_part() {
    let transfer = sample(2, 8);
    let fine = coded(2, 8, CodeOptions::default());
    let (nonzeros, all) = fine.nonzeros();
    let representatives: usize = fine.segments.iter().map(|part| part.representatives.rows()).sum();
    let weights: usize = transfer.iter().map(|part| part.clustering.all_weights().len()).sum();
    assert!(all == 16 * representatives && nonzeros <= all);
    let size = fine.size();
    let expected = CodeSize {
        representatives: 3 * nonzeros as u64,
        columns: 2 * 2 * 16,
        weights: 2 * weights as u64,
        steps: 8 * representatives as u64,
        clusters: 2 * 5 + 2 * 42,
    };
    assert_eq!((size, fine.clusters()), (expected, 4));
    assert_eq!(size.total() - size.as_the_paper_counts(), 64 + size.steps + 94);
    let options = CodeOptions { representative_bits: 8, weight_bits: 12, scale: ScaleOf::Segment };
    let coarse = coded(2, 8, options);
    let nonzeros = coarse.nonzeros().0 as u64;
    let size = coarse.size();
    let bytes = |part: &CompressedSegment| (12 * part.clustering.all_weights().len() as u64).div_ceil(8);
    let weights = transfer.iter().map(bytes).sum::<u64>();
    assert_eq!((size.representatives, size.weights, size.steps), (2 * nonzeros, weights, 16));
}

/// Weights of any size, on a single vector of a single number, are coded as multiples of their step, ties to even.
#[test]
fn numbers_come_back_within_half_a_step() {
    let coded = |weights: Vec<f64>, weight_bits: u8| {
        let one = AffineSubspace { mean: vec![0.0], vectors: vec![1.0], eigenvalues: vec![1.0] };
        let vertices: Vec<u32> = (0..weights.len() as u32).collect();
        let clustering = Clustering::new(vec![one], vec![0; weights.len()], weights).expect("a clustering");
        let part = CompressedSegment { segment: 0, vertices, clustering };
        let coded = CodedSegment::code(&part, CodeOptions { weight_bits, ..CodeOptions::default() }).expect("coded");
        (coded.weights, f64::from(coded.weight_steps[0]))
    };
    for bits in 2..=16 {
        for largest in [1.0, 0.3, 1e-30, 7e20, 1e-44] {
            let values: Vec<f64> = (0..=64).map(|k| largest * (f64::from(k) / 32.0 - 1.0)).collect();
            let (codes, step) = coded(values.clone(), bits);
            for (value, code) in values.into_iter().zip(codes) {
                assert!(i32::from(code).abs() < 1 << (bits - 1), "{bits} bits: {code}");
                let back = f64::from(code) * step;
                // The quotient has a rounding error of at most 2^-53 times 2^15.
                assert!((back - value).abs() <= step * (0.5 + 1e-11), "{bits} bits of {largest}: {value} to {back}");
            }
        }
    }
    assert_eq!(coded(vec![0.0; 2], 16), (vec![0; 2], 0.0));
    assert_eq!(coded(vec![0.5, 1.5, 2.5, -0.5, 32767.0], 16), (vec![0, 2, 2, 0, 32767], 1.0));
}

#[test]
fn rows_come_back() {
    let random = CounterRng::new(4);
    for (rows, columns) in [(0, 3), (1, 1), (5, 7), (256, 3), (257, 2), (700, 5)] {
        let draw = |at: usize| match random.bits(at as u64, 0, 0) % 5 {
            0 => ((random.bits(at as u64, 1, 0) & 0xffff) as u16).cast_signed(),
            _ => 0,
        };
        let values: Vec<i16> = (0..rows * columns).map(draw).collect();
        let sparse = SparseRows::encode(&values, columns);
        assert_eq!(sparse.decode(), values, "{rows} x {columns}");
        let (counts, of_rows, of_values) = sparse.parts();
        let parts = (counts.to_vec(), of_rows.to_vec(), of_values.to_vec());
        assert_eq!(SparseRows::from_parts(rows, columns, parts.0, parts.1, parts.2).as_ref(), Some(&sparse));
        let nonzeros = values.iter().filter(|value| **value != 0).count();
        assert_eq!((sparse.nonzeros(), sparse.block_count()), (nonzeros, rows.div_ceil(256)));
    }
}

#[test]
fn parts_that_do_not_go_together_are_refused() {
    let of = |rows, columns, counts: &[u16], of_rows: &[u8], values: &[i16]| {
        SparseRows::from_parts(rows, columns, counts.to_vec(), of_rows.to_vec(), values.to_vec())
    };
    assert!(of(3, 2, &[2, 0], &[0, 2], &[5, 6]).is_some());
    for (counts, of_rows, values) in [
        (&[2][..], &[0, 2][..], &[5, 6][..]),
        (&[2, 1], &[0, 2], &[5, 6]),
        (&[2, 0], &[0, 3], &[5, 6]),
        (&[2, 0], &[2, 0], &[5, 6]),
        (&[2, 0], &[0, 2], &[5, 0]),
        (&[2, 0], &[0, 2], &[5]),
    ] {
        assert_eq!(of(3, 2, counts, of_rows, values), None, "{counts:?} {of_rows:?} {values:?}");
    }
}

#[test]
fn a_column_holds_the_rows_of_its_block() {
    let mut values = vec![0; 2 * 300];
    (values[3], values[2 * 255 + 1], values[2 * 256 + 1], values[2 * 299]) = (-7, 5, i16::MIN, 9);
    let sparse = SparseRows::encode(&values, 2);
    assert_eq!(sparse.parts(), (&[0, 2, 1, 1][..], &[1, 255, 43, 0][..], &[-7, 5, 9, i16::MIN][..]));
}
