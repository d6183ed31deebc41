//! Coverage: the pixels of a triangle.

use super::triangle::TriangleSetup;
use crate::texture::Region;

/// A 2x2 block of pixels, the unit for derivatives: lane 0 at (x, y), lane 1 to its right, lanes 2 and 3 in the next
/// row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelQuad {
    /// Column of lane 0, even.
    pub x: u32,
    /// Row of lane 0, even.
    pub y: u32,
    /// Bit `i` is set if lane `i` is covered; other lanes are helpers. Never 0.
    pub mask: u8,
}

impl PixelQuad {
    /// Column and row of a lane.
    pub fn lane(&self, lane: usize) -> (u32, u32) {
        (self.x + (lane as u32 & 1), self.y + (lane as u32 >> 1 & 1))
    }
}

impl TriangleSetup {
    /// Returns `true` if the fill rule assigns the pixel to this triangle: the pixel's centre is inside, or on a top or
    /// left edge.
    pub fn coverage(&self, x: u32, y: u32) -> bool {
        self.edges.iter().all(|e| e.at(x, y) >= e.bias)
    }

    /// Returns `true` only if no pixel of the region is covered. Conservative: may return `false` for a region that the
    /// triangle narrowly misses.
    pub fn misses(&self, region: Region) -> bool {
        let r = region.intersect(self.bounds);
        if r.width == 0 || r.height == 0 {
            return true;
        }
        // An edge function is largest at the corner in the direction of its gradient.
        self.edges.iter().any(|e| {
            let x = if e.a > 0 { r.x + r.width - 1 } else { r.x };
            let y = if e.b > 0 { r.y + r.height - 1 } else { r.y };
            e.at(x, y) < e.bias
        })
    }

    /// Returns `true` if every pixel of the region is covered.
    pub fn covers(&self, region: Region) -> bool {
        let r = region.intersect(self.bounds);
        r == region
            && r.width != 0
            && r.height != 0
            && self.edges.iter().all(|e| {
                let x = if e.a > 0 { r.x } else { r.x + r.width - 1 };
                let y = if e.b > 0 { r.y } else { r.y + r.height - 1 };
                e.at(x, y) >= e.bias
            })
    }

    /// Iterates over the quads of the region with at least one covered pixel, row by row. Pixels outside the region are
    /// never covered.
    pub fn quads(&self, region: Region) -> QuadIterator<'_> {
        let region = if self.misses(region) { Region::default() } else { region.intersect(self.bounds) };
        QuadIterator { setup: self, region, x: region.x & !1, y: region.y & !1 }
    }
}

/// Iterator over the covered quads of a region; see [`TriangleSetup::quads`].
#[derive(Clone, Debug)]
pub struct QuadIterator<'a> {
    setup: &'a TriangleSetup,
    region: Region,
    x: u32,
    y: u32,
}

impl QuadIterator<'_> {
    fn mask(&self) -> u8 {
        let r = &self.region;
        let quad = PixelQuad { x: self.x, y: self.y, mask: 0 };
        (0..4).fold(0, |mask, lane| {
            let (x, y) = quad.lane(lane);
            let inside = x >= r.x && y >= r.y && x - r.x < r.width && y - r.y < r.height;
            mask | u8::from(inside && self.setup.coverage(x, y)) << lane
        })
    }
}

impl Iterator for QuadIterator<'_> {
    type Item = PixelQuad;

    fn next(&mut self) -> Option<PixelQuad> {
        let (right, bottom) = (self.region.x + self.region.width, self.region.y + self.region.height);
        while self.y < bottom {
            while self.x < right {
                let quad = PixelQuad { x: self.x, y: self.y, mask: self.mask() };
                self.x += 2;
                if quad.mask != 0 {
                    return Some(quad);
                }
            }
            self.x = self.region.x & !1;
            self.y += 2;
        }
        None
    }
}
