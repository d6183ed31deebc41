//! The directions of a rule in packets of sixteen neighboring directions, which traverse a hierarchy of boxes together.

use glam::DVec3;

use super::frame::LocalFrame;
use super::origins::RayOrigin;

/// Number of directions in a packet.
pub(super) const LANES: usize = 16;

/// One number per direction of a packet.
pub(super) type Lanes = [f32; LANES];

/// Rounding margin that is added to the radius of a packet.
const MARGIN: f32 = 1e-6;

/// The mask of a lane that is set.
pub(super) const ALL: u32 = u32::MAX;

/// The directions of a rule, packet by packet. The last packet may have fewer than [`LANES`].
#[derive(Clone, Debug)]
pub(super) struct PacketedRule {
    /// Index of each direction in the rule.
    order: Vec<u32>,
    /// Local directions, one vector per component.
    local: [Vec<f64>; 3],
}

/// A packet in global coordinates: unit directions in the precision of rays, and a mask of those above the horizon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packet {
    pub(super) direction: [Lanes; 3],
    /// Per lane all bits set, or none.
    pub(super) live: [u32; LANES],
    /// The mean of the live directions.
    pub(super) middle: [f32; 3],
    /// Upper bound of the distance of live directions from `middle`.
    pub(super) radius: f32,
}

impl PacketedRule {
    pub(super) fn new(directions: &[DVec3]) -> Self {
        let mut order: Vec<u32> = (0..directions.len() as u32).collect();
        part(&mut order, directions);
        let along = |axis: usize| {
            let mut values: Vec<f64> = order.iter().map(|&at| directions[at as usize][axis]).collect();
            values.resize(order.len().next_multiple_of(LANES), 0.0);
            values
        };
        Self { local: [0, 1, 2].map(along), order }
    }

    /// The indices within the rule of each packet's directions.
    pub(super) fn places(&self) -> impl DoubleEndedIterator<Item = &[u32]> {
        self.order.chunks(LANES)
    }

    /// A packet in the frame of a vertex: its directions have the same bits as those of single rays.
    #[inline(always)]
    pub(super) fn packet(&self, number: usize, frame: &LocalFrame, origin: &RayOrigin) -> Packet {
        let first = number * LANES;
        let [x, y, z] = &self.local;
        let (x, y, z) = (&x[first..first + LANES], &y[first..first + LANES], &z[first..first + LANES]);
        let [tangent, bitangent, normal] = frame.axes();
        let mut global = [[0.0; LANES]; 3];
        for axis in 0..3 {
            let (t, b, n) = (tangent[axis], bitangent[axis], normal[axis]);
            for i in 0..LANES {
                global[axis][i] = x[i] * t + y[i] * b + z[i] * n;
            }
        }
        let count = self.order.len() - number * LANES;
        let mut below = [ALL; LANES];
        for plane in &origin.planes {
            for i in 0..LANES {
                let height = plane.x * global[0][i] + plane.y * global[1][i] + plane.z * global[2][i];
                below[i] &= if height < 0.0 { ALL } else { 0 };
            }
        }
        let mut packet = Packet { direction: [[0.0; LANES]; 3], live: [0; LANES], middle: [0.0; 3], radius: 0.0 };
        for axis in 0..3 {
            for i in 0..LANES {
                packet.direction[axis][i] = global[axis][i] as f32;
            }
        }
        for i in 0..LANES {
            packet.live[i] = if i < count { !below[i] } else { 0 };
        }
        packet.enclose();
        packet
    }
}

impl Packet {
    /// Computes the middle and the radius.
    #[inline(always)]
    fn enclose(&mut self) {
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for i in 0..LANES {
            let weight = if self.live[i] == 0 { 0.0 } else { 1.0 };
            count += weight;
            for axis in 0..3 {
                sum[axis] += weight * self.direction[axis][i];
            }
        }
        let share = 1.0 / max(count, 1.0);
        self.middle = [sum[0] * share, sum[1] * share, sum[2] * share];
        let mut most = 0.0;
        for i in 0..LANES {
            let away = sub([self.direction[0][i], self.direction[1][i], self.direction[2][i]], self.middle);
            most = max(most, if self.live[i] == 0 { 0.0 } else { dot(away, away) });
        }
        self.radius = most.sqrt() + MARGIN;
    }
}

/// Sorts indices so that each run of [`LANES`] has neighboring directions: halves recursively along the axis of largest
/// extent, where each part but the last has a multiple of [`LANES`].
fn part(order: &mut [u32], directions: &[DVec3]) {
    if order.len() <= LANES {
        return;
    }
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &at in &*order {
        (low, high) = (low.min(directions[at as usize]), high.max(directions[at as usize]));
    }
    let extent = high - low;
    let axis = (0..3).fold(0, |best, axis| if extent[axis] > extent[best] { axis } else { best });
    // Ties go to the lower index, so that the order is unique.
    order.sort_by(|&one, &other| {
        directions[one as usize][axis].total_cmp(&directions[other as usize][axis]).then(one.cmp(&other))
    });
    let packets = order.len().div_ceil(LANES);
    let (lower, upper) = order.split_at_mut(packets.div_ceil(2) * LANES);
    part(lower, directions);
    part(upper, directions);
}

#[inline(always)]
pub(super) fn mask(condition: bool) -> u32 {
    if condition { ALL } else { 0 }
}

/// The smaller number, in one instruction where `f32::min` needs several. The arguments are never NaN.
#[inline(always)]
pub(super) fn min(one: f32, other: f32) -> f32 {
    if one < other { one } else { other }
}

#[inline(always)]
pub(super) fn max(one: f32, other: f32) -> f32 {
    if one > other { one } else { other }
}

#[inline(always)]
pub(super) fn sub(one: [f32; 3], other: [f32; 3]) -> [f32; 3] {
    [one[0] - other[0], one[1] - other[1], one[2] - other[2]]
}

#[inline(always)]
pub(super) fn dot(one: [f32; 3], other: [f32; 3]) -> f32 {
    one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sphere::DirectionRule;

    #[test]
    fn every_direction_is_in_one_packet() {
        for degree in [0, 6, 13, 44] {
            let rule = DirectionRule::hemisphere(degree);
            let packeted = PacketedRule::new(rule.directions());
            let mut places: Vec<u32> = packeted.places().flatten().copied().collect();
            assert!(packeted.places().rev().skip(1).all(|packet| packet.len() == LANES));
            places.sort_unstable();
            assert_eq!(places, (0..rule.len() as u32).collect::<Vec<_>>());
        }
    }
}
