//! Superclusters: clusters whose constants are in the registers at the same time.

use std::collections::BTreeMap;

use super::{check_triangles, overdraw};
use crate::clustering::Clustering;
use crate::error::{InputError, input_error};

/// Constant registers for the products of clusters' vectors with the light (section 6.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ConstantRegisters {
    /// Number of registers for all clusters of a supercluster.
    pub limit: usize,
    /// Number of registers per representative vector.
    pub per_vector: usize,
}

impl ConstantRegisters {
    /// Registers for glossy transfer with N_r rows and one color per pass: four numbers per register, whole registers
    /// per vector.
    pub fn glossy(limit: usize, rows: usize) -> Self {
        Self { limit, per_vector: rows.div_ceil(4) }
    }

    /// Registers for diffuse transfer: one color per register.
    pub fn diffuse(limit: usize) -> Self {
        Self { limit, per_vector: 1 }
    }

    /// Number of registers of a cluster with a mean and n' vectors.
    pub fn needed(self, vectors: usize) -> usize {
        (vectors + 1).saturating_mul(self.per_vector)
    }
}

/// Clusters in groups that are drawn together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Superclusters {
    of_cluster: Vec<u32>,
    count: usize,
}

impl Superclusters {
    /// Begins with one supercluster per cluster. Repeatedly merges the two superclusters that share the most triangles
    /// and fit the registers together (on ties, the lowest), until no two neighbours fit.
    pub fn new(
        clustering: &Clustering,
        triangles: &[[u32; 3]],
        registers: ConstantRegisters,
    ) -> Result<Self, InputError> {
        check_triangles(triangles, clustering.points())?;
        let mut needed = needed(clustering, registers)?;
        let mut of_cluster: Vec<u32> = (0..needed.len() as u32).collect();
        let mut corners = mixed_triangles(triangles, clustering.of_point());
        while let Some((a, b)) = best_pair(&corners, &needed, registers.limit) {
            needed[a as usize] += needed[b as usize];
            of_cluster.iter_mut().filter(|of| **of == b).for_each(|of| *of = a);
            corners = renamed(corners, a, b);
        }
        Ok(Self::numbered(of_cluster))
    }

    /// One supercluster per cluster.
    pub fn apart(clustering: &Clustering, registers: ConstantRegisters) -> Result<Self, InputError> {
        let count = needed(clustering, registers)?.len();
        Ok(Self { of_cluster: (0..count as u32).collect(), count })
    }

    /// Numbers superclusters in the order of their lowest clusters.
    fn numbered(mut of_cluster: Vec<u32>) -> Self {
        let mut numbers = BTreeMap::new();
        for of in &mut of_cluster {
            let next = numbers.len() as u32;
            *of = *numbers.entry(*of).or_insert(next);
        }
        Self { count: numbers.len(), of_cluster }
    }

    /// Number of superclusters.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The supercluster of each cluster.
    pub fn of_cluster(&self) -> &[u32] {
        &self.of_cluster
    }

    /// The number of triangles drawn, summed over superclusters. Panics if the superclusters were made from another
    /// clustering or other triangles.
    pub fn overdraw(&self, clustering: &Clustering, triangles: &[[u32; 3]]) -> u64 {
        let of_point: Vec<u32> = clustering.of_point().iter().map(|&k| self.of_cluster[k as usize]).collect();
        overdraw(triangles, &of_point)
    }
}

/// The number of registers of each cluster, none above the limit.
fn needed(clustering: &Clustering, registers: ConstantRegisters) -> Result<Vec<usize>, InputError> {
    let needed: Vec<usize> = clustering.subspaces().iter().map(|s| registers.needed(s.len())).collect();
    match needed.iter().position(|&needed| needed > registers.limit) {
        Some(cluster) => Err(input_error!(
            "cluster {cluster} needs {} constant registers, expected at most {}; use fewer vectors",
            needed[cluster],
            registers.limit
        )),
        None => Ok(needed),
    }
}

/// Numbers of triangles by their set of two or three clusters. A set of two is stored as [a, b, b].
type MixedTriangles = BTreeMap<[u32; 3], u64>;

fn mixed_triangles(triangles: &[[u32; 3]], of_point: &[u32]) -> MixedTriangles {
    let mut found = MixedTriangles::new();
    for corners in triangles {
        add(&mut found, corners.map(|corner| of_point[corner as usize]), 1);
    }
    found
}

fn add(mixed: &mut MixedTriangles, mut clusters: [u32; 3], count: u64) {
    clusters.sort_unstable();
    let [a, b, c] = clusters;
    if a != c {
        *mixed.entry(if a == b { [a, c, c] } else { [a, b, c] }).or_default() += count;
    }
}

fn renamed(mixed: MixedTriangles, to: u32, from: u32) -> MixedTriangles {
    let mut found = MixedTriangles::new();
    for (clusters, count) in mixed {
        add(&mut found, clusters.map(|cluster| if cluster == from { to } else { cluster }), count);
    }
    found
}

/// The two superclusters, lower first, that share the most triangles among the pairs that fit into the registers.
fn best_pair(mixed: &MixedTriangles, needed: &[usize], limit: usize) -> Option<(u32, u32)> {
    let mut common: BTreeMap<(u32, u32), u64> = BTreeMap::new();
    for (&[a, b, c], &count) in mixed {
        *common.entry((a, b)).or_default() += count;
        if b != c {
            *common.entry((a, c)).or_default() += count;
            *common.entry((b, c)).or_default() += count;
        }
    }
    let fitting = common.into_iter().filter(|((a, b), _)| needed[*a as usize] + needed[*b as usize] <= limit);
    // max_by_key returns the last among equals, which in a reversed iterator is the first.
    fitting.rev().max_by_key(|&(_, count)| count).map(|(pair, _)| pair)
}
