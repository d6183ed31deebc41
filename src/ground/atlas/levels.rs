//! Clusters of every level of an atlas.

use glam::DVec3;
use rayon::prelude::*;

use super::part::TexelPart;
use super::place::FacePlace;
use super::surface::AtlasSurface;
use super::texel::{Cluster, Texel};

/// Factor that enlarges a radius, so that rounding leaves no point outside.
const ROUNDING: f64 = 1.0 + 1e-14;

/// Computes the clusters of each level, finest first.
pub(super) fn levels(surface: &AtlasSurface, places: &[FacePlace], texels: &[Texel], side: u32) -> Vec<Vec<Cluster>> {
    let mut levels: Vec<Vec<Cluster>> =
        vec![texels.iter().map(|texel| Cluster { area: texel.area, point: texel.point, radius: 0.0 }).collect()];
    let mut width = side;
    while width > 1 {
        let next = coarser(levels.last().map_or(&[], Vec::as_slice), width);
        levels.push(next);
        width /= 2;
    }
    for (level, clusters) in levels.iter_mut().enumerate() {
        find_radii(surface, places, texels, side, level as u32, clusters);
    }
    levels
}

/// Computes the clusters of the next coarser level; `width` is the finer level's number of clusters per row.
fn coarser(finer: &[Cluster], width: u32) -> Vec<Cluster> {
    let (width, half) = (width as usize, width as usize / 2);
    let of_four = |at: usize| {
        let first = 2 * (at / half) * width + 2 * (at % half);
        Cluster::of_four([first, first + 1, first + width, first + width + 1].map(|place| &finer[place]))
    };
    (0..half * half).into_par_iter().map(of_four).collect()
}

fn find_radii(
    surface: &AtlasSurface,
    places: &[FacePlace],
    texels: &[Texel],
    side: u32,
    level: u32,
    clusters: &mut [Cluster],
) {
    let (size, width) = (1_u32 << level, side >> level);
    // Clusters that lie within one face:
    clusters.par_iter_mut().enumerate().for_each(|(at, cluster)| {
        let [x, y] = [at as u32 % width * size, at as u32 / width * size];
        let face = texels[(y * side + x) as usize].face;
        let place = &places[face as usize];
        if place.width >= size {
            let [low, high] = [[x, y], [x + size, y + size]].map(|corner| corner.map(f64::from));
            let part = TexelPart::new(place, surface.corners(face), low, high);
            cluster.radius = part.farthest(cluster.point) * ROUNDING;
        }
    });
    // Faces that lie within one cluster:
    for (face, place) in (0..).zip(places).filter(|(_, place)| place.width < size) {
        let cluster = &mut clusters[((place.y >> level) * width + (place.x >> level)) as usize];
        let farthest = farthest(surface.corners(face), cluster.point) * ROUNDING;
        cluster.radius = cluster.radius.max(farthest);
    }
}

fn farthest(corners: [DVec3; 3], from: DVec3) -> f64 {
    corners.map(|corner| corner.distance_squared(from)).into_iter().fold(0.0, f64::max).sqrt()
}
