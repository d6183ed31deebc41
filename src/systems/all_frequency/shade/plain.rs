//! Transferred radiance by plain loops in f64.

use super::check_light;
use crate::all_frequency::code::CodedTransfer;
use crate::all_frequency::compressed::CompressedTransfer;
use crate::error::InputError;
use crate::linalg::dot;

/// A segment's part of equation 13.
struct PlainSegment<'a> {
    /// M^i L of each representative, m rows of 3 channels.
    products: Vec<[f64; 3]>,
    vertices: &'a [u32],
    /// For each vertex, its representatives and their weights.
    weights: Vec<Vec<(usize, f64)>>,
}

/// T_p by equation 13: `rows` rows of 3 channels per vertex.
fn sums<'a>(vertices: usize, rows: usize, segments: impl Iterator<Item = PlainSegment<'a>>) -> Vec<[f64; 3]> {
    let mut radiance = vec![[0.0; 3]; vertices * rows];
    for PlainSegment { products, vertices, weights } in segments {
        for (&vertex, weights) in vertices.iter().zip(&weights) {
            let into = &mut radiance[vertex as usize * rows..][..rows];
            for &(representative, weight) in weights {
                for (into, product) in into.iter_mut().zip(&products[representative * rows..][..rows]) {
                    (0..3).for_each(|c| into[c] += weight * product[c]);
                }
            }
        }
    }
    radiance
}

/// T_p from uncoded transfer. `light` is as in [`Shader::transferred`](super::Shader::transferred).
pub fn transferred(transfer: &CompressedTransfer, light: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, InputError> {
    let coefficients = transfer.coefficients();
    check_light(light.len(), coefficients, transfer.segments.last().map(|part| part.segment))?;
    let segments = transfer.segments.iter().map(|part| {
        let light = &light[part.segment * coefficients..][..coefficients];
        let channels = [0, 1, 2].map(|c| light.iter().map(|rgb| rgb[c]).collect::<Vec<f64>>());
        let subspaces = part.clustering.subspaces();
        let representatives = subspaces.iter().flat_map(|cluster| cluster.vectors());
        let matrix_rows = representatives.flat_map(|vector| vector.chunks_exact(coefficients));
        let firsts: Vec<usize> =
            subspaces.iter().scan(0, |next, cluster| Some(std::mem::replace(next, *next + cluster.len()))).collect();
        let of_point = |(point, &cluster): (usize, &u32)| {
            (firsts[cluster as usize]..).zip(part.clustering.weights(point).iter().copied()).collect()
        };
        PlainSegment {
            products: matrix_rows.map(|row| [0, 1, 2].map(|c| dot(row, &channels[c]))).collect(),
            vertices: &part.vertices,
            weights: part.clustering.of_point().iter().enumerate().map(of_point).collect(),
        }
    });
    Ok(sums(transfer.vertices, transfer.rows, segments))
}

/// T_p from coded transfer, decoded as integers times steps.
pub fn transferred_of_code(transfer: &CodedTransfer, light: &[[f64; 3]]) -> Result<Vec<[f64; 3]>, InputError> {
    let coefficients = transfer.coefficients;
    check_light(light.len(), coefficients, transfer.segments.last().map(|part| part.segment))?;
    let segments = transfer.segments.iter().map(|part| {
        let light = &light[part.segment * coefficients..][..coefficients];
        let product = |row: &[i16]| {
            let mut sum = [0.0; 3];
            for (&code, light) in row.iter().zip(light) {
                (0..3).for_each(|c| sum[c] += f64::from(code) * light[c]);
            }
            sum
        };
        let mut weights = part.weights.iter().zip(part.representative_of_weight()).map(|(&weight, row)| {
            let steps = f64::from(part.representative_steps[row]) * f64::from(part.weight_steps[row]);
            (row, f64::from(weight) * steps)
        });
        let of_cluster =
            |&cluster: &u16| weights.by_ref().take(usize::from(part.counts[usize::from(cluster)])).collect();
        PlainSegment {
            products: part.representatives.decode().chunks_exact(coefficients).map(product).collect(),
            vertices: &part.vertices,
            weights: part.cluster_of.iter().map(of_cluster).collect(),
        }
    });
    Ok(sums(transfer.vertices, transfer.rows, segments))
}
