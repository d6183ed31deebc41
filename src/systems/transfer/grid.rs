//! The cube of light texels, its segments, and the finer cube of directions in which visibility is sampled.
//!
//! Faces and the order of rows and columns are Direct3D's ([`CUBE_FACES`](crate::sphere::CUBE_FACES)). The index of a
//! light texel is 1024 face + 32 row + column. The index of a fine direction is 16384 face + 128 row + column, with 4 x
//! 4 fine directions per light texel (section 4).

use std::sync::OnceLock;

use glam::DVec3;

use crate::sphere::CubeMap;

/// Light texels along an edge of the cube.
pub const LIGHT_SIDE: usize = 32;
/// Fine directions along an edge of a light texel.
pub const SUPERSAMPLES: usize = 4;
/// Fine directions along an edge of the cube.
pub const FINE_SIDE: usize = LIGHT_SIDE * SUPERSAMPLES;
/// Light texels: n_L.
pub const LIGHT_TEXELS: usize = 6 * LIGHT_SIDE * LIGHT_SIDE;
/// Fine directions.
pub const FINE_DIRECTIONS: usize = 6 * FINE_SIDE * FINE_SIDE;
/// Cube map of the light's texels.
pub const LIGHT_MAP: CubeMap = CubeMap::new(LIGHT_SIDE);

/// The division of the cube into squares, each with its own Haar transform.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, strum::Display, strum::EnumIter, strum::EnumMessage)]
#[strum(serialize_all = "kebab-case")]
pub enum Segmentation {
    /// 24 segments of 16 x 16 texels, four per face: the paper's.
    ///
    /// Segment face 4 + 2 (row / 16) + column / 16.
    #[default]
    #[strum(to_string = "24")]
    Quarters,
    /// The six faces, 32 x 32 texels each, for comparison (Figure 6).
    ///
    /// Those of \[NRH03\].
    #[strum(to_string = "6")]
    Faces,
}

impl Segmentation {
    /// Texels along an edge of a segment.
    pub const fn side(self) -> usize {
        match self {
            Self::Quarters => LIGHT_SIDE / 2,
            Self::Faces => LIGHT_SIDE,
        }
    }

    /// Texels of a segment.
    pub const fn len(self) -> usize {
        self.side() * self.side()
    }

    /// Always false.
    pub const fn is_empty(self) -> bool {
        false
    }

    /// The number of segments.
    pub const fn count(self) -> usize {
        LIGHT_TEXELS / self.len()
    }

    /// The segment of a light texel, and the texel's index in it, row by row. Panics if there is no such texel.
    pub fn place(self, texel: usize) -> [usize; 2] {
        assert!(texel < LIGHT_TEXELS, "a texel of the light, not {texel}");
        let [face, row, column] = face_row_column(texel, LIGHT_SIDE);
        let (side, across) = (self.side(), LIGHT_SIDE / self.side());
        let segment = face * across * across + across * (row / side) + column / side;
        [segment, row % side * side + column % side]
    }

    /// The light texel at an index of a segment. Panics if there is no such segment or index.
    pub fn texel(self, segment: usize, place: usize) -> usize {
        assert!(segment < self.count() && place < self.len(), "a place of a segment, not {place} of {segment}");
        let (side, across) = (self.side(), LIGHT_SIDE / self.side());
        let (face, quarter) = (segment / (across * across), segment % (across * across));
        let (row, column) = (quarter / across * side + place / side, quarter % across * side + place % side);
        (face * LIGHT_SIDE + row) * LIGHT_SIDE + column
    }
}

/// Face, row and column of a texel of a cube of this side.
pub const fn face_row_column(texel: usize, side: usize) -> [usize; 3] {
    [texel / (side * side), texel / side % side, texel % side]
}

/// The direction of a light texel's center.
pub fn texel_center(texel: usize) -> DVec3 {
    let [face, row, column] = face_row_column(texel, LIGHT_SIDE);
    LIGHT_MAP.direction(face, column, row)
}

/// The solid angle of a light texel, in steradians.
pub fn texel_solid_angle(texel: usize) -> f64 {
    let [_, row, column] = face_row_column(texel, LIGHT_SIDE);
    LIGHT_MAP.solid_angle(column, row)
}

/// The light texel that contains a fine direction.
pub const fn light_texel(fine: usize) -> usize {
    let [face, row, column] = face_row_column(fine, FINE_SIDE);
    (face * LIGHT_SIDE + row / SUPERSAMPLES) * LIGHT_SIDE + column / SUPERSAMPLES
}

/// Directions in the light's texels, 1, 2 x 2 or 4 x 4 in each, with their solid angles. The index of a direction is
/// (32 s)^2 face + 32 s row + column, with s directions along an edge of a texel.
#[derive(Debug)]
pub struct FineDirections {
    samples: usize,
    directions: Vec<DVec3>,
    solid_angles: Vec<f64>,
}

impl FineDirections {
    /// The fine directions, 4 x 4 per texel, computed once.
    pub fn get() -> &'static Self {
        Self::of(SUPERSAMPLES)
    }

    /// Directions with `samples` (1, 2 or 4) along an edge of a texel, computed once each. Panics for another number.
    pub fn of(samples: usize) -> &'static Self {
        static ALL: [OnceLock<FineDirections>; 3] = [const { OnceLock::new() }; 3];
        assert!([1, 2, 4].contains(&samples), "1, 2 or 4 directions along an edge of a texel, not {samples}");
        ALL[samples.ilog2() as usize].get_or_init(|| Self::new(samples))
    }

    fn new(samples: usize) -> Self {
        let side = LIGHT_SIDE * samples;
        let map = CubeMap::new(side);
        let direction = |[face, row, column]: [usize; 3]| map.direction(face, column, row);
        let of_face: Vec<f64> = (0..side * side).map(|texel| map.solid_angle(texel % side, texel / side)).collect();
        Self {
            samples,
            directions: (0..6 * side * side).map(|fine| direction(face_row_column(fine, side))).collect(),
            solid_angles: of_face.repeat(6),
        }
    }

    /// Directions along an edge of a texel.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Directions along an edge of the cube.
    pub fn side(&self) -> usize {
        LIGHT_SIDE * self.samples
    }

    /// The directions by index, of length 1.
    pub fn directions(&self) -> &[DVec3] {
        &self.directions
    }

    /// The solid angles of their texels in steradians, exact to rounding. They sum to 4 pi.
    pub fn solid_angles(&self) -> &[f64] {
        &self.solid_angles
    }

    /// The indices of the directions in a light texel, row by row.
    pub fn in_texel(&self, texel: usize) -> impl Iterator<Item = usize> + use<> {
        let (samples, side) = (self.samples, self.side());
        let [face, row, column] = face_row_column(texel, LIGHT_SIDE);
        let first = (face * side + row * samples) * side + column * samples;
        (0..samples * samples).map(move |sample| first + sample / samples * side + sample % samples)
    }
}
