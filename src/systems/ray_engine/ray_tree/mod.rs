//! The 5-D ray tree (section 5.3, after Arvo and Kirk 1987): rays with similar origins and directions share a bucket.
//!
//! A ray is a point of five dimensions: its origin, and where its direction meets a face of the unit cube. Each of the
//! six faces has a tree. A bucket that overflows is split in four: in two at the mean of the origins, along the axis on
//! which they vary most, and in two at the mean of the directions, likewise.

mod key;
mod take;

use crate::geom::Ray;
use key::{Key, RayTreeEntry, Split};

/// Parameters of a ray tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayTreeParameters {
    /// Maximum number of rays of a bucket: the paper uses 256, two textures of 64 x 4.
    pub bucket: usize,
    /// Subtrees with at most this number of rays left are merged into one bucket.
    pub merge: usize,
}

impl Default for RayTreeParameters {
    fn default() -> Self {
        Self { bucket: 256, merge: 128 }
    }
}

/// Counters of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayTreeCounts {
    /// Number of rays inserted.
    pub inserted: u64,
    /// Nodes passed by inserted rays, including buckets.
    pub nodes_passed: u64,
    /// Number of buckets split in four.
    pub splits: u64,
    /// Number of batches removed.
    pub batches: u64,
    /// Rays in batches that come from the batch's own bucket.
    pub own: u64,
    /// Rays in batches that were taken from siblings of the bucket.
    pub stolen: u64,
    /// Levels of inner nodes merged into a bucket.
    pub levels_merged: u64,
    /// Batches after which buckets were merged.
    pub merges: u64,
}

#[derive(Clone, Debug)]
enum RayTreeContent {
    Bucket(Vec<RayTreeEntry>),
    Inner(Split, [u32; 4]),
}

#[derive(Clone, Debug)]
struct RayTreeNode {
    /// Number of rays in all buckets below.
    count: usize,
    parent: Option<u32>,
    kind: RayTreeContent,
}

/// Rays in coherent buckets, identified by the caller's indices.
#[derive(Clone, Debug)]
pub struct RayTree {
    parameters: RayTreeParameters,
    /// Nodes; the first six are the roots of the faces.
    nodes: Vec<RayTreeNode>,
    free: Vec<u32>,
    counts: RayTreeCounts,
}

impl RayTree {
    /// Creates an empty tree. A bucket holds at least one ray.
    pub fn new(parameters: RayTreeParameters) -> Self {
        let parameters = RayTreeParameters { bucket: parameters.bucket.max(1), ..parameters };
        let root = RayTreeNode { count: 0, parent: None, kind: RayTreeContent::Bucket(Vec::new()) };
        Self { parameters, nodes: vec![root; key::FACES], free: Vec::new(), counts: RayTreeCounts::default() }
    }

    /// Number of rays in the tree.
    pub fn len(&self) -> usize {
        self.nodes[..key::FACES].iter().map(|root| root.count).sum()
    }

    /// Returns `true` if the tree holds no rays.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Counters so far.
    pub fn counts(&self) -> RayTreeCounts {
        self.counts
    }

    /// Occupancy of the non-empty buckets, in [0, 1], in no particular order. The paper: typically 0.5 to 0.8.
    pub fn occupancy(&self) -> Vec<f64> {
        let share = |rays: &Vec<RayTreeEntry>| rays.len() as f64 / self.parameters.bucket as f64;
        let bucket = |node: &RayTreeNode| match &node.kind {
            RayTreeContent::Bucket(rays) if !rays.is_empty() => Some(share(rays)),
            _ => None,
        };
        self.nodes.iter().filter_map(bucket).collect()
    }

    /// Bytes allocated by the tree.
    pub fn bytes(&self) -> usize {
        let buckets = self.nodes.iter().map(|node| match &node.kind {
            RayTreeContent::Bucket(rays) => rays.capacity() * size_of::<RayTreeEntry>(),
            RayTreeContent::Inner(..) => 0,
        });
        self.nodes.capacity() * size_of::<RayTreeNode>()
            + self.free.capacity() * size_of::<u32>()
            + buckets.sum::<usize>()
    }

    /// Inserts a ray.
    pub fn insert(&mut self, ray: u32, at: &Ray) {
        let (face, key) = Key::of(at);
        let mut node = face;
        loop {
            self.counts.nodes_passed += 1;
            let here = &mut self.nodes[node as usize];
            here.count += 1;
            match &mut here.kind {
                RayTreeContent::Inner(split, children) => node = children[split.child(&key)],
                RayTreeContent::Bucket(rays) => {
                    rays.push(RayTreeEntry { ray, key });
                    break;
                }
            }
        }
        self.counts.inserted += 1;
        self.split(node);
    }

    /// Splits an overfull bucket, and any overfull child; rays with identical keys stay together.
    fn split(&mut self, node: u32) {
        let RayTreeContent::Bucket(rays) = &mut self.nodes[node as usize].kind else { return };
        if rays.len() <= self.parameters.bucket {
            return;
        }
        let Some(split) = Split::of(rays) else { return };
        let mut parts: [Vec<RayTreeEntry>; 4] = Default::default();
        for entry in std::mem::take(rays) {
            parts[split.child(&entry.key)].push(entry);
        }
        let children = parts.map(|rays| {
            self.make(RayTreeNode { count: rays.len(), parent: Some(node), kind: RayTreeContent::Bucket(rays) })
        });
        self.nodes[node as usize].kind = RayTreeContent::Inner(split, children);
        self.counts.splits += 1;
        for child in children {
            self.split(child);
        }
    }

    /// Allocates a node.
    fn make(&mut self, node: RayTreeNode) -> u32 {
        if let Some(place) = self.free.pop() {
            self.nodes[place as usize] = node;
            return place;
        }
        self.nodes.push(node);
        (self.nodes.len() - 1) as u32
    }
}
