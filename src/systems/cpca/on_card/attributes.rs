//! Data of vertices: the mesh in chunks, one per supercluster with all triangles that have a vertex in it (section
//! 6.2).

use std::mem::take;

use super::products::Products;
use super::transfer::CompressedTransfer;
use super::weights::CardWeights;
use crate::card::{Attribute, attribute, by_register};
use crate::cpca::coherence::Superclusters;
use crate::cpca::kernels::{VertexKernel, VertexShading};

/// Triangles that are drawn together, with the attributes of their vertices.
#[derive(Clone, Debug, Default)]
pub(super) struct Chunk {
    /// The supercluster's clusters, in the order of their constants.
    pub(super) clusters: Vec<u32>,
    /// Attributes by register: position, address and alpha, weights, and for glossy transfer tangent and normal.
    pub(super) attributes: Vec<Attribute>,
    pub(super) indices: Vec<u32>,
}

impl Chunk {
    /// The products of the chunk's clusters as constants: for diffuse transfer a color per vector, for glossy transfer
    /// the numbers of one channel, four per constant.
    pub(super) fn constants(&self, products: &Products, kernel: &VertexKernel, channel: usize) -> Vec<[f32; 4]> {
        let mut all = Vec::new();
        for vector in self.clusters.iter().flat_map(|&cluster| products.vectors(cluster as usize)) {
            match kernel.shading {
                VertexShading::Diffuse | VertexShading::DiffuseColor => {
                    let [r, g, b] = vector.map(|rows| rows[0]);
                    all.push([r, g, b, 0.0]);
                }
                VertexShading::Glossy { .. } => {
                    let four = |rows: &[f32]| [0, 1, 2, 3].map(|at| rows.get(at).copied().unwrap_or(0.0));
                    all.extend(vector[channel].chunks(4).map(four));
                }
            }
        }
        all
    }
}

pub(super) fn chunks(
    transfer: &CompressedTransfer<'_>,
    weights: &CardWeights,
    superclusters: &Superclusters,
    kernel: &VertexKernel,
    positions: &[[u32; 4]],
) -> Vec<Chunk> {
    let mut chunks = vec![Chunk::default(); superclusters.count()];
    let mut addresses = Vec::new();
    let mut used = vec![0; chunks.len()];
    for (cluster, &chunk) in superclusters.of_cluster().iter().enumerate() {
        chunks[chunk as usize].clusters.push(cluster as u32);
        addresses.push(used[chunk as usize]);
        used[chunk as usize] += (transfer.clustering.subspaces()[cluster].len() + 1) * kernel.per_vector();
    }
    let chunk_of = |vertex: u32| superclusters.of_cluster()[transfer.clustering.of_point()[vertex as usize] as usize];
    for corners in transfer.vertices.triangles() {
        let [a, b, c] = corners.map(chunk_of);
        let distinct = [Some(a), (b != a).then_some(b), (c != a && c != b).then_some(c)];
        distinct.into_iter().flatten().for_each(|chunk| chunks[chunk as usize].indices.extend(corners));
    }
    // Outside the supercluster, alpha and weights are 0.
    let attributes = |vertex: usize, inside: bool| {
        let clustering = transfer.clustering;
        let cluster = clustering.of_point()[vertex] as usize;
        let address = if inside { addresses[cluster] } else { 0 };
        let alpha = f64::from(u8::from(inside));
        let mut all = vec![positions[vertex], attribute([address as f64, alpha, 0.0], 0.0)];
        let own = if inside { clustering.weights(vertex) } else { &[] };
        let held = |at: usize| own.get(at).map_or(0.0, |&weight| weights.attribute(cluster, at, weight));
        let weight = |at: usize| held(at).to_bits();
        all.extend((0..kernel.weight_registers()).map(|register| [0, 1, 2, 3].map(|at| weight(4 * register + at))));
        if transfer.is_glossy() {
            all.extend(transfer.vertices.frames()[vertex].attributes());
        }
        all
    };
    let mut local = vec![u32::MAX; positions.len()];
    for (number, chunk) in (0..).zip(&mut chunks) {
        let globals = take(&mut chunk.indices);
        let mut vertices = Vec::new();
        chunk.indices.extend(globals.into_iter().map(|vertex| {
            if local[vertex as usize] == u32::MAX {
                local[vertex as usize] = vertices.len() as u32;
                vertices.push(vertex);
            }
            local[vertex as usize]
        }));
        vertices.iter().for_each(|&vertex| local[vertex as usize] = u32::MAX);
        chunk.attributes = by_register(kernel.attributes(), vertices.len(), |at| {
            let vertex = vertices[at];
            attributes(vertex as usize, chunk_of(vertex) == number)
        });
    }
    chunks
}
