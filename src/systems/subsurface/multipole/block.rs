//! Factors of all texels of a square of an atlas, computed together.
//!
//! The light of a far cluster varies smoothly among near texels. So a square of texels has one second-order expansion
//! of the light of all clusters that are far from it. Its four quarters have expansions for the clusters that were too
//! near, and so on; each texel gathers the remaining clusters individually. Each node of the tree of clusters stores
//! what the squares and the texel gather at that node separately, so that a texel has the factor of every node: what is
//! gathered at the node itself, plus the sum of its children's factors.

use super::expansion::Expansion;
use super::integrate::Receiver;
use super::kernel::{SPREAD, add};
use super::surface::{ClusterId, from_morton, to_morton};

/// The level of the largest squares of texels that are computed together: 16 x 16.
pub(in crate::subsurface) const BLOCK_LEVEL: u32 = 4;

/// Computes the factors of all texels of a square.
#[derive(Clone, Debug)]
pub(in crate::subsurface) struct BlockReceiver<'a, const N: usize> {
    receiver: Receiver<'a, N>,
    nodes: Vec<Node<N>>,
    /// Stamp of the latest square: squares are counted, so that parts of earlier squares are recognised.
    stamp: u64,
    /// The stamps of the squares around the current texel, by level.
    present: [u64; BLOCK_LEVEL as usize + 1],
    /// Nodes that were divided only for the current texel.
    divided: Vec<u32>,
}

/// A cluster in the tree of visited clusters.
#[derive(Clone, Copy, Debug)]
struct Node<const N: usize> {
    level: u32,
    /// Index in Morton order.
    place: u32,
    parent: u32,
    /// Index of the first of its four children.
    children: u32,
    /// Part that the current texel gathers.
    own: Part<[f64; N]>,
    /// Part that each square around the current texel gathers as a whole, by level from 1.
    shared: [Part<Expansion<N>>; BLOCK_LEVEL as usize],
}

/// A part of a node's light, for the square with this stamp.
#[derive(Clone, Copy, Debug)]
struct Part<T> {
    stamp: u64,
    value: T,
}

/// Index for a missing parent or missing children.
const NONE: u32 = u32::MAX;
/// A stamp that no square has.
const NEVER: u64 = 0;
/// The stamp of squares larger than the atlas, which no part has.
const NO_SQUARE: u64 = u64::MAX;

impl<const N: usize> Node<N> {
    fn new(level: u32, place: u32, parent: u32) -> Self {
        let own = Part { stamp: NEVER, value: [0.0; N] };
        let shared = [Part { stamp: NEVER, value: Expansion::default() }; BLOCK_LEVEL as usize];
        Self { level, place, parent, children: NONE, own, shared }
    }
}

impl<T> Part<T> {
    /// Accumulates into the part of the square `stamp`; clears it first if it belongs to another square.
    fn gather(&mut self, stamp: u64, value: &T, add: impl Fn(&mut T, &T))
    where
        T: Copy,
    {
        if self.stamp == stamp {
            add(&mut self.value, value);
        } else {
            *self = Self { stamp, value: *value };
        }
    }

    fn of(&self, stamp: u64) -> Option<&T> {
        (self.stamp == stamp).then_some(&self.value)
    }
}

impl<'a, const N: usize> BlockReceiver<'a, N> {
    pub(in crate::subsurface) fn new(receiver: Receiver<'a, N>) -> Self {
        let present = [NO_SQUARE; BLOCK_LEVEL as usize + 1];
        Self { receiver, nodes: Vec::new(), stamp: NEVER, present, divided: Vec::new() }
    }

    /// Visits each texel of a square with the factors of the given clusters, the first nodes of the texel's tree.
    pub(in crate::subsurface) fn visit(
        &mut self,
        square: ClusterId,
        roots: &[ClusterId],
        each: &mut impl FnMut(&mut TexelFactors<'_, 'a, N>),
    ) {
        self.nodes.clear();
        self.nodes.extend(roots.iter().map(|root| Node::new(root.level, to_morton(root.x, root.y) as u32, NONE)));
        let pending: Vec<u32> = (0..roots.len() as u32).collect();
        self.enter(square.level, to_morton(square.x, square.y), &pending, each);
    }

    /// Gathers from nodes without children: from far nodes for the whole square, from the others for its quarters.
    fn enter(
        &mut self,
        level: u32,
        place: usize,
        pending: &[u32],
        each: &mut impl FnMut(&mut TexelFactors<'_, 'a, N>),
    ) {
        let first = self.nodes.len();
        self.stamp += 1;
        self.present[level as usize] = self.stamp;
        if level == 0 {
            for &node in pending {
                let sum = self.gather_to_texel(place, node);
                self.add_to_ancestors(node, |node, stamp| node.own.gather(stamp, &sum, add));
            }
            each(&mut TexelFactors { block: self, texel: place });
            for node in std::mem::take(&mut self.divided) {
                self.nodes[node as usize].children = NONE;
            }
        } else {
            let mut near = Vec::new();
            for &node in pending {
                let sum = self.gather_to_square(level, place, node, &mut near);
                let add =
                    |node: &mut Node<N>, stamp| node.shared[level as usize - 1].gather(stamp, &sum, Expansion::add);
                self.add_to_ancestors(node, add);
            }
            for quarter in 4 * place..4 * place + 4 {
                self.enter(level - 1, quarter, &near, each);
            }
        }
        self.nodes.truncate(first);
        for &node in pending {
            self.nodes[node as usize].children = NONE;
        }
    }

    fn add_to_ancestors(&mut self, node: u32, add: impl Fn(&mut Node<N>, u64)) {
        let mut at = self.nodes[node as usize].parent;
        while at != NONE {
            let ancestor = &mut self.nodes[at as usize];
            add(ancestor, self.stamp);
            at = ancestor.parent;
        }
    }

    /// Appends the children of a node; returns their indices.
    fn divide(&mut self, at: u32) -> std::ops::Range<u32> {
        let Node { level, place, .. } = self.nodes[at as usize];
        let first = self.nodes.len() as u32;
        self.nodes.extend((4 * place..4 * place + 4).map(|child| Node::new(level - 1, child, at)));
        self.nodes[at as usize].children = first;
        first..first + 4
    }

    /// Adds the part of a node that a square gathers as a whole. If the node is too near, it is divided if it is larger
    /// than the square; otherwise it is appended to `near`, and the square is divided first.
    fn gather_to_square(&mut self, level: u32, place: usize, at: u32, near: &mut Vec<u32>) -> Expansion<N> {
        let surface = self.receiver.surface();
        let node = &self.nodes[at as usize];
        let (square, cluster) = (&surface.level(level)[place], &surface.level(node.level)[node.place as usize]);
        let sum = match self.receiver.kernel().expansion(square, cluster) {
            Some(expansion) => expansion,
            None if node.level > 0 && cluster.size_squared >= SPREAD * square.size_squared => {
                let mut sum = Expansion::default();
                for child in self.divide(at) {
                    sum.add(&self.gather_to_square(level, place, child, near));
                }
                sum
            }
            None => {
                near.push(at);
                return Expansion::default();
            }
        };
        self.nodes[at as usize].shared[level as usize - 1] = Part { stamp: self.stamp, value: sum };
        sum
    }

    /// Returns the part of a node that a texel gathers individually.
    fn gather_to_texel(&mut self, texel: usize, at: u32) -> [f64; N] {
        let Node { level, place, .. } = self.nodes[at as usize];
        let sum = match self.receiver.undivided(texel, level, place as usize) {
            Some(factor) => factor,
            None => {
                let mut sum = [0.0; N];
                for child in self.divide(at) {
                    add(&mut sum, &self.gather_to_texel(texel, child));
                }
                sum
            }
        };
        self.nodes[at as usize].own = Part { stamp: self.stamp, value: sum };
        sum
    }
}

/// The factors of one texel, by node of the texel's tree of clusters.
pub(in crate::subsurface) struct TexelFactors<'b, 'a, const N: usize> {
    block: &'b mut BlockReceiver<'a, N>,
    /// Index in Morton order.
    texel: usize,
}

impl<const N: usize> TexelFactors<'_, '_, N> {
    /// Column and row of the texel.
    pub(in crate::subsurface) fn texel(&self) -> (u32, u32) {
        from_morton(self.texel)
    }

    pub(in crate::subsurface) fn cluster(&self, node: usize) -> ClusterId {
        let Node { level, place, .. } = self.block.nodes[node];
        let (x, y) = from_morton(place as usize);
        ClusterId { level, y, x }
    }

    pub(in crate::subsurface) fn factor(&self, node: usize) -> [f64; N] {
        let BlockReceiver { receiver, nodes, present, .. } = &*self.block;
        let surface = receiver.surface();
        let receiver = &surface.level(0)[self.texel];
        let Node { own, shared, .. } = &nodes[node];
        let mut sum = own.of(present[0]).copied().unwrap_or([0.0; N]);
        for (level, part) in (1..).zip(shared) {
            if let Some(expansion) = part.of(present[level as usize]) {
                let center = surface.level(level)[self.texel >> (2 * level)].point;
                add(&mut sum, &expansion.mean_over(receiver, center));
            }
        }
        sum
    }

    /// Indices of the four children of a node, computed on first use; `None` for a texel.
    pub(in crate::subsurface) fn children(&mut self, node: usize) -> Option<usize> {
        let Node { level, place, children, .. } = self.block.nodes[node];
        if level == 0 {
            return None;
        }
        if children != NONE {
            return Some(children as usize);
        }
        let children = self.block.divide(node as u32);
        self.block.divided.push(node as u32);
        for (child, place) in children.clone().zip(4 * place..) {
            let value = self.block.receiver.descend(self.texel, level - 1, place as usize);
            self.block.nodes[child as usize].own = Part { stamp: self.block.present[0], value };
        }
        Some(children.start as usize)
    }
}
