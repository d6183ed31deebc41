//! Laws of texels and clusters.

use crossbar::atlas::{Atlas, Cluster};
use glam::DVec3;
use proptest::prelude::*;

use super::meshes::atlases;

/// Extent of a mesh.
fn extent(atlas: &Atlas) -> f64 {
    let top = atlas.cluster(atlas.levels() - 1, 0, 0);
    top.radius + top.point.length()
}

/// The area and mean point of a flat convex polygon.
fn polygon(ring: &[DVec3]) -> (f64, DVec3) {
    let (mut area, mut sum) = (0.0, DVec3::ZERO);
    for pair in ring[1..].windows(2) {
        let own = (pair[0] - ring[0]).cross(pair[1] - ring[0]).length() / 2.0;
        area += own;
        sum += own * (ring[0] + pair[0] + pair[1]) / 3.0;
    }
    (area, if area > 0.0 { sum / area } else { ring[0] })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Every face has its own rectangle, the rectangles tile the atlas without overlap, and the areas add up.
    #[test]
    fn every_face_owns_texels_of_its_own((sample, side) in atlases()) {
        let atlas = Atlas::new(&sample.mesh, side).expect("an atlas");
        prop_assert_eq!(atlas.texels().len() as u32, side * side);
        let mut areas = vec![0.0; sample.mesh.len()];
        let mut counts = vec![0; sample.mesh.len()];
        for (at, texel) in (0..).zip(atlas.texels()) {
            prop_assert!(atlas.places()[texel.face as usize].contains(at % side, at / side));
            areas[texel.face as usize] += texel.area;
            counts[texel.face as usize] += 1;
        }
        for (face, place) in (0..).zip(atlas.places()) {
            prop_assert_eq!(counts[face as usize], place.texels());
            let area = sample.mesh.area(face);
            prop_assert!((areas[face as usize] - area).abs() <= 1e-12 * area);
        }
        let sum: f64 = areas.iter().sum();
        let whole: f64 = (0..sample.mesh.len() as u32).map(|face| sample.mesh.area(face)).sum();
        prop_assert!((sum - whole).abs() <= 1e-12 * whole && (atlas.area() - whole).abs() <= 1e-12 * whole);
    }

    /// The polygons and the points of a texel have its area and mean point, computed here in a different way.
    #[test]
    fn parts_are_what_texels_say((sample, side) in atlases()) {
        let atlas = Atlas::new(&sample.mesh, side).expect("an atlas");
        let close = 1e-12 * extent(&atlas);
        for (at, texel) in (0..).zip(atlas.texels()) {
            let part = atlas.part(at);
            let pieces: Vec<_> = part.polygons().map(polygon).collect();
            prop_assert!((1..=2).contains(&pieces.len()));
            let area: f64 = pieces.iter().map(|piece| piece.0).sum();
            prop_assert!((area - texel.area).abs() <= close * extent(&atlas), "{area} {}", texel.area);
            if texel.area > 1e-6 * atlas.mean_texel_area() {
                let mean = pieces.iter().map(|piece| piece.0 * piece.1).sum::<DVec3>() / area;
                prop_assert!(mean.distance(texel.point) <= 1000.0 * close, "{mean} {texel:?}");
            }
            for n in [1, 2, 3] {
                let points: Vec<_> = atlas.points(at, n).collect();
                prop_assert_eq!(points.len() as u32, n * n);
                let mean = points.iter().sum::<DVec3>() / f64::from(n * n);
                prop_assert!(mean.distance(texel.point) <= close);
            }
        }
    }

    /// A texel of a level is the area-weighted mean of its finest texels, and its bounding ball contains the parts of
    /// these texels.
    #[test]
    fn clusters_are_means_of_their_texels((sample, side) in atlases()) {
        let atlas = Atlas::new(&sample.mesh, side).expect("an atlas");
        prop_assert_eq!(1 << (atlas.levels() - 1), side);
        let close = 1e-12 * extent(&atlas);
        for level in 0..atlas.levels() {
            let width = side >> level;
            prop_assert_eq!(atlas.clusters(level).len() as u32, width * width);
            for (at, cluster) in (0..).zip(atlas.clusters(level)) {
                let [x, y] = [at % width, at / width];
                prop_assert_eq!(cluster, atlas.cluster(level, x, y));
                check_cluster(&atlas, level, [x, y], cluster, close)?;
            }
        }
    }

}

fn check_cluster(
    atlas: &Atlas,
    level: u32,
    [x, y]: [u32; 2],
    cluster: &Cluster,
    close: f64,
) -> Result<(), TestCaseError> {
    let side = atlas.side();
    let below =
        || (y << level..(y + 1) << level).flat_map(|row| (x << level..(x + 1) << level).map(move |at| row * side + at));
    let texels = || below().map(|at| &atlas.texels()[at as usize]);
    let area: f64 = texels().map(|texel| texel.area).sum();
    prop_assert!((area - cluster.area).abs() <= 1e-12 * area);
    let mean = match area > 0.0 {
        true => texels().map(|texel| texel.area * texel.point).sum::<DVec3>() / area,
        false => texels().map(|texel| texel.point).sum::<DVec3>() / f64::from(1 << (2 * level)),
    };
    prop_assert!(mean.distance(cluster.point) <= close, "level {level}: {mean} {cluster:?}");
    for at in below() {
        for corner in atlas.part(at).polygons().flatten() {
            prop_assert!(corner.distance(cluster.point) <= cluster.radius + close, "level {level}");
        }
    }
    Ok(())
}
