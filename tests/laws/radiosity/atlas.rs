//! Radiosities in a meshed atlas: nothing leaks, nothing is made, what is the same everywhere stays so.

use approx::assert_relative_eq;
use crossbar::geom::random::CounterRng;
use crossbar::radiosity::display::{RadiosityAtlas, at_corners};
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::{Patches, Subdivision};

fn patches(most: usize) -> Patches {
    let room = rooms::cornell(CornellBox { blocks: true, ..CornellBox::default() });
    Patches::new(&room, Subdivision::AtMost(most)).expect("patches")
}

/// Any radiosities, one a patch.
fn any(patches: &Patches, seed: u64) -> Vec<[f64; 3]> {
    let random = CounterRng::new(seed);
    (0..patches.list().len() as u64).map(|i| [0, 1, 2].map(|channel| 5.0 * random.unit(i, channel, 0))).collect()
}

/// Weights of corners, on the rim of a triangle and within.
fn places() -> Vec<[f64; 3]> {
    let steps = (0..=8).flat_map(|i| (0..=8 - i).map(move |j| [f64::from(i) / 8.0, f64::from(j) / 8.0]));
    steps.map(|[a, b]| [a, b, 1.0 - a - b]).collect()
}

/// Every triangle in a color of its own: no read anywhere on it shows another color, at any size of its rectangle.
#[test]
fn no_read_leaves_its_triangle() {
    let patches = patches(90);
    for side in [16, 32, 64, 128] {
        let atlas = RadiosityAtlas::new(&patches, side).expect("an atlas");
        let texels: Vec<[f64; 3]> = atlas.atlas().texels().iter().map(|texel| [f64::from(texel.face); 3]).collect();
        for triangle in 0..atlas.mesh().len() as u32 {
            for weights in places() {
                assert_eq!(atlas.read(&texels, triangle, weights), [f64::from(triangle); 3], "{side}: {weights:?}");
            }
        }
    }
}

/// To the bit.
#[test]
fn what_is_the_same_everywhere_stays_so() {
    let patches = patches(200);
    let atlas = RadiosityAtlas::new(&patches, 64).expect("an atlas");
    let same = [0.3, 1.0 / 3.0, 7e5];
    let texels = atlas.texels(&patches, &vec![same; patches.list().len()]);
    assert!(texels.iter().all(|texel| *texel == same));
    for triangle in 0..atlas.mesh().len() as u32 {
        assert!(places().into_iter().all(|weights| atlas.read(&texels, triangle, weights) == same), "{triangle}");
    }
}

/// Texels are means: together they hold what the interpolation between corners holds, and differ from patches of
/// constant radiosity by no more than corners do.
#[test]
fn power_is_kept() {
    for (most, side, seed) in [(60, 16, 1), (60, 64, 2), (300, 32, 3), (300, 128, 4)] {
        let patches = patches(most);
        let radiosity = any(&patches, seed);
        let atlas = RadiosityAtlas::new(&patches, side).expect("an atlas");
        let texels = atlas.texels(&patches, &radiosity);
        let power = atlas.power(&patches, &radiosity, &texels);
        let corners = at_corners(&patches, &radiosity);
        for channel in 0..3 {
            let interpolated = |triangle: u32| {
                let patch = &patches.list()[atlas.patch_of(triangle) as usize];
                let of_patch = &corners[atlas.patch_of(triangle) as usize];
                let own = atlas.atlas().corners(triangle);
                let nearest = |at: glam::DVec3| {
                    let apart = |corner: &glam::DVec3| (*corner - at).length();
                    let all = patch.corners().iter().enumerate();
                    all.min_by(|a, b| apart(a.1).total_cmp(&apart(b.1))).map_or(0, |(corner, _)| corner)
                };
                let mean: f64 = own.into_iter().map(|at| of_patch[nearest(at)][channel] / 3.0).sum();
                atlas.mesh().area(triangle) * mean
            };
            let expected: f64 = (0..atlas.mesh().len() as u32).map(interpolated).sum();
            assert_relative_eq!(power.held[channel], expected, max_relative = 1e-12);
            let apart = (power.held[channel] - power.exact[channel]).abs();
            assert!(apart <= power.bound[channel] && power.bound[channel] > 0.0, "{power:?}");
        }
    }
}

/// The interpolation is met the better the more texels there are, and its corners are those of the patches.
#[test]
fn finer_atlases_are_nearer_to_the_interpolation() {
    let patches = patches(60);
    let radiosity = any(&patches, 9);
    let corners = at_corners(&patches, &radiosity);
    let mut largest = Vec::new();
    for side in [32, 128, 512] {
        let atlas = RadiosityAtlas::new(&patches, side).expect("an atlas");
        let texels = atlas.texels(&patches, &radiosity);
        let mut apart = 0.0_f64;
        for triangle in 0..atlas.mesh().len() as u32 {
            let patch = atlas.patch_of(triangle) as usize;
            for (corner, at) in patches.list()[patch].corners().iter().enumerate() {
                let own = atlas.atlas().corners(triangle);
                if own.iter().any(|own| (*own - *at).length() < 1e-9) {
                    let found = atlas.read_at(&texels, triangle, *at);
                    apart = (0..3).fold(apart, |most, c| most.max((found[c] - corners[patch][corner][c]).abs()));
                }
            }
        }
        largest.push(apart);
    }
    assert!(largest[0] > 2.0 * largest[1] && largest[1] > 2.0 * largest[2], "{largest:?}");
}

#[test]
fn too_few_texels_are_refused() {
    let patches = patches(90);
    assert!(RadiosityAtlas::new(&patches, 4).is_err_and(|error| {
        error.to_string().contains(" faces do not fit into an atlas of 4 x 4 texels, expected a side of")
    }));
    assert!(RadiosityAtlas::new(&patches, 48).is_err_and(|error| {
        error.to_string().contains("found an atlas of 48 x 48 texels, expected a side that is a power of")
    }));
}
