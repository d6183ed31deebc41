//! Removal of a batch: a full bucket found by a greedy search, filled up from its siblings.

use super::{RayTree, RayTreeContent, RayTreeEntry, RayTreeNode, key};

impl RayTree {
    /// Removes a batch of rays for the card: at most the rays of one bucket; empty if the tree is empty. The search
    /// always descends to the child with the most rays below it, which may miss the fullest bucket.
    pub fn take(&mut self) -> Vec<u32> {
        let root = self.fullest(0..key::FACES as u32);
        if self.nodes[root as usize].count == 0 {
            return Vec::new();
        }
        let bucket = self.descend(root);
        let size = self.parameters.bucket;
        let mut rays = Vec::with_capacity(size);
        self.drain(bucket, size, &mut rays);
        let own = rays.len();
        // Nearest siblings first: rays are taken from the parent's other children, not from farther away.
        if let Some(parent) = self.nodes[bucket as usize].parent {
            while rays.len() < size && self.nodes[parent as usize].count > 0 {
                let donor = self.descend(parent);
                self.drain(donor, size - rays.len(), &mut rays);
            }
        }
        let levels_merged = self.merge_above(bucket);
        self.counts.batches += 1;
        self.counts.own += own as u64;
        self.counts.stolen += (rays.len() - own) as u64;
        self.counts.levels_merged += levels_merged as u64;
        self.counts.merges += u64::from(levels_merged > 0);
        rays.into_iter().map(|entry| entry.ray).collect()
    }

    /// Returns the node with the most rays below it; on ties, the first.
    fn fullest(&self, nodes: impl IntoIterator<Item = u32>) -> u32 {
        let mut best = (0, None);
        for node in nodes {
            let count = self.nodes[node as usize].count;
            if best.1.is_none_or(|most| count > most) {
                best = (node, Some(count));
            }
        }
        best.0
    }

    /// Descends greedily to a bucket.
    fn descend(&self, mut node: u32) -> u32 {
        while let RayTreeContent::Inner(_, children) = &self.nodes[node as usize].kind {
            node = self.fullest(*children);
        }
        node
    }

    /// Moves up to `most` rays from the end of a bucket, and corrects the counts above it.
    fn drain(&mut self, bucket: u32, most: usize, into: &mut Vec<RayTreeEntry>) {
        let RayTreeContent::Bucket(rays) = &mut self.nodes[bucket as usize].kind else { return };
        let taken = most.min(rays.len());
        into.extend(rays.drain(rays.len() - taken..));
        let mut above = Some(bucket);
        while let Some(node) = above {
            self.nodes[node as usize].count -= taken;
            above = self.nodes[node as usize].parent;
        }
    }

    /// Walks up from a bucket and merges subtrees of few rays into one bucket. Returns the number of levels removed.
    fn merge_above(&mut self, bucket: u32) -> usize {
        let mut levels = 0;
        let mut above = self.nodes[bucket as usize].parent;
        let few = self.parameters.merge.min(self.parameters.bucket);
        while let Some(node) = above.filter(|&node| self.nodes[node as usize].count <= few) {
            let mut rays = Vec::new();
            self.collect(node, &mut rays);
            self.nodes[node as usize].kind = RayTreeContent::Bucket(rays);
            above = self.nodes[node as usize].parent;
            levels += 1;
        }
        levels
    }

    /// Moves all rays of a node's subtree into `into` and frees the nodes below it.
    fn collect(&mut self, node: u32, into: &mut Vec<RayTreeEntry>) {
        let kind = std::mem::replace(&mut self.nodes[node as usize].kind, RayTreeContent::Bucket(Vec::new()));
        match kind {
            RayTreeContent::Bucket(rays) => into.extend(rays),
            RayTreeContent::Inner(_, children) => {
                for child in children {
                    self.collect(child, into);
                    self.nodes[child as usize] =
                        RayTreeNode { count: 0, parent: None, kind: RayTreeContent::Bucket(Vec::new()) };
                    self.free.push(child);
                }
            }
        }
    }
}
