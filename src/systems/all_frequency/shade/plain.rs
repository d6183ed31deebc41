//! Transferred radiance by plain loops in f64.

use super::check_light;
use crate::all_frequency::code::CodedTransfer;
use crate::error::InputError;

/// T_p by equation 13 from coded transfer, decoded as integers times steps: m rows of 3 channels per vertex. `light` is
/// as in [`Shader::transferred`](super::Shader::transferred).
pub fn transferred(transfer: &CodedTransfer, light: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, InputError> {
    let (rows, coefficients) = (transfer.rows, transfer.coefficients);
    check_light(light.len(), coefficients, transfer.segments.last().map(|part| part.segment))?;
    let mut radiance = vec![[0.0; 3]; transfer.vertices * rows];
    for part in &transfer.segments {
        let light = &light[part.segment * coefficients..][..coefficients];
        let product = |row: &[i16]| {
            let mut sum = [0.0; 3];
            for (&code, light) in row.iter().zip(light) {
                (0..3).for_each(|c| sum[c] += f64::from(code) * light[c]);
            }
            sum
        };
        // M^i L of each representative, m rows of 3 channels.
        let products: Vec<[f64; 3]> = part.representatives.decode().chunks_exact(coefficients).map(product).collect();
        let mut weights = part.weights.iter().zip(part.representative_of_weight());
        for (&vertex, &cluster) in part.vertices.iter().zip(&part.cluster_of) {
            let into = &mut radiance[vertex as usize * rows..][..rows];
            for (&weight, i) in weights.by_ref().take(usize::from(part.counts[usize::from(cluster)])) {
                let steps = f64::from(part.representative_steps[i]) * f64::from(part.weight_steps[i]);
                let weight = f64::from(weight) * steps;
                for (into, product) in into.iter_mut().zip(&products[i * rows..][..rows]) {
                    (0..3).for_each(|c| into[c] += weight * product[c]);
                }
            }
        }
    }
    Ok(radiance)
}
