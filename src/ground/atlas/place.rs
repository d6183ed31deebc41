//! A face's rectangle of texels, and the map between the rectangle and the face.
//!
//! docs/atlas.md defines the map: affine in each half, continuous across the diagonal, and preserving ratios of areas.

use glam::DVec3;

/// Rectangle of a face, in texels, and the assignment of corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FacePlace {
    /// Column of its first texel.
    pub x: u32,
    /// Row of its first texel.
    pub y: u32,
    /// Texels per row: a power of two.
    pub width: u32,
    /// Number of rows: `width` or twice `width`.
    pub height: u32,
    /// Index, 0 to 2, of the face's corner at (x, y): corner a. Corners b and c follow it in the face's order.
    pub first: u8,
    /// `true` if corner b lies along y and c along x, instead of b along x and c along y.
    pub transposed: bool,
}

impl FacePlace {
    /// Chooses the placement of a face in a rectangle with the squarest texels; on ties, the first of the six.
    pub(super) fn squarest([x, y, width, height]: [u32; 4], corners: [DVec3; 3]) -> Self {
        let place = |first, transposed| Self { x, y, width, height, first, transposed };
        let places = (0..3).flat_map(|first| [false, true].map(|transposed| place(first, transposed)));
        let stretched = places.map(|place| (place.stretch(corners), place));
        let best = stretched.min_by(|one, other| one.0.total_cmp(&other.0));
        best.map_or(place(0, false), |(_, place)| place)
    }

    /// Sum of the squared sides of a texel's image, in both halves. All placements have the same area, so the smallest
    /// sum belongs to the squarest image: sum / area is at least 2 per half, its value for a square.
    fn stretch(&self, corners: [DVec3; 3]) -> f64 {
        let [a, b, c] = self.in_turn(corners);
        let [along_u, along_v] = if self.transposed { [self.height, self.width] } else { [self.width, self.height] };
        let [along_u, along_v] = [along_u, along_v].map(|texels| f64::from(texels) * f64::from(texels));
        let far = (c - b).length_squared() / 4.0;
        ((b - a).length_squared() + far) / along_u + ((c - a).length_squared() + far) / along_v
    }

    /// Reorders one value per corner from the face's index order to the order of corners a, b and c.
    pub fn in_turn<T: Copy>(&self, of: [T; 3]) -> [T; 3] {
        let first = usize::from(self.first) % 3;
        [of[first], of[(first + 1) % 3], of[(first + 2) % 3]]
    }

    /// Reorders values of corners a, b and c to the face's index order: the inverse of [`FacePlace::in_turn`].
    pub fn by_index<T: Copy>(&self, [a, b, c]: [T; 3]) -> [T; 3] {
        match self.first {
            0 => [a, b, c],
            1 => [c, a, b],
            _ => [b, c, a],
        }
    }

    /// Number of texels.
    pub fn texels(&self) -> u32 {
        self.width * self.height
    }

    /// Returns `true` if a texel of the atlas belongs to the face.
    pub fn contains(&self, x: u32, y: u32) -> bool {
        (self.x..self.x + self.width).contains(&x) && (self.y..self.y + self.height).contains(&y)
    }

    /// Smallest and largest texel coordinates, `[x, y, x, y]`, with which a bilinear read stays on the face: half a
    /// texel within the rectangle. Coordinates clamped to them also read the nearest texel of the face.
    pub fn bounds(&self) -> [f64; 4] {
        let [x, y, width, height] = [self.x, self.y, self.width, self.height].map(f64::from);
        [x + 0.5, y + 0.5, x + width - 0.5, y + height - 0.5]
    }

    /// Barycentric weights, by corner index, at texel coordinates, which are clamped to the face's rectangle. Exact if
    /// the coordinates are multiples of 2^-20 texels.
    pub fn weights(&self, x: f64, y: f64) -> [f64; 3] {
        let [u, v] = self.local(x, y);
        self.weights_of(u, v, u.min(v))
    }

    /// Texel coordinates of the point of the face with these barycentric weights, by corner index, which are clamped.
    pub fn coordinates(&self, weights: [f64; 3]) -> [f64; 2] {
        let [a, b, c] = self.in_turn(weights).map(|weight| if weight >= 0.0 { weight.min(1.0) } else { 0.0 });
        let [u, v] = if b >= c { [1.0 - a, 2.0 * c] } else { [2.0 * b, 1.0 - a] }.map(|part: f64| part.min(1.0));
        let [along_x, along_y] = if self.transposed { [v, u] } else { [u, v] };
        let [x, y, width, height] = [self.x, self.y, self.width, self.height].map(f64::from);
        [x + width * along_x, y + height * along_y]
    }

    /// Barycentric weights, by corner index, at the mean point of a rectangle within the face's rectangle. The means
    /// are exact, even if the diagonal crosses the rectangle.
    pub fn mean_weights(&self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> [f64; 3] {
        let ([u0, v0], [u1, v1]) = (self.local(x0, y0), self.local(x1, y1));
        let [u, v] = [(u0 + u1) / 2.0, (v0 + v1) / 2.0];
        let least = if u1 <= v0 || v1 <= u0 {
            u.min(v)
        } else {
            // min(u, v) = u - max(u - v, 0), and the integral of max(u - v, 0) over the rectangle is a sum of four
            // terms t^3 / 6, one per corner.
            let cube = |t: f64| if t > 0.0 { t * t * t / 6.0 } else { 0.0 };
            let excess = cube(u1 - v0) - cube(u1 - v1) - cube(u0 - v0) + cube(u0 - v1);
            u - excess / ((u1 - u0) * (v1 - v0))
        };
        self.weights_of(u, v, least)
    }

    fn local(&self, x: f64, y: f64) -> [f64; 2] {
        let part = |at: f64, from: u32, texels: u32| {
            let part = (at - f64::from(from)) / f64::from(texels);
            if part >= 0.0 { part.min(1.0) } else { 0.0 }
        };
        let [along_x, along_y] = [part(x, self.x, self.width), part(y, self.y, self.height)];
        if self.transposed { [along_y, along_x] } else { [along_x, along_y] }
    }

    fn weights_of(&self, u: f64, v: f64, least: f64) -> [f64; 3] {
        let half = least / 2.0;
        let [b, c] = [u - half, v - half];
        // For a single point, u + v - least is the larger of u and v.
        self.by_index([1.0 - (u + v - least), b, c])
    }
}
