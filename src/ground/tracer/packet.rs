//! The ray-triangle test of `triangle_test.rs` for eight triangles at a time, in the host's vector units.

use super::triangle_test::{HostRay, HostTriangle, scaled_corners};
use glam::Vec3;

use super::best::Best;
use crate::geom::Mesh;

const LANES: usize = 8;

type Lanes = [f32; LANES];
/// One corner per lane, by component.
type Corners = [Lanes; 3];

/// Up to eight triangles of a leaf, by component. Lanes without a triangle hold a degenerate triangle, which no ray
/// hits. Edges and normal are recomputed each time, which costs less than loading them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
struct Packet {
    a: Corners,
    b: Corners,
    c: Corners,
    triangles: [u32; LANES],
    /// Number of lanes that hold a triangle.
    filled: u32,
    /// `true` if the next packet belongs to the same leaf.
    more: bool,
}

/// Packets of all leaves.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Packets(Vec<Packet>);

impl Packets {
    /// Adds a leaf's triangles, at least one, at a scale; returns the index of its first packet.
    pub(crate) fn add(&mut self, mesh: &Mesh, scale: f64, leaf: &[u32]) -> u32 {
        let first = self.0.len() as u32;
        let parts = leaf.chunks(LANES);
        let last = parts.len() - 1;
        self.0.extend(parts.enumerate().map(|(i, ids)| Packet::new(mesh, scale, ids, i < last)));
        first
    }

    /// Tests a leaf's triangles and offers the hits to `best`. Returns the number of triangles tested.
    #[inline(always)]
    pub(crate) fn test<const BOTH: bool>(&self, leaf: u32, ray: &HostRay, best: &mut Best) -> u64 {
        let mut tests = 0;
        for packet in &self.0[leaf as usize..] {
            packet.test::<BOTH>(ray, best);
            tests += u64::from(packet.filled);
            if !packet.more {
                break;
            }
        }
        tests
    }
}

impl Packet {
    fn new(mesh: &Mesh, scale: f64, ids: &[u32], more: bool) -> Self {
        let mut lanes = [[Vec3::ZERO; 3]; LANES];
        for (lane, &id) in lanes.iter_mut().zip(ids) {
            *lane = scaled_corners(mesh.corners(id).unwrap_or_default(), scale);
        }
        let of = |corner: usize| std::array::from_fn(|axis| std::array::from_fn(|i| lanes[i][corner][axis]));
        Self {
            a: of(0),
            b: of(1),
            c: of(2),
            triangles: std::array::from_fn(|i| ids.get(i).copied().unwrap_or_default()),
            filled: ids.len() as u32,
            more,
        }
    }

    #[inline(always)]
    fn test<const BOTH: bool>(&self, ray: &HostRay, best: &mut Best) {
        let (mut t, mut hit, mut any) = ([0.0; LANES], [0u32; LANES], 0);
        // Lanes without a triangle are tested too: without branches the loop becomes vector code.
        for i in 0..LANES {
            let at = |corner: &Corners| Vec3::new(corner[0][i], corner[1][i], corner[2][i]);
            let lane = HostTriangle::new([at(&self.a), at(&self.b), at(&self.c)]);
            let (parameter, is_hit) = lane.test::<BOTH>(ray);
            t[i] = parameter;
            hit[i] = u32::from(is_hit);
            any |= hit[i];
        }
        if any != 0 {
            for i in 0..LANES {
                if hit[i] != 0 {
                    best.offer(t[i], self.triangles[i]);
                }
            }
        }
    }
}
