//! Shadow rays from one point, a packet of directions at a time: classified as certainly blocked, certainly unblocked,
//! or unclear. Unclear rays are left to the caster ([`shadow_leaf`](super::shadow_leaf)).

use super::packets::{LANES, Lanes, Packet, mask, max, min, sub};
use super::shadow_leaf::{PacketState, ShadowLeaf, WIDTH};
use super::skyline::Occluders;
use crate::geom::vector::{narrow, wide};

/// Relative error of ray parameters at the planes of a box: a few roundings.
const SLACK: f32 = 1.0 + 16.0 * f32::EPSILON;
/// Growth of the boxes, relative to the mesh's extent: more than the rounding of a direction can move a ray.
const GROWTH: f64 = 1e-6;
/// The least extent of a mesh, 2^-100: the rays of smaller meshes are left to the caster.
const LEAST_EXTENT: f64 = 1.0 / (1_u128 << 100) as f64;
/// Lower bound of direction components in divisions: it moves a ray by this fraction of its length.
const LEAST: f32 = 1e-18;

/// The axis value that marks a leaf.
const LEAF: u32 = u32::MAX;

/// A bounding box of triangles.
#[derive(Clone, Copy, Debug)]
struct ShadowNode {
    low: [f32; 3],
    high: [f32; 3],
    /// Index of the second child, or of a leaf's triangles; the first child follows its parent.
    next: u32,
    /// The axis along which the children were split; [`LEAF`] for a leaf.
    axis: u32,
}

/// The triangles of a mesh in a hierarchy of boxes, in units of the mesh's extent.
#[derive(Clone, Debug)]
pub(super) struct ShadowTree {
    nodes: Vec<ShadowNode>,
    leaves: Vec<ShadowLeaf>,
    /// Scale factor of the coordinates, a power of two.
    scale: f64,
}

/// Results for the rays of a packet, per lane all bits set or none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shadowed {
    pub(super) blocked: [u32; LANES],
    /// Neither certainly blocked nor certainly unblocked.
    pub(super) unclear: [u32; LANES],
}

impl ShadowTree {
    /// A tree over the triangles of `occluders`.
    pub(super) fn new(occluders: &Occluders) -> Self {
        let extent = extent(2.0 * occluders.nodes()[0].half.length());
        let mut tree = Self { nodes: Vec::new(), leaves: Vec::new(), scale: 1.0 / extent };
        tree.add(occluders, 0, (0, occluders.triangles().len()), extent);
        tree
    }

    /// Adds a node of `occluders` over a range of its triangles, and its descendants.
    fn add(&mut self, occluders: &Occluders, index: usize, (first, count): (usize, usize), extent: f64) {
        let node = &occluders.nodes()[index];
        let half = node.half + GROWTH * (extent + node.middle.abs());
        let ends = [node.middle - half, node.middle + half].map(|end| narrow(self.scale * end));
        let place = self.nodes.len();
        let is_leaf = count <= WIDTH;
        let next = if is_leaf { self.leaves.len() as u32 } else { 0 };
        self.nodes.push(ShadowNode {
            low: ends[0],
            high: ends[1],
            next,
            axis: if is_leaf { LEAF } else { u32::from(node.axis) },
        });
        if is_leaf {
            self.leaves.push(ShadowLeaf::new(&occluders.triangles()[first..first + count], self.scale));
            return;
        }
        self.add(occluders, index + 1, (first, count / 2), extent);
        self.nodes[place].next = self.nodes.len() as u32;
        self.add(occluders, node.next as usize, (first + count / 2, count - count / 2), extent);
    }

    /// An origin in the tree's coordinates.
    pub(super) fn origin(&self, at: [f32; 3]) -> [f32; 3] {
        narrow(self.scale * wide(at))
    }

    /// Traces the live rays of a packet from an origin in the tree's coordinates. `blocker` is the leaf to be tested
    /// first; it is set to the leaf that blocked a ray last.
    #[inline(always)]
    pub(super) fn trace(
        &self,
        origin: [f32; 3],
        packet: &Packet,
        blocker: &mut Option<u32>,
        waiting: &mut Vec<u32>,
    ) -> Shadowed {
        let [x, y, z] = &packet.direction;
        let inverse = [inverse(x), inverse(y), inverse(z)];
        let mut state = PacketState { live: packet.live, unclear: [0; LANES] };
        // Neighboring packets are often blocked by the same leaf.
        if let Some(leaf) = *blocker {
            self.leaves[leaf as usize].test(origin, packet, &mut state);
        }
        // The fourth entry is never read: with the mask below the index needs no bounds check.
        let forward = [packet.middle[0] >= 0.0, packet.middle[1] >= 0.0, packet.middle[2] >= 0.0, false];
        waiting.clear();
        waiting.push(0);
        while let Some(index) = waiting.pop() {
            let node = &self.nodes[index as usize];
            if !meets(node, origin, &inverse, &state.live) {
                continue;
            }
            if node.axis != LEAF {
                let (first, second) = (index + 1, node.next);
                // The nearer child is pushed last, so that it is visited first.
                waiting.extend(if forward[node.axis as usize & 3] { [second, first] } else { [first, second] });
            } else if self.leaves[node.next as usize].test(origin, packet, &mut state) {
                *blocker = Some(node.next);
                if state.live == [0; LANES] {
                    break;
                }
            }
        }
        let mut shadowed = Shadowed { blocked: [0; LANES], unclear: [0; LANES] };
        for i in 0..LANES {
            shadowed.blocked[i] = packet.live[i] & !state.live[i];
            shadowed.unclear[i] = state.unclear[i] & state.live[i];
        }
        shadowed
    }
}

/// The least power of two that is not below `length`, and at least [`LEAST_EXTENT`].
fn extent(length: f64) -> f64 {
    let mut extent = LEAST_EXTENT;
    while extent < length {
        extent *= 2.0;
    }
    extent
}

/// True if a live ray may intersect a box.
#[inline(always)]
fn meets(node: &ShadowNode, origin: [f32; 3], inverse: &[Lanes; 3], live: &[u32; LANES]) -> bool {
    let (low, high) = (sub(node.low, origin), sub(node.high, origin));
    let mut any = 0;
    for i in 0..LANES {
        let (mut near, mut far) = (0.0, f32::INFINITY);
        for axis in 0..3 {
            let (one, other) = (low[axis] * inverse[axis][i], high[axis] * inverse[axis][i]);
            near = max(near, min(one, other));
            far = min(far, max(one, other));
        }
        any |= mask(near <= far * SLACK) & live[i];
    }
    any != 0
}

/// Reciprocals of the components, bounded by 1 / [`LEAST`] in magnitude.
#[inline(always)]
fn inverse(components: &Lanes) -> Lanes {
    let mut inverse = [0.0; LANES];
    for i in 0..LANES {
        let size = max(components[i].abs(), LEAST);
        inverse[i] = if components[i] < 0.0 { -1.0 / size } else { 1.0 / size };
    }
    inverse
}
