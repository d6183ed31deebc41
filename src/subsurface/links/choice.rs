//! Which clusters a texel has links to.

use super::super::factor::{Branch, ClusterId, Receiver};

/// Which clusters the texels of an atlas have links to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkChoice {
    /// All clusters of a level, the same for every texel: 1, 4, 16, 64, ... links.
    Fixed {
        /// The level.
        level: u32,
    },
    /// Per texel, from the root: the cluster with the highest factor gives way to its four children while there are at
    /// most `count`.
    Adaptive {
        /// The largest number of links.
        count: usize,
    },
}

impl LinkChoice {
    /// Links per texel of an atlas of `side` texels along a side.
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

/// Chooses the links of a texel: while three more fit into `count`, the cluster with the highest factor (for RGB, the
/// highest sum of the three) gives way to its children. A texel at the top is set aside, where it stays a link. Equal
/// factors: the higher level first, then the lower row, then the lower column.
///
/// `chosen` receives positions in `tree`: 1 + 3 k of them.
pub(super) fn adaptive<const N: usize>(
    receiver: &mut Receiver<'_, N>,
    texel: [u32; 2],
    count: usize,
    tree: &mut Vec<Branch<N>>,
    chosen: &mut Vec<usize>,
) {
    receiver.tree(texel, tree);
    chosen.clear();
    chosen.push(0);
    while chosen.len() + 3 <= count {
        let key = |at: usize| {
            let branch = &tree[at];
            let ClusterId { level, x, y } = branch.cluster();
            (branch.factor.iter().sum::<f64>(), (level, std::cmp::Reverse(y), std::cmp::Reverse(x)))
        };
        let divisible = (0..chosen.len()).filter(|&k| tree[chosen[k]].level > 0);
        let top = divisible.max_by(|&a, &b| {
            let [(left, left_tie), (right, right_tie)] = [key(chosen[a]), key(chosen[b])];
            left.total_cmp(&right).then(left_tie.cmp(&right_tie))
        });
        let Some(top) = top else { return };
        let Some(first) = receiver.children(texel, tree, chosen[top]) else { return };
        chosen.splice(top..=top, first..first + 4);
    }
}
