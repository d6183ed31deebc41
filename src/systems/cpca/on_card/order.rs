//! The vertex programs' sums on the host, in their order and precision: the bits that the card must give.
//!
//! alpha times the mean's product comes first, then weight times product is added vector by vector: product and sum
//! are rounded one after the other, or together on devices with a fused multiply-add.

use refsim::device::{MadMode, Rules};
use refsim::num::{Format, ops};

use super::error::PrtCardError;
use super::products::Products;
use super::transfer::CompressedTransfer;
use super::weights::CardWeights;

/// The exit radiance of every vertex as the card computes it: three channels per vertex, with one number per row of the
/// transfer.
///
/// # Errors
/// [`PrtCardError`] if the parts of the transfer have contradictory sizes.
pub fn exit_coefficients(
    rules: &Rules,
    transfer: &CompressedTransfer<'_>,
    card_weights: &CardWeights,
    products: &Products,
) -> Result<Vec<[Vec<f32>; 3]>, PrtCardError> {
    transfer.shape()?;
    let of_point = transfer.clustering.of_point().iter().enumerate();
    let of_vertex = |(vertex, &cluster): (usize, &u32)| {
        let weights = transfer.clustering.weights(vertex).iter().enumerate();
        let weights: Vec<f32> =
            weights.map(|(at, &weight)| card_weights.attribute(cluster as usize, at, weight)).collect();
        let vectors: Vec<[&[f32]; 3]> = products.vectors(cluster as usize).collect();
        [0, 1, 2].map(|channel| {
            let row = |row| sum(rules, transfer.vectors, &weights, vectors.iter().map(|vector| vector[channel][row]));
            (0..transfer.basis.len()).map(row).collect()
        })
    };
    Ok(of_point.map(of_vertex).collect())
}

/// 1 times the first number plus weight times number; up to `vectors` weights, those that are missing being 0.
fn sum(rules: &Rules, vectors: usize, weights: &[f32], mut numbers: impl Iterator<Item = f32>) -> f32 {
    let format = rules.vertex_format;
    let enter = |value: f32| ops::convert(&Format::FP32, format, value.to_bits()).bits;
    let mut next = || enter(numbers.next().unwrap_or(0.0));
    let mut sum = ops::mul(format, enter(1.0), next()).bits;
    for vector in 0..vectors {
        let (weight, number) = (enter(weights.get(vector).copied().unwrap_or(0.0)), next());
        sum = match rules.mad {
            MadMode::TwoRoundings => ops::add(format, ops::mul(format, weight, number).bits, sum).bits,
            MadMode::Fused => ops::fused_mad(format, weight, number, sum).bits,
        };
    }
    f32::from_bits(ops::convert(&format, Format::FP32, sum).bits)
}
