//! The choice of the clusters to which a texel links.

use std::cmp::Reverse;
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

    /// Start of the cluster in Morton order.
    fn place(&self) -> u64 {
        let ClusterId { level, y, x } = self.cluster;
        (to_morton(x, y) as u64) << (2 * level)
    }
}

/// Order of replacement: texels last; then by highest sum of factors, higher level, lower row, lower column.
type Rank = (bool, i64, u32, Reverse<u32>, Reverse<u32>);

impl<const N: usize> Candidate<N> {
    fn rank(&self) -> Rank {
        let ClusterId { level, y, x } = self.cluster;
        // Integers in the order of the numbers, as in `f64::total_cmp`.
        let bits = self.factor.iter().sum::<f64>().to_bits().cast_signed();
        let sum = bits ^ ((bits >> 63).cast_unsigned() >> 1).cast_signed();
        (level > 0, sum, level, Reverse(y), Reverse(x))
    }
}

/// Chooses the links of a texel, beginning with the root of its tree: while `count` allows three more, the cluster with
/// the highest factor is replaced by its children; texels are not replaced. Returns 1 + 3 k links in the order of the
/// tree.
pub(super) fn adaptive<const N: usize>(texel: &mut TexelFactors<'_, '_, N>, count: usize) -> Vec<Candidate<N>> {
    // Each division removes one cluster from the queue and adds four.
    let mut found = Vec::with_capacity(count + count / 3 + 1);
    found.push(Candidate::new(texel, 0));
    let mut queue = BinaryHeap::with_capacity(count + 3);
    queue.push((found[0].rank(), 0));
    while queue.len() + 3 <= count {
        let Some(&(_, top)) = queue.peek() else { break };
        let Some(first) = texel.children(found[top].node) else { break };
        queue.pop();
        for node in first..first + 4 {
            let child = Candidate::new(texel, node);
            queue.push((child.rank(), found.len()));
            found.push(child);
        }
    }
    let mut links: Vec<Candidate<N>> = queue.into_iter().map(|(_, at)| found[at]).collect();
    links.sort_unstable_by_key(Candidate::place);
    links
}
