//! Quality of an atlas: evenness, connectivity and compactness.

use rayon::prelude::*;

use super::meshed::Atlas;
use super::tree::{ClusterNode, ClusterTree};
use crate::geom::{Adjacency, Mesh};

/// Quality of an atlas.
#[derive(Debug, Clone, PartialEq)]
pub struct AtlasQuality {
    /// Fraction of the texels that lie on a face with an area, in [0, 1].
    pub used: f64,
    /// Standard deviation of the texels' areas, relative to their mean.
    pub deviation: f64,
    /// Standard deviation of the texels' areas, relative to their mean, with every texel weighted by its area.
    pub deviation_by_area: f64,
    /// Smallest non-zero area of a texel, relative to the mean.
    pub least: f64,
    /// Largest area of a texel, relative to the mean.
    pub most: f64,
    /// Number of nodes of the tree.
    pub nodes: usize,
    /// Number of nodes whose faces are connected by edges.
    pub connected: usize,
    /// Number of nodes that are also simply connected: without holes and handles.
    pub simply_connected: usize,
    /// Number of connected nodes with a disconnected child.
    pub torn: usize,
    /// Quality of each level, finest first.
    pub levels: Vec<LevelQuality>,
}

/// Quality of the clusters of a level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelQuality {
    /// Number of clusters.
    pub clusters: usize,
    /// Mean compactness of the clusters with an area.
    pub compactness: f64,
    /// Fifth percentile of the compactness.
    pub low_compactness: f64,
    /// Mean radius, relative to a disc of the mean area.
    pub radius: f64,
    /// Number of tree nodes of this size with more than one face.
    pub nodes: usize,
    /// Number of connected nodes among [`Self::nodes`].
    pub connected: usize,
    /// Number of simply connected nodes among [`Self::nodes`].
    pub simply_connected: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Topology {
    connected: bool,
    simply: bool,
}

impl AtlasQuality {
    /// Measures an atlas.
    pub fn of(atlas: &Atlas) -> Self {
        let welded = atlas.welded();
        let topologies = topologies(atlas.tree(), &welded, &welded.adjacency());
        let count = |holds: &dyn Fn(&Topology) -> bool| topologies.iter().filter(|it| holds(it)).count();
        let torn = |node: &usize| {
            let children = atlas.tree().children(*node);
            topologies[*node].connected && children.is_some_and(|both| !both.iter().all(|&it| topologies[it].connected))
        };
        let mean = atlas.mean_texel_area();
        let ratios = || atlas.texels().iter().map(|texel| texel.area / mean);
        let texels = atlas.texels().len() as f64;
        let square = |ratio: f64| (ratio - 1.0) * (ratio - 1.0);
        let by_area_mean = ratios().map(|ratio| ratio * ratio).sum::<f64>() / texels;
        let by_area = |ratio: f64| ratio * (ratio - by_area_mean) * (ratio - by_area_mean);
        Self {
            used: ratios().filter(|ratio| *ratio > 0.0).count() as f64 / texels,
            deviation: (ratios().map(square).sum::<f64>() / texels).sqrt(),
            deviation_by_area: (ratios().map(by_area).sum::<f64>() / texels).sqrt(),
            least: ratios().filter(|ratio| *ratio > 0.0).fold(f64::INFINITY, f64::min),
            most: ratios().fold(0.0, f64::max),
            nodes: topologies.len(),
            connected: count(&|it| it.connected),
            simply_connected: count(&|it| it.simply),
            torn: (0..topologies.len()).filter(torn).count(),
            levels: (0..atlas.levels()).map(|level| level_quality(atlas, &topologies, level)).collect(),
        }
    }
}

fn level_quality(atlas: &Atlas, topologies: &[Topology], level: u32) -> LevelQuality {
    let clusters = atlas.clusters(level);
    let with_area = || clusters.iter().filter(|cluster| cluster.area > 0.0 && cluster.radius > 0.0);
    let disc = |radius: f64| std::f64::consts::PI * radius * radius;
    let mut compact: Vec<f64> = with_area().map(|cluster| cluster.area / disc(cluster.radius)).collect();
    compact.sort_unstable_by(f64::total_cmp);
    let mean_area = atlas.area() / clusters.len() as f64;
    let radii = with_area().map(|cluster| cluster.radius).sum::<f64>();
    let count = compact.len().max(1) as f64;
    let of_size = |node: &ClusterNode| node.width == 1 << level && node.height == node.width && node.faces > 1;
    let nodes = || atlas.tree().nodes().iter().zip(topologies).filter(|(node, _)| of_size(node));
    LevelQuality {
        clusters: clusters.len(),
        compactness: compact.iter().sum::<f64>() / count,
        low_compactness: compact.get(compact.len() / 20).copied().unwrap_or(0.0),
        radius: radii / count / (mean_area / std::f64::consts::PI).sqrt(),
        nodes: nodes().count(),
        connected: nodes().filter(|(_, it)| it.connected).count(),
        simply_connected: nodes().filter(|(_, it)| it.simply).count(),
    }
}

fn topologies(tree: &ClusterTree, welded: &Mesh, adjacency: &Adjacency) -> Vec<Topology> {
    let mut place = vec![0; tree.order().len()];
    (0..).zip(tree.order()).for_each(|(at, &face)| place[face as usize] = at);
    let of = |node: &ClusterNode| match node.faces {
        1 => Topology { connected: true, simply: true },
        _ => topology(tree.faces(node), node.first, &place, welded, adjacency),
    };
    tree.nodes().par_iter().map(of).collect()
}

/// Connects faces along their common edges and computes the topology of the result. A vertex is counted once per fan of
/// faces, so that contact of a cluster with itself at a vertex is not a hole.
fn topology(faces: &[u32], first: u32, place: &[u32], welded: &Mesh, adjacency: &Adjacency) -> Topology {
    let mut corners = Classes::new(3 * faces.len());
    let mut parts = Classes::new(faces.len());
    let mut edges = 0;
    for (own, &face) in faces.iter().enumerate() {
        let mine = welded.triangles()[face as usize];
        for (side, edge) in adjacency.edges_of(face).into_iter().enumerate() {
            let on_edge = edge.map(|edge| &adjacency.edges()[edge as usize].triangles);
            let within =
                |other: &u32| place[*other as usize].checked_sub(first).filter(|at| (*at as usize) < faces.len());
            let Some(other) = on_edge.into_iter().flatten().filter_map(within).min().filter(|at| (*at as usize) < own)
            else {
                edges += 1;
                continue;
            };
            let theirs = welded.triangles()[faces[other as usize] as usize];
            parts.join(own, other as usize);
            for corner in [side, (side + 1) % 3] {
                if let Some(same) = theirs.iter().position(|vertex| *vertex == mine[corner]) {
                    corners.join(3 * own + corner, 3 * other as usize + same);
                }
            }
        }
    }
    let connected = parts.count == 1;
    // The Euler characteristic, 1 for a disc and 2 for a sphere, is at least 1.
    Topology { connected, simply: connected && corners.count + faces.len() > edges }
}

/// Disjoint sets (union-find).
struct Classes {
    parent: Vec<u32>,
    count: usize,
}

impl Classes {
    fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect(), count }
    }

    fn root(&mut self, mut of: usize) -> usize {
        while self.parent[of] as usize != of {
            let above = self.parent[self.parent[of] as usize];
            self.parent[of] = above;
            of = above as usize;
        }
        of
    }

    fn join(&mut self, one: usize, other: usize) {
        let [one, other] = [self.root(one), self.root(other)];
        if one != other {
            self.parent[one.max(other)] = one.min(other) as u32;
            self.count -= 1;
        }
    }
}
