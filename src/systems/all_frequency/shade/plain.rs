//! Transferred radiance by plain loops in f64.

use super::LightSizeError;
use crate::all_frequency::code::CodedTransfer;
use crate::all_frequency::compressed::CompressedTransfer;
use crate::linalg::dot;

/// T_p by equation 13 from transfer that is not coded: per vertex m rows of 3 channels. `light` is as in
/// [`Shader::transferred`](super::Shader::transferred).
///
/// # Errors
/// [`LightSizeError`].
pub fn transferred(transfer: &CompressedTransfer, light: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, LightSizeError> {
    let (rows, coefficients) = (transfer.rows, transfer.coefficients());
    let last = transfer.segments.last().map(|part| part.segment);
    LightSizeError::check(light.len(), coefficients, last)?;
    let mut radiance = vec![[0.0; 3]; transfer.vertices * rows];
    for part in &transfer.segments {
        let light = &light[part.segment * coefficients..][..coefficients];
        let channels = [0, 1, 2].map(|c| light.iter().map(|rgb| rgb[c]).collect::<Vec<f64>>());
        // M^i L of each representative of each cluster.
        let products: Vec<Vec<[f64; 3]>> = (part.clustering.subspaces().iter())
            .map(|cluster| {
                let rows = cluster.vectors().flat_map(|vector| vector.chunks_exact(coefficients));
                rows.map(|row| [0, 1, 2].map(|c| dot(row, &channels[c]))).collect()
            })
            .collect();
        for (point, &vertex) in part.vertices.iter().enumerate() {
            let products = &products[part.clustering.of_point()[point] as usize];
            let into = &mut radiance[vertex as usize * rows..][..rows];
            for (weight, products) in part.clustering.weights(point).iter().zip(products.chunks_exact(rows)) {
                for (into, product) in into.iter_mut().zip(products) {
                    (0..3).for_each(|c| into[c] += weight * product[c]);
                }
            }
        }
    }
    Ok(radiance)
}

/// The same from coded transfer, decoded as integers times steps.
///
/// # Errors
/// [`LightSizeError`].
pub fn transferred_of_code(transfer: &CodedTransfer, light: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, LightSizeError> {
    let (rows, coefficients) = (transfer.rows, transfer.coefficients);
    let last = transfer.segments.last().map(|part| part.segment);
    LightSizeError::check(light.len(), coefficients, last)?;
    let mut radiance = vec![[0.0; 3]; transfer.vertices * rows];
    for part in &transfer.segments {
        let light = &light[part.segment * coefficients..][..coefficients];
        let codes = part.representatives.decode();
        let product = |row: &[i16]| {
            let mut sum = [0.0; 3];
            for (&code, light) in row.iter().zip(light) {
                (0..3).for_each(|c| sum[c] += f64::from(code) * light[c]);
            }
            sum
        };
        let products: Vec<[f64; 3]> = codes.chunks_exact(coefficients).map(product).collect();
        let of_weight = part.representative_of_weight();
        let mut weights = part.weights.iter().zip(of_weight);
        for (&vertex, &cluster) in part.vertices.iter().zip(&part.cluster_of) {
            let into = &mut radiance[vertex as usize * rows..][..rows];
            for (&weight, row) in weights.by_ref().take(usize::from(part.counts[usize::from(cluster)])) {
                let steps = f64::from(part.representative_steps[row]) * f64::from(part.weight_steps[row]);
                for (into, product) in into.iter_mut().zip(&products[row * rows..][..rows]) {
                    (0..3).for_each(|c| into[c] += f64::from(weight) * steps * product[c]);
                }
            }
        }
    }
    Ok(radiance)
}
