//! The moments of every cluster of an atlas, in mm.

use glam::DVec3;
use rayon::prelude::*;

use super::check_scale;
use super::face_map::{FaceMap, Window};
use super::moments::{BALL, Moments, size_squared};
use crate::atlas::Atlas;
use crate::error::InputError;

/// A cluster of an atlas: the texel at column x and row y of a level; level 0 is the finest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClusterId {
    /// The level.
    pub level: u32,
    /// The row.
    pub y: u32,
    /// The column.
    pub x: u32,
}

/// The moments (area, mean point, covariance) of every cluster of an atlas, in mm. Clusters of a level are in Morton
/// order, so the children of cluster k are the clusters 4 k to 4 k + 3 of the next finer level.
#[derive(Clone, Debug)]
pub struct SurfaceMoments {
    side: u32,
    levels: Vec<Vec<Moments>>,
    faces: Vec<FaceMap>,
    /// The face of each texel, in Morton order.
    texel_faces: Vec<u32>,
}

impl SurfaceMoments {
    /// Computes the moments of the clusters of an atlas.
    pub fn new(atlas: &Atlas, mm_per_unit: f64) -> Result<Self, InputError> {
        check_scale(mm_per_unit)?;
        let in_mm = |corner: DVec3| mm_per_unit * corner;
        let faces: Vec<FaceMap> = (0..)
            .zip(atlas.places())
            .map(|(face, &place)| FaceMap::new(place.in_turn(atlas.corners(face)).map(in_mm), place))
            .collect();
        let side = atlas.side();
        let texels = side as usize * side as usize;
        let texel = |k: usize| &atlas.texels()[row_major(k, side)];
        let texel_faces: Vec<u32> = (0..texels).into_par_iter().map(|k| texel(k).face).collect();
        let finest = (0..texels).into_par_iter().map(|k| {
            let (x, y) = from_morton(k);
            let face = &faces[texel(k).face as usize];
            face.moments(face.window(x, y), texel(k).area * mm_per_unit * mm_per_unit)
        });
        let mut levels: Vec<Vec<Moments>> = vec![finest.collect()];
        while let Some(below) = levels.last().filter(|level| level.len() > 1) {
            let level = below.par_chunks_exact(4).map(|four| Moments::together(&[four[0], four[1], four[2], four[3]]));
            let level = level.collect();
            levels.push(level);
        }
        for (level, clusters) in (1..).zip(&mut levels[1..]) {
            set_sizes(clusters, level, atlas, mm_per_unit);
        }
        Ok(Self { side, levels, faces, texel_faces })
    }

    /// Texels along a side of the atlas.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// The number of levels.
    pub fn level_count(&self) -> u32 {
        self.levels.len() as u32
    }

    /// The area of the surface, in mm^2.
    pub fn area(&self) -> f64 {
        self.root().area
    }

    /// The area of a cluster, in mm^2. Panics if there is no such cluster.
    pub fn cluster_area(&self, cluster: ClusterId) -> f64 {
        self.area_at(cluster.level, to_morton(cluster.x, cluster.y))
    }

    /// The area of a cluster, by its Morton index in a level.
    pub(in crate::subsurface) fn area_at(&self, level: u32, place: usize) -> f64 {
        self.level(level)[place].area
    }

    /// Mean point, covariance (xx, yy, zz, xy, xz, yz) and squared size of a cluster, for tests.
    #[doc(hidden)]
    pub fn moments(&self, cluster: ClusterId) -> (DVec3, [f64; 6], f64) {
        let found = &self.level(cluster.level)[to_morton(cluster.x, cluster.y)];
        (found.point, found.covariance.0, found.size_squared)
    }

    /// Mean texel area of the atlas divided by the cluster's mean texel area; 0 for a cluster without area. Factors are
    /// multiplied by it if the means of levels weigh all texels equally.
    pub(in crate::subsurface) fn area_ratio(&self, cluster: ClusterId) -> f64 {
        let texels = (1_u64 << (2 * cluster.level)) as f64;
        let all = f64::from(self.side) * f64::from(self.side);
        let area = self.cluster_area(cluster);
        if area > 0.0 { (self.area() / all) / (area / texels) } else { 0.0 }
    }

    pub(super) fn level(&self, level: u32) -> &[Moments] {
        &self.levels[level as usize]
    }

    pub(super) fn root(&self) -> &Moments {
        &self.levels[self.levels.len() - 1][0]
    }

    /// Upper bound on the distance of two points of the surface, in mm.
    pub(super) fn diameter(&self) -> f64 {
        2.0 * (BALL * self.root().size_squared).sqrt()
    }

    /// The face of a texel, given by Morton index, and the texel's window in the face.
    pub(super) fn window(&self, texel: usize) -> (&FaceMap, Window) {
        let face = &self.faces[self.texel_faces[texel] as usize];
        let (x, y) = from_morton(texel);
        (face, face.window(x, y))
    }
}

/// Sets sizes from the atlas's bounding balls, which are tight.
fn set_sizes(clusters: &mut [Moments], level: u32, atlas: &Atlas, mm_per_unit: f64) {
    clusters.par_iter_mut().enumerate().for_each(|(k, moments)| {
        let (x, y) = from_morton(k);
        let cluster = atlas.cluster(level, x, y);
        // The atlas's mean point may differ by rounding.
        let radius = mm_per_unit * cluster.radius + (mm_per_unit * cluster.point - moments.point).length();
        moments.size_squared = size_squared(&moments.covariance, radius * radius);
    });
}

fn row_major(texel: usize, side: u32) -> usize {
    let (x, y) = from_morton(texel);
    y as usize * side as usize + x as usize
}

/// The Morton index of column x, row y.
pub(in crate::subsurface) fn to_morton(x: u32, y: u32) -> usize {
    let spread = |value: u32| {
        let mut v = u64::from(value);
        v = (v | (v << 16)) & 0x0000_ffff_0000_ffff;
        v = (v | (v << 8)) & 0x00ff_00ff_00ff_00ff;
        v = (v | (v << 4)) & 0x0f0f_0f0f_0f0f_0f0f;
        v = (v | (v << 2)) & 0x3333_3333_3333_3333;
        (v | (v << 1)) & 0x5555_5555_5555_5555
    };
    (spread(x) | (spread(y) << 1)) as usize
}

/// Column and row of a Morton index.
pub(in crate::subsurface) fn from_morton(place: usize) -> (u32, u32) {
    let gather = |value: u64| {
        let mut v = value & 0x5555_5555_5555_5555;
        v = (v | (v >> 1)) & 0x3333_3333_3333_3333;
        v = (v | (v >> 2)) & 0x0f0f_0f0f_0f0f_0f0f;
        v = (v | (v >> 4)) & 0x00ff_00ff_00ff_00ff;
        v = (v | (v >> 8)) & 0x0000_ffff_0000_ffff;
        (v | (v >> 16)) as u32
    };
    (gather(place as u64), gather(place as u64 >> 1))
}
