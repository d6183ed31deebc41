//! Directions in which a vertex certainly sees the sky, so that no ray needs to be traced.
//!
//! The hemisphere of a vertex is divided into [`RINGS`] x [`COLUMNS`] parts, with narrow rings at the horizon. A
//! hierarchy of boxes over the triangles marks the parts that a triangle may cover: by its bounding sphere, by its
//! height over the vertex's tangent plane and, if it is near, by its own plane, which rays must approach from the
//! front. Parts that are not marked are unblocked in exact arithmetic; the margins are far larger than the rounding
//! errors of a ray's origin and direction.

use glam::DVec3;

use super::frame::LocalFrame;
use super::vertices::Vertices;
use crate::elementary::{atan2, on_circle};

/// Number of rings by z: ring k begins at z = (k / RINGS)^2.
const RINGS: usize = 24;
/// Number of columns by azimuth; one 64-bit word holds a ring.
const COLUMNS: usize = 64;
/// Largest number of triangles in a leaf.
const LEAF: usize = 4;
/// Sines of angular radii below which a box is marked as a whole; the second is used if the first marks little.
const SMALL: [f64; 2] = [0.25, 0.08];
/// Marked fraction of the hemisphere above which the first marking is final, because little sky remains to be found.
const MUCH: f64 = 0.5;
/// Sine of an angle. A box seen under a larger angle is descended without testing whether its region is marked.
const WIDE: f64 = 0.4;
/// Sine of an angle. A sphere seen under a larger angle is treated as near.
const NEAR: f64 = 0.9;
/// Margin by which angles are widened, in radians: rays differ from their f64 directions by 1e-7.
const MARGIN: f64 = 1e-5;

/// The parts of a hemisphere in which something may be visible, by local direction.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Skyline([u64; RINGS]);

/// A part of the hemisphere, by ring and column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SkyPart {
    ring: u8,
    column: u8,
}

impl SkyPart {
    /// The part that contains a local direction with z >= 0.
    pub(crate) fn of(local: DVec3) -> Self {
        Self { ring: ring(local.z) as u8, column: (turns(local) * COLUMNS as f64) as u8 % COLUMNS as u8 }
    }

    fn middle(self) -> DVec3 {
        let ring = usize::from(self.ring);
        at(f64::midpoint(lower_end(ring), lower_end(ring + 1)), (f64::from(self.column) + 0.5) / COLUMNS as f64)
    }
}

/// The ring that contains z, clamped to the first and the last.
fn ring(z: f64) -> usize {
    ((z.max(0.0).sqrt() * RINGS as f64) as usize).min(RINGS - 1)
}

/// The z at which a ring begins.
fn lower_end(ring: usize) -> f64 {
    let root = ring as f64 / RINGS as f64;
    root * root
}

fn at(z: f64, turns: f64) -> DVec3 {
    let [x, y] = on_circle(turns);
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * x, radius * y, z)
}

impl Skyline {
    /// True if something may be visible in a part.
    pub(crate) fn is_marked(&self, part: SkyPart) -> bool {
        self.0[usize::from(part.ring)] >> part.column & 1 != 0
    }

    /// True if something may be visible within an angle, given by its sine, around a local direction of length 1, above
    /// the horizon.
    pub(crate) fn may_block(&self, local: DVec3, sine: f64) -> bool {
        Region::of(local, 1.0, sine, f64::INFINITY).is_some_and(|region| self.meets(&region))
    }

    /// The marked fraction of the hemisphere.
    fn share(&self) -> f64 {
        let count = (1..).step_by(2).zip(&self.0).map(|(area, ring)| area * ring.count_ones()).sum::<u32>();
        f64::from(count) / (RINGS * RINGS * COLUMNS) as f64
    }

    fn mark(&mut self, region: &Region) {
        self.0[region.rings[0]..=region.rings[1]].iter_mut().for_each(|ring| *ring |= region.columns);
    }

    fn meets(&self, region: &Region) -> bool {
        self.0[region.rings[0]..=region.rings[1]].iter().any(|ring| ring & region.columns != 0)
    }

    fn holds(&self, region: &Region) -> bool {
        self.0[region.rings[0]..=region.rings[1]].iter().all(|ring| ring & region.columns == region.columns)
    }
}

/// A range of rings, and columns as bits.
struct Region {
    rings: [usize; 2],
    columns: u64,
}

impl Region {
    /// The region that a sphere around `at` covers above the horizon and below `highest`, the largest z of its
    /// directions; `None` if it is empty. `sine` is the sine of its angular radius, below 1.
    fn of(at: DVec3, distance: f64, sine: f64, highest: f64) -> Option<Self> {
        let sine = sine + MARGIN;
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        let z = at.z / distance;
        let across = (1.0 - z * z).max(0.0).sqrt();
        // z of the lowest and the highest point of the circle; 1 if it contains the pole.
        let low = z * cosine - across * sine;
        let holds_pole = sine >= across && z > 0.0;
        let high = if holds_pole { 1.0 } else { z * cosine + across * sine };
        let high = high.min(highest + MARGIN);
        if high < 0.0 {
            return None;
        }
        let rings = [ring(low - MARGIN), ring(high + MARGIN)];
        let ratio = sine / across;
        if ratio >= 1.0 || ratio.is_nan() {
            return Some(Self { rings, columns: u64::MAX });
        }
        // The angle with this sine is at most ratio + (pi/2 - 1) ratio^3.
        let half = (ratio + 0.571 * ratio * ratio * ratio) / std::f64::consts::TAU + MARGIN;
        if half >= 0.5 {
            return Some(Self { rings, columns: u64::MAX });
        }
        let middle = turns(at);
        let column = |turns: f64| (turns * COLUMNS as f64).floor();
        let (first, last) = (column(middle - half), column(middle + half));
        let count = (last - first) as u32 + 1;
        let ones = if count >= COLUMNS as u32 { u64::MAX } else { (1 << count) - 1 };
        Some(Self { rings, columns: ones.rotate_left(first.rem_euclid(COLUMNS as f64) as u32) })
    }
}

/// Azimuth in turns, in [0, 1].
fn turns(local: DVec3) -> f64 {
    let turns = atan2(local.y, local.x) / std::f64::consts::TAU;
    if turns < 0.0 { turns + 1.0 } else { turns }
}

/// A bounding box of triangles, with the index of its children or triangles.
#[derive(Clone, Copy, Debug)]
struct BoxNode {
    middle: DVec3,
    half: DVec3,
    /// Index of the second child, or of the first triangle of a leaf; the first child follows its parent.
    next: u32,
    /// Number of triangles of a leaf; 0 for an inner node.
    count: u32,
}

/// The triangles of a mesh in a hierarchy of boxes.
#[derive(Clone, Debug)]
pub(crate) struct Occluders {
    nodes: Vec<BoxNode>,
    triangles: Vec<[DVec3; 3]>,
    /// Center directions of all parts, ring by ring.
    middles: Vec<DVec3>,
    /// Largest distance of a direction from the center of its part, per ring, with the margin.
    part_radii: [f64; RINGS],
}

impl Occluders {
    pub(crate) fn new(vertices: &Vertices) -> Self {
        let mut triangles: Vec<[DVec3; 3]> =
            (0..vertices.triangles().len() as u32).map(|triangle| vertices.corners(triangle)).collect();
        let mut nodes = Vec::with_capacity(triangles.len());
        build(&mut nodes, &mut triangles, 0);
        let part = |i: usize| SkyPart { ring: (i / COLUMNS) as u8, column: (i % COLUMNS) as u8 };
        let middles = (0..RINGS * COLUMNS).map(|i| part(i).middle()).collect();
        Self { nodes, triangles, middles, part_radii: std::array::from_fn(part_radius) }
    }

    /// The skyline of a point, in the local coordinates of a frame.
    pub(crate) fn skyline(&self, at: DVec3, frame: &LocalFrame, waiting: &mut Vec<u32>) -> Skyline {
        let coarse = self.skyline_with(SMALL[0], at, frame, waiting);
        if coarse.share() > MUCH { coarse } else { self.skyline_with(SMALL[1], at, frame, waiting) }
    }

    fn skyline_with(&self, small: f64, at: DVec3, frame: &LocalFrame, waiting: &mut Vec<u32>) -> Skyline {
        let mut skyline = Skyline::default();
        let rows = [frame.tangent(), frame.normal().cross(frame.tangent()), frame.normal()].map(DVec3::abs);
        waiting.clear();
        waiting.push(0);
        while let Some(index) = waiting.pop() {
            let node = self.nodes[index as usize];
            let middle = frame.to_local(node.middle - at);
            let top = middle.z + rows[2].dot(node.half);
            if top <= 0.0 {
                continue;
            }
            let (distance, radius) = (middle.length(), node.half.length());
            let sine = radius / distance;
            if sine < WIDE {
                let highest = top / (distance - radius);
                match Region::of(middle, distance, sine, highest) {
                    None => continue,
                    Some(region) if skyline.holds(&region) => continue,
                    Some(region) if sine < small => {
                        skyline.mark(&region);
                        continue;
                    }
                    Some(_) => {}
                }
            }
            if node.count == 0 {
                waiting.extend([node.next, index + 1]);
                continue;
            }
            for corners in &self.triangles[node.next as usize..(node.next + node.count) as usize] {
                self.triangle(small, corners.map(|corner| frame.to_local(corner - at)), &mut skyline);
            }
        }
        skyline
    }

    /// Visits triangles whose distance from `place` may be at most `share` times their size or the position's
    /// coordinates.
    pub(crate) fn around(&self, place: DVec3, share: f64, mut visit: impl FnMut([DVec3; 3])) {
        let mut waiting = vec![0];
        while let Some(index) = waiting.pop() {
            let node = self.nodes[index as usize];
            let reach = share * (2.0 * node.half.length() + place.abs().element_sum());
            if !((place - node.middle).abs() - node.half).cmple(DVec3::splat(reach)).all() {
                continue;
            }
            if node.count == 0 {
                waiting.extend([node.next, index + 1]);
            } else {
                self.triangles[node.next as usize..(node.next + node.count) as usize]
                    .iter()
                    .copied()
                    .for_each(&mut visit);
            }
        }
    }

    /// Marks the parts that a triangle in local coordinates may cover.
    fn triangle(&self, small: f64, [a, b, c]: [DVec3; 3], skyline: &mut Skyline) {
        let top = a.z.max(b.z).max(c.z);
        if top <= 0.0 {
            return;
        }
        let middle = (a + b + c) / 3.0;
        let radius = [a, b, c].map(|corner| corner.distance(middle)).into_iter().fold(0.0, f64::max);
        let distance = middle.length();
        let sine = radius / distance;
        let (highest, near) = if sine < NEAR { (top / (distance - radius), false) } else { (f64::INFINITY, true) };
        let region = if near {
            Some(Region { rings: [0, RINGS - 1], columns: u64::MAX })
        } else {
            Region::of(middle, distance, sine, highest)
        };
        let Some(region) = region.filter(|region| !skyline.holds(region)) else { return };
        if sine < small {
            skyline.mark(&region);
            return;
        }
        // Rays from the vertex hit the triangle only if they approach its plane.
        let across = (b - a).cross(c - a);
        let length = across.length();
        if length == 0.0 {
            return;
        }
        let plane = if across.dot(a) > 0.0 { -across } else { across } / length;
        let slope = plane.truncate().length();
        for ring in region.rings[0]..=region.rings[1] {
            // A lower bound of the product over all columns of the ring.
            let (middle, radius) = (self.middles[ring * COLUMNS], self.part_radii[ring]);
            if plane.z * middle.z - slope * middle.truncate().length() >= radius + MARGIN {
                continue;
            }
            for column in ones(region.columns & !skyline.0[ring]) {
                if plane.dot(self.middles[ring * COLUMNS + column]) < radius {
                    skyline.0[ring] |= 1 << column;
                }
            }
        }
    }
}

/// The largest distance of a direction from the center of its part in a ring, with the margin.
fn part_radius(ring: usize) -> f64 {
    let middle = SkyPart { ring: ring as u8, column: 0 }.middle();
    let ends = [lower_end(ring), lower_end(ring + 1)];
    ends.map(|z| at(z, 0.0).distance(middle)).into_iter().fold(0.0, f64::max) + MARGIN
}

/// The indices of the set bits, in increasing order.
pub(crate) fn ones(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (bits != 0).then(|| {
            let lowest = bits.trailing_zeros() as usize;
            bits &= bits - 1;
            lowest
        })
    })
}

/// Appends the boxes over `triangles`, the first of which has index `first`, and sorts the triangles leaf by leaf.
fn build(nodes: &mut Vec<BoxNode>, triangles: &mut [[DVec3; 3]], first: u32) {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for corner in triangles.iter().flatten() {
        (low, high) = (low.min(*corner), high.max(*corner));
    }
    let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
    let node = nodes.len();
    let count = triangles.len();
    if count <= LEAF {
        nodes.push(BoxNode { middle, half, next: first, count: count as u32 });
        return;
    }
    let axis = if half.x >= half.y && half.x >= half.z {
        0
    } else if half.y >= half.z {
        1
    } else {
        2
    };
    nodes.push(BoxNode { middle, half, next: 0, count: 0 });
    let sum = |corners: &[DVec3; 3]| corners[0][axis] + corners[1][axis] + corners[2][axis];
    triangles.select_nth_unstable_by(count / 2, |one, other| sum(one).total_cmp(&sum(other)));
    let (lower, upper) = triangles.split_at_mut(count / 2);
    build(nodes, lower, first);
    nodes[node].next = nodes.len() as u32;
    build(nodes, upper, first + (count / 2) as u32);
}
