//! Stand-ins for the models of the subsurface paper, which are not available: the printed face counts, and roughly
//! similar shapes.
//!
//! Each is a deformed geodesic sphere. A closed mesh has an even number of faces, so the bunny, with an odd one, is
//! open: at the bottom.

use glam::DVec3;

use super::geodesic::{Lobe, bumped, mesh_of};
use crate::geom::Mesh;

/// Builds a stand-in for the paper's head: 7,232 faces, closed, about 2.3 units high.
pub fn head() -> Mesh {
    let lobes = [
        Lobe { toward: [0.0, -1.0, -0.1], height: 0.22, narrow: 45.0 },
        Lobe { toward: [0.35, -1.0, 0.2], height: -0.08, narrow: 40.0 },
        Lobe { toward: [-0.35, -1.0, 0.2], height: -0.08, narrow: 40.0 },
        Lobe { toward: [0.0, -1.0, -0.5], height: -0.05, narrow: 60.0 },
        Lobe { toward: [1.0, 0.1, 0.0], height: 0.2, narrow: 60.0 },
        Lobe { toward: [-1.0, 0.1, 0.0], height: 0.2, narrow: 60.0 },
        Lobe { toward: [0.0, 0.4, -1.0], height: 0.3, narrow: 6.0 },
    ];
    let shape = |toward: DVec3| toward * bumped(toward, &lobes) * DVec3::new(0.75, 0.95, 1.05);
    mesh_of(19, &shape, |sphere| sphere.divide_largest(6, &shape))
}

/// Builds a stand-in for the paper's dolphin: 21,952 faces, closed, about 4 units long, with thin fins.
pub fn dolphin() -> Mesh {
    let fins = [
        Lobe { toward: [0.1, 0.0, 1.0], height: 0.5, narrow: 90.0 },
        Lobe { toward: [0.5, 0.8, -0.5], height: 0.8, narrow: 120.0 },
        Lobe { toward: [0.5, -0.8, -0.5], height: 0.8, narrow: 120.0 },
        Lobe { toward: [-1.0, 0.25, 0.0], height: 0.4, narrow: 150.0 },
        Lobe { toward: [-1.0, -0.25, 0.0], height: 0.4, narrow: 150.0 },
    ];
    let shape = |toward: DVec3| {
        // Thick in front of the middle, thin towards the tail, and bent upwards at both ends.
        let girth = 0.18 + 0.22 * (1.0 + toward.x) * (1.2 - toward.x);
        let at = toward * bumped(toward, &fins) * DVec3::new(2.0, girth, girth);
        at + DVec3::Z * (0.08 * at.x * at.x)
    };
    mesh_of(33, &shape, |sphere| sphere.divide_largest(86, &shape))
}

/// Builds a stand-in for the paper's bunny: 69,451 faces, open at the bottom, about 2.5 units high.
pub fn bunny() -> Mesh {
    let lobes = [
        Lobe { toward: [0.8, 0.0, 0.7], height: 0.45, narrow: 9.0 },
        Lobe { toward: [0.42, 0.28, 1.0], height: 0.75, narrow: 110.0 },
        Lobe { toward: [0.42, -0.28, 1.0], height: 0.75, narrow: 110.0 },
        Lobe { toward: [-1.0, 0.0, -0.2], height: 0.15, narrow: 40.0 },
        Lobe { toward: [0.4, 0.6, -0.8], height: 0.15, narrow: 20.0 },
        Lobe { toward: [0.4, -0.6, -0.8], height: 0.15, narrow: 20.0 },
    ];
    let fur = |toward: DVec3| {
        let wave = |at: f64| 16.0 * at * at * at - 12.0 * at;
        1.0 + 0.004 * wave(toward.x) * wave(toward.y) + 0.003 * wave(toward.z)
    };
    let shape = |toward: DVec3| toward * (bumped(toward, &lobes) * fur(toward)) * DVec3::new(1.1, 0.9, 1.0);
    mesh_of(60, &shape, |sphere| sphere.open_at_the_bottom(69_451))
}
