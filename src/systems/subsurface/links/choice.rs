//! The choice of the clusters to which a texel links.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::super::multipole::{ClusterId, TexelFactors, to_morton};

/// The choice of the clusters to which texels link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkChoice {
    /// All clusters of a level, for every texel: 1, 4, 16, 64, ... links.
    Fixed {
        /// The level.
        level: u32,
    },
    /// Chosen for each texel, beginning with the root: the cluster with the highest factor is replaced by its four
    /// children, as long as there are at most `count` links.
    Adaptive {
        /// The largest number of links.
        count: usize,
    },
}

impl LinkChoice {
    /// Links per texel of an atlas with `side` texels per side.
    pub fn per_texel(self, side: u32) -> u64 {
        match self {
            Self::Fixed { level } => u64::from(side >> level.min(31)).pow(2),
            Self::Adaptive { count } => count as u64,
        }
    }

    /// "fixed" or "adaptive".
    pub fn word(self) -> &'static str {
        match self {
            Self::Fixed { .. } => "fixed",
            Self::Adaptive { .. } => "adaptive",
        }
    }
}

/// A link of a texel that may be replaced by its four children.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate<const N: usize> {
    node: usize,
    pub(super) cluster: ClusterId,
    pub(super) factor: [f64; N],
}

impl<const N: usize> Candidate<N> {
    fn new(texel: &TexelFactors<'_, '_, N>, node: usize) -> Self {
        Self { node, cluster: texel.cluster(node), factor: texel.factor(node) }
    }

    fn is_texel(&self) -> bool {
        self.cluster.level == 0
    }

    /// Start of the cluster in Morton order.
    fn place(&self) -> u64 {
        let ClusterId { level, y, x } = self.cluster;
        (to_morton(x, y) as u64) << (2 * level)
    }
}

/// Order of replacement: texels last; then by highest factor (for RGB, the sum of the three), higher level, lower row,
/// lower column.
impl<const N: usize> Ord for Candidate<N> {
    fn cmp(&self, other: &Self) -> Ordering {
        let sum = |link: &Self| link.factor.iter().sum::<f64>();
        let tie = |link: &Self| (link.cluster.level, Reverse(link.cluster.y), Reverse(link.cluster.x));
        let divisible = other.is_texel().cmp(&self.is_texel());
        divisible.then(sum(self).total_cmp(&sum(other))).then(tie(self).cmp(&tie(other)))
    }
}

impl<const N: usize> PartialOrd for Candidate<N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<const N: usize> PartialEq for Candidate<N> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<const N: usize> Eq for Candidate<N> {}

/// Chooses the links of a texel, beginning with the root of its tree: while `count` allows three more, the cluster with
/// the highest factor is replaced by its children; texels are not replaced. Returns 1 + 3 k links in the order of the
/// tree.
pub(super) fn adaptive<const N: usize>(texel: &mut TexelFactors<'_, '_, N>, count: usize) -> Vec<Candidate<N>> {
    let mut queue = BinaryHeap::with_capacity(count);
    queue.push(Candidate::new(texel, 0));
    while queue.len() + 3 <= count {
        let Some(top) = queue.peek() else { break };
        let Some(first) = texel.children(top.node) else { break };
        queue.pop();
        queue.extend((first..first + 4).map(|node| Candidate::new(texel, node)));
    }
    let mut links = queue.into_vec();
    links.sort_unstable_by_key(Candidate::place);
    links
}
