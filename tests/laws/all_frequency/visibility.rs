//! Compares visibility maps traced by rays with the reference's triangle tests.

use crossbar::all_frequency::paper::AllFrequencyReference;
use crossbar::geom::teapot::teapot;
use crossbar::geom::{Mesh, Sides};
use crossbar::sphere::CUBE_FACES;
use crossbar::tracer::HostTracer;
use crossbar::transfer::Vertices;
use crossbar::transfer::grid::{FINE_DIRECTIONS, FINE_SIDE};
use crossbar::transfer::linear_basis::BasisWidth;
use crossbar::transfer::visibility::{Horizon, VISIBILITY_BYTES, VisibilityMaps, VisibilitySampling};
use glam::DVec3;

use super::{all, clutter, in_threads, trace, vertices};
use crate::environment::by_form;

fn face_row_column(fine: usize) -> [usize; 3] {
    [fine / (FINE_SIDE * FINE_SIDE), fine / FINE_SIDE % FINE_SIDE, fine % FINE_SIDE]
}

/// Distance of a fine direction from the nearest edge of a triangle, or from the plane of a triangle that contains the
/// eye, in pixels of the direction's face.
fn pixels_to_edge(mesh: &Mesh, eye: DVec3, fine: usize) -> f64 {
    let [face, row, column] = face_row_column(fine);
    let axes = CUBE_FACES[face];
    let half = FINE_SIDE as f64 / 2.0;
    let pixel = DVec3::new(column as f64 + 0.5 - half, row as f64 + 0.5 - half, half);
    let of_face = |v: DVec3| DVec3::new(axes.right.dot(v), axes.down.dot(v), axes.center.dot(v));
    let to_line = |normal: DVec3| normal.dot(pixel).abs() / normal.truncate().length();
    let mut nearest = f64::INFINITY;
    for corners in mesh.iter_corners() {
        let corners = corners.map(|corner| of_face(DVec3::from(corner.map(f64::from)) - eye));
        for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(a, b): (usize, usize)| (corners[a], corners[b])) {
            if a.z <= 0.0 && b.z <= 0.0 {
                continue;
            }
            let line = a.cross(b);
            if a.z > 0.0 && b.z > 0.0 {
                // Only the part of the edge between the two cut points counts.
                let [p, q] = [a, b].map(|point| half * point.truncate() / point.z);
                let at = pixel.truncate();
                let along = ((at - p).dot(q - p) / (q - p).length_squared()).clamp(0.0, 1.0);
                nearest = nearest.min(at.distance(p + along * (q - p)));
            } else if line.truncate().length() > 0.0 {
                nearest = nearest.min(to_line(line));
            }
        }
        // The plane of a triangle that nearly contains the eye projects to a line on the face.
        let plane = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        if plane.normalize().dot(corners[0]).abs() < 1e-5 && plane.truncate().length() > 0.0 {
            nearest = nearest.min(to_line(plane));
        }
    }
    nearest
}

/// `count` random meshes, of three sizes in turn, and a teapot.
fn meshes(count: u64) -> Vec<(String, Mesh)> {
    let random =
        (0..count).map(|seed| (format!("clutter {seed}"), clutter(seed, 12, [0.3, 1.0, 3.0][seed as usize % 3])));
    random.chain([("teapot".to_owned(), teapot(2).expect("a teapot"))]).collect()
}

fn some(vertices: &Vertices) -> Vec<u32> {
    all(vertices).into_iter().filter(|vertex| vertices.len() < 40 || vertex % 13 == 0).collect()
}

/// Directions that are not cast are unblocked, also with fewer directions; the bits do not depend on the number of
/// threads. Without the vertex normal's plane as horizon, vertices see more, and nothing else changes. By default, one
/// random mesh per size.
#[test]
fn maps_are_those_of_casting_every_ray_in_any_number_of_threads() {
    for (name, mesh) in meshes(by_form(3, 8)) {
        let vertices = vertices(&mesh);
        let of = some(&vertices);
        let mut caster = HostTracer::new(&mesh, Sides::Both);
        for log2_samples in 0..3 {
            let [by_normal, by_geometry] = [Horizon::Normal, Horizon::Geometry].map(|horizon| {
                let sampling = VisibilitySampling { log2_samples, horizon };
                let expected = VisibilityMaps::trace_all(&vertices, &of, sampling, &mut caster).expect("maps");
                let found = VisibilityMaps::trace_sampled(&vertices, &of, sampling, &mut caster, &mut |_, _| ());
                let found = found.expect("maps");
                assert!(found.words() == expected.words(), "{name}, {sampling:?}");
                let counts = |maps: &VisibilityMaps| (maps.counts.above, maps.counts.visible);
                assert_eq!(counts(&found), counts(&expected), "{name}, {sampling:?}");
                if sampling == VisibilitySampling::default() {
                    assert!(found.counts.traced < expected.counts.traced, "{name}");
                    assert_eq!(found.bits(0).len() * 8, VISIBILITY_BYTES);
                    for threads in [1, 2, 5] {
                        let traced = in_threads(threads, || trace(&mesh, &vertices, &of));
                        assert!(traced.words() == found.words(), "{name}, {threads} threads");
                    }
                }
                found
            });
            let directions = by_normal.sampling().directions().directions();
            assert_eq!(64 * by_normal.bits(0).len(), directions.len());
            for (map, &vertex) in of.iter().enumerate() {
                let normal = vertices.frames()[vertex as usize].normal();
                for (fine, &direction) in directions.iter().enumerate() {
                    let is_above = normal.dot(direction) > 0.0;
                    let expected = is_above && by_geometry.is_visible(map, fine);
                    assert_eq!(by_normal.is_visible(map, fine), expected, "{name}, {log2_samples}, {vertex}, {fine}");
                }
            }
        }
    }
}

/// Bits differ from the reference, which tests triangle by triangle in f64, only if an edge passes within a hundredth
/// of a pixel.
#[test]
fn rays_see_what_the_reference_sees() {
    let (mut compared, mut differ) = (0, 0);
    for (name, mesh) in meshes(8) {
        let vertices = vertices(&mesh);
        let of: Vec<u32> = some(&vertices).into_iter().step_by(5).collect();
        let maps = trace(&mesh, &vertices, &of);
        let product = |_: DVec3, s: DVec3| s.z;
        let reference = AllFrequencyReference {
            vertices: &vertices,
            product: &product,
            light: &[0.0; 6144],
            hats: BasisWidth::OneTexel,
        };
        for (map, &vertex) in of.iter().enumerate() {
            let eye = DVec3::from(vertices.positions()[vertex as usize].map(f64::from));
            for fine in (map % 3..FINE_DIRECTIONS).step_by(3) {
                compared += 1;
                if maps.is_visible(map, fine) != reference.sees(vertex as usize, face_row_column(fine)) {
                    let off = pixels_to_edge(&mesh, eye, fine);
                    assert!(off < 0.01, "{name}, vertex {vertex}, direction {fine}: {off} pixels off");
                    differ += 1;
                }
            }
        }
    }
    assert!(differ < compared / 10_000, "{differ} of {compared}");
}
